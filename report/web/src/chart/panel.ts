// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { seriesColour } from "../colours";
import { el, textWidth } from "../svg";
import { markerPath } from "./marks";
import type { Plot, PlotPanel, PlotSeries } from "./model";
import type { Scale, Tick } from "./scale";
import { thin } from "./thin";

/** Where a panel's plot lies in its picture, in pixels. */
export interface Geometry {
  width: number;
  height: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export interface PanelScales {
  x: Scale;
  y: Scale;
}

let clips = 0;

const px = (v: number): string => v.toFixed(1);

const TURN = 34; // [deg]

/** How the labels of categories fit: beside each other, or turned and as long as there is room before them. left: of the first category. */
export function categoryLabels(labels: readonly string[], perCategory: number, left: number): { turned: boolean; texts: string[]; height: number } {
  const longest = Math.max(0, ...labels.map((label) => textWidth(label)));
  if (longest <= perCategory - 6) return { turned: false, texts: [...labels], height: 20 };
  const texts = labels.map((label, k) => {
    const room = (left + (k + 0.5) * perCategory) / Math.cos((TURN * Math.PI) / 180);
    const most = Math.max(8, Math.min(26, Math.floor(room / textWidth("m"))));
    return label.length > most ? `${label.slice(0, most - 1)}…` : label;
  });
  const turnedLongest = Math.max(0, ...texts.map((label) => textWidth(label)));
  return { turned: true, texts, height: 18 + 0.6 * turnedLongest };
}

function xTicks(plot: Plot, scale: Scale, g: Geometry): Tick[] {
  const { labels } = plot.x;
  const width = g.width - g.left - g.right;
  if (!labels) return scale.ticks(Math.max(2, Math.floor(width / 85)));
  const fit = categoryLabels(labels, width / Math.max(1, scale.domain[1] - scale.domain[0]), g.left);
  return fit.texts.map((label, value) => ({ value, label })).filter(({ value }) => value >= scale.domain[0] && value <= scale.domain[1]);
}

/** Ticks without those whose labels would touch: the labels go, the ticks stay. */
function thinned(ticks: Tick[], at: (tick: Tick) => number, room: (tick: Tick) => number): Tick[] {
  let end = -Infinity;
  return [...ticks]
    .sort((a, b) => at(a) - at(b))
    .map((tick) => {
      if (!tick.label) return tick;
      const half = room(tick) / 2;
      if (at(tick) - half < end) return { ...tick, label: "" };
      end = at(tick) + half;
      return tick;
    });
}

function drawAxes(parent: SVGElement, plot: Plot, scales: PanelScales, g: Geometry, withX: boolean): void {
  const right = g.width - g.right;
  const bottom = g.height - g.bottom;
  const yt = thinned(scales.y.ticks(Math.max(2, Math.floor((bottom - g.top) / 42))), (tick) => scales.y(tick.value), () => 14);
  const xt = xTicks(plot, scales.x, g);
  const turned = plot.x.labels !== null && categoryLabels(plot.x.labels, (right - g.left) / (scales.x.domain[1] - scales.x.domain[0]), g.left).turned;
  const xLabelled = turned ? xt : thinned(xt, (tick) => scales.x(tick.value), (tick) => textWidth(tick.label) + 8);
  const grid = [
    ...yt.filter((tick) => tick.label).map((tick) => `M${g.left} ${px(scales.y(tick.value))}H${right}`),
    ...xLabelled.filter((tick) => tick.label).map((tick) => `M${px(scales.x(tick.value))} ${g.top}V${bottom}`),
  ];
  parent.append(el("path", { class: "grid", d: grid.join("") }));
  const zero = scales.y.log ? NaN : scales.y(0);
  if (zero > g.top && zero < bottom) parent.append(el("path", { class: "zero", d: `M${g.left} ${px(zero)}H${right}` }));
  const ticks = [
    ...yt.map((tick) => `M${g.left} ${px(scales.y(tick.value))}h${tick.label ? -5 : -3}`),
    ...xLabelled.map((tick) => `M${px(scales.x(tick.value))} ${bottom}v${tick.label ? 5 : 3}`),
  ];
  parent.append(el("path", { class: "ticks", d: ticks.join("") }));
  for (const tick of yt)
    if (tick.label) parent.append(el("text", { x: g.left - 8, y: px(scales.y(tick.value) + 4), "text-anchor": "end" }, tick.label));
  if (!withX) return;
  for (const tick of xLabelled) {
    if (!tick.label) continue;
    const x = scales.x(tick.value);
    const place = turned
      ? { transform: `translate(${px(x + 3)} ${bottom + 14}) rotate(${-TURN})`, "text-anchor": "end" }
      : { x: px(x), y: bottom + 18, "text-anchor": "middle" };
    parent.append(el("text", place, tick.label));
  }
}

function linePath(series: PlotSeries, scales: PanelScales, g: Geometry): string {
  const { x, y } = scales;
  const n = Math.min(series.x.length, series.y.length);
  const column = (i: number): number => x(series.x[i]!);
  const height = (i: number): number => y(series.y[i]!);
  const runs = thin(n, column, height, g.left, g.width - g.right);
  let path = "";
  for (const run of runs) {
    run.forEach((i, k) => (path += `${k === 0 ? "M" : "L"}${px(column(i))} ${px(height(i))}`));
    // A point between gaps would not be seen as a line.
    if (run.length === 1) path += "h0.01";
  }
  return path;
}

function markersPath(series: PlotSeries, scales: PanelScales, g: Geometry): string {
  const n = Math.min(series.x.length, series.y.length);
  const right = g.width - g.right;
  const taken = new Set<number>();
  const paths: string[] = [];
  for (let i = 0; i < n; ++i) {
    const x = scales.x(series.x[i]!);
    const y = scales.y(series.y[i]!);
    if (Number.isNaN(x) || Number.isNaN(y) || x < g.left - 0.5 || x > right + 0.5) continue;
    const key = Math.round(x) * 65536 + Math.round(y);
    if (taken.has(key)) continue;
    taken.add(key);
    paths.push(markerPath(series.look, x, y, 3.4));
  }
  // Markers that hide their line are of no use.
  return series.line && paths.length > (right - g.left) / 9 ? "" : paths.join("");
}

function drawLevels(parent: SVGElement, panel: PlotPanel, scales: PanelScales, g: Geometry): void {
  const right = g.width - g.right;
  let above = Infinity;
  for (const level of [...panel.levels].sort((a, b) => a.value - b.value)) {
    const y = scales.y(level.value);
    if (Number.isNaN(y) || y < g.top - 0.5 || y > g.height - g.bottom + 0.5) continue;
    parent.append(el("path", { class: "level", d: `M${g.left} ${px(y)}H${right}` }));
    const at = y - g.top < 14 ? y + 13 : y - 4;
    if (Math.abs(above - at) < 12 || !level.label) continue;
    above = at;
    parent.append(el("text", { class: "level-label", x: right - 5, y: px(at), "text-anchor": "end" }, level.label));
  }
}

/** Draws a panel into an element. `withX`: labels of the common axis below it. */
export function drawPanel(parent: SVGElement, plot: Plot, panel: PlotPanel, scales: PanelScales, g: Geometry, withX: boolean): void {
  const id = `chart-clip-${++clips}`;
  const width = Math.max(0, g.width - g.left - g.right);
  const height = Math.max(0, g.height - g.top - g.bottom);
  parent.append(el("clipPath", { id }, el("rect", { x: g.left, y: g.top - 2, width, height: height + 4 })));
  drawAxes(parent, plot, scales, g, withX);
  parent.append(el("rect", { class: "frame", x: g.left, y: g.top, width, height }));
  const data = el("g", { "clip-path": `url(#${id})` });
  const markers = el("g");
  let any = false;
  for (const series of panel.series) {
    if (series.hidden) continue;
    const colour = seriesColour(series.look);
    const line = series.line ? linePath(series, scales, g) : "";
    if (line) data.append(el("path", { class: "line", d: line, style: `stroke:${colour}`, "stroke-dasharray": series.dash || "none" }));
    const marks = series.points ? markersPath(series, scales, g) : "";
    if (marks) markers.append(el("path", { class: "marks", d: marks, style: `fill:${colour}` }));
    any ||= line !== "" || marks !== "";
  }
  drawLevels(parent, panel, scales, g);
  parent.append(data, markers);
  if (!any) parent.append(el("text", { class: "nothing", x: g.left + width / 2, y: g.top + height / 2 + 4, "text-anchor": "middle" }, "no values"));
}
