// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { colourMap, lut, STATE_COLOURS, css } from "../colours";
import type { FieldInfo } from "../data";
import { lineSample, luminance, type BarContent, type LegendEntry } from "./bars";
import type { Options } from "./controls";
import { isEverywhere } from "./fields";
import type { Model } from "./model";
import { OTHER } from "./panel";
import { stateTable, type Colouring } from "./raster";
import { colourRange, levels, type Range } from "./scales";
import { svg } from "./svg";
import { brief, titled } from "./text";

/** How the field is drawn at a step: its colours, its isolines, and the same of the differences. */
export interface Style {
  field: FieldInfo;
  colouring: Colouring;
  levels: number[];
  /** Null unless differences are shown. */
  difference: { colouring: Colouring; levels: number[] } | null;
  bars: BarContent[];
  everywhere: boolean;
}

const LEVELS = 7;
const SIGNED_LEVELS = 10;

/** Levels at which lines are drawn: not the ends, and not zero of signed fields, where large areas lie. */
function linesAt(range: Range, signed: boolean): number[] {
  return levels(range, signed ? SIGNED_LEVELS : LEVELS).filter((v) => v > range.low && v < range.high && (!signed || v !== 0));
}

export function styleOf(model: Model, options: Options, field: FieldInfo, frames: readonly number[], differences: boolean): Style {
  const states = field.kind === "state";
  const kind = field.kind === "diverging" ? "diverging" : "sequential";
  const own = options.scale === "own" && options.own.high > options.own.low;
  const range = own ? options.own : colourRange(model.range(field.name, frames), field.kind);
  const colouring: Colouring = { table: states ? stateTable() : lut(kind), range, states };
  const at = states || !options.isolines ? [] : linesAt(range, kind === "diverging");
  const bars: BarContent[] = states
    ? []
    : [{ range, colour: colourMap(kind), lines: at, title: titled(field.label, field.unit), beyond: own }];
  let difference: Style["difference"] = null;
  if (differences && !states) {
    const span = colourRange(model.differenceRange(field.name, frames, options.choice), "diverging");
    const lines = options.isolines ? linesAt(span, true) : [];
    difference = { colouring: { table: lut("diverging"), range: span, states: false }, levels: lines };
    bars.push({
      range: span,
      colour: colourMap("diverging"),
      lines,
      title: titled(`Difference to ${model.sets[0]?.name ?? ""}`, field.unit),
      beyond: true,
    });
  }
  return { field, colouring, levels: at, difference, bars, everywhere: isEverywhere(field.name) };
}

/** Whether a line of a level is to be light, by the colour under it. */
export function isLight(level: number, colouring: Colouring, kind: "sequential" | "diverging"): boolean {
  const { low, high } = colouring.range;
  return luminance(colourMap(kind)((level - low) / (high - low))) < 0.25;
}

/** Arrows: how large they are, and the one in the legend. */
export interface ArrowScale {
  /** Pixels a unit of traction. */
  pixels: number;
  reference: number;
  unit: string;
}

export function arrowScale(most: number, spacing: number, unit: string): ArrowScale | null {
  if (!(most > 0) || !Number.isFinite(most)) return null;
  const reference = Math.max(...levels({ low: 0, high: most }, 4));
  return { pixels: (1.25 * spacing) / most, reference, unit };
}

/** The legend: what is drawn, and the colours of states. */
export function legendOf(style: Style, options: Options, other: string | null, arrows: ArrowScale | null): LegendEntry[] {
  const out: LegendEntry[] = [];
  if (style.colouring.states)
    for (const { name, rgb, alpha } of STATE_COLOURS)
      if (alpha > 0)
        out.push({
          text: name,
          width: 16,
          draw: (parent, x, y) => void svg("rect", { x, y: y - 6, width: 16, height: 12, fill: css(rgb) }, parent),
        });
  out.push({ text: "edge of contact", width: 22, draw: lineSample({ stroke: "var(--text)", "stroke-width": 1.5 }) });
  if (options.division && !style.colouring.states)
    out.push({ text: "adhesion | slip", width: 22, draw: lineSample({ stroke: "#ffffff", "stroke-width": 1.6 }, true) });
  if (other !== null && options.other)
    out.push({ text: other, width: 22, draw: lineSample({ stroke: OTHER, "stroke-width": 1.8, "stroke-dasharray": "6 3" }) });
  if (arrows && options.arrows) {
    const length = arrows.reference * arrows.pixels;
    out.push({
      text: `traction ${brief(arrows.reference)} ${arrows.unit}`,
      width: Math.max(10, length),
      draw: (parent, x, y) => {
        const end = x + length;
        const head = Math.min(4.5, length / 2);
        svg(
          "path",
          {
            d: `M${x} ${y}H${end}M${end - head} ${y - head / 2}L${end} ${y}L${end - head} ${y + head / 2}`,
            fill: "none",
            stroke: "var(--text)",
            "stroke-width": 1.15,
          },
          parent,
        );
      },
    });
  }
  out.push({
    text: "contact reference",
    width: 12,
    draw: (parent, x, y) =>
      void svg("path", { d: `M${x} ${y}h12M${x + 6} ${y - 6}v12`, stroke: "var(--text)", "stroke-width": 1.4 }, parent),
  });
  return out;
}
