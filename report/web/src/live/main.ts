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
const NAMES = controls.flatMap(({ name }) => (name === "" ? [] : [name]));

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
  /** Over the lateral place: of which wheel and rail it is, and what. */
  private geometryOf = "";
  private geometry: Functions | null = null;

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
    this.request(COARSE_MM);  // before the fields, so that it is solved while they are drawn
    this.refresh();
  }

  private refresh(): void {
    this.panel.refresh(this.state.changes, this.numbers, this.own);
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
    const { trouble } = await this.engine.ask({ kind: "text", given: { toml, changes: [] } });
    if (trouble !== undefined) return this.complain(`${name} was not opened: ${trouble}`);
    this.adopt({ toml, changes: new Map<string, string>() });
  }

  private async save(): Promise<void> {
    const { text, trouble } = await this.engine.ask({ kind: "text", given: givenOf(this.state) });
    if (text !== undefined) save(new Blob([text], { type: "text/plain" }), "case.toml");
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
    const { solved, trouble } = await this.engine.ask({ kind: "solve", given: givenOf(state), element, name: "", names: NAMES });
    this.busy = false;
    const current = state === this.state;
    if (solved) {  // on the way to another state, too: a hand that moves shall see something
      this.good = state;
      this.show(solved, current);
      if (current) this.learn(solved.numbers);
    } else if (current) {
      this.refuse(trouble ?? "nothing came back");
    }
    if (this.wanted !== undefined) return void this.solve(this.wanted);
    if (!current || !solved) return;  // its request comes, or there is none
    if (solved.coarse) this.timer = window.setTimeout(() => this.request(null), REST);
    else this.rest(state);
  }

  /** What the case says goes to the fields. */
  private learn(numbers: Record<string, number>): void {
    this.numbers = numbers;
    this.refresh();
  }

  /** What can wait until nothing moves: browsers take few changes of an address in a second. */
  private rest(state: State): void {
    history.replaceState(null, "", this.address(state));
    void this.renewGeometry(state);
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
  private show({ frame, surfaces, remarks, force, milliseconds, numbers, coarse }: Solved, current: boolean): void {
    const { data } = this.store;
    frame.name = data.sets[0]?.frames[0]?.name ?? "";
    data.sets[0]!.frames = [frame];
    if (surfaces) data.surfaces = surfaces;
    this.mark(1e3 * (numbers["wheelset.y"] ?? NaN));
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
      ["Solved in", `${formatNumber(milliseconds, 3)} ms`, coarse ? `elements of ${COARSE_MM} mm` : "elements as the case says"],
    ];
    this.cards.replaceChildren(
      ...entries.map(([label, value, note]) => {
        const card = make("div", "card");
        card.append(make("span", "card-label", label), make("span", "card-value", value), make("span", "card-note", note));
        return card;
      }),
    );
    if (current) Object.assign(document.body.dataset, { live: coarse ? "coarse" : "fine", pressure: String(pressure) });
  }

  private remark({ text, patch, grave }: Remark): HTMLElement {
    const banner = make("div", grave ? "banner warning" : "banner note");
    banner.append(make("strong", "", grave ? "Warning:" : "Minor warning:"), ` ${patch > 0 ? `patch ${patch}: ` : ""}${text}`);
    return banner;
  }

  private get chart(): ChartView | undefined {
    return this.store.data.views.find((one): one is ChartView => one.type === "chart");
  }

  /** The present place [mm] among the rolling radii. */
  private mark(y: number): void {
    const here = this.chart?.panels[0]?.series[1];
    const { geometry } = this;
    if (!here || !geometry) return;
    const at = geometry.y_mm.reduce((best, value, k) => (Math.abs(value - y) < Math.abs(geometry.y_mm[best]! - y) ? k : best), 0);
    [here.x, here.y] = [[y], [geometry.delta_r_mm[at] ?? null]];
  }

  /** Rolling radii and contact over y, where wheel or rail are others. */
  private async renewGeometry(state: State): Promise<void> {
    const { chart: view } = this;
    const given = givenOf(state);
    const key = JSON.stringify([given.toml, given.changes.filter((change) => /^(wheel\.|rail\.|track\.|wheelset\.nominal)/.test(change))]);
    if (!view || key === this.geometryOf) return;
    const { json } = await this.engine.ask({ kind: "geometry", given });
    this.geometry = (json as { geometry?: { functions?: Functions } } | undefined)?.geometry?.functions ?? null;
    this.geometryOf = key;
    const { y_mm = [], delta_r_mm = [], rail_y_right_mm = [], wheel_y_right_mm = [] } = this.geometry ?? {};
    view.x!.values = y_mm;
    for (const [series, values] of [
      [view.panels[0]?.series[0], delta_r_mm],
      [view.panels[1]?.series[0], rail_y_right_mm],
      [view.panels[1]?.series[1], wheel_y_right_mm],
    ] as const)
      if (series) series.y = values;
    this.mark(1e3 * (this.numbers["wheelset.y"] ?? NaN));
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
