// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { ChartView, LiveData, ReportData } from "../data";
import { save } from "../download";
import { formatNumber } from "../numbers";
import type { Store } from "../store";
import { Engine } from "./engine";
import { button, make, Panel, type Check, type Target } from "./panel";
import type { Remark, Solved } from "./solve";
import { changed, controls, fromAddress, givenOf, shapeKey, toAddress, type State } from "./state";

/** Elements of the answer while something moves [mm], and when the hand rests [ms]. */
const COARSE_MM = 1;
const REST = 180;
/** Changes of one control that follow so closely are taken back together [ms]. */
const TOGETHER = 800;
const LARGEST_FILE = 20e6;
const NAMES = [...controls.flatMap(({ name }) => (name === "" ? [] : [name])), "discretisation.dx"];

interface Functions {
  y_mm: number[];
  delta_r_mm: (number | null)[];
  wheel_y_right_mm: (number | null)[];
  rail_y_right_mm: (number | null)[];
}

class Live implements Target {
  private readonly engine: Engine;
  private readonly panel: Panel;
  /** What is wrong with the last change, and what the answer warns of. */
  private readonly trouble = make("div", "");
  private readonly warnings = make("div", "");
  private readonly cards = make("div", "cards");
  private state: State;
  private numbers: Record<string, number> = {};
  /** What was solved last without trouble. */
  private good: State;
  private readonly past: State[] = [];
  private readonly future: State[] = [];
  /** The control that was changed last, and when. */
  private own = "";
  private touched = 0;
  private busy = false;
  private wanted: number | null | undefined;
  private timer = 0;
  private geometryOf = "";

  constructor(
    private readonly section: HTMLElement,
    private readonly store: Store,
    private readonly live: LiveData,
  ) {
    this.engine = new Engine(live);
    this.good = { toml: live.toml, changes: new Map<string, string>() };
    this.state = fromAddress(location.hash, live.toml) ?? this.good;
    this.panel = new Panel(live, this);
    const bar = make("div", "controls live-bar");
    const open = make("input", "");
    open.type = "file";
    open.accept = ".toml";
    open.dataset["control"] = "open";
    open.setAttribute("aria-label", "Open a case file");
    open.addEventListener("change", () => {
      const file = open.files?.[0];
      if (file) this.file("", file);
      open.value = "";
    });
    bar.append(
      button("Undo", "undo", "Take back the last change (Ctrl Z)", () => this.step(this.past, this.future)),
      button("Redo", "redo", "Make it again (Ctrl Shift Z)", () => this.step(this.future, this.past)),
      button("As the case says", "reset", "Take back all changes", () => this.adopt({ toml: this.state.toml, changes: new Map<string, string>() })),
      button("Save case.toml", "save", "A file that treadmark run solves to the same numbers", () => void this.save()),
      make("span", "", "Open a case:"),
      open,
    );
    const messages = make("div", "live-messages");
    messages.setAttribute("aria-live", "polite");
    messages.append(this.trouble, this.warnings);
    this.section.append(bar, this.panel.element, messages, this.cards);
    this.listen();
    this.follow(this.state);
  }

