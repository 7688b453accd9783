// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { FieldInfo, ContactView } from "../data";
import { addDownloads } from "../download";
import { copyOf, onPaper, PAPER_WIDTH } from "../print";
import type { Store } from "../store";
import { drawBar, drawLegend, legendRows, type LegendEntry } from "./bars";
import { ARROW_SPACING, cellsOf, contentOf, panelValue, type Scene } from "./content";
import { button, makeControls, type Offer, type Options } from "./controls";
import { centre, csvOf } from "./csv";
import { shownValue, TRACTION } from "./fields";
import { listen } from "./input";
import { layOut, type Layout } from "./layout";
import { choicesOf, isApart, Model, type PanelModel } from "./model";
import { Painter, rectOf, type Cells } from "./painter";
import { locate, PanelNodes } from "./panel";
import { elementOf, peakOf, type Found, type Place } from "./pick";
import { Readout, stateNames } from "./readout";
import { SectionCharts, sectionsCsv } from "./section-charts";
import { sectionsOf, type Sections } from "./section-model";
import { makeSkeleton, type Skeleton } from "./skeleton";
import { statusText } from "./status";
import { arrowScale, legendOf, styleOf } from "./style";
import { pngOf, put, standalone, svg } from "./svg";
import { brief } from "./text";

const SINGLE_HEIGHT = 450;
const TALL_HEIGHT = 600;
const MULTIPLE_HEIGHT = 310;
const PAPER_PANEL_HEIGHT = 260;
const FIRST_SHOWN = 4;

/** The view of contact patches in a figure. */
export class ContactFigure {
  private readonly model: Model;
  private readonly fields: FieldInfo[];
  private readonly options: Options;
  private readonly other: string | null;
  private readonly allFirst: boolean;
  private readonly painter = new Painter();
  private readonly readout: Readout;
  private readonly charts: SectionCharts;
  private readonly parts: Skeleton;
  private readonly nodes: PanelNodes[] = [];
  private panels: PanelModel[] = [];
  private cells: Cells[][] = [];
  private scene: Scene | null = null;
  private sections: Sections | null = null;
  private furnished = "";
  private pick: Place | null = null;
  private remembered: Place | null = null;
  private hover: Place | null = null;
  private widths: [number, number] = [0, 0];
  private onPaper = false;
  private visible = false;
  private stale = true;

  constructor(
    private readonly figure: HTMLElement,
    private readonly view: ContactView,
    private readonly store: Store,
  ) {
    this.model = new Model(store.data, view.sets);
    this.fields = this.model.fields();
    const { sets } = this.model;
    this.other = sets.some(({ nominal }) => nominal !== null) ? "nominal patch" : sets.length > 1 ? (sets[0]?.name ?? null) : null;
    // Results that are laid over each other may differ in where they have contact.
    this.allFirst = store.data.kind === "live" || (store.data.kind === "overlay" && isApart(this.model));
    this.options = {
      field: this.fields.find(({ name }) => name === "pressure")?.name ?? this.fields[0]?.name ?? "",
      choice: this.allFirst ? { kind: "all" } : { kind: "load", rank: 0 },
      scale: "all",
      own: { low: 0, high: 1 },
      window: "all",
      isolines: true,
      division: true,
      slip: false,
      arrows: false,
      other: this.other !== null,
      difference: false,
      shown: new Set(sets.map((_, k) => k).filter((k) => k < FIRST_SHOWN)),
    };
    const controls = makeControls(
      this.options,
      this.offer(),
      () => this.refresh(),
      () => this.scene?.style.colouring.range ?? { low: 0, high: 1 },
    );
    this.parts = makeSkeleton(figure, controls, view.id, sets.length > 1);
    // Where any step has something to say, its line stays, so that the picture does not jump.
    this.parts.status.hidden = !store.data.live && this.model.frames.every((k) => statusText(this.model.panels(k, this.options.choice), true).text === "");
    this.readout = new Readout(this.model, this.fields);
    this.fillSide();
    this.charts = new SectionCharts(view.id);
    this.parts.sections.append(this.charts.drawing);
    this.addInput();
    this.addFiles();
    this.watch();
  }

