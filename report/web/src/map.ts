// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { lut } from "./colours";
import type { Domain } from "./chart/scale";
import { extentOf, linearTicks, makeScale } from "./chart/scale";
import { toCsv } from "./csv";
import type { MapView } from "./data";
import { addDownloads } from "./download";
import { formatNumber, labelWithUnit, withUnit } from "./numbers";
import { decode } from "./packed";
import { copyOf, onPaper, PAPER_WIDTH } from "./print";
import { placeReadout } from "./chart/readout";
import type { Store } from "./store";
import { el, standaloneSvg, svgToPng, textWidth } from "./svg";

/** Range of the colours: of the values; about zero where the sign matters. */
export function colourRange(lists: ArrayLike<number>[], kind: "sequential" | "diverging"): Domain {
  const extent = extentOf(lists, false) ?? [0, 1];
  if (kind === "diverging") {
    const most = Math.max(Math.abs(extent[0]), Math.abs(extent[1])) || 1;
    return [-most, most];
  }
  return extent[1] > extent[0] ? extent : [extent[0] - 0.5, extent[0] + 0.5];
}

/** Size of the drawn rectangle: true to scale where both axes have one unit and that is neither too flat nor too high. */
export function mapHeight(width: number, across: number, along: number, sameUnit: boolean): number {
  const least = Math.min(200, 0.5 * width);
  const most = Math.min(460, 1.1 * width);
  if (!sameUnit) return Math.min(most, Math.max(least, 0.5 * width));
  return Math.min(most, Math.max(least, (width * along) / across));
}

/** The values as a picture, one pixel a cell, growing y upwards; cells without a value are transparent. */
function pictureOf(view: MapView, values: ArrayLike<number>, range: Domain): string {
  const canvas = document.createElement("canvas");
  canvas.width = view.nx;
  canvas.height = view.ny;
  const context = canvas.getContext("2d");
  if (!context) return "";
  const image = context.createImageData(view.nx, view.ny);
  const colours = lut(view.value.kind, 256);
  for (let j = 0; j < view.ny; ++j) {
    const row = view.dy > 0 ? view.ny - 1 - j : j;
    for (let i = 0; i < view.nx; ++i) {
      const value = values[j * view.nx + i]!;
      if (Number.isNaN(value)) continue;
      const code = Math.min(255, Math.max(0, Math.round((255 * (value - range[0])) / (range[1] - range[0]))));
      const column = view.dx > 0 ? i : view.nx - 1 - i;
      image.data.set(colours.subarray(4 * code, 4 * code + 4), 4 * (row * view.nx + column));
    }
  }
  context.putImageData(image, 0, 0);
  return canvas.toDataURL("image/png");
}

function barPicture(kind: "sequential" | "diverging"): string {
  const canvas = document.createElement("canvas");
  canvas.width = 1;
  canvas.height = 256;
  const context = canvas.getContext("2d");
  if (!context) return "";
  const image = context.createImageData(1, 256);
  const colours = lut(kind, 256);
  for (let k = 0; k < 256; ++k) image.data.set(colours.subarray(4 * (255 - k), 4 * (255 - k) + 4), 4 * k);
  context.putImageData(image, 0, 0);
  return canvas.toDataURL("image/png");
}

class MapPlot {
  readonly svg = el("svg", { class: "map", tabindex: 0, role: "img" });
  private values: ArrayLike<number>;
  private readonly range: Domain;
  private readonly x: Domain;
  private readonly y: Domain;
  private picture = "";
  private readonly readout = document.createElement("div");
  private readonly live = document.createElement("div");
  private readonly hover = el("g", { class: "hover" });
  private toPixel: { x: (v: number) => number; y: (v: number) => number } = { x: (v) => v, y: (v) => v };
  private toValue: { x: (v: number) => number; y: (v: number) => number } = { x: (v) => v, y: (v) => v };
  private cell: [number, number] | null = null;
  private drawnWidth = 0;
  private visible = false;

