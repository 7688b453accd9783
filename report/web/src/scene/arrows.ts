// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Patch } from "../data";
import { lift } from "./patch";

/** Flat arrows on a patch: dark ones and, a little smaller and nearer to the eye, light ones, so that they show on every colour. */
export interface ArrowMesh {
  positions: Float32Array;
  /** Four bytes a vertex. */
  colours: Uint8Array;
  index: Uint32Array;
  count: number;
}

const acrossPatch = 13;
const dark = [20, 24, 32, 255];
const light = [255, 255, 255, 255];

/** One arrow in the plane: seven corners, three triangles; `rim` widens it on all sides. */
function arrowCorners(x: number, s: number, tx: number, ts: number, width: number, rim: number): [number, number][] {
  const size = Math.hypot(tx, ts);
  const [ex, es] = [tx / size, ts / size];
  const head = Math.min(size, 3.4 * width);
  const half = 0.5 * width + rim;
  const wide = 1.5 * width + 1.6 * rim;
  const at = (along: number, across: number): [number, number] => [x + along * ex - across * es, s + along * es + across * ex];
  const start = -0.5 * size;
  const neck = 0.5 * size - head;
  return [
    at(start - rim, -half),
    at(start - rim, half),
    at(neck, half),
    at(neck, -half),
    at(neck - rim, -wide),
    at(neck - rim, wide),
    at(0.5 * size + 2.2 * rim, 0),
  ];
}

/**
 * Arrows of the tractions on the rail, the mean of some elements each, longest for `greatest` [MPa]. `heights`: of the corners of the
 * elements, from drape.
 */
export function arrowsOfPatch(
  patch: Patch,
  elements: Uint32Array,
  tractionX: ArrayLike<number>,
  tractionS: ArrayLike<number>,
  heights: Float32Array,
  greatest: number,
): ArrowMesh {
  const { nx, dx_mm: dx, ds_mm: ds } = patch;
  let [i0, i1, j0, j1] = [Infinity, -1, Infinity, -1];
  for (const element of elements) {
    const ix = element % nx;
    const iy = (element - ix) / nx;
    [i0, i1, j0, j1] = [Math.min(i0, ix), Math.max(i1, ix), Math.min(j0, iy), Math.max(j1, iy)];
  }
  const spacing = Math.max((i1 - i0 + 1) * dx, (j1 - j0 + 1) * ds) / acrossPatch;
  const strideX = Math.max(1, Math.round(spacing / dx));
  const strideS = Math.max(1, Math.round(spacing / ds));
  const cell = Math.max(strideX * dx, strideS * ds);
  const columns = Math.ceil((i1 - i0 + 1) / strideX);
  const sums = new Map<number, { x: number; s: number; tx: number; ts: number; n: number; count: number }>();
  for (const element of elements) {
    const ix = element % nx;
    const iy = (element - ix) / nx;
    const [tx, ts] = [tractionX[element]!, tractionS[element]!];
    if (!Number.isFinite(tx + ts)) continue;
    const key = Math.floor((ix - i0) / strideX) + columns * Math.floor((iy - j0) / strideS);
    let sum = sums.get(key);
    if (!sum) sums.set(key, (sum = { x: 0, s: 0, tx: 0, ts: 0, n: 0, count: 0 }));
    sum.x += patch.x0_mm + ix * dx;
    sum.s += patch.s0_mm + iy * ds;
    sum.tx += tx;
    sum.ts += ts;
    sum.n += 0.5 * (heights[iy * (nx + 1) + ix]! + heights[(iy + 1) * (nx + 1) + ix + 1]!);
    sum.count += 1;
  }
  const wanted = [...sums.values()].filter((sum) => Math.hypot(sum.tx, sum.ts) > 0.03 * greatest * sum.count);
  const positions = new Float32Array(2 * 21 * wanted.length);
  const colours = new Uint8Array(2 * 28 * wanted.length);
  const index = new Uint32Array(2 * 9 * wanted.length);
  const width = 0.12 * cell;
  wanted.forEach((sum, k) => {
    const scale = (1.7 * cell) / (greatest * sum.count);
    [0.45 * width, 0].forEach((rim, layer) => {
      const first = 7 * (k + layer * wanted.length);
      const corners = arrowCorners(sum.x / sum.count, sum.s / sum.count, sum.tx * scale, sum.ts * scale, width, rim);
      corners.forEach(([x, s], c) => {
        positions.set([x, s, sum.n / sum.count - (3 + layer) * lift], 3 * (first + c));
        colours.set(layer === 0 ? dark : light, 4 * (first + c));
      });
      const faces = [0, 3, 2, 0, 2, 1, 4, 6, 5].map((c) => c + first);
      index.set(faces, 9 * (k + layer * wanted.length));
    });
  });
  return { positions, colours, index, count: wanted.length };
}
