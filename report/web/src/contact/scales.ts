// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { scaleLinear } from "d3-scale";

import type { FieldInfo, Patch } from "../data";
import { contactBox, edgesOf, fieldOf, gridEdges, isEverywhere, stateOf, type Box } from "./fields";
import type { Item } from "./place";

export interface Range {
  low: number;
  high: number;
}

const ranges = new WeakMap<Patch, Map<string, Range>>();

/** Least and greatest finite value; low > high where there is none. */
export function extent(values: ArrayLike<number>, counts: (i: number) => boolean = () => true): Range {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < values.length; ++i) {
    const v = values[i]!;
    if (v < low && v > -Infinity && counts(i)) low = v;
    if (v > high && v < Infinity && counts(i)) high = v;
  }
  return { low, high };
}

/** Least and greatest value of a field where it is shown. */
export function rangeOf(patch: Patch, name: string, blobs: string[]): Range {
  let known = ranges.get(patch);
  if (!known) ranges.set(patch, (known = new Map<string, Range>()));
  let range = known.get(name);
  if (!range) {
    const values = fieldOf(patch, name, blobs);
    const state = stateOf(patch, blobs);
    const everywhere = isEverywhere(name);
    range = values ? extent(values, (i) => everywhere || state[i]! > 0) : { low: Infinity, high: -Infinity };
    known.set(name, range);
  }
  return range;
}

/** Share of the values that the colours of differences cover: at edges of contact single elements differ much more. */
const COVERED = 0.98;

/** A range about zero that holds nearly all finite values. */
export function mostOf(values: ArrayLike<number>): Range {
  const sizes: number[] = [];
  for (let i = 0; i < values.length; ++i) if (Number.isFinite(values[i])) sizes.push(Math.abs(values[i]!));
  if (sizes.length === 0) return { low: Infinity, high: -Infinity };
  sizes.sort((a, b) => a - b);
  const size = sizes[Math.min(sizes.length - 1, Math.ceil(COVERED * sizes.length) - 1)]!;
  return { low: -size, high: size };
}

export function union(a: Range, b: Range): Range {
  return { low: Math.min(a.low, b.low), high: Math.max(a.high, b.high) };
}

/** Ends of the colours for values of a range, at round numbers: from zero where the values come near it, symmetric if diverging. */
export function colourRange({ low, high }: Range, kind: FieldInfo["kind"]): Range {
  if (!(low <= high)) return { low: 0, high: 1 };
  if (kind === "diverging") {
    const most = Math.max(Math.abs(low), Math.abs(high)) || 1;
    const end = scaleLinear().domain([0, most]).nice(4).domain()[1] ?? most;
    return { low: -end, high: end };
  }
  const from = low >= 0 && low < 0.5 * high ? 0 : low;
  const to = high > from ? high : from + (Math.abs(from) * 1e-3 || 1);
  const [a, b] = scaleLinear().domain([from, to]).nice(6).domain();
  return { low: a ?? from, high: b ?? to };
}

/** Round values inside a range, about `count`. */
export function levels({ low, high }: Range, count: number): number[] {
  return scaleLinear().domain([low, high]).ticks(count);
}

/** Smallest box around boxes; null without any. */
export function around(boxes: readonly Box[]): Box | null {
  if (boxes.length === 0) return null;
  return {
    x0: Math.min(...boxes.map((b) => b.x0)),
    x1: Math.max(...boxes.map((b) => b.x1)),
    y0: Math.min(...boxes.map((b) => b.y0)),
    y1: Math.max(...boxes.map((b) => b.y1)),
  };
}

export function moved(box: Box, dx: number, dy: number): Box {
  return { x0: box.x0 + dx, x1: box.x1 + dx, y0: box.y0 + dy, y1: box.y1 + dy };
}

/** What a patch fills in the picture [mm]: its contact, or its whole grid. */
export function itemBox(item: Item, whole: boolean, blobs: string[]): Box | null {
  const contact = whole ? null : contactBox(item.patch, blobs);
  if (!whole && !contact) return null;
  return moved(contact ? edgesOf(item.patch, contact) : gridEdges(item.patch), item.ox, item.os);
}

/** A margin around a window: a part of its longer side, and no side less than a third of the other, so that pictures keep a shape. */
export function withMargin(box: Box, part = 0.07): Box {
  const w = box.x1 - box.x0;
  const h = box.y1 - box.y0;
  const margin = part * Math.max(w, h);
  const growX = Math.max(margin, (h / 3 - w) / 2);
  const growY = Math.max(margin, (w / 3 - h) / 2);
  return { x0: box.x0 - growX, x1: box.x1 + growX, y0: box.y0 - growY, y1: box.y1 + growY };
}

/** A window for when there is nothing to show [mm]. */
export const EMPTY_WINDOW: Box = { x0: -10, x1: 10, y0: -10, y1: 10 };