  constructor(
    private readonly frame: HTMLElement,
    title: string,
    private readonly view: MapView,
    private readonly store: Store,
  ) {
    this.values = this.valuesNow();
    // One range for all steps, so that colours keep their meaning.
    this.range = colourRange((view.by_step ?? [view.values]).map((packed) => decode(packed, store.data.blobs)), view.value.kind);
    const edges = (start: number, step: number, n: number): Domain => {
      const a = start - step / 2;
      const b = start + (n - 0.5) * step;
      return a < b ? [a, b] : [b, a];
    };
    this.x = edges(view.x0, view.dx, view.nx);
    this.y = edges(view.y0, view.dy, view.ny);
    this.svg.setAttribute("aria-label", `${title}: ${labelWithUnit(view.value.label, view.value.unit)}. Arrow keys read single values.`);
    this.readout.className = "readout";
    this.readout.hidden = true;
    this.live.className = "visually-hidden";
    this.live.setAttribute("aria-live", "polite");
    frame.replaceChildren(this.svg, this.readout, this.live);
    this.listen();
  }

  private valuesNow(): ArrayLike<number> {
    return decode(this.view.by_step?.[this.store.step] ?? this.view.values, this.store.data.blobs);
  }

  private changeStep(): void {
    this.values = this.valuesNow();
    this.picture = "";
    this.drawnWidth = 0;
  }

  private listen(): void {
    if (this.view.by_step)
      this.store.onStep(() => {
        this.changeStep();
        this.draw();
      });
    new ResizeObserver(() => this.draw()).observe(this.frame);
    new IntersectionObserver(
      (entries) => {
        this.visible = entries.some((entry) => entry.isIntersecting);
        this.draw();
      },
      { rootMargin: "150px" },
    ).observe(this.frame);
    window.addEventListener("beforeprint", () => this.drawAt(PAPER_WIDTH));
    const figure = this.frame.closest<HTMLElement>("figure");
    if (figure && this.view.by_step)
      onPaper(figure, this.store, (suffix) => {
        this.changeStep();
        this.drawAt(PAPER_WIDTH);
        return [copyOf(this.svg, suffix)];
      });
    window.addEventListener("afterprint", () => {
      this.changeStep();
      this.draw();
    });
    this.svg.addEventListener("pointermove", (event) => {
      const box = this.svg.getBoundingClientRect();
      const scale = this.drawnWidth / Math.max(1, box.width);
      this.pointAt((event.clientX - box.left) * scale, (event.clientY - box.top) * scale);
    });
    this.svg.addEventListener("pointerleave", () => this.leave());
    this.svg.addEventListener("blur", () => this.leave());
    this.svg.addEventListener("keydown", (event) => {
      const { view } = this;
      const moves: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      const move = moves[event.key];
      if (!move) return;
      event.preventDefault();
      const [i, j] = this.cell ?? [Math.floor(view.nx / 2), Math.floor(view.ny / 2)];
      const clamp = (k: number, n: number): number => Math.min(n - 1, Math.max(0, k));
      this.live.textContent = this.point(clamp(i + move[0] * Math.sign(view.dx), view.nx), clamp(j + move[1] * Math.sign(view.dy), view.ny));
    });
  }

  private draw(): void {
    const width = Math.floor(this.frame.clientWidth);
    if (this.visible && width > 0 && width !== this.drawnWidth) this.drawAt(width);
  }

