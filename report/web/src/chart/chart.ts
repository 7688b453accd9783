// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { ChartView } from "../data";
import { copyOf, onPaper, PAPER_HEIGHT, PAPER_WIDTH } from "../print";
import { el } from "../svg";
import type { Store } from "../store";
import { chartCsv } from "./csv";
import { PanelHead } from "./head";
import type { Layout } from "./layout";
import { chartSvg, drawXLabel, fit, layOut } from "./layout";
import type { Plot } from "./model";
import { extentsOfAllSteps, isMonotone, plotOf, seriesKey, wholeX } from "./model";
import type { Hit } from "./nearest";
import { nearestPoint, nearestStep } from "./nearest";
import { drawPanel } from "./panel";
import type { PointerTarget } from "./pointer";
import { attachPointer } from "./pointer";
import { fillReadout, placeReadout } from "./readout";
import type { Domain } from "./scale";
import { moved, zoomed } from "./scale";

interface PanelParts {
  head: PanelHead;
  svg: SVGSVGElement;
  picture: SVGGElement;
  cursor: SVGGElement;
  hover: SVGGElement;
}

/** Heading of the section, caption, note and frame of a figure on paper [px]. */
const AROUND_ON_PAPER = 150;

/** A chart in its figure: drawn when it can be seen and something changed. */
export class Chart implements PointerTarget {
  readonly root = document.createElement("div");
  readonly stepsByDrag: boolean;
  private readonly parts: PanelParts[];
  private readonly readout = document.createElement("div");
  private readonly live = document.createElement("div");
  private readonly resetButton: HTMLButtonElement;
  private readonly hidden = new Set<string>();
  private readonly fixed: { x: Domain | null; y: (Domain | null)[] } | null;
  private plot: Plot;
  private layouts: Layout[] = [];
  private window: Domain | null = null;
  private width = 0;
  private most = Infinity;
  private visible = false;
  private stale = true;
  private scheduled = false;
  private pointed: { panel: number; hit: Hit } | null = null;

  constructor(
    private readonly plotFrame: HTMLElement,
    private readonly title: string,
    private readonly view: ChartView,
    private readonly store: Store,
  ) {
    this.stepsByDrag = view.linked;
    this.fixed = extentsOfAllSteps(view, store);
    this.plot = plotOf(view, store, this.hidden);
    this.root.className = "chart-frame";
    this.root.tabIndex = 0;
    this.root.setAttribute("role", "group");
    this.root.setAttribute("aria-roledescription", "chart");
    const keys = view.linked ? "Arrow keys choose the step" : "Arrow keys go from point to point";
    this.root.setAttribute("aria-label", `${title}. ${keys}, plus and minus zoom, 0 shows all.`);
    this.readout.className = "readout";
    this.readout.hidden = true;
    this.live.className = "visually-hidden";
    this.live.setAttribute("aria-live", "polite");
    const buttons = document.createElement("div");
    buttons.className = "chart-buttons";
    const button = (text: string, label: string, act: () => void): HTMLButtonElement => {
      const element = document.createElement("button");
      element.type = "button";
      element.textContent = text;
      element.title = label;
      element.setAttribute("aria-label", label);
      element.addEventListener("click", act);
      buttons.append(element);
      return element;
    };
    const wheel = view.linked ? "Ctrl + wheel, Shift + drag" : "Ctrl + wheel, drag";
    this.resetButton = button("All", "Show all (double click, 0)", () => this.reset());
    button("−", "Zoom out", () => this.zoomByKey(1.5));
    button("+", `Zoom in (${wheel})`, () => this.zoomByKey(1 / 1.5));
    this.resetButton.hidden = true;
    this.parts = this.plot.panels.map((_, p) => this.makePanel(p));
    this.parts[0]?.head.element.append(buttons);
    this.root.append(this.readout, this.live);
    plotFrame.replaceChildren(this.root);
    this.listen();
  }

  private makePanel(p: number): PanelParts {
    const withValues = this.view.linked;
    const head = new PanelHead(this.plot, p, withValues, (s) => {
      const key = seriesKey(p, s);
      if (!this.hidden.delete(key)) this.hidden.add(key);
      this.change();
    });
    const picture = el("g");
    const cursor = el("g", { class: "cursor-layer" });
    const hover = el("g", { class: "hover" });
    const svg = el("svg", { class: "chart", "aria-hidden": "true" }, picture, cursor, hover);
    attachPointer(svg, p, this);
    this.root.append(head.element, svg);
    return { head, svg, picture, cursor, hover };
  }

