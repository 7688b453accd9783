// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Patch } from "../data";
import { elementAt, fieldOf, isEverywhere, isZeroOutside, stateOf } from "./fields";
import { onGridOf, toTrack } from "./place";

/** Value of a field of `truth` in the element nearest to a place in its grid; outside contact 0 or NaN, as the field is there. */
function truthAt(truth: Patch, values: ArrayLike<number>, state: ArrayLike<number>, name: string, x: number, s: number): number {
  const at = elementAt(truth, x, s);
  if (!at) return isZeroOutside(name) ? 0 : NaN;
  const i = at.iy * truth.nx + at.ix;
  if (state[i]! > 0 || isEverywhere(name)) return values[i]!;
  return isZeroOutside(name) ? 0 : NaN;
}

/**
 * Values of a patch minus those of the truth, element by element of the patch; compared at the same place in track, with the
 * nearest element of the truth. NaN where neither is in contact, but for fields that have a meaning there too.
 */
export function difference(patch: Patch, truth: Patch | null, name: string, blobs: string[]): Float32Array | null {
  const values = fieldOf(patch, name, blobs);
  const theirs = truth && fieldOf(truth, name, blobs);
  if (!values || (truth && !theirs)) return null;
  const state = stateOf(patch, blobs);
  const theirState = truth && stateOf(truth, blobs);
  const everywhere = isEverywhere(name);
  const zero = isZeroOutside(name);
  const out = new Float32Array(values.length);
  // The map between the grids is linear: its columns are the steps along x and s.
  const at = (x: number, s: number): [number, number] => (truth ? onGridOf(truth, toTrack(patch, x, s)) : [0, 0]);
  const o = at(patch.x0_mm, patch.s0_mm);
  const u = at(patch.x0_mm + patch.dx_mm, patch.s0_mm);
  const v = at(patch.x0_mm, patch.s0_mm + patch.ds_mm);
  for (let iy = 0, i = 0; iy < patch.ny; ++iy)
    for (let ix = 0; ix < patch.nx; ++ix, ++i) {
      const x = o[0] + ix * (u[0] - o[0]) + iy * (v[0] - o[0]);
      const s = o[1] + ix * (u[1] - o[1]) + iy * (v[1] - o[1]);
      const here = everywhere || state[i]! > 0;
      const mine = here ? values[i]! : zero ? 0 : NaN;
      const other = truth && theirs && theirState ? truthAt(truth, theirs, theirState, name, x, s) : zero ? 0 : NaN;
      out[i] = !here && other === 0 ? NaN : mine - other;
    }
  return out;
}
