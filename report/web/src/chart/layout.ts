// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { labelWithUnit } from "../numbers";
import { el, standaloneSvg, textWidth } from "../svg";
import type { Domain } from "./scale";
import { makeScale } from "./scale";
import { sampleOf } from "./marks";
import type { Plot } from "./model";
import { rangeY } from "./model";
import type { Geometry, PanelScales } from "./panel";
import { categoryLabels, drawPanel } from "./panel";

export interface Layout {
  geometry: Geometry;
  scales: PanelScales;
}

/** Between the plots of panels, and below the last one with its axis [px]. */
const PANEL_GAP = 16;
const AXIS = 48;
/** Most height of a plot whose axes have one scale [px]. */
const MOST_TO_SCALE = 520;
/** Least height of a plot [px]. */
const LEAST_HEIGHT = 60;

/** Whether so many panels fit into a height. */
export function fit(count: number, most: number): boolean {
  return (most - AXIS) / count - PANEL_GAP >= LEAST_HEIGHT;
}

/** Sizes and scales of the panels in a picture of some width; `most`: height that all of them together may have. */
export function layOut(plot: Plot, width: number, x: Domain, window: Domain | null, fixedY: (Domain | null)[], most = Infinity): Layout[] {
  const count = plot.panels.length;
  const wanted = (count === 1 ? 250 : count === 2 ? 190 : 150) * (most < Infinity ? 0.78 : width < 500 ? 0.85 : 1);
  let plotHeight = Math.max(LEAST_HEIGHT, Math.min(wanted, Math.floor((most - AXIS) / count - PANEL_GAP)));
  const ranges = plot.panels.map((panel, p) => rangeY(panel, window, fixedY[p] ?? null));
  const labelWidth = Math.max(
    24,
    ...plot.panels.map((panel, p) =>
      Math.max(0, ...makeScale(ranges[p]!, [plotHeight, 0], panel.log).ticks(Math.max(2, Math.floor(plotHeight / 42))).map((tick) => textWidth(tick.label))),
    ),
  );
  const left = Math.ceil(labelWidth) + 14;
  let right = 14;
  if (plot.toScale) {
    const [low, high] = ranges[0]!;
    const perUnit = Math.min((width - left - right) / (x[1] - x[0]), Math.min(most, MOST_TO_SCALE) / (high - low));
    plotHeight = Math.max(1, perUnit * (high - low));
    right = width - left - perUnit * (x[1] - x[0]);
  }
  const perCategory = (width - left - right) / Math.max(1, x[1] - x[0]);
  const ticksHeight = plot.x.labels ? categoryLabels(plot.x.labels, perCategory, left).height : 22;
  const axisHeight = Math.ceil(ticksHeight) + (plot.x.label ? 20 : 2);
  return plot.panels.map((panel, p) => {
    const last = p === count - 1;
    const bottom = last ? axisHeight : 10;
    const geometry: Geometry = { width, height: plotHeight + 6 + bottom, left, right, top: 6, bottom };
    return {
      geometry,
      scales: {
        x: makeScale(x, [left, width - right], plot.x.log),
        y: makeScale(ranges[p]!, [geometry.height - bottom, 6], panel.log),
      },
    };
  });
}

export function drawXLabel(parent: SVGElement, plot: Plot, g: Geometry): void {
  if (!plot.x.label) return;
  const place = { class: "axis-label", x: g.left + (g.width - g.left - g.right) / 2, y: g.height - 5, "text-anchor": "middle" };
  parent.append(el("text", place, labelWithUnit(plot.x.label, plot.x.unit)));
}

/** The heading and the legend of a panel as SVG; their height. */
function drawHead(parent: SVGElement, plot: Plot, p: number, g: Geometry): number {
  const panel = plot.panels[p]!;
  parent.append(el("text", { class: "axis-label", x: 4, y: 14 }, labelWithUnit(panel.label, panel.unit)));
  const shown = panel.series.filter((series) => !series.hidden);
  if (shown.length <= 1 && (shown[0]?.name ?? panel.label) === panel.label) return 18;
  let x = 4;
  let y = 20;
  for (const series of shown) {
    const width = 28 + textWidth(series.name, 12) + 16;
    if (x > 4 && x + width > g.width) {
      x = 4;
      y += 17;
    }
    const group = el("g", { transform: `translate(${x} ${y})` }, sampleOf(series));
    group.append(el("text", { class: "legend-label", x: 28, y: 10 }, series.name));
    parent.append(group);
    x += width;
  }
  return y + 17;
}

/** The chart as a picture of its own with title and legend. `host`: an element of the page that lends it the style sheet. */
export function chartSvg(plot: Plot, title: string, width: number, x: Domain, window: Domain | null, fixedY: (Domain | null)[], host: Element): string {
  const layouts = layOut(plot, width, x, window, fixedY);
  const svg = el("svg", { class: "chart" });
  svg.append(el("text", { class: "chart-title", x: 4, y: 18 }, title));
  let y = 28;
  layouts.forEach(({ geometry, scales }, p) => {
    const head = el("g", { transform: `translate(0 ${y})` });
    svg.append(head);
    y += drawHead(head, plot, p, geometry);
    const body = el("g", { transform: `translate(0 ${y})` });
    drawPanel(body, plot, plot.panels[p]!, scales, geometry, p === layouts.length - 1);
    if (p === layouts.length - 1) drawXLabel(body, plot, geometry);
    svg.append(body);
    y += geometry.height + 6;
  });
  svg.setAttribute("width", String(width));
  svg.setAttribute("height", String(y));
  svg.setAttribute("viewBox", `0 0 ${width} ${y}`);
  const frame = document.createElement("div");
  frame.className = "off-screen";
  frame.append(svg);
  host.append(frame);
  try {
    return standaloneSvg(svg);
  } finally {
    frame.remove();
  }
}