  private drawAt(width: number): void {
    this.drawnWidth = width;
    const { view } = this;
    this.picture ||= pictureOf(view, this.values, this.range);
    const barTicks = linearTicks(this.range, 5).filter((tick) => tick.value >= this.range[0] && tick.value <= this.range[1]);
    const barRoom = 34 + Math.max(...barTicks.map((tick) => textWidth(tick.label)));
    const left = 20 + Math.max(...linearTicks(this.y, 5).map((tick) => textWidth(tick.label)));
    const top = 38;
    const plotWidth = Math.max(50, width - left - barRoom - 8);
    const plotHeight = mapHeight(plotWidth, this.x[1] - this.x[0], this.y[1] - this.y[0], view.x.unit === view.y.unit);
    const right = left + plotWidth;
    const bottom = top + plotHeight;
    const height = bottom + 44;
    const xs = makeScale(this.x, [left, right], false);
    const ys = makeScale(this.y, [bottom, top], false);
    this.toPixel = { x: xs, y: ys };
    this.toValue = { x: (v) => xs.invert(v), y: (v) => ys.invert(v) };
    const { svg } = this;
    svg.setAttribute("width", String(width));
    svg.setAttribute("height", String(height));
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const box = { x: left, y: top, width: plotWidth, height: plotHeight };
    svg.replaceChildren(
      el("rect", { class: "nothing-there", ...box }),
      el("image", { ...box, href: this.picture, preserveAspectRatio: "none", "image-rendering": "pixelated" }),
    );
    this.drawMarks(left, right);
    svg.append(el("rect", { class: "frame", ...box }));
    this.drawAxes(left, right, bottom);
    this.drawBar(right + 14, top, plotHeight, barTicks);
    svg.append(
      el("text", { class: "axis-label", x: 4, y: 14 }, labelWithUnit(view.y.label, view.y.unit)),
      el("text", { class: "axis-label", x: width - 2, y: top - 10, "text-anchor": "end" }, labelWithUnit(view.value.label, view.value.unit)),
      el("text", { class: "axis-label", x: left + plotWidth / 2, y: height - 6, "text-anchor": "middle" }, labelWithUnit(view.x.label, view.x.unit)),
      this.hover,
    );
    this.leave();
  }

  private drawAxes(left: number, right: number, bottom: number): void {
    const { x, y } = this.toPixel;
    const xt = linearTicks(this.x, Math.max(2, Math.floor((right - left) / 85))).filter((tick) => tick.value >= this.x[0] && tick.value <= this.x[1]);
    const yt = linearTicks(this.y, 5).filter((tick) => tick.value >= this.y[0] && tick.value <= this.y[1]);
    const lines = [...xt.map((tick) => `M${x(tick.value).toFixed(1)} ${bottom}v5`), ...yt.map((tick) => `M${left} ${y(tick.value).toFixed(1)}h-5`)];
    this.svg.append(el("path", { class: "ticks", d: lines.join("") }));
    for (const tick of xt) this.svg.append(el("text", { x: x(tick.value).toFixed(1), y: bottom + 18, "text-anchor": "middle" }, tick.label));
    for (const tick of yt) this.svg.append(el("text", { x: left - 8, y: (y(tick.value) + 4).toFixed(1), "text-anchor": "end" }, tick.label));
  }

  private drawBar(left: number, top: number, height: number, ticks: { value: number; label: string }[]): void {
    const scale = makeScale(this.range, [top + height, top], false);
    const box = { x: left, y: top, width: 12, height };
    this.svg.append(el("image", { ...box, href: barPicture(this.view.value.kind), preserveAspectRatio: "none" }), el("rect", { class: "frame", ...box }));
    for (const tick of ticks) {
      const y = scale(tick.value);
      this.svg.append(el("path", { class: "ticks", d: `M${left + 12} ${y.toFixed(1)}h4` }), el("text", { x: left + 19, y: (y + 4).toFixed(1) }, tick.label));
    }
  }