  private offer(): Offer {
    const has = (name: string): boolean => this.fields.some((field) => field.name === name);
    return {
      fields: this.fields.map(({ name, label }) => ({ name, label })),
      choices: choicesOf(this.model, this.allFirst),
      steps: this.model.frames.length > 1,
      tractions: has("traction_x") && has("traction_s"),
      slip: has("state"),
      other: this.other,
      sets: this.model.sets.map(({ name }) => name),
    };
  }

  private fillSide(): void {
    const buttons = document.createElement("div");
    buttons.className = "controls";
    buttons.append(
      button("Peak", "peak", "Pick the element with the largest value shown", () => this.pickPeak()),
      button("Clear", "clear", "Pick no element", () => this.setPick(null)),
    );
    this.parts.side.append(this.readout.numbers.element, this.readout.element.element, buttons);
  }

  private watch(): void {
    const { store } = this;
    store.onStep(() => this.refresh());
    store.onTheme(() => this.refresh());
    store.onRenewal(() => {
      this.model.renew();
      this.refresh();
    });
    store.onPoint(() => this.takePoint());
    if (typeof IntersectionObserver === "undefined") this.visible = true;
    else
      new IntersectionObserver(
        (entries) => {
          this.visible = entries.some(({ isIntersecting }) => isIntersecting);
          if (this.visible && this.stale) this.refresh();
        },
        { rootMargin: "300px" },
      ).observe(this.figure);
    new ResizeObserver(() => {
      if (this.measure()) this.refresh();
    }).observe(this.parts.root);
    addEventListener("beforeprint", () => this.drawForPaper());
    onPaper(this.figure, store, (suffix) => {
      this.drawForPaper();
      const { status, picture, sections } = this.parts;
      const parts = [status, picture, this.readout.numbers.element, sections];
      return parts.filter((part) => !part.hidden).map((part) => copyOf(part, suffix));
    });
    addEventListener("afterprint", () => {
      this.onPaper = false;
      this.measure();
      this.draw();
    });
  }

  private drawForPaper(): void {
    this.onPaper = true;
    this.widths = [PAPER_WIDTH, PAPER_WIDTH];
    this.draw();
  }

  /** Takes the widths there are, apart from drawing: to ask for them then would have the browser lay out the page twice. */
  private measure(): boolean {
    const { left, sections } = this.parts;
    const now: [number, number] = [Math.max(240, left.clientWidth), Math.max(240, sections.clientWidth)];
    const changed = now[0] !== this.widths[0] || now[1] !== this.widths[1];
    this.widths = now;
    return changed;
  }

  /** Draws, at once if the reader sees it. */
  refresh(): void {
    if (this.visible) this.draw();
    else this.stale = true;
  }

  private get frame(): number | null {
    if (this.store.data.timeline) return this.store.frame();
    return this.model.frames[0] ?? null;
  }

  private draw(): void {
    this.stale = false;
    if (this.widths[0] === 0) this.measure();
    const { model, options, parts } = this;
    const field = this.fields.find(({ name }) => name === options.field);
    const frame = this.frame;
    const all = model.panels(frame, options.choice);
    this.panels = all.filter(({ k }) => options.shown.has(k));
    const status = statusText(this.panels, model.sets.length > 1);
    parts.status.textContent = status.text;
    parts.status.classList.toggle("failed", status.bad);
    if (!field) return;
    const here = frame === null ? [] : [frame];
    const colourFrames = options.scale === "step" ? here : model.frames;
    const windowFrames = options.window === "step" ? here : model.frames;
    const difference = options.difference && this.panels.some(({ k }) => k > 0);
    const style = styleOf(model, options, field, colourFrames, difference);
    if (!options.shown.has(0) && style.difference) style.bars.shift();
    const window = model.window(windowFrames, options.choice, options.shown, options.window === "grid", options.other);
    const unit = this.fields.find(({ name }) => name === "traction_x")?.unit ?? "";
    const arrows = options.arrows ? arrowScale(model.range(TRACTION, colourFrames).high, ARROW_SPACING, unit) : null;
    const legend = legendOf(style, options, this.other, arrows);
    const layout = this.layOut(window, style.bars.length, legend);
    this.scene = { model, options, style, window, layout, arrows, truth: all[0]?.items ?? [] };
    this.furnish(legend);
    this.cells = this.panels.map((panel) => cellsOf(this.scene!, panel));
    this.painter.draw(parts.canvas, layout, window, this.cells);
    this.keepPick();
    this.drawPanels();
    this.readout.fillNumbers(this.panels);
    this.drawReadout();
    this.drawSections();
  }

