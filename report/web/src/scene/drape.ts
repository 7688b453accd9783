// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Patch } from "../data";
import type { Block } from "./surface";
import { length, relative, sub, toOuter, type Place, type Vec3 } from "./vec";

/** A body's triangles where a patch lies on it. */
export interface Ground {
  place: Place;
  centre: Vec3;
  positions: Float32Array;
  blocks: Block[];
}

export function placeOf(patch: Patch): Place {
  return { origin: patch.origin_mm, rotation: patch.rotation };
}

/** Heights of one triangle at the corners of the elements; of several surfaces over a corner the one nearest to the plane counts. */
function rasterise(heights: Float32Array, patch: Patch, limit: number, a: Vec3, b: Vec3, c: Vec3): void {
  const { nx, ny, dx_mm: dx, ds_mm: ds } = patch;
  const x0 = patch.x0_mm - 0.5 * dx;
  const s0 = patch.s0_mm - 0.5 * ds;
  const i0 = Math.max(0, Math.ceil((Math.min(a[0], b[0], c[0]) - x0) / dx - 1e-6));
  const i1 = Math.min(nx, Math.floor((Math.max(a[0], b[0], c[0]) - x0) / dx + 1e-6));
  const j0 = Math.max(0, Math.ceil((Math.min(a[1], b[1], c[1]) - s0) / ds - 1e-6));
  const j1 = Math.min(ny, Math.floor((Math.max(a[1], b[1], c[1]) - s0) / ds + 1e-6));
  if (i0 > i1 || j0 > j1) return;
  const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (Math.abs(area) < 1e-12) return;
  for (let j = j0; j <= j1; ++j) {
    const s = s0 + j * ds;
    for (let i = i0; i <= i1; ++i) {
      const x = x0 + i * dx;
      const v = ((x - a[0]) * (c[1] - a[1]) - (s - a[1]) * (c[0] - a[0])) / area;
      const w = ((b[0] - a[0]) * (s - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
      if (v < -1e-6 || w < -1e-6 || v + w > 1 + 1e-6) continue;
      const n = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
      const k = j * (nx + 1) + i;
      if (Math.abs(n) <= limit && !(Math.abs(n) >= Math.abs(heights[k]!))) heights[k] = n;
    }
  }
}

/**
 * Heights n of the corners of a patch's elements, (ny + 1) rows of nx + 1, at which they lie on the ground, in the patch's axes (n into
 * the rail) [mm]. Zero, the plane of the patch, where there is no ground near.
 */
export function drape(patch: Patch, ground: Ground | null): Float32Array {
  const { nx, ny, dx_mm: dx, ds_mm: ds } = patch;
  const heights = new Float32Array((nx + 1) * (ny + 1));
  if (!ground) return heights;
  heights.fill(NaN);
  const reach = 0.5 * Math.hypot(nx * dx, ny * ds);
  const middle: Vec3 = [patch.x0_mm + 0.5 * (nx - 1) * dx, patch.s0_mm + 0.5 * (ny - 1) * ds, 0];
  const inPatch = relative(placeOf(patch), ground.place);
  const vertex = (p: Float32Array, k: number): Vec3 =>
    toOuter(inPatch, [p[3 * k]! + ground.centre[0], p[3 * k + 1]! + ground.centre[1], p[3 * k + 2]! + ground.centre[2]]);
  for (const block of ground.blocks) {
    const centre = toOuter(inPatch, [
      block.centre[0] + ground.centre[0],
      block.centre[1] + ground.centre[1],
      block.centre[2] + ground.centre[2],
    ]);
    if (length(sub(centre, middle)) > block.radius + 1.5 * reach) continue;
    const { index } = block;
    const known = new Map<number, Vec3>();
    const point = (k: number): Vec3 => {
      let p = known.get(k);
      if (!p) known.set(k, (p = vertex(ground.positions, k)));
      return p;
    };
    for (let f = 0; f < index.length; f += 3) rasterise(heights, patch, reach, point(index[f]!), point(index[f + 1]!), point(index[f + 2]!));
  }
  for (let k = 0; k < heights.length; ++k) if (Number.isNaN(heights[k])) heights[k] = 0;
  return heights;
}
