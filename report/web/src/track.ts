// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { linearTicks } from "./chart/scale";
import { colourMap, lut } from "./colours";
import { drawBar } from "./contact/bars";
import { contactBox, edgesOf, fieldOf, stateOf, type Box } from "./contact/fields";
import { toTrack, type Vector } from "./contact/place";
import { paint } from "./contact/raster";
import { colourRange, rangeOf, union, type Range } from "./contact/scales";
import { standalone, svg } from "./contact/svg";
import { titled } from "./contact/text";
import { quoted } from "./csv";
import type { Frame, Patch, TrackView } from "./data";
import { addDownloads } from "./download";
import { decode } from "./packed";
import { copyOf, PAPER_WIDTH } from "./print";
import { cutOf, drawBody, sideNames, type Section } from "./section";
import type { Store } from "./store";
import { svgToPng } from "./svg";

/** So many frames at most, at equal distances and with the one shown first. */
export const MOST_PANELS = 24;

/** Corners of a rectangle of a patch in track. */
function corners(patch: Patch, box: Box): Vector[] {
  return [box.x0, box.x1].flatMap((x) => [box.y0, box.y1].map((s) => toTrack(patch, x, s)));
}

/** What contact fills in track, x and y [mm]; null without contact. */
export function trackBox(patch: Patch, blobs: string[]): Box | null {
  const contact = contactBox(patch, blobs);
  if (!contact) return null;
  const at = corners(patch, edgesOf(patch, contact));
  const [xs, ys] = [at.map(([x]) => x), at.map(([, y]) => y)];
  return { x0: Math.min(...xs), x1: Math.max(...xs), y0: Math.min(...ys), y1: Math.max(...ys) };
}

/** Frames to draw: all with contact or, of many, some at equal distances and `first`. */
export function somePanels(frames: readonly number[], first: number | null): number[] {
  if (frames.length <= MOST_PANELS) return [...frames];
  const step = (frames.length - 1) / (MOST_PANELS - 1);
  const some = Array.from({ length: MOST_PANELS }, (_, k) => frames[Math.round(k * step)]!);
  // The one shown first takes the place of the nearest.
  const place = first === null ? -1 : frames.indexOf(first);
  if (place >= 0) some[Math.round(place / step)] = frames[place]!;
  return some;
}

interface Panel {
  frame: Frame;
  step: number | null;
  main: Vector;
  rail: Section;
  wheel: Section;
  pictures: { patch: Patch; href: string }[];
}

const LEFT = 48;
const GAP = 14;
const HEAD = 36;
const FOOT = 40;
const LEAST_WIDTH = 165;
const LEAST_ON_PAPER = 135;
const MOST_WIDTH = 300;
/** Beyond the patches, across [mm]. */
const AROUND = 6;
/** Height of the section and of the view from above, at most, in widths of a panel. */
const SECTION_SHARE = 0.6;
const ABOVE_SHARE = 1.4;

/** Small pictures of a run from above, in track axes, each over the section of wheel and rail through its contact. */
class TrackFigure {
  private readonly drawing: SVGSVGElement;
  private readonly panels: Panel[] = [];
  private readonly outlines = new Map<number, SVGRectElement>();
  private window: Box = { x0: 0, x1: 1, y0: 0, y1: 1 };
  private range: Range = { low: 0, high: 1 };
  private drawnWidth = 0;
  private columns = 1;
  private rowHeight = 0;

  constructor(
    figure: HTMLElement,
    frame: HTMLElement,
    private readonly view: TrackView,
    private readonly store: Store,
  ) {
    this.drawing = svg("svg", { class: "track-view", "font-family": "var(--sans)", "font-size": 11.5, role: "img" });
    this.collect();
    this.drawing.setAttribute("aria-label", `Contact of ${this.panels.length} steps in track axes over the sections of wheel and rail`);
    frame.replaceChildren(this.drawing);
    if (this.panels.length === 0) return;
    this.draw(Math.max(200, Math.floor(frame.clientWidth)));  // at once: what is below shall not jump
    new ResizeObserver(() => {
      const width = Math.floor(frame.clientWidth);
      if (width > 0 && width !== this.drawnWidth) this.draw(width);
    }).observe(frame);
    const list = document.createElement("div");
    list.className = "paper-steps";
    window.addEventListener("beforeprint", () => {
      this.draw(PAPER_WIDTH, true);
      list.replaceChildren(...this.rows());
      frame.after(list);
      figure.classList.add("on-paper");
    });
    window.addEventListener("afterprint", () => {
      list.remove();
      list.replaceChildren();
      figure.classList.remove("on-paper");
      this.draw(Math.floor(frame.clientWidth));
    });
    store.onStep(() => this.mark());
  }

