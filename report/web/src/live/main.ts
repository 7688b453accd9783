// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { ChartView, LiveData, Placed, ReportData, Series, SurfaceData } from "../data";
import { save } from "../download";
import { formatNumber } from "../numbers";
import type { Store } from "../store";
import { Engine } from "./engine";
import { button, make, Panel, type Check, type Target } from "./panel";
import type { Given, Remark, Solved } from "./solve";
import { BESIDE, besideOf, changed, controls, fromAddress, givenOf, shapeKey, toAddress, tomlOf, type State } from "./state";

/** Elements of the answer while something moves [mm], and when the hand rests [ms]. */
const COARSE_MM = 1;
const REST = 180;
/** Changes of one control that follow so closely are taken back together [ms]. */
const TOGETHER = 800;
const LARGEST_FILE = 20e6;
/** Of a number: what solvers leave open is no difference [%]. */
const LEAST_SHARE = 0.01;
const NAMES = controls.flatMap(({ name }) => (name === "" ? [] : [name]));

/** Of `treadmark geometry`. */
interface Geometry {
  functions: { y_mm: number[]; delta_r_mm: (number | null)[]; wheel_y_right_mm: (number | null)[]; rail_y_right_mm: (number | null)[] };
  conicity: { amplitude_mm: number[]; tan_gamma_e: (number | null)[] };
  conicity_3mm: number | null;
}
const NOTHING: Geometry = {
  functions: { y_mm: [], delta_r_mm: [], wheel_y_right_mm: [], rail_y_right_mm: [] },
  conicity: { amplitude_mm: [], tan_gamma_e: [] },
  conicity_3mm: null,
};

/** What is known of what the reader is at, and of what is beside it. */
class Side {
  /** The last answer, of what, with its wheel and rail. */
  solved: Solved | null = null;
  state: State | null = null;
  surfaces: SurfaceData[] = [];
  /** Over the lateral place, and of which wheel and rail that is. */
  geometry: Geometry = NOTHING;
  geometryOf = "";

  take(solved: Solved, state: State): void {
    [this.solved, this.state] = [solved, state];
    if (solved.surfaces) this.surfaces = solved.surfaces;
  }
}

/** Numbers of an answer: label, value, unit, note. */
function numbersOf({ frame, force }: Solved, { conicity_3mm }: Geometry): [string, number, string, string][] {
  const pressure = frame.patches.reduce((most, { numbers }) => Math.max(Number.isNaN(most) ? 0 : most, numbers["pmax_MPa"] ?? NaN), NaN);
  const wear = frame.patches.reduce((sum, { numbers }) => sum + (numbers["t_gamma_N"] ?? NaN), 0);
  return [
    ["Largest pressure", pressure, "MPa", frame.patches.length === 1 ? "one patch" : `${frame.patches.length} patches`],
    ["Vertical force", force[2] / 1e3, "kN", "on the rail"],
    ["Lateral force", force[1] / 1e3, "kN", "on the rail"],
    ["Longitudinal force", force[0] / 1e3, "kN", "on the rail"],
    ["Wear number Tγ", wear, "N", "of all patches"],
    ["Equivalent conicity", conicity_3mm ?? NaN, "", "amplitude 3 mm"],
  ];
}

