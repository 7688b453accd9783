// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { linearTicks } from "../chart/scale";
import { quoted } from "../csv";
import { drawLegend, legendRows, lineSample, type LegendEntry } from "./bars";
import { LEGEND_ROW, type Rect } from "./layout";
import type { Range } from "./scales";
import { curvePath, type Curve } from "./section";
import { put, say, svg } from "./svg";
import { plain } from "./csv";

/** One of the two charts: its title, its axis, the ends of the axis [mm], the picked place, and the curves. */
export interface SectionContent {
  title: string;
  axis: string;
  domain: Range;
  at: number;
  curves: Curve[];
}

export interface CurveLook {
  name: string;
  colour: string;
  dash: string;
}

const LEFT = 54;
const RIGHT = 10;
const TITLE = 24;
const HEIGHT = 150;
const BOTTOM = 40;
const GAP = 30;
const NARROW = 600;

interface ChartNodes {
  axes: SVGGElement;
  paths: SVGPathElement[];
  cursor: SVGPathElement;
  title: SVGTextElement;
}

/** Two small charts of values along x and along s through the picked element. */
export class SectionCharts {
  readonly drawing: SVGSVGElement;
  private readonly legend: SVGGElement;
  private readonly charts: ChartNodes[];
  private curves = "";
  private drawn: string[] = ["", ""];

  constructor(private readonly id: string) {
    this.drawing = svg("svg", {
      role: "img",
      "aria-label": "Sections through the picked element",
      "font-family": "var(--sans)",
      "font-size": 12,
    });
    this.legend = svg("g", {}, this.drawing);
    this.charts = [0, 1].map((k) => {
      const clip = svg("clipPath", { id: `${id}-section-${k}` }, this.drawing);
      svg("rect", {}, clip);
      const axes = svg("g", { fill: "var(--muted)", "font-size": 11.5 }, this.drawing);
      const cursor = svg("path", { stroke: "var(--text)", "stroke-opacity": 0.6, "stroke-dasharray": "1 3" }, this.drawing);
      svg("g", { "clip-path": `url(#${id}-section-${k})`, fill: "none", "stroke-width": 1.7, "stroke-linejoin": "round" }, this.drawing);
      const title = svg("text", { fill: "var(--text)", "font-weight": 600 }, this.drawing);
      return { axes, cursor, title, paths: [] };
    });
  }

  private rebuildCurves(looks: readonly CurveLook[]): void {
    const key = JSON.stringify(looks);
    if (key === this.curves) return;
    this.curves = key;
    this.charts.forEach((chart, k) => {
      const group = this.drawing.querySelector(`g[clip-path="url(#${this.id}-section-${k})"]`);
      group?.replaceChildren();
      chart.paths = looks.map(({ colour, dash }) => svg("path", { stroke: colour, "stroke-dasharray": dash }, group ?? this.drawing));
    });
  }