  private stepsOf(): Map<number, number> {
    const { timeline, blobs } = this.store.data;
    const steps = new Map<number, number>();
    if (!timeline?.frames) return steps;
    const frames = decode(timeline.frames, blobs);
    for (let step = 0; step < timeline.count; ++step) {
      const frame = frames[step] ?? NaN;
      if (!Number.isNaN(frame) && !steps.has(frame)) steps.set(frame, step);
    }
    return steps;
  }

  private collect(): void {
    const { data } = this.store;
    const { blobs } = data;
    const frames = data.sets[this.view.set]?.frames ?? [];
    const steps = this.stepsOf();
    const there = frames.flatMap((frame, k) => (frame.patches.some((patch) => contactBox(patch, blobs)) ? [k] : []));
    const window: Box = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
    let range: Range = { low: Infinity, high: -Infinity };
    for (const k of somePanels(there, this.store.frame())) {
      const frame = frames[k]!;
      for (const patch of frame.patches) {
        const box = trackBox(patch, blobs);
        if (!box) continue;
        range = union(range, rangeOf(patch, "pressure", blobs));
        Object.assign(window, {
          x0: Math.min(window.x0, box.x0),
          x1: Math.max(window.x1, box.x1),
          y0: Math.min(window.y0, box.y0),
          y1: Math.max(window.y1, box.y1),
        });
      }
      const { rail, wheel, marks } = cutOf(frame, data.surfaces, blobs)!;
      this.panels.push({ frame, step: steps.get(k) ?? null, main: marks[0]!.at, rail, wheel, pictures: [] });
    }
    this.range = colourRange(range, "sequential");
    this.window = { x0: window.x0 - 2, x1: window.x1 + 2, y0: window.y0 - AROUND, y1: window.y1 + AROUND };
    for (const panel of this.panels) panel.pictures = panel.frame.patches.map((patch) => ({ patch, href: this.paintOf(patch) }));
  }

  private paintOf(patch: Patch): string {
    const { blobs } = this.store.data;
    const values = fieldOf(patch, "pressure", blobs);
    const canvas = document.createElement("canvas");
    canvas.width = patch.nx;
    canvas.height = patch.ny;
    const context = canvas.getContext("2d");
    if (!values || !context) return "";
    const image = new ImageData(patch.nx, patch.ny);
    const colouring = { table: lut("sequential"), range: this.range, states: false };
    paint(image.data, values, stateOf(patch, blobs), patch.nx, patch.ny, colouring);
    context.putImageData(image, 0, 0);
    return canvas.toDataURL("image/png");
  }