  private drawMarks(left: number, right: number): void {
    const { x, y } = this.toPixel;
    for (const mark of this.view.marks) {
      const path = mark.points.map(([px, py], k) => `${k === 0 ? "M" : "L"}${x(px).toFixed(1)} ${y(py).toFixed(1)}`).join("");
      const elsewhere = mark.points.every(([px]) => x(px) < left) || mark.points.every(([px]) => x(px) > right); // another turn
      if (!path || elsewhere) continue;
      this.svg.append(el("path", { class: "mark-halo", d: path }), el("path", { class: "mark", d: path }));
      const at = mark.points.map(([px]) => x(px)).reduce((sum, v) => sum + v, 0) / mark.points.length;
      const highest = Math.min(...mark.points.map(([, py]) => y(py)));
      const room = textWidth(mark.label) / 2 + 4;
      const place = { x: Math.min(right - room, Math.max(left + room, at)).toFixed(1), y: Math.max(50, highest - 6).toFixed(1) };
      if (mark.label) this.svg.append(el("text", { class: "mark-label", ...place, "text-anchor": "middle" }, mark.label));
    }
  }

  private pointAt(px: number, py: number): void {
    const { view } = this;
    const i = Math.round((this.toValue.x(px) - view.x0) / view.dx);
    const j = Math.round((this.toValue.y(py) - view.y0) / view.dy);
    if (i < 0 || j < 0 || i >= view.nx || j >= view.ny) this.leave();
    else this.point(i, j);
  }

  private point(i: number, j: number): string {
    const { view } = this;
    this.cell = [i, j];
    const x = view.x0 + i * view.dx;
    const y = view.y0 + j * view.dy;
    const value = this.values[j * view.nx + i] ?? NaN;
    const lines = [
      `${view.value.label} ${withUnit(formatNumber(value), view.value.unit)}`,
      `${view.x.label} ${withUnit(formatNumber(x, 5), view.x.unit)}`,
      `${view.y.label} ${withUnit(formatNumber(y, 5), view.y.unit)}`,
    ];
    const strong = document.createElement("strong");
    strong.textContent = lines[0] ?? "";
    this.readout.replaceChildren(strong, `\n${lines.slice(1).join("\n")}`);
    const w = Math.max(4, Math.abs(this.toPixel.x(x + view.dx) - this.toPixel.x(x)));
    const h = Math.max(4, Math.abs(this.toPixel.y(y + view.dy) - this.toPixel.y(y)));
    const cx = this.toPixel.x(x);
    const cy = this.toPixel.y(y);
    const box = { x: cx - w / 2, y: cy - h / 2, width: w, height: h };
    this.hover.replaceChildren(el("rect", { class: "hover-cell-halo", ...box }), el("rect", { class: "hover-cell", ...box }));
    placeReadout(this.readout, cx, cy, this.frame.clientWidth, this.svg.getBoundingClientRect().height);
    return lines.join(", ");
  }

  private leave(): void {
    this.cell = null;
    this.readout.hidden = true;
    this.hover.replaceChildren();
  }

  text(): string {
    if (this.drawnWidth === 0) this.drawAt(Math.floor(this.frame.clientWidth) || 800);
    return standaloneSvg(this.svg);
  }

  csv(): string {
    const { view } = this;
    const rows: (string | number)[][] = [
      [labelWithUnit(view.x.label, view.x.unit), labelWithUnit(view.y.label, view.y.unit), labelWithUnit(view.value.label, view.value.unit)],
    ];
    for (let j = 0; j < view.ny; ++j)
      for (let i = 0; i < view.nx; ++i) rows.push([view.x0 + i * view.dx, view.y0 + j * view.dy, this.values[j * view.nx + i] ?? NaN]);
    return toCsv(rows);
  }
}

/** A quantity over a rectangle, as colours. */
export function mountMap(figure: HTMLElement, view: MapView, store: Store): void {
  const frame = figure.querySelector<HTMLElement>(".plot");
  if (!frame) return;
  const map = new MapPlot(frame, figure.querySelector("figcaption")?.textContent ?? view.id, view, store);
  addDownloads(figure, { svg: () => map.text(), png: () => svgToPng(map.text()), csv: () => map.csv() }, view.id);
}