  private listen(): void {
    new ResizeObserver(() => {
      const width = Math.floor(this.root.clientWidth);
      if (width > 0 && width !== this.width) {
        this.width = width;
        this.change();
      }
    }).observe(this.root);
    new IntersectionObserver(
      (entries) => {
        this.visible = entries.some((entry) => entry.isIntersecting);
        if (this.visible) this.schedule();
      },
      { rootMargin: "150px" },
    ).observe(this.root);
    this.store.onStep(() => {
      if (this.view.by_step) this.stale = true;
      this.follow();
      if (this.view.by_step || this.view.linked) this.schedule();
    });
    this.store.onRenewal(() => this.change());
    if (this.view.linked)
      this.store.onAxis(() => {
        this.window = null;
        this.change();
      });
    window.addEventListener("beforeprint", () => this.drawForPaper());
    const figure = this.plotFrame.closest<HTMLElement>("figure");
    if (figure && this.view.by_step)
      onPaper(figure, this.store, (suffix) => {
        this.drawForPaper();
        return [copyOf(this.root, suffix)];
      });
    window.addEventListener("afterprint", () => {
      this.width = Math.floor(this.root.clientWidth);
      this.most = Infinity;
      this.change();
    });
    this.root.addEventListener("keydown", (event) => {
      if (event.target === this.root && !event.ctrlKey && !event.metaKey && !event.altKey && this.key(event.key)) event.preventDefault();
    });
    this.root.addEventListener("blur", () => this.leave());
  }

  private change(): void {
    this.stale = true;
    this.schedule();
  }

