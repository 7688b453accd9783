// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { FieldInfo, Patch } from "../data";
import { decode, type Decoded } from "../packed";

// Fields of a patch: which of them mean something outside contact, and those made of others.

/** Of the grid of a patch, without its values. */
export type Grid = Pick<Patch, "nx" | "ny" | "x0_mm" | "s0_mm" | "dx_mm" | "ds_mm">;

/** Traction magnitude and friction bound, where the file has what they are made of. */
export const TRACTION = "traction";
export const FRICTION_BOUND = "friction_bound";

const outsideOf = new Map<string, FieldInfo["outside"]>();

/** What the page says of its fields; to be told before they are shown. */
export function learnFields(fields: FieldInfo[]): void {
  for (const field of fields) outsideOf.set(field.name, field.outside);
  outsideOf.set(FRICTION_BOUND, "zero");
}

/** Fields with a meaning in every element, not in contact alone. */
export function isEverywhere(name: string): boolean {
  return outsideOf.get(name) === "value";
}

/** Fields that are zero outside contact, so that lines may run to the edge of contact. */
export function isZeroOutside(name: string): boolean {
  return outsideOf.get(name) === "zero";
}

const made = new WeakMap<Patch, Map<string, Decoded | null>>();

function combine(patch: Patch, a: string, b: string, blobs: string[], f: (a: number, b: number) => number): Decoded | null {
  const left = fieldOf(patch, a, blobs);
  const right = fieldOf(patch, b, blobs);
  if (!left || !right) return null;
  const out = new Float32Array(left.length);
  for (let i = 0; i < out.length; ++i) out[i] = f(left[i]!, right[i]!);
  return out;
}

function make(patch: Patch, name: string, blobs: string[]): Decoded | null {
  if (name === TRACTION) return combine(patch, "traction_x", "traction_s", blobs, Math.hypot);
  if (name === FRICTION_BOUND) return combine(patch, "friction", "pressure", blobs, (mu, p) => mu * p);
  return null;
}

/** Values of a field, element by element; null where the patch has none. */
export function fieldOf(patch: Patch, name: string, blobs: string[]): Decoded | null {
  const packed = patch.values[name];
  if (packed) return decode(packed, blobs);
  let known = made.get(patch);
  if (!known) made.set(patch, (known = new Map<string, Decoded | null>()));
  let values = known.get(name);
  if (values === undefined) known.set(name, (values = make(patch, name, blobs)));
  return values;
}

const states = new WeakMap<Patch, Decoded>();

/** State of every element; without the field, elements under pressure count as contact, and without pressure all do. */
export function stateOf(patch: Patch, blobs: string[]): Decoded {
  const state = fieldOf(patch, "state", blobs);
  if (state) return state;
  let known = states.get(patch);
  if (!known) {
    const pressure = fieldOf(patch, "pressure", blobs);
    known = new Float32Array(patch.nx * patch.ny).fill(1);
    if (pressure) for (let i = 0; i < known.length; ++i) known[i] = pressure[i]! > 0 ? 1 : 0;
    states.set(patch, known);
  }
  return known;
}

/** Values for lines of equal value: outside contact 0 or NaN, as the field is there. */
export function lineValues(patch: Patch, name: string, blobs: string[]): Decoded | null {
  if (isEverywhere(name)) return fieldOf(patch, name, blobs);
  let known = made.get(patch);
  if (!known) made.set(patch, (known = new Map<string, Decoded | null>()));
  const key = `${name} in contact`;
  let values = known.get(key);
  if (values === undefined) {
    const all = fieldOf(patch, name, blobs);
    const state = stateOf(patch, blobs);
    const outside = isZeroOutside(name) ? 0 : NaN;
    values = all && Float32Array.from(all, (v, i) => (state[i]! > 0 ? v : outside));
    known.set(key, values);
  }
  return values;
}

/** Value of a field in an element as the reader is shown it: NaN where it has no meaning. */
export function shownValue(patch: Patch, name: string, element: number, blobs: string[]): number {
  if (name !== "state" && !isEverywhere(name) && stateOf(patch, blobs)[element] === 0) return NaN;
  return fieldOf(patch, name, blobs)?.[element] ?? NaN;
}

/** A rectangle, in elements (both ends included) or in mm. */
export interface Box {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

const boxes = new WeakMap<Patch, Box | { none: true }>();

/** First and last column and row in contact; null without contact. */
export function contactBox(patch: Patch, blobs: string[]): Box | null {
  const known = boxes.get(patch);
  if (known) return "none" in known ? null : known;
  const state = stateOf(patch, blobs);
  const box: Box = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
  for (let iy = 0, i = 0; iy < patch.ny; ++iy)
    for (let ix = 0; ix < patch.nx; ++ix, ++i)
      if (state[i]! > 0) {
        box.x0 = Math.min(box.x0, ix);
        box.x1 = Math.max(box.x1, ix);
        box.y0 = Math.min(box.y0, iy);
        box.y1 = Math.max(box.y1, iy);
      }
  const found = box.x1 >= 0;
  boxes.set(patch, found ? box : { none: true });
  return found ? box : null;
}

/** Edges in mm of a range of elements. */
export function edgesOf(grid: Grid, elements: Box): Box {
  return {
    x0: grid.x0_mm + (elements.x0 - 0.5) * grid.dx_mm,
    x1: grid.x0_mm + (elements.x1 + 0.5) * grid.dx_mm,
    y0: grid.s0_mm + (elements.y0 - 0.5) * grid.ds_mm,
    y1: grid.s0_mm + (elements.y1 + 0.5) * grid.ds_mm,
  };
}

/** Edges in mm of the whole grid. */
export function gridEdges(grid: Grid): Box {
  return edgesOf(grid, { x0: 0, x1: grid.nx - 1, y0: 0, y1: grid.ny - 1 });
}

/** Column and row of the element nearest to a place; null when the place is off the grid. */
export function elementAt(grid: Grid, x: number, s: number): { ix: number; iy: number } | null {
  const ix = Math.round((x - grid.x0_mm) / grid.dx_mm);
  const iy = Math.round((s - grid.s0_mm) / grid.ds_mm);
  return ix >= 0 && ix < grid.nx && iy >= 0 && iy < grid.ny ? { ix, iy } : null;
}