  /** Draws the charts into a width [px]; axes only where they changed. */
  draw(width: number, sections: readonly SectionContent[], looks: readonly CurveLook[], range: Range, valueTitle: string): void {
    this.rebuildCurves(looks);
    const entries: LegendEntry[] = looks.map(({ name, colour, dash }) => ({
      text: name,
      width: 22,
      draw: lineSample({ stroke: colour, "stroke-width": 1.9, "stroke-dasharray": dash }),
    }));
    const stacked = width < NARROW;
    const rows = legendRows(entries, width - LEFT);
    const top = rows * LEGEND_ROW + 4;
    const w = stacked ? width - LEFT - RIGHT : (width - GAP) / 2 - LEFT - RIGHT;
    const places: Rect[] = sections.map((_, k) => ({
      x: LEFT + (stacked ? 0 : k * (w + RIGHT + GAP + LEFT)),
      y: top + TITLE + (stacked ? k * (TITLE + HEIGHT + BOTTOM + 4) : 0),
      width: Math.max(40, w),
      height: HEIGHT,
    }));
    const height = top + (stacked ? 2 : 1) * (TITLE + HEIGHT + BOTTOM) + (stacked ? 4 : 0);
    put(this.drawing, "width", String(width));
    put(this.drawing, "height", String(height));
    sections.forEach((section, k) => {
      const place = places[k]!;
      const chart = this.charts[k]!;
      const key = JSON.stringify([place, section.domain, range, valueTitle, section.axis, looks]);
      if (key !== this.drawn[k]) {
        this.drawn[k] = key;
        this.drawAxes(k, place, section, range, valueTitle);
        if (k === 0) {
          this.legend.replaceChildren();
          drawLegend(this.legend, entries, { x: LEFT, y: 14, width: width - LEFT });
        }
      }
      const px = (at: number): number => place.x + ((at - section.domain.low) / (section.domain.high - section.domain.low)) * place.width;
      const py = (v: number): number => place.y + place.height - ((v - range.low) / (range.high - range.low)) * place.height;
      chart.paths.forEach((path, c) => {
        const curve = section.curves[c];
        put(path, "d", curve ? curvePath(curve, px, py) : "");
      });
      put(chart.cursor, "d", `M${px(section.at).toFixed(1)} ${place.y}v${place.height}`);
      say(chart.title, section.title);
    });
  }

  private drawAxes(k: number, place: Rect, section: SectionContent, range: Range, valueTitle: string): void {
    const chart = this.charts[k]!;
    const { x, y, width, height } = place;
    const bottom = y + height;
    const clip = this.drawing.querySelector(`#${this.id}-section-${k} rect`);
    if (clip) for (const [name, value] of Object.entries({ x, y: y - 1, width, height: height + 2 })) put(clip, name, String(value));
    put(chart.title, "x", String(x));
    put(chart.title, "y", String(y - 9));
    const g = chart.axes;
    g.replaceChildren();
    const line = (d: string, stroke: string): void => void svg("path", { d, stroke, fill: "none", "shape-rendering": "crispEdges" }, g);
    const label = (px: number, py: number, anchor: string, text: string): void => {
      svg("text", { x: px.toFixed(1), y: py.toFixed(1), "text-anchor": anchor }, g).textContent = text;
    };
    for (const { value, label: text } of linearTicks([range.low, range.high], 5)) {
      const py = bottom - ((value - range.low) / (range.high - range.low)) * height;
      line(`M${x} ${py.toFixed(1)}h${width}`, value === 0 ? "var(--line-strong)" : "var(--grid)");
      label(x - 7, py + 4, "end", text);
    }
    for (const { value, label: text } of linearTicks([section.domain.low, section.domain.high], Math.max(2, width / 60))) {
      const px = x + ((value - section.domain.low) / (section.domain.high - section.domain.low)) * width;
      line(`M${px.toFixed(1)} ${bottom}v5`, "var(--line-strong)");
      label(px, bottom + 17, "middle", text);
    }
    line(`M${x} ${y}V${bottom}H${x + width}`, "var(--line-strong)");
    svg("text", { x: x + width / 2, y: bottom + 34, "text-anchor": "middle", fill: "var(--text)", "font-size": 12 }, g).textContent =
      section.axis;
    svg(
      "text",
      { transform: `translate(${x - 42} ${y + height / 2}) rotate(-90)`, "text-anchor": "middle", fill: "var(--text)", "font-size": 12 },
      g,
    ).textContent = valueTitle;
  }
}

/** The numbers of both sections: one line a place, first along x, then along s. */
export function sectionsCsv(sections: readonly SectionContent[]): string {
  const lines = ["section,curve,place_mm,value"];
  sections.forEach((section, k) => {
    for (const { name, at, values } of section.curves)
      at.forEach((place, i) => lines.push(`${k === 0 ? "along x" : "along s"},${quoted(name)},${plain(place)},${plain(values[i]!)}`));
  });
  return `${lines.join("\n")}\n`;
}