  private schedule(): void {
    if (this.scheduled || !this.visible) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.draw();
    });
  }

  /** On paper every chart is drawn, as wide as a page and not higher with the heads of its panels and what frames it. */
  private drawForPaper(): void {
    this.width = PAPER_WIDTH;
    this.root.style.width = `${PAPER_WIDTH}px`;
    this.most = PAPER_HEIGHT - AROUND_ON_PAPER - this.parts.reduce((sum, { head }) => sum + head.element.offsetHeight, 0);
    this.root.style.width = "";
    // Paper ends between panels where there are too many.
    const long = !fit(this.parts.length, this.most);
    this.plotFrame.closest("figure")?.classList.toggle("long", long);
    if (long) this.most = Number.MAX_VALUE;
    this.stale = true;
    this.draw();
  }

  private draw(): void {
    if (this.width === 0) this.width = Math.floor(this.root.clientWidth);
    if (this.width === 0) return;
    if (this.stale) this.drawPicture();
    this.stale = false;
    this.drawCursor();
  }

  private whole(): Domain {
    return wholeX(this.plot, this.fixed?.x ?? null);
  }

  private drawPicture(): void {
    this.plot = plotOf(this.view, this.store, this.hidden);
    this.layouts = layOut(this.plot, this.width, this.window ?? this.whole(), this.window, this.fixed?.y ?? [], this.most);
    this.layouts.forEach(({ geometry, scales }, p) => {
      const { svg, picture } = this.parts[p]!;
      const last = p === this.layouts.length - 1;
      svg.setAttribute("width", String(geometry.width));
      svg.setAttribute("height", String(geometry.height));
      svg.setAttribute("viewBox", `0 0 ${geometry.width} ${geometry.height}`);
      picture.replaceChildren();
      drawPanel(picture, this.plot, this.plot.panels[p]!, scales, geometry, last);
      if (last) drawXLabel(picture, this.plot, geometry);
    });
    this.resetButton.hidden = this.window === null;
    this.leave();
  }

  private drawCursor(): void {
    const step = this.store.step;
    const at = this.plot.x.values[step];
    this.layouts.forEach(({ geometry: g, scales }, p) => {
      const { head, cursor } = this.parts[p]!;
      const panel = this.plot.panels[p]!;
      head.update(this.plot, p, this.view.linked ? step : null);
      cursor.replaceChildren();
      if (!this.view.linked || at === undefined) return;
      const x = scales.x(at);
      if (!(x >= g.left - 0.5 && x <= g.width - g.right + 0.5)) return;
      cursor.append(el("path", { class: "cursor", d: `M${x.toFixed(1)} ${g.top}V${g.height - g.bottom}` }));
      for (const series of panel.series) {
        const y = scales.y(series.y[step] ?? NaN);
        if (series.hidden || Number.isNaN(y) || series.x !== this.plot.x.values) continue;
        cursor.append(el("circle", { class: "cursor-point", cx: x.toFixed(1), cy: y.toFixed(1), r: 4 }));
      }
    });
  }

  /** Keeps the current step in a zoomed window. */
  private follow(): void {
    const at = this.plot.x.values[this.store.step];
    if (!this.view.linked || !this.window || at === undefined || Number.isNaN(at)) return;
    if (at >= this.window[0] && at <= this.window[1]) return;
    const { log } = this.plot.x;
    const to = (v: number): number => (log ? Math.log(v) : v);
    const share = (to(at) - to(this.window[0])) / (to(this.window[1]) - to(this.window[0]));
    this.window = moved(this.window, this.whole(), share > 0 ? share - 0.1 : share - 0.9, log);
    this.stale = true;
  }

  // ---- pointer ----

  get isZoomed(): boolean {
    return this.window !== null;
  }

  inPlot(panel: number, y: number): boolean {
    const g = this.layouts[panel]?.geometry;
    return g !== undefined && y >= g.top - 6 && y <= g.height - g.bottom;
  }

  private hitAt(panel: number, x: number, y: number): Hit | null {
    const layout = this.layouts[panel];
    if (!layout) return null;
    const { geometry: g, scales } = layout;
    return nearestPoint(this.plot.panels[panel]!, scales, x, y, g.left, g.width - g.right);
  }

  chooseStep(panel: number, x: number, y: number): void {
    const layout = this.layouts[panel];
    if (!layout) return;
    const { values } = this.plot.x;
    // On a path that turns back the same x belongs to several steps: then the nearest point decides.
    const step = isMonotone(values) ? nearestStep(values, layout.scales.x, x, this.store.step) : (this.hitAt(panel, x, y)?.index ?? null);
    if (step !== null) this.store.setStep(step);
  }

  click(panel: number, x: number, y: number): void {
    const hit = this.hitAt(panel, x, y);
    if (!hit || Math.hypot(hit.x - x, hit.y - y) > 24) return;
    const step = this.plot.panels[panel]!.series[hit.series]?.steps?.[hit.index];
    if (step !== undefined && !Number.isNaN(step)) this.store.setStep(step);
  }

  hover(panel: number, x: number, y: number): void {
    const hit = this.hitAt(panel, x, y);
    if (hit) this.point(panel, hit);
    else this.leave();
  }

  private point(panel: number, hit: Hit): string {
    this.pointed = { panel, hit };
    const text = fillReadout(this.readout, this.plot, panel, this.layouts[panel]!.scales, hit);
    this.parts.forEach(({ hover }, p) => {
      const g = this.layouts[p]!.geometry;
      hover.replaceChildren(el("path", { class: "hover-line", d: `M${hit.x.toFixed(1)} ${g.top}V${g.height - g.bottom}` }));
      if (p === panel) hover.append(el("circle", { class: "hover-point", cx: hit.x.toFixed(1), cy: hit.y.toFixed(1), r: 5 }));
    });
    const svg = this.parts[panel]!.svg.getBoundingClientRect();
    const root = this.root.getBoundingClientRect();
    placeReadout(this.readout, hit.x + svg.left - root.left, hit.y + svg.top - root.top, root.width, root.height);
    return text;
  }

  leave(): void {
    this.pointed = null;
    this.readout.hidden = true;
    for (const { hover } of this.parts) hover.replaceChildren();
  }

  band(from: number, to: number): void {
    this.parts.forEach(({ hover }, p) => {
      const g = this.layouts[p]!.geometry;
      const clamp = (x: number): number => Math.min(g.width - g.right, Math.max(g.left, x));
      const [a, b] = [clamp(Math.min(from, to)), clamp(Math.max(from, to))];
      hover.replaceChildren();
      if (b > a) hover.append(el("rect", { class: "band", x: a, y: g.top, width: b - a, height: g.height - g.top - g.bottom }));
    });
  }

  zoomTo(from: number, to: number): void {
    const layout = this.layouts[0];
    if (!layout) return;
    const { geometry: g, scales } = layout;
    const clamp = (x: number): number => Math.min(g.width - g.right, Math.max(g.left, x));
    const a = scales.x.invert(clamp(Math.min(from, to)));
    const b = scales.x.invert(clamp(Math.max(from, to)));
    if (!(b > a)) return;
    this.window = [a, b];
    this.change();
  }

  zoomAbout(x: number, factor: number): void {
    const scale = this.layouts[0]?.scales.x;
    if (scale) this.zoom(scale.invert(x), factor);
  }

  private zoom(about: number, factor: number): void {
    const whole = this.whole();
    const next = zoomed(this.window ?? whole, whole, about, factor, this.plot.x.log);
    this.window = next === whole ? null : next;
    this.change();
  }

  pan(pixels: number): void {
    const g = this.layouts[0]?.geometry;
    if (!g || !this.window) return;
    this.window = moved(this.window, this.whole(), pixels / (g.width - g.left - g.right), this.plot.x.log);
    this.change();
  }

  reset(): void {
    this.window = null;
    this.change();
  }

  // ---- keyboard ----

  private zoomByKey(factor: number): void {
    const [from, to] = this.window ?? this.whole();
    const step = this.plot.x.values[this.store.step];
    const inWindow = this.view.linked && step !== undefined && step >= from && step <= to;
    const middle = this.plot.x.log ? Math.sqrt(from * to) : (from + to) / 2;
    this.zoom(inWindow ? step : middle, factor);
  }

  private key(key: string): boolean {
    const moves: Record<string, number> = { ArrowRight: 1, ArrowLeft: -1, PageUp: 10, PageDown: -10, Home: -Infinity, End: Infinity };
    const move = moves[key];
    if (move !== undefined) {
      if (this.view.linked) this.moveStep(move);
      else this.movePoint(move);
      return true;
    }
    if (key === "+" || key === "=") this.zoomByKey(1 / 1.5);
    else if (key === "-") this.zoomByKey(1.5);
    else if (key === "0" || key === "Escape") this.reset();
    else return false;
    return true;
  }

  private moveStep(by: number): void {
    const count = this.store.data.timeline?.count ?? 0;
    if (Number.isFinite(by)) this.store.setStep(this.store.step + (Math.abs(by) > 1 ? Math.sign(by) * Math.max(1, Math.round(count / 10)) : by));
    else this.store.setStep(by > 0 ? count - 1 : 0);
    this.live.textContent = this.store.data.timeline?.names?.[this.store.step] ?? `step ${this.store.step + 1}`;
  }

  /** From point to point of the pointed series. */
  private movePoint(by: number): void {
    const panel = this.pointed?.panel ?? 0;
    const layout = this.layouts[panel];
    const s = this.pointed?.hit.series ?? this.plot.panels[panel]?.series.findIndex((each) => !each.hidden) ?? -1;
    const series = this.plot.panels[panel]?.series[s];
    if (!layout || !series) return;
    const { geometry: g, scales } = layout;
    const seen: number[] = [];
    for (let i = 0; i < Math.min(series.x.length, series.y.length); ++i) {
      const x = scales.x(series.x[i]!);
      if (x >= g.left - 0.5 && x <= g.width - g.right + 0.5 && !Number.isNaN(scales.y(series.y[i]!))) seen.push(i);
    }
    if (seen.length === 0) return;
    const order = seen.sort((a, b) => series.x[a]! - series.x[b]!);
    const was = this.pointed ? order.indexOf(this.pointed.hit.index) : -1;
    const to = was < 0 ? 0 : Math.min(order.length - 1, Math.max(0, was + by));
    const index = order[to]!;
    this.live.textContent = this.point(panel, { series: s, index, x: scales.x(series.x[index]!), y: scales.y(series.y[index]!) });
  }

  // ---- downloads ----

  svg(): string {
    const plot = plotOf(this.view, this.store, this.hidden);
    return chartSvg(plot, this.title, 900, this.window ?? this.whole(), this.window, this.fixed?.y ?? [], this.plotFrame);
  }

  csv(): string {
    return chartCsv(plotOf(this.view, this.store, new Set()));
  }
}