  private draw(width: number, paper = false): void {
    this.drawnWidth = width;
    this.outlines.clear();
    const { window, drawing, panels } = this;
    const room = width - LEFT - 8;
    const columns = Math.max(1, Math.min(panels.length, Math.floor((room + GAP) / ((paper ? LEAST_ON_PAPER : LEAST_WIDTH) + GAP))));
    const w = Math.min(MOST_WIDTH, (room - GAP * (columns - 1)) / columns);
    const scale = Math.min(w / (window.y1 - window.y0), (ABOVE_SHARE * w) / (window.x1 - window.x0));
    const above = scale * (window.x1 - window.x0);
    const below = Math.round(SECTION_SHARE * w);
    const rows = Math.ceil(panels.length / columns);
    const rowHeight = HEAD + above + below + FOOT;
    const height = Math.ceil(rows * rowHeight + 64);
    for (const [name, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}` })) drawing.setAttribute(name, String(value));
    drawing.replaceChildren();
    Object.assign(this, { columns, rowHeight });
    panels.forEach((panel, k) => {
      const x = LEFT + (k % columns) * (w + GAP);
      const y = Math.floor(k / columns) * rowHeight + HEAD;
      this.drawPanel(panel, k, { x, y, w, above, below, scale }, k % columns === 0);
    });
    const bar = { x: LEFT, y: rows * rowHeight + 8, width: Math.min(room, 300), height: 13, vertical: false };
    const field = this.store.data.fields.find(({ name }) => name === "pressure");
    const content = { range: this.range, colour: colourMap("sequential"), lines: [], title: titled(field?.label ?? "pressure", field?.unit ?? "MPa"), beyond: false };
    drawBar(svg("g", { class: "track-bar" }, drawing), `${this.view.id}-bar`, bar, content);
    this.mark();
  }

  /** Each row of panels as a picture of its own, between which paper may end; the last one with the scale of colours. */
  private rows(): SVGSVGElement[] {
    const count = Math.ceil(this.panels.length / this.columns);
    return Array.from({ length: count }, (_, row) => {
      const copy = copyOf(this.drawing, `row-${row}`) as SVGSVGElement;
      copy.querySelectorAll(".track-panel").forEach((panel, k) => Math.floor(k / this.columns) === row || panel.remove());
      if (row + 1 < count) copy.querySelector(".track-bar")?.remove();
      const top = row * this.rowHeight;
      const height = row + 1 < count ? this.rowHeight : Number(copy.getAttribute("height")) - top;
      copy.setAttribute("height", height.toFixed(1));
      copy.setAttribute("viewBox", `0 ${top.toFixed(1)} ${this.drawnWidth} ${height.toFixed(1)}`);
      return copy;
    });
  }

  private drawPanel(panel: Panel, k: number, at: { x: number; y: number; w: number; above: number; below: number; scale: number }, first: boolean): void {
    const { window, view } = this;
    const { x, y, w, above, below, scale } = at;
    const height = above + below;
    // The window may be narrower than the panel: both are about one middle.
    const middle = (window.y0 + window.y1) / 2;
    const [ya, yb] = [middle - w / 2 / scale, middle + w / 2 / scale];
    const across = (value: number): number => x + (value - ya) * scale;
    const along = (value: number): number => y + (window.x1 - value) * scale;
    const high = (z: number): number => y + above + 0.55 * below + (z - panel.main[2]) * scale;
    const group = svg("g", { class: "track-panel", "pointer-events": "none" }, this.drawing);
    const clip = svg("clipPath", { id: `${view.id}-clip-${k}` }, group);
    const box = { x: x.toFixed(1), y: y.toFixed(1), width: w.toFixed(1), height: height.toFixed(1) };
    svg("rect", box, clip);
    const inside = svg("g", { "clip-path": `url(#${view.id}-clip-${k})`, fill: "none", "stroke-linejoin": "round" }, group);
    const placed = (curve: Section): [number, number][] => curve.map(([v, z]) => [across(v), Math.max(y + above, high(z))]);
    drawBody(inside, placed(panel.rail), y + height, "var(--series-1)");
    drawBody(inside, placed(panel.wheel), y + above, "var(--series-2)");
    for (const { patch, href } of panel.pictures) this.drawPatch(inside, patch, href, across, along);
    // Where contact is, through both pictures.
    svg("path", { d: `M${across(panel.main[1]).toFixed(1)} ${y.toFixed(1)}v${height.toFixed(1)}`, stroke: "var(--cursor)", "stroke-dasharray": "2 3" }, inside);
    for (const patch of panel.frame.patches) {
      const [, py, pz] = toTrack(patch, ...patch.reference_mm);
      svg("circle", { cx: across(py).toFixed(1), cy: high(pz).toFixed(1), r: 3, fill: "var(--cursor)" }, inside);
    }
    svg("path", { d: `M${x.toFixed(1)} ${(y + above).toFixed(1)}h${w.toFixed(1)}`, stroke: "var(--line-strong)" }, group);
    const outline = svg("rect", { ...box, class: "track-hit", fill: "none", "pointer-events": "all", stroke: "var(--line-strong)" }, group);
    if (panel.step !== null) {
      const step = panel.step;
      this.outlines.set(step, outline);
      outline.style.cursor = "pointer";
      outline.addEventListener("click", () => this.store.setStep(step));
    }
    this.drawTexts(group, panel, at, { ya, yb, across, along }, first);
  }

  /** The elements lie in track as their patch does: columns forward, which is up, rows across. */
  private drawPatch(parent: SVGElement, patch: Patch, href: string, across: (y: number) => number, along: (x: number) => number): void {
    if (!href) return;
    const box = edgesOf(patch, { x0: 0, x1: patch.nx - 1, y0: 0, y1: patch.ny - 1 });
    const place = (px: number, ps: number): [number, number] => {
      const [tx, ty] = toTrack(patch, px, ps);
      return [across(ty), along(tx)];
    };
    // Of the picture: its upper left corner, its upper right one, its lower left one.
    const [o, a, b] = [place(box.x0, box.y1), place(box.x1, box.y1), place(box.x0, box.y0)];
    const { nx, ny } = patch;
    const matrix = [(a[0] - o[0]) / nx, (a[1] - o[1]) / nx, (b[0] - o[0]) / ny, (b[1] - o[1]) / ny, o[0], o[1]];
    svg("image", { width: nx, height: ny, preserveAspectRatio: "none", "image-rendering": "pixelated", href, transform: `matrix(${matrix.map((v) => v.toFixed(5)).join(" ")})` }, parent);
  }

  private drawTexts(
    group: SVGElement,
    panel: Panel,
    { x, y, w, above, below }: { x: number; y: number; w: number; above: number; below: number },
    { ya, yb, across, along }: { ya: number; yb: number; across: (y: number) => number; along: (x: number) => number },
    first: boolean,
  ): void {
    const text = (words: string, attributes: Record<string, string | number>): void => void (svg("text", { fill: "var(--muted)", ...attributes }, group).textContent = words);
    const cut = panel.frame.name.indexOf(", ");
    const [head, rest] = cut < 0 ? [panel.frame.name, ""] : [panel.frame.name.slice(0, cut), panel.frame.name.slice(cut + 2)];
    text(head, { x, y: y - 20, fill: "var(--text)", "font-weight": 600 });
    text(rest, { x, y: y - 6 });
    const bottom = y + above + below;
    const names = sideNames(panel.main[1]);
    names?.forEach((name, side) => text(name, { x: side === 0 ? x + 5 : x + w - 5, y: bottom - 5, "text-anchor": side === 0 ? "start" : "end", "font-size": 10.5 }));
    for (const { value, label } of linearTicks([ya, yb], 4)) {
      const px = across(value).toFixed(1);
      svg("path", { d: `M${px} ${bottom.toFixed(1)}v4`, stroke: "var(--line-strong)" }, group);
      text(label, { x: px, y: bottom + 15, "text-anchor": "middle" });
    }
    if (!first) return;
    text("y, to the right [mm]", { x, y: bottom + 30 });
    for (const { value, label } of linearTicks([this.window.x0, this.window.x1], Math.max(2, above / 45))) {
      const py = along(value);
      svg("path", { d: `M${x} ${py.toFixed(1)}h-4`, stroke: "var(--line-strong)" }, group);
      text(label, { x: x - 7, y: (py + 4).toFixed(1), "text-anchor": "end" });
    }
    text("x, forward [mm]", { transform: `translate(${x - 36} ${y + above / 2}) rotate(-90)`, "text-anchor": "middle" });
  }

  /** The panel of the step that is shown stands out. */
  private mark(): void {
    for (const [step, outline] of this.outlines) {
      const here = this.store.frame(step) === this.store.frame();
      outline.setAttribute("stroke", here ? "var(--accent)" : "var(--line-strong)");
      outline.setAttribute("stroke-width", here ? "2.5" : "1");
    }
  }

  text(): string {
    return standalone(this.drawing);
  }

  csv(): string {
    const lines = ["step,patch,x_mm,y_mm,z_mm"];
    for (const { frame } of this.panels)
      for (const patch of frame.patches)
        lines.push([quoted(frame.name), quoted(patch.name), ...toTrack(patch, ...patch.reference_mm)].join(","));
    return `${lines.join("\n")}\n`;
  }
}

/** Contact in track axes over wheel and rail. */
export function mountTrack(figure: HTMLElement, view: TrackView, store: Store): void {
  const plot = figure.querySelector<HTMLElement>(".plot");
  if (!plot) return;
  const track = new TrackFigure(figure, plot, view, store);
  addDownloads(figure, { svg: () => track.text(), png: () => svgToPng(track.text()), csv: () => track.csv() }, view.id);
}
