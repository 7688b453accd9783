// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { linearTicks } from "./chart/scale";
import { seriesDash } from "./colours";
import { contactBox, edgesOf } from "./contact/fields";
import { byLoad, toTrack, type Vector } from "./contact/place";
import { standalone, svg, textWidth } from "./contact/svg";
import { brief } from "./contact/text";
import { quoted } from "./csv";
import type { Frame, Patch, Placed, SectionView, SurfaceData } from "./data";
import { addDownloads } from "./download";
import { decode, type Decoded } from "./packed";
import { copyOf, onPaper, PAPER_WIDTH } from "./print";
import type { Store } from "./store";
import { svgToPng } from "./svg";

/** (y, z) of the track, NaN where there is no surface [mm]. */
export type Section = [number, number][];

/** Where the lines along a body, from station to station, pass x of the track; of a wheel's two places the lower one. */
export function sectionAt(surface: SurfaceData, at: Placed, x: number, blobs: string[]): Section {
  const [px, py, pz] = [decode(surface.x, blobs), decode(surface.y, blobs), decode(surface.z, blobs)] as [Decoded, Decoded, Decoded];
  const { nu, nv, closed } = surface;
  const { origin_mm: o, rotation: r } = at;
  const along = (k: number): number => o[0] + r[0]! * px[k]! + r[1]! * py[k]! + r[2]! * pz[k]!;
  const out: Section = [];
  for (let iv = 0; iv < nv; ++iv) {
    let best: [number, number] = [NaN, NaN];
    let xb = along(iv);
    for (let iu = 0; iu + 1 < nu + (closed ? 1 : 0); ++iu) {  // no lists in here: it takes most of the time of a picture
      const a = iu * nv + iv;
      const b = ((iu + 1) % nu) * nv + iv;
      const xa = xb;
      xb = along(b);
      if (!((xa - x) * (xb - x) <= 0) || xa === xb) continue;
      const t = (x - xa) / (xb - xa);
      const qx = px[a]! + t * (px[b]! - px[a]!);
      const qy = py[a]! + t * (py[b]! - py[a]!);
      const qz = pz[a]! + t * (pz[b]! - pz[a]!);
      const z = o[2] + r[6]! * qx + r[7]! * qy + r[8]! * qz;
      if (z <= best[1]) continue;
      best = [o[1] + r[3]! * qx + r[4]! * qy + r[5]! * qz, z];
    }
    out.push(best);
  }
  return out;
}

/** Names of the sides of the rail at the lower and the upper end of y; none near the track's centre, where there is no such rail. */
export function sideNames(y: number): [string, string] | null {
  if (!(Math.abs(y) > 200)) return null;
  return y > 0 ? ["gauge side", "field side"] : ["field side", "gauge side"];
}

/** A contact in the plane of the section. */
export interface Mark {
  patch: Patch;
  /** The contact reference, and where contact ends across, at the reference's x. */
  at: Vector;
  ends: [Vector, Vector] | null;
}

export interface Cut {
  /** Plane of the section in track [mm]. */
  x: number;
  rail: Section;
  wheel: Section;
  /** The most loaded one first. */
  marks: Mark[];
}

/**
 * Wheel and rail of a frame cut across the track through its most loaded contact; without contact, below the axle. `plane`: at
 * this x instead.
 */
export function cutOf(frame: Frame, surfaces: readonly SurfaceData[], blobs: string[], plane?: number): Cut | null {
  const marks = byLoad(frame).map((k): Mark => {
    const patch = frame.patches[k]!;
    const [x, s] = patch.reference_mm;
    const contact = contactBox(patch, blobs);
    const box = contact && edgesOf(patch, contact);
    return { patch, at: toTrack(patch, x, s), ends: box && [toTrack(patch, x, box.y0), toTrack(patch, x, box.y1)] };
  });
  const x = plane ?? marks[0]?.at[0] ?? frame.wheel?.origin_mm[0];
  if (x === undefined) return null;
  const section = (body: Placed | null): Section => {
    const surface = body && surfaces[body.surface];
    return surface ? sectionAt(surface, body, x, blobs) : [];
  };
  return { x, rail: section(frame.rail), wheel: section(frame.wheel), marks };
}