  private layOut(window: Scene["window"], bars: number, legend: readonly LegendEntry[]): Layout {
    const many = this.model.sets.length > 1;
    const tall = window.y1 - window.y0 > 1.3 * (window.x1 - window.x0);
    const wish = {
      width: this.widths[0],
      count: this.panels.length,
      window,
      titles: true,
      bars,
      legendRows: 1,
      panelHeight: many ? MULTIPLE_HEIGHT : this.onPaper ? PAPER_PANEL_HEIGHT : tall ? TALL_HEIGHT : SINGLE_HEIGHT,
    };
    const first = layOut(wish);
    const rows = legendRows(legend, first.legend.width);
    return rows === 1 ? first : layOut({ ...wish, legendRows: rows });
  }

  /** Panels, colour bars and legend: made anew only when they change. */
  private furnish(legend: readonly LegendEntry[]): void {
    const { scene, parts, view, nodes } = this;
    if (!scene) return;
    const { layout, style, options, arrows } = scene;
    while (nodes.length < layout.panels.length)
      nodes.push(new PanelNodes(parts.drawing, `${view.id}-panel-${nodes.length}`, `${view.id}-hatch`));
    while (nodes.length > layout.panels.length) nodes.pop()?.group.remove();
    layout.panels.forEach((place, k) => nodes[k]!.place(place, scene.window, layout.scale));
    const bars = style.bars.map(({ range, lines, title }) => [range, lines, title]);
    const key = JSON.stringify([
      layout.width,
      layout.height,
      layout.bars,
      layout.legend,
      bars,
      options,
      arrows,
      legend.map(({ text }) => text),
    ]);
    if (key === this.furnished) return;
    this.furnished = key;
    put(parts.drawing, "width", String(layout.width));
    put(parts.drawing, "height", String(layout.height));
    parts.furniture.replaceChildren();
    style.bars.forEach((bar, k) => drawBar(parts.furniture, `${view.id}-bar-${k}`, layout.bars[k]!, bar));
    drawLegend(parts.furniture, legend, layout.legend);
  }

  private drawPanels(): void {
    const { scene, panels, nodes } = this;
    if (!scene) return;
    const cut = this.pick ?? { x: 0, s: 0 };
    panels.forEach((panel, k) => {
      const picked = this.pick?.set === panel.set ? this.found(panel, this.pick) : null;
      const at = scene.layout.panels[k];
      // A picture alone may have its title over the colour bars too.
      const room = at && panels.length === 1 ? scene.layout.width - at.x : (at?.width ?? 0);
      if (at) nodes[k]?.fill(contentOf(scene, panel, k, this.cells[k] ?? [], cut, picked), room);
    });
  }

  private found(panel: PanelModel | undefined, place: { x: number; s: number }): Found | null {
    return panel ? elementOf(panel, place.x, place.s, this.store.data.blobs) : null;
  }

  // ---- the picked element ----

  private panelOf(set: number): PanelModel | undefined {
    return this.panels.find((panel) => panel.set === set);
  }

