// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Patch } from "../data";
import { contactOutline, division, slipOutline, type Line } from "./edges";
import { stateOf } from "./fields";
import { isolines } from "./isolines";
import type { Item } from "./place";

// Lines of a patch, found once and kept, and their paths in pixels.

export interface PatchLines {
  outline: Line[];
  division: Line[];
  slip: Line[];
}

const known = new WeakMap<Patch, PatchLines>();
const knownLevels = new WeakMap<object, { key: string; lines: Line[][] }>();

export function linesOf(patch: Patch, blobs: string[]): PatchLines {
  let lines = known.get(patch);
  if (!lines) {
    const state = stateOf(patch, blobs);
    const { nx, ny } = patch;
    lines = { outline: contactOutline(state, nx, ny), division: division(state, nx, ny), slip: slipOutline(state, nx, ny) };
    known.set(patch, lines);
  }
  return lines;
}

/** Isolines of values (kept with the array of values), for each level. */
export function levelLines(values: ArrayLike<number> & object, nx: number, ny: number, levels: readonly number[]): Line[][] {
  const key = levels.join(" ");
  const kept = knownLevels.get(values);
  if (kept?.key === key) return kept.lines;
  const lines = levels.map((level) => isolines(values, nx, ny, [level]));
  knownLevels.set(values, { key, lines });
  return lines;
}

/** From mm of the picture to pixels: px = x + scale * mm, py = y - scale * mm. */
export interface ToPixels {
  x: number;
  y: number;
  scale: number;
}

function tenth(v: number): number {
  return Math.round(10 * v) / 10;
}

/** Path of lines of an item's grid. */
export function pathOf(lines: readonly Line[], item: Item, to: ToPixels): string {
  const p = item.patch;
  const bx = p.dx_mm * to.scale;
  const by = -p.ds_mm * to.scale;
  const ax = to.x + (p.x0_mm + item.ox) * to.scale - 0.5 * bx;
  const ay = to.y - (p.s0_mm + item.os) * to.scale - 0.5 * by;
  let path = "";
  for (const { points, closed } of lines) {
    for (let i = 0; i < points.length; i += 2)
      path += `${i === 0 ? "M" : "L"}${tenth(ax + bx * points[i]!)} ${tenth(ay + by * points[i + 1]!)}`;
    if (closed) path += "Z";
  }
  return path;
}
