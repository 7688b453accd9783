// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { fieldOf, isEverywhere, isZeroOutside, stateOf } from "./fields";
import type { Item } from "./place";

/** A curve of a section: places [mm] and values, NaN where there is none. */
export interface Curve {
  name: string;
  at: number[];
  values: number[];
}

/** Values of a field along the row (along x) or the column (along s) of an element, at the places of the picture. */
export function sectionOf(
  item: Item,
  along: "x" | "s",
  ix: number,
  iy: number,
  field: string,
  blobs: string[],
): Omit<Curve, "name"> | null {
  const { patch } = item;
  const values = fieldOf(patch, field, blobs);
  if (!values) return null;
  const state = stateOf(patch, blobs);
  const outside = isZeroOutside(field) ? 0 : NaN;
  const count = along === "x" ? patch.nx : patch.ny;
  const out = { at: new Array<number>(count), values: new Array<number>(count) };
  for (let k = 0; k < count; ++k) {
    const i = along === "x" ? iy * patch.nx + k : k * patch.nx + ix;
    out.at[k] = along === "x" ? patch.x0_mm + k * patch.dx_mm + item.ox : patch.s0_mm + k * patch.ds_mm + item.os;
    out.values[k] = isEverywhere(field) || state[i]! > 0 ? values[i]! : outside;
  }
  return out;
}

/** Path of a curve in pixels; breaks where there is no value, and leaves out points at zero whose neighbours are zero. */
export function curvePath(curve: Omit<Curve, "name">, px: (at: number) => number, py: (value: number) => number): string {
  const { at, values } = curve;
  let path = "";
  let drawing = false;
  for (let k = 0; k < at.length; ++k) {
    const v = values[k]!;
    const lone = v === 0 && (values[k - 1] ?? 0) === 0 && (values[k + 1] ?? 0) === 0;
    if (!Number.isFinite(v) || lone) {
      drawing = false;
      continue;
    }
    path += `${drawing ? "L" : "M"}${px(at[k]!).toFixed(1)} ${py(v).toFixed(1)}`;
    drawing = true;
  }
  return path;
}