  /** The picked place stays from step to step; the element there is what the other views are told. */
  private keepPick(): void {
    const { pick, store } = this;
    if (!pick) return;
    const at = this.found(this.panelOf(pick.set), pick);
    const point = at ? { set: pick.set, patch: at.item.index, ix: at.ix, iy: at.iy } : null;
    if (JSON.stringify(point) !== JSON.stringify(store.point)) store.setPoint(point);
  }

  private setPick(place: Place | null): void {
    this.pick = place;
    if (place) this.keepPick();
    else this.store.setPoint(null);
    this.drawPanels();
    this.drawReadout();
    this.drawSections();
  }

  /** Another view may have picked an element. */
  private takePoint(): void {
    const { point } = this.store;
    if (!point) return;
    const panel = this.panelOf(point.set);
    const item = panel?.items.find(({ index }) => index === point.patch);
    if (!item) return;
    const now = this.pick?.set === point.set ? this.found(panel, this.pick) : null;
    if (now?.item === item && now.ix === point.ix && now.iy === point.iy) return;
    const [x, s] = centre(item, point.ix, point.iy);
    this.setPick({ x, s, set: point.set });
  }

  private pickFound(found: Found, set: number): void {
    const [x, s] = centre(found.item, found.ix, found.iy);
    this.setPick({ x, s, set });
    const { scene, fields } = this;
    const field = fields.find(({ name }) => name === scene?.style.field.name);
    if (!field) return;
    const value = shownValue(found.item.patch, field.name, found.iy * found.item.patch.nx + found.ix, this.store.data.blobs);
    const said = field.kind === "state" ? (stateNames[value] ?? "") : `${brief(value)} ${field.unit}`;
    this.parts.live.textContent = `x ${brief(x)} mm, s ${brief(s)} mm: ${field.label} ${said}`;
  }

  private pickPeak(): void {
    const { scene } = this;
    const panel = (this.pick && this.panelOf(this.pick.set)) ?? this.panels[0];
    if (!scene || !panel) return;
    const found = peakOf(panel, (item, i) => panelValue(scene, panel, item, i), this.store.data.blobs);
    if (found) this.pickFound(found, panel.set);
  }

  private move(dx: number, ds: number): void {
    const { pick } = this;
    const panel = pick && this.panelOf(pick.set);
    const at = panel && this.found(panel, pick);
    if (!at) return this.pickPeak();
    const { nx, ny } = at.item.patch;
    const ix = Math.min(nx - 1, Math.max(0, at.ix + dx));
    const iy = Math.min(ny - 1, Math.max(0, at.iy + ds));
    this.pickFound({ item: at.item, ix, iy }, panel.set);
  }

  private placeAt(pixel: [number, number]): Place | null {
    const { scene } = this;
    const at = scene && locate(scene.layout, scene.window, ...pixel);
    const panel = at && this.panels[at.panel];
    return at && panel && this.found(panel, at) ? { x: at.x, s: at.s, set: panel.set } : null;
  }

  private addInput(): void {
    listen(this.parts.picture, this.parts.drawing, {
      hover: (pixel) => {
        const place = pixel && this.placeAt(pixel);
        if (!place && !this.hover) return;
        this.hover = place;
        this.drawReadout();
        this.drawTip(pixel);
      },
      pick: (pixel) => {
        const place = this.placeAt(pixel);
        const found = place && this.found(this.panelOf(place.set), place);
        if (!found) return;
        const [x, s] = centre(found.item, found.ix, found.iy);
        if (this.pick?.x !== x || this.pick.s !== s || this.pick.set !== place.set) this.setPick({ x, s, set: place.set });
      },
      move: (dx, ds) => this.move(dx, ds),
      peak: () => this.pickPeak(),
      clear: () => this.setPick(null),
      step: (by) => this.store.setStep(this.store.step + by),
      remember: () => (this.remembered = this.pick),
      recall: () => this.setPick(this.remembered),
    });
  }

