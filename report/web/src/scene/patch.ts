// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Patch } from "../data";
import type { Vec3 } from "./vec";

/** Elements are drawn this far out of the surface, towards the wheel [mm]. */
export const lift = 0.03;

/** The elements of a patch that are shown, a quad each, in the patch's axes (x, s, n) [mm]. */
export interface PatchMesh {
  /** Index of the element, ix + nx iy, of each quad. */
  elements: Uint32Array;
  /** Four corners a quad. */
  positions: Float32Array;
  index: Uint32Array;
}

/** Elements in contact, by their state or else by their pressure; all where neither is known. */
export function shownElements(patch: Patch, state: ArrayLike<number> | null, pressure: ArrayLike<number> | null): Uint32Array {
  const test = state ?? pressure;
  const shown: number[] = [];
  for (let k = 0; k < patch.nx * patch.ny; ++k) if (!test || test[k]! > 0) shown.push(k);
  return Uint32Array.from(shown);
}

/** `heights`: of the corners of the elements, from drape. */
export function meshOfPatch(patch: Patch, elements: Uint32Array, heights: Float32Array): PatchMesh {
  const { nx, dx_mm: dx, ds_mm: ds } = patch;
  const positions = new Float32Array(12 * elements.length);
  const index = new Uint32Array(6 * elements.length);
  elements.forEach((element, q) => {
    const ix = element % nx;
    const iy = (element - ix) / nx;
    for (let corner = 0; corner < 4; ++corner) {
      const i = ix + (corner === 1 || corner === 2 ? 1 : 0);
      const j = iy + (corner >= 2 ? 1 : 0);
      const at = 12 * q + 3 * corner;
      positions[at] = patch.x0_mm + (i - 0.5) * dx;
      positions[at + 1] = patch.s0_mm + (j - 0.5) * ds;
      positions[at + 2] = heights[j * (nx + 1) + i]! - lift;
    }
    index.set([4 * q, 4 * q + 1, 4 * q + 2, 4 * q, 4 * q + 2, 4 * q + 3], 6 * q);
  });
  return { elements, positions, index };
}

/** The corners of an element on the ground. */
export function elementCorners(patch: Patch, heights: Float32Array, ix: number, iy: number): Vec3[] {
  const { positions } = meshOfPatch(patch, Uint32Array.of(ix + patch.nx * iy), heights);
  return [0, 3, 6, 9].map((k): Vec3 => [positions[k]!, positions[k + 1]!, positions[k + 2]!]);
}

/** Four bytes a corner: a colour for every quad. */
export function quadColours(elements: Uint32Array, colour: (element: number, out: Uint8Array, at: number) => void): Uint8Array {
  const colours = new Uint8Array(16 * elements.length);
  elements.forEach((element, q) => {
    const at = 16 * q;
    colour(element, colours, at);
    for (let corner = 1; corner < 4; ++corner) colours.copyWithin(at + 4 * corner, at, at + 4);
  });
  return colours;
}

/** Where the contact is: the reference of the patch with the greatest normal force, else of the first one. */
export function mainPatch(patches: readonly Patch[]): Patch | null {
  let best: Patch | null = null;
  for (const patch of patches) if (!best || (patch.numbers["fn_N"] ?? 0) > (best.numbers["fn_N"] ?? 0)) best = patch;
  return best;
}