/** A body of a section as a filled path: from its curve to `end`, the edge of the picture that lies inside it. */
export function drawBody(parent: SVGElement, curve: readonly [number, number][], end: number, colour: string, width = 1.5): void {
  const points = curve.filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y)).map(([x, y]) => [x.toFixed(1), y.toFixed(1)] as const);
  if (points.length < 2) return;
  const path = points.map((point) => point.join(" ")).join("L");
  svg("path", { d: `M${points[0]![0]} ${end}L${path}L${points.at(-1)![0]} ${end}z`, fill: colour, "fill-opacity": 0.16 }, parent);
  svg("path", { d: `M${path}`, stroke: colour, "stroke-width": width }, parent);
}

/** A body of another result as a dashed line. */
function drawOther(parent: SVGElement, curve: readonly [number, number][], colour: string, dash: string): void {
  const points = curve.filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y)).map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`);
  if (points.length > 1) svg("path", { class: "section-other", d: `M${points.join("L")}`, stroke: colour, "stroke-width": 2, "stroke-dasharray": dash }, parent);
}

const LEFT = 52;
const TOP = 40;
const RIGHT = 10;
const FOOT = 44;
/** Beyond the curves [mm]. */
const AROUND = 4;
const MOST_WIDTH = 860;
const LEAST_HEIGHT = 120;
const MOST_HEIGHT = 520;
/** Length of the normals [px]. */
const NORMAL = 46;

/** Wheel and rail in the plane of the contact, both axes to one scale, with contacts, their widths, normals and forces. */
class SectionFigure {
  private readonly drawing = svg("svg", { class: "section-view", "font-family": "var(--sans)", "font-size": 11.5, role: "img" });
  private drawnWidth = 0;
  private visible = true;
  private stale = false;
  private shown: Cut | null = null;
  private others: { name: string; cut: Cut }[] = [];

  constructor(
    figure: HTMLElement,
    frame: HTMLElement,
    private readonly view: SectionView,
    private readonly store: Store,
  ) {
    frame.replaceChildren(this.drawing);
    this.draw(Math.max(200, Math.floor(frame.clientWidth)));  // at once: what is below shall not jump
    const fit = (): void => {
      const width = Math.floor(frame.clientWidth);
      if (width > 0 && width !== this.drawnWidth) this.draw(width);
    };
    new ResizeObserver(fit).observe(frame);
    store.onStep(() => this.draw(this.drawnWidth));
    new IntersectionObserver(
      (entries) => {
        this.visible = entries.some(({ isIntersecting }) => isIntersecting);
        if (this.visible && this.stale) this.draw(this.drawnWidth);
      },
      { rootMargin: "300px" },
    ).observe(frame);
    store.onRenewal(() => {
      if (this.visible) this.draw(this.drawnWidth);
      else this.stale = true;
    });
    window.addEventListener("beforeprint", () => this.draw(PAPER_WIDTH));
    onPaper(figure, store, (suffix) => {
      this.draw(PAPER_WIDTH);
      return [copyOf(this.drawing, suffix)];
    });
    window.addEventListener("afterprint", () => this.draw(Math.floor(frame.clientWidth)));
  }

  private draw(width: number): void {
    this.drawnWidth = width;
    this.stale = false;
    const { drawing, view } = this;
    const { data } = this.store;
    const frame = data.sets[view.set]?.frames[this.store.frame() ?? -1];
    const cut = frame ? cutOf(frame, data.surfaces, data.blobs) : null;
    this.shown = cut;
    const others = (view.over ?? []).map((k) => ({ name: data.sets[k]?.name ?? "", frame: data.sets[k]?.frames[this.store.frame() ?? -1] }));
    this.others = others.flatMap(({ name, frame: one }) => {
      const other = one && cut && cutOf(one, data.surfaces, data.blobs, cut.x);
      return other ? [{ name, cut: other }] : [];
    });
    const all = cut ? [cut, ...this.others.map((other) => other.cut)] : [];
    const bodies = all.flatMap(({ rail, wheel }) => [...rail, ...wheel]).filter(([y, z]) => Number.isFinite(y) && Number.isFinite(z));
    drawing.replaceChildren();
    if (!cut || bodies.length === 0) {
      this.resize(width, 40);
      const words = "No surfaces of wheel and rail at this step.";
      svg("text", { x: 4, y: 24, fill: "var(--muted)" }, drawing).textContent = words;
      drawing.setAttribute("aria-label", words);
      return;
    }
    const [ys, zs] = [bodies.map(([y]) => y), bodies.map(([, z]) => z)];
    const [y0, y1] = [Math.min(...ys) - AROUND, Math.max(...ys) + AROUND];
    const [z0, z1] = [Math.min(...zs) - AROUND, Math.max(...zs) + AROUND];
    const room = Math.min(MOST_WIDTH, width - LEFT - RIGHT);
    const scale = Math.min(room / (y1 - y0), MOST_HEIGHT / (z1 - z0));
    const [w, h] = [scale * (y1 - y0), Math.max(LEAST_HEIGHT, scale * (z1 - z0))];
    const across = (y: number): number => LEFT + (y - y0) * scale;
    const down = (z: number): number => TOP + h / 2 + (z - (z0 + z1) / 2) * scale;
    this.resize(width, Math.ceil(TOP + h + FOOT));
    const clip = svg("clipPath", { id: `${view.id}-clip` }, drawing);
    svg("rect", { x: LEFT, y: TOP, width: w, height: h }, clip);
    const inside = svg("g", { "clip-path": `url(#${view.id}-clip)`, fill: "none", "stroke-linejoin": "round" }, drawing);
    const placed = (curve: Section): [number, number][] => curve.map(([y, z]) => [across(y), down(z)]);
    drawBody(inside, placed(cut.rail), TOP + h, "var(--series-1)", 2);
    drawBody(inside, placed(cut.wheel), TOP, "var(--series-2)", 2);
    this.others.forEach(({ cut: other }, k) => {
      drawOther(inside, placed(other.rail), "var(--series-1)", seriesDash(k + 1));
      drawOther(inside, placed(other.wheel), "var(--series-2)", seriesDash(k + 1));
    });
    svg("rect", { x: LEFT, y: TOP, width: w, height: h, fill: "none", stroke: "var(--line-strong)" }, drawing);
    cut.marks.forEach((mark) => this.drawMark(mark, across, down));
    this.drawTexts(cut, frame!, { w, h }, { y0, y1, z0: z0 + (z1 - z0 - h / scale) / 2, z1: z1 - (z1 - z0 - h / scale) / 2 }, across, down);
  }

  private resize(width: number, height: number): void {
    for (const [name, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}` })) this.drawing.setAttribute(name, String(value));
  }

  /** Width of the contact as a thick line, its reference, the normal from wheel to rail with the force. */
  private drawMark({ patch, at, ends }: Mark, across: (y: number) => number, down: (z: number) => number): void {
    const group = svg("g", { class: "section-contact", fill: "none", stroke: "var(--cursor)" }, this.drawing);
    const point = ([, y, z]: Vector): string => `${across(y).toFixed(1)} ${down(z).toFixed(1)}`;
    const [px, py] = [across(at[1]), down(at[2])];
    if (ends) svg("path", { class: "section-width", d: `M${point(ends[0])}L${point(ends[1])}`, "stroke-width": 5, "stroke-linecap": "butt" }, group);
    const [ny, nz] = [patch.rotation[5]!, patch.rotation[8]!];
    svg("path", { d: `M${px.toFixed(1)} ${py.toFixed(1)}l${(NORMAL * ny).toFixed(1)} ${(NORMAL * nz).toFixed(1)}`, "stroke-width": 1.5 }, group);
    svg("circle", { cx: px.toFixed(1), cy: py.toFixed(1), r: 3.5, fill: "var(--surface)", "stroke-width": 1.5 }, group);
    const force = patch.numbers["fn_N"];
    if (force === null || force === undefined) return;
    const words = `${brief(force / 1000)} kN`;
    const [tx, ty] = [px + (NORMAL + 6) * ny, py + (NORMAL + 6) * nz + 8];
    const least = LEFT + 4 + textWidth(words) / 2;
    const text = { x: Math.max(least, tx).toFixed(1), y: ty.toFixed(1), "text-anchor": "middle", fill: "var(--text)", "font-weight": 600 };
    svg("text", { ...text, stroke: "var(--surface)", "stroke-width": 3, "paint-order": "stroke" }, this.drawing).textContent = words;
  }

  private drawTexts(
    cut: Cut,
    frame: Frame,
    { w, h }: { w: number; h: number },
    { y0, y1, z0, z1 }: { y0: number; y1: number; z0: number; z1: number },
    across: (y: number) => number,
    down: (z: number) => number,
  ): void {
    const { drawing } = this;
    const text = (words: string, attributes: Record<string, string | number>): void =>
      void (svg("text", { fill: "var(--muted)", ...attributes }, drawing).textContent = words);
    const plane = `cut at x = ${brief(cut.x)} mm${cut.marks.length > 0 ? "" : ", no contact"}`;
    text(frame.name, { x: LEFT, y: 15, fill: "var(--text)", "font-weight": 600 });
    text(plane, { x: LEFT, y: 31 });
    drawing.setAttribute("aria-label", `Section of wheel and rail, ${frame.name}, ${plane}`);
    text("wheel", { x: LEFT + 8, y: TOP + 16, fill: "var(--series-2)", "font-weight": 600 });
    text("rail", { x: LEFT + w / 2, y: TOP + h - 8, fill: "var(--series-1)", "font-weight": 600, "text-anchor": "middle" });
    sideNames((y0 + y1) / 2)?.forEach((name, side) =>
      text(name, { x: side === 0 ? LEFT + 8 : LEFT + w - 8, y: TOP + h - 8, "text-anchor": side === 0 ? "start" : "end" }),
    );
    const bottom = TOP + h;
    for (const { value, label } of linearTicks([y0, y1], Math.max(2, w / 80))) {
      const x = across(value).toFixed(1);
      svg("path", { d: `M${x} ${bottom.toFixed(1)}v4`, stroke: "var(--line-strong)" }, drawing);
      text(label, { x, y: (bottom + 16).toFixed(1), "text-anchor": "middle" });
    }
    for (const { value, label } of linearTicks([z0, z1], Math.max(2, h / 45))) {
      const y = down(value);
      svg("path", { d: `M${LEFT} ${y.toFixed(1)}h-4`, stroke: "var(--line-strong)" }, drawing);
      text(label, { x: LEFT - 7, y: (y + 4).toFixed(1), "text-anchor": "end" });
    }
    text("y, to the right [mm]", { x: LEFT + w / 2, y: (bottom + 33).toFixed(1), "text-anchor": "middle" });
    text("z, down [mm]", { transform: `translate(14 ${(TOP + h / 2).toFixed(1)}) rotate(-90)`, "text-anchor": "middle" });
  }

  /** What is shown, as the name of a step. */
  name(): string {
    return this.store.data.sets[this.view.set]?.frames[this.store.frame() ?? -1]?.name ?? "";
  }

  text(): string {
    return standalone(this.drawing);
  }

  /** Drawn anew, at the step that the store has. */
  textNow(): string {
    this.draw(this.drawnWidth);
    return this.text();
  }

  csv(): string {
    const cut = this.shown;
    const lines = ["step,what,x_mm,y_mm,z_mm"];
    const add = (what: string, x: number, points: Section): void =>
      points.forEach(([y, z]) => Number.isFinite(y) && lines.push([quoted(this.name()), quoted(what), x.toPrecision(7), y.toPrecision(7), z.toPrecision(7)].join(",")));
    if (cut) {
      add("rail", cut.x, cut.rail);
      add("wheel", cut.x, cut.wheel);
      for (const { patch, at } of cut.marks) add(patch.name, at[0], [[at[1], at[2]]]);
      for (const { name, cut: other } of this.others) {
        add(`rail, ${name}`, cut.x, other.rail);
        add(`wheel, ${name}`, cut.x, other.wheel);
      }
    }
    return `${lines.join("\n")}\n`;
  }
}

/** Wheel and rail cut across the track at the contact of the chosen step. */
export function mountSection(figure: HTMLElement, view: SectionView, store: Store): void {
  const plot = figure.querySelector<HTMLElement>(".plot");
  if (!plot) return;
  const section = new SectionFigure(figure, plot, view, store);
  addDownloads(figure, {
    svg: () => section.text(),
    png: () => svgToPng(section.text()),
    csv: () => section.csv(),
    series: { store, draw: () => section.textNow() },
  }, view.id, () => section.name());
}