function moved(placed: Placed | null, by: number): Placed | null {
  return placed && { ...placed, surface: placed.surface + by };
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
  private readonly here = new Side();
  private readonly there = new Side();
  private besideTrouble = "";

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
    open.accept = ".toml,.json";
    open.dataset["control"] = "open";
    open.setAttribute("aria-label", "Open a case file, or the result file of a run");
    open.addEventListener("change", () => {
      const file = open.files?.[0];
      if (file) this.file("", file);
      open.value = "";
    });
    bar.append(
      button("Undo", "undo", "Take back the last change (Ctrl Z)", () => this.step(this.past, this.future)),
      button("Redo", "redo", "Make it again (Ctrl Shift Z)", () => this.step(this.future, this.past)),
      button("As the case says", "reset", "Take back all changes", () => this.adopt({ ...this.state, changes: new Map<string, string>() })),
      button("Save case.toml", "save", "A file that treadmark run solves to the same numbers", () => void this.save()),
      make("span", "", "Open a case:"),
      open,
    );
    const messages = make("div", "live-messages");
    messages.setAttribute("aria-live", "polite");
    messages.append(this.trouble, this.warnings);
    this.section.append(bar, this.panel.element, messages, this.cards);
    document.querySelector("#beside > h2")?.after(this.panel.beside);
    this.reveal();
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
    this.follow({ ...this.state, changes: changed(this.state.changes, key, value) });
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

  file(where: string, file: File): void {
    void this.read(where, file).catch((error: unknown) => this.complain(error instanceof Error ? error.message : String(error)));
  }

  private async read(where: string, file: File): Promise<void> {
    if (file.size > LARGEST_FILE) return this.complain(`${file.name} has ${formatNumber(file.size / 1e6, 3)} MB: no profile and no case is so large.`);
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.toml$/i.test(file.name)) return this.open(new TextDecoder().decode(bytes), file.name);
    if (/\.json$/i.test(file.name)) return this.open(caseOf(new TextDecoder().decode(bytes)), file.name);
    const side = where.startsWith(BESIDE) ? BESIDE : "";
    const name = await this.engine.addFile(file.name.replace(/[^\w.+-]+/g, "_"), bytes);
    const { json, trouble } = await this.engine.ask({ kind: "check", name, body: where.slice(side.length) });
    if (trouble !== undefined) return this.complain(`${file.name} was not taken: ${trouble}`);
    const check = json as Check;
    const known = check.body === "wheel" ? "wheel" : "rail";
    this.panel.learn(known, name, check);
    this.change(shapeKey(side + known, "file"), name);
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
    const { solved, trouble } = await this.engine.ask({ kind: "solve", given: givenOf(state), element, name: "", names: NAMES, beside: false });
    if (solved) {  // on the way to another state, too: a hand that moves shall see something
      this.good = state;
      this.here.take(solved, state);
      this.show(state === this.state);
      if (state === this.state) this.learn(solved.numbers);
      await this.solveBeside(state, element);
    } else if (state === this.state) {
      this.refuse(trouble ?? "nothing came back");
    }
    this.busy = false;
    if (this.wanted !== undefined) return void this.solve(this.wanted);
    if (state !== this.state || !solved) return;  // its request comes, or there is none
    if (solved.coarse || this.there.solved?.coarse) this.timer = window.setTimeout(() => this.request(null), REST);
    else this.rest(state);
  }

  /** The same place with what the reader chose beside it, unless there is another place by now. */
  private async solveBeside(state: State, element: number | null): Promise<void> {
    const other = besideOf(state);
    const shown = this.there.solved !== null || this.besideTrouble !== "";
    if ((!other && !shown) || this.wanted !== undefined || state !== this.state) return;
    const { solved, trouble = "nothing came back" } = other
      ? await this.engine.ask({ kind: "solve", given: givenOf(other), element, name: "", names: [], beside: true })
      : { trouble: "" };
    this.besideTrouble = solved ? "" : trouble;
    if (solved) this.there.take(solved, state);
    else this.there.solved = null;
    this.show(state === this.state);
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
    else if (this.here.solved?.coarse) this.request(null);
    else if (this.here.solved) this.rest(this.good);
  }

  private complain(text: string): void {
    const banner = make("div", "banner failed", text);
    banner.setAttribute("role", "alert");
    this.trouble.replaceChildren(banner);
    document.body.dataset["live"] = "trouble";
  }

  /** Answers go to the views. `current`: there is no other state yet. */
  private show(current: boolean): void {
    const { here, there, store } = this;
    const { data } = store;
    const { solved } = here;
    if (!solved) return;
    const name = data.sets[0]?.frames[0]?.name ?? "";
    data.sets[0]!.frames = [{ ...solved.frame, name }];
    if (data.sets[1]) {
      const frame = there.solved?.frame;
      const by = here.surfaces.length;
      data.sets[1].frames = frame ? [{ ...frame, name, wheel: moved(frame.wheel, by), rail: moved(frame.rail, by) }] : [];
    }
    data.surfaces = [...here.surfaces, ...there.surfaces];
    this.mark();
    store.renew();
    this.reveal();
    this.warn();
    this.fillCards();
    if (!current) return;
    const { dataset } = document.body;
    Object.assign(dataset, { live: solved.coarse ? "coarse" : "fine", pressure: String(numbersOf(solved, NOTHING)[0]![1]) });
    dataset["beside"] = there.solved ? String(numbersOf(there.solved, NOTHING)[0]![1]) : this.besideTrouble;
  }

  /** What is beside it is there to be seen where there is anything. */
  private reveal(): void {
    for (const figure of document.querySelectorAll<HTMLElement>("#beside > figure")) figure.hidden = !this.there.solved;
  }

  /** What answers warn of. */
  private warn(): void {
    const banners: HTMLElement[] = [];
    for (const [before, { solved }] of [["", this.here], ["Beside it: ", this.there]] as const) {
      if (!solved) continue;
      const { frame, remarks } = solved;
      if (frame.status !== "ok") banners.push(make("div", "banner warning", before + (frame.message || frame.status)));
      banners.push(...remarks.map((remark) => this.remark(remark, before)));
    }
    if (this.besideTrouble !== "") banners.unshift(make("div", "banner failed", `Beside it: ${this.besideTrouble}`));
    this.warnings.replaceChildren(...banners);
  }

  private fillCards(): void {
    const { here, there } = this;
    if (!here.solved) return;
    const others = there.solved && numbersOf(there.solved, there.geometry);
    const said = (value: number, unit: string): string => (Number.isNaN(value) ? "–" : unit === "" ? formatNumber(value) : `${formatNumber(value)} ${unit}`);
    const entries = numbersOf(here.solved, here.geometry).map(([label, value, unit, note], k): [string, string, string] => {
      const other = others?.[k]?.[1];
      if (other === undefined) return [label, said(value, unit), note];
      const share = (100 * (other - value)) / Math.abs(value);
      const differ = here.state === there.state && Math.abs(share) >= LEAST_SHARE && Number.isFinite(share) ? ` (${share < 0 ? "−" : "+"}${formatNumber(Math.abs(share), 3)} %)` : "";
      return [label, said(value, unit), `${note}; beside ${said(other, unit)}${differ}`];
    });
    const { milliseconds, coarse } = here.solved;
    entries.push(["Solved in", `${formatNumber(milliseconds, 3)} ms`, coarse ? `elements of ${COARSE_MM} mm` : "elements as the case says"]);
    this.cards.replaceChildren(
      ...entries.map(([label, value, note]) => {
        const card = make("div", "card");
        card.append(make("span", "card-label", label), make("span", "card-value", value), make("span", "card-note", note));
        return card;
      }),
    );
  }

  private remark({ text, patch, grave }: Remark, before: string): HTMLElement {
    const banner = make("div", grave ? "banner warning" : "banner note");
    banner.append(make("strong", "", grave ? "Warning:" : "Minor warning:"), ` ${before}${patch > 0 ? `patch ${patch}: ` : ""}${text}`);
    return banner;
  }

  // ---- over the lateral place ----

  private chart(id: string): ChartView | undefined {
    return this.store.data.views.find((one): one is ChartView => one.type === "chart" && one.id === id);
  }

  /** The present place among the rolling radii. */
  private mark(): void {
    const y = 1e3 * (this.here.solved?.numbers["wheelset.y"] ?? NaN);
    const { y_mm, delta_r_mm } = this.here.geometry.functions;
    const at = y_mm.reduce((best, value, k) => (Math.abs(value - y) < Math.abs(y_mm[best]! - y) ? k : best), 0);
    const place = this.chart("rolling-radii")?.panels[0]?.series[1];
    if (place) [place.x, place.y] = [[y], [delta_r_mm[at] ?? null]];
  }

  /** Rolling radii, contact and conicity, where wheel or rail are others. */
  private async renewGeometry(state: State): Promise<void> {
    let renewed = false;
    for (const [side, one] of [[this.here, state], [this.there, besideOf(state)]] as const) {
      const given = one && givenOf(one);
      const key = given ? JSON.stringify([given.toml, given.number, given.changes.filter((change) => /^(wheel\.|rail\.|track\.|wheelset\.nominal)/.test(change))]) : "";
      if (key === side.geometryOf) continue;
      side.geometryOf = key;
      side.geometry = given ? await this.geometry(given) : NOTHING;
      renewed = true;
    }
    if (!renewed) return;
    const [here, there] = [this.here.geometry, this.there.geometry];
    const { y_mm, delta_r_mm, rail_y_right_mm, wheel_y_right_mm } = here.functions;
    this.fill("rolling-radii", y_mm, [
      [{ y: delta_r_mm }, {}, { x: there.functions.y_mm, y: there.functions.delta_r_mm }],
      [{ y: rail_y_right_mm }, { y: wheel_y_right_mm }],
    ]);
    const at3 = here.conicity_3mm === null ? [] : [3];
    this.fill("conicity", here.conicity.amplitude_mm, [
      [{ y: here.conicity.tan_gamma_e }, { x: at3, y: at3.map(() => here.conicity_3mm) }, { x: there.conicity.amplitude_mm, y: there.conicity.tan_gamma_e }],
    ]);
    this.mark();
    this.fillCards();
    this.store.renew();
  }

  /** Other numbers for a chart: its abscissae, and of each panel what of its series is new. */
  private fill(id: string, x: number[], panels: Pick<Partial<Series>, "x" | "y">[][]): void {
    const view = this.chart(id);
    if (!view) return;
    if (view.x) view.x.values = x;
    panels.forEach((rows, p) => rows.forEach((row, k) => Object.assign(view.panels[p]?.series[k] ?? {}, row)));
  }

  private async geometry(given: Given): Promise<Geometry> {
    const { json } = await this.engine.ask({ kind: "geometry", given });
    return (json as { geometry?: Geometry } | undefined)?.geometry ?? NOTHING;
  }
}

/** The case of a result file as text. Errors: words for who opened it. */
function caseOf(json: string): string {
  let result: unknown = null;
  try {
    result = JSON.parse(json);
  } catch {
    throw new Error("the file is no JSON");
  }
  const toml = tomlOf(result);
  if (toml === null) throw new Error("the file holds no case: result.json of treadmark run does, of up to 100 of a wheel on a rail");
  return toml;
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