  private drawReadout(): void {
    const place = this.hover ?? this.pick;
    const caption = this.hover ? "Under the pointer" : this.pick ? "Picked element" : "At the contact reference";
    this.readout.element.element.dataset["source"] = this.hover ? "pointer" : this.pick ? "pick" : "reference";
    this.readout.fillElement(this.panels, place ?? { x: 0, s: 0 }, caption);
  }

  /** The value beside the pointer. */
  private drawTip(pixel: [number, number] | null): void {
    const { tip } = this.parts;
    const { hover, scene } = this;
    const panel = hover && this.panelOf(hover.set);
    const found = hover && this.found(panel ?? undefined, hover);
    tip.hidden = !found || !pixel || !scene;
    if (!found || !pixel || !scene || !panel) return;
    const [x, s] = centre(found.item, found.ix, found.iy);
    const { field } = scene.style;
    const i = found.iy * found.item.patch.nx + found.ix;
    const value = field.kind === "state" ? null : panelValue(scene, panel, found.item, i);
    const said =
      value === null
        ? (stateNames[shownValue(found.item.patch, "state", i, this.store.data.blobs)] ?? "–")
        : `${brief(value)} ${field.unit}`;
    tip.textContent = `${said}\nx ${brief(x)}, s ${brief(s)} mm`;
    const left = pixel[0] > scene.layout.width - 150 ? pixel[0] - 140 : pixel[0] + 14;
    tip.style.transform = `translate(${Math.max(0, left).toFixed(0)}px, ${(pixel[1] + 14).toFixed(0)}px)`;
  }

  private drawSections(): void {
    const { scene, options, panels } = this;
    if (!scene) return;
    const frames = options.scale === "step" ? (this.frame === null ? [] : [this.frame]) : this.model.frames;
    this.sections = sectionsOf(this.model, options, scene.style, this.fields, panels, frames, scene.window, this.pick ?? { x: 0, s: 0 });
    const { contents, looks, range, title } = this.sections;
    this.charts.draw(this.widths[1], contents, looks, range, title);
  }

  // ---- files ----

  private pictureText(): string {
    const { scene } = this;
    if (!scene) return "";
    return standalone(this.parts.drawing, (copy) => {
      copy.querySelectorAll(".cells").forEach((slot, k) => {
        for (const one of this.cells[k] ?? []) {
          const { x, y, width, height } = rectOf(one.item, scene.layout.panels[k]!, scene.window, scene.layout.scale);
          const image = svg("image", {
            x,
            y,
            width,
            height,
            preserveAspectRatio: "none",
            "image-rendering": "pixelated",
            href: this.painter.toDataUrl(one),
          });
          slot.append(image);
        }
      });
    });
  }

  private addFiles(): void {
    const size = (drawing: SVGSVGElement): [number, number] => [
      Number(drawing.getAttribute("width")),
      Number(drawing.getAttribute("height")),
    ];
    const many = this.model.sets.length > 1;
    const shown = (): string => (this.frame === null ? "" : (this.model.sets[0]?.frames[this.frame]?.name ?? ""));
    const csv = (): string => {
      const parts = this.panels.flatMap((panel) =>
        panel.items.map((item) => ({ name: many ? `${panel.name} ${item.patch.name}`.trim() : item.patch.name, item })),
      );
      return csvOf(parts, this.fields, this.store.data.blobs);
    };
    addDownloads(
      this.parts.left,
      {
        svg: () => this.pictureText(),
        png: () => pngOf(this.pictureText(), ...size(this.parts.drawing)),
        csv,
        series: {
          store: this.store,
          draw: () => {
            this.draw();
            return this.pictureText();
          },
        },
      },
      this.view.id,
      shown,
    );
    const charts = this.charts.drawing;
    addDownloads(
      this.parts.sections,
      {
        svg: () => standalone(charts),
        png: () => pngOf(standalone(charts), ...size(charts)),
        csv: () => sectionsCsv(this.sections?.contents ?? []),
      },
      `${this.view.id}-sections`,
      shown,
    );
  }
}
