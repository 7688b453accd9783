// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { linearTicks } from "../chart/scale";
import { css } from "../colours";
import type { Rect } from "./layout";
import { legendPlaces, LEGEND_ROW } from "./layout";
import type { Range } from "./scales";
import { svg, textWidth } from "./svg";

const INK = "var(--text)";
const FONT = "11.5px system-ui, sans-serif"; // of the numbers

/** A colour bar: its place, its values, the values with a line across, its title. */
export interface BarContent {
  range: Range;
  colour: (t: number) => [number, number, number];
  lines: number[];
  title: string;
  /** Values may lie beyond the ends, which then are pointed. */
  beyond: boolean;
}

/** Between numbers beside each other [px]. */
const LABEL_GAP = 5;

/** Where numbers of a lying bar stand: none beyond its ends, where the picture may end, the last one always, others where they touch none. */
export function labelPlaces(at: readonly number[], widths: readonly number[], length: number): (number | null)[] {
  const middles = at.map((x, k) => Math.min(length - widths[k]! / 2, Math.max(widths[k]! / 2, x)));
  const last = middles.length - 1;
  let end = -Infinity;
  return middles.map((x, k) => {
    const half = widths[k]! / 2;
    const room = k === last ? Infinity : middles[last]! - widths[last]! / 2;
    if (k < last && (x - half < end || x + half + LABEL_GAP > room)) return null;
    end = x + half + LABEL_GAP;
    return x;
  });
}

/** Draws a colour bar anew. */
export function drawBar(parent: SVGElement, id: string, place: Rect & { vertical: boolean }, content: BarContent): void {
  const { range, colour, title } = content;
  const { vertical } = place;
  const gradient = svg("linearGradient", { id, x1: 0, x2: vertical ? 0 : 1, y1: vertical ? 1 : 0, y2: 0 }, svg("defs", {}, parent));
  for (let k = 0; k <= 32; ++k) svg("stop", { offset: (k / 32).toFixed(4), "stop-color": css(colour(k / 32)) }, gradient);
  const { x, y, width, height } = place;
  if (content.beyond)
    for (const t of [0, 1]) {
      const tip = vertical
        ? `M${x} ${t ? y : y + height}h${width}l${-width / 2} ${t ? -9 : 9}z`
        : `M${t ? x + width : x} ${y}v${height}l${t ? 9 : -9} ${-height / 2}z`;
      svg("path", { d: tip, fill: css(colour(t)), stroke: "var(--line-strong)", "stroke-width": 0.8 }, parent);
    }
  svg("rect", { x, y, width, height, fill: `url(#${id})`, stroke: "var(--line-strong)", "shape-rendering": "crispEdges" }, parent);
  const length = vertical ? height : width;
  const at = (value: number): number => ((value - range.low) / (range.high - range.low)) * length;
  const ticks = linearTicks([range.low, range.high], Math.max(2, length / (vertical ? 55 : 62)));
  const numbers = svg("g", { fill: "var(--muted)", "font-size": 11.5 }, parent);
  for (const value of content.lines) {
    const [px, py] = vertical ? [x, y + height - at(value)] : [x + at(value), y];
    const light = luminance(colour(at(value) / length)) < 0.4;
    svg(
      "path",
      {
        d: `M${px.toFixed(1)} ${py.toFixed(1)}${vertical ? `h${width}` : `v${height}`}`,
        stroke: light ? "#ffffff" : "#000000",
        "stroke-opacity": 0.6,
        "stroke-width": 0.9,
      },
      parent,
    );
  }
  const widths = ticks.map(({ label }) => textWidth(label, FONT));
  const places = labelPlaces(
    ticks.map(({ value }) => at(value)),
    widths,
    length,
  );
  ticks.forEach(({ value, label }, k) => {
    const [px, py] = vertical ? [x + width, y + height - at(value)] : [x + at(value), y + height];
    svg(
      "path",
      { d: `M${px.toFixed(1)} ${py.toFixed(1)}${vertical ? "h4" : "v4"}`, stroke: "var(--line-strong)", "shape-rendering": "crispEdges" },
      parent,
    );
    const middle = places[k];
    if (!vertical && middle === null) return;
    const text = svg("text", vertical ? { x: px + 7, y: (py + 4).toFixed(1) } : { x: (x + middle!).toFixed(1), y: py + 16, "text-anchor": "middle" }, numbers);
    text.textContent = label;
  });
  const wide = Math.max(...widths);
  const place2 = vertical
    ? { transform: `translate(${(x + width + 7 + wide + 16).toFixed(1)} ${(y + height / 2).toFixed(1)}) rotate(-90)` }
    : { x: (x + width / 2).toFixed(1), y: y + height + 32 };
  svg("text", { ...place2, "text-anchor": "middle", fill: INK, "font-size": 12 }, parent).textContent = title;
}

/** Lightness of a colour, 0 to 1 (relative luminance without the exact gamma). */
export function luminance([r, g, b]: [number, number, number]): number {
  return 0.2126 * (r / 255) ** 2.2 + 0.7152 * (g / 255) ** 2.2 + 0.0722 * (b / 255) ** 2.2;
}

/** An entry of the legend: its text, the width of its sample and how to draw that, its left end in the middle of the line given. */
export interface LegendEntry {
  text: string;
  width: number;
  draw: (parent: SVGElement, x: number, y: number) => void;
}

const SAMPLE_GAP = 6;

function widths(entries: readonly LegendEntry[]): number[] {
  return entries.map(({ text, width }) => width + SAMPLE_GAP + textWidth(text));
}

export function legendRows(entries: readonly LegendEntry[], room: number): number {
  if (entries.length === 0) return 0;
  return Math.max(...legendPlaces(widths(entries), room).map(({ row }) => row)) + 1;
}

/** Draws the legend anew. */
export function drawLegend(parent: SVGElement, entries: readonly LegendEntry[], place: { x: number; y: number; width: number }): void {
  const places = legendPlaces(widths(entries), place.width);
  entries.forEach(({ text, width, draw }, k) => {
    const { x, row } = places[k]!;
    const y = place.y + row * LEGEND_ROW;
    draw(parent, place.x + x, y - 4);
    svg("text", { x: (place.x + x + width + SAMPLE_GAP).toFixed(1), y, fill: INK, "font-size": 12 }, parent).textContent = text;
  });
}

/** A sample of a line. */
export function lineSample(attributes: Record<string, string | number>, casing = false): LegendEntry["draw"] {
  return (parent, x, y) => {
    if (casing) svg("path", { d: `M${x} ${y}h22`, stroke: "#10151a", "stroke-width": 3.6, "stroke-opacity": 0.8 }, parent);
    svg("path", { d: `M${x} ${y}h22`, fill: "none", ...attributes }, parent);
  };
}