  private listen(): void {
    for (const name of ["dragover", "drop"] as const)
      document.addEventListener(name, (event) => {
        event.preventDefault();
        const file = event.dataTransfer?.files[0];
        if (name === "drop" && file) this.file("", file);
      });
    document.addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
      event.preventDefault();
      if (event.shiftKey) this.step(this.future, this.past);
      else this.step(this.past, this.future);
    });
    window.addEventListener("hashchange", () => {
      const state = fromAddress(location.hash, this.live.toml);
      if (state && this.address(state) !== this.address(this.state)) this.adopt(state);
    });
  }

  private address(state: State): string {
    return `#${toAddress(state, this.live.toml)}`;
  }

  /** Elements of the first answer: coarser ones than the case has. */
  private get first(): number | null {
    const own = 1e3 * (this.numbers["discretisation.dx"] ?? NaN);
    return own >= COARSE_MM ? null : COARSE_MM;
  }

  /** The numbers of the case with its changes go to the fields. */
  private async tell(): Promise<void> {
    const { said } = await this.engine.ask({ kind: "said", given: givenOf(this.state), names: NAMES });
    if (said) this.numbers = said.numbers;
    this.panel.refresh(this.state.changes, this.numbers, this.own);
  }

  // ---- changes ----

  change(key: string, value: string): void {
    const now = performance.now();
    if (key !== this.own || now - this.touched > TOGETHER) this.past.push(this.state);
    [this.own, this.touched] = [key, now];
    this.trouble.replaceChildren();
    this.future.length = 0;
    const { toml, changes } = this.state;
    this.follow({ toml, changes: changed(changes, key, value) });
  }

  private adopt(state: State): void {
    this.past.push(this.state);
    this.future.length = 0;
    this.own = "";
    this.trouble.replaceChildren();
    this.follow(state);
  }

  private step(from: State[], to: State[]): void {
    const next = from.pop();
    if (!next) return;
    to.push(this.state);
    this.own = "";
    this.trouble.replaceChildren();
    this.follow(next);
  }

  private follow(state: State): void {
    this.state = state;
    void this.tell().then(() => this.request(this.first));
  }

  // ---- files ----

  file(body: string, file: File): void {
    void this.read(body, file).catch((error: unknown) => this.complain(error instanceof Error ? error.message : String(error)));
  }

  private async read(body: string, file: File): Promise<void> {
    if (file.size > LARGEST_FILE) return this.complain(`${file.name} has ${formatNumber(file.size / 1e6, 3)} MB: no profile and no case is so large.`);
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.toml$/i.test(file.name)) return this.open(new TextDecoder().decode(bytes), file.name);
    const name = await this.engine.addFile(file.name.replace(/[^\w.+-]+/g, "_"), bytes);
    const { json, trouble } = await this.engine.ask({ kind: "check", name, body });
    if (trouble !== undefined) return this.complain(`${file.name} was not taken: ${trouble}`);
    const check = json as Check;
    const known = check.body === "wheel" ? "wheel" : "rail";
    this.panel.learn(known, name, check);
    this.change(shapeKey(known, "file"), name);
  }

  private async open(toml: string, name: string): Promise<void> {
    const { trouble } = await this.engine.ask({ kind: "said", given: { toml, changes: [] }, names: [] });
    if (trouble !== undefined) return this.complain(`${name} was not opened: ${trouble}`);
    this.adopt({ toml, changes: new Map<string, string>() });
  }

  private async save(): Promise<void> {
    const { said, trouble } = await this.engine.ask({ kind: "said", given: givenOf(this.state), names: [] });
    if (said) save(new Blob([said.toml], { type: "text/plain" }), "case.toml");
    else this.complain(`The case cannot be written: ${trouble ?? ""}`);
  }

  // ---- solving ----

  /** One task at a time; of those that come meanwhile the last one counts. */
  private request(element: number | null): void {
    clearTimeout(this.timer);
    if (this.busy) this.wanted = element;
    else void this.solve(element);
  }

  private async solve(element: number | null): Promise<void> {
    this.busy = true;
    this.wanted = undefined;
    const { state } = this;
    const { solved, trouble } = await this.engine.ask({ kind: "solve", given: givenOf(state), element, name: "" });
    this.busy = false;
    const current = state === this.state;
    if (solved) {  // on the way to another state, too: a hand that moves shall see something
      this.good = state;
      this.show(solved, element, current);
      history.replaceState(null, "", this.address(state));
    } else if (current) {
      this.refuse(trouble ?? "nothing came back");
    }
    if (this.wanted !== undefined) return void this.solve(this.wanted);
    if (!current || !solved) return;  // its request comes, or there is none
    if (element !== null) this.timer = window.setTimeout(() => this.request(null), REST);
    else void this.showGeometry(state);
  }

  /** The last good state stays, what was typed stays to be mended. */
  private refuse(trouble: string): void {
    this.complain(trouble);
    const begins = this.cards.childElementCount === 0 && this.state !== this.good;  // by an address that does not hold here
    this.state = this.good;
    this.own = "";
    if (this.past[this.past.length - 1] === this.good) this.past.pop();
    if (begins) this.follow(this.good);
  }

  private complain(text: string): void {
    const banner = make("div", "banner failed", text);
    banner.setAttribute("role", "alert");
    this.trouble.replaceChildren(banner);
    document.body.dataset["live"] = "trouble";
  }

  /** `current`: there is no other state yet. */
  private show({ frame, surfaces, remarks, force, milliseconds }: Solved, element: number | null, current: boolean): void {
    const { data } = this.store;
    frame.name = data.sets[0]?.frames[0]?.name ?? "";
    data.sets[0]!.frames = [frame];
    if (surfaces) data.surfaces = surfaces;
    this.store.renew();
    this.warnings.replaceChildren(...remarks.map((remark) => this.remark(remark)));
    if (frame.status !== "ok") this.warnings.prepend(make("div", "banner warning", frame.message || frame.status));
    const pressure = frame.patches.reduce((most, { numbers }) => Math.max(Number.isNaN(most) ? 0 : most, numbers["pmax_MPa"] ?? NaN), NaN);
    const wear = frame.patches.reduce((sum, { numbers }) => sum + (numbers["t_gamma_N"] ?? NaN), 0);
    const entries: [string, string, string][] = [
      ["Largest pressure", `${formatNumber(pressure)} MPa`, frame.patches.length === 1 ? "one patch" : `${frame.patches.length} patches`],
      ["Vertical force", `${formatNumber(force[2] / 1e3)} kN`, "on the rail"],
      ["Lateral force", `${formatNumber(force[1] / 1e3)} kN`, "on the rail"],
      ["Longitudinal force", `${formatNumber(force[0] / 1e3)} kN`, "on the rail"],
      ["Wear number Tγ", `${formatNumber(wear)} N`, "of all patches"],
      ["Solved in", `${formatNumber(milliseconds, 3)} ms`, element === null ? "elements as the case says" : `elements of ${element} mm`],
    ];
    this.cards.replaceChildren(
      ...entries.map(([label, value, note]) => {
        const card = make("div", "card");
        card.append(make("span", "card-label", label), make("span", "card-value", value), make("span", "card-note", note));
        return card;
      }),
    );
    if (current) Object.assign(document.body.dataset, { live: element === null ? "fine" : "coarse", pressure: String(pressure) });
  }

  private remark({ text, patch, grave }: Remark): HTMLElement {
    const banner = make("div", grave ? "banner warning" : "banner note");
    banner.append(make("strong", "", grave ? "Warning:" : "Minor warning:"), ` ${patch > 0 ? `patch ${patch}: ` : ""}${text}`);
    return banner;
  }

  /** Rolling radii and contact over y, with the present place. */
  private async showGeometry(state: State): Promise<void> {
    const view = this.store.data.views.find((one): one is ChartView => one.type === "chart");
    if (!view) return;
    const y = 1e3 * (this.numbers["wheelset.y"] ?? NaN);
    const given = givenOf(state);
    const key = JSON.stringify([given.toml, given.changes.filter((change) => /^(wheel\.|rail\.|track\.|wheelset\.nominal)/.test(change))]);
    if (key !== this.geometryOf) {
      const { json } = await this.engine.ask({ kind: "geometry", given });
      const functions = (json as { geometry?: { functions?: Functions } } | undefined)?.geometry?.functions;
      this.geometryOf = key;
      const all = functions ? [functions.delta_r_mm, functions.rail_y_right_mm, functions.wheel_y_right_mm] : [[], [], []];
      view.x!.values = functions?.y_mm ?? [];
      [view.panels[0]?.series[0], view.panels[1]?.series[0], view.panels[1]?.series[1]].forEach((series, k) => {
        if (series) series.y = all[k]!;
      });
    }
    const mark = view.panels[0]?.series[1];
    const places = view.x!.values as number[];
    const at = places.reduce((best, value, k) => (Math.abs(value - y) < Math.abs(places[best]! - y) ? k : best), 0);
    if (mark) [mark.x, mark.y] = [[y], [(view.panels[0]!.series[0]!.y as (number | null)[])[at] ?? null]];
    this.store.renew();
  }
}

window.addEventListener("treadmark-report", (event) => {
  const store = (event as CustomEvent<Store>).detail;
  const data: ReportData = store.data;
  const section = document.getElementById("given");
  if (!data.live || !section) return;
  try {
    new Live(section, store, data.live);
  } catch (error) {
    section.append(make("p", "view-note failed", `This page cannot solve: ${error instanceof Error ? error.message : String(error)}`));
  }
});
