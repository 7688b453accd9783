// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { contours } from "d3-contour";

import type { Line } from "./edges";

/**
 * Lines of equal value through the centres of elements, in the coordinates of edges.ts (the centre of the first element is at
 * 0.5, 0.5). They end at the border of the grid and next to elements without a value.
 */
export function isolines(values: ArrayLike<number>, nx: number, ny: number, levels: readonly number[]): Line[] {
  if (nx < 2 || ny < 2) return [];
  const numbers = Array.from(values);
  const generator = contours().size([nx, ny]);
  const out: Line[] = [];
  for (const level of levels)
    for (const polygon of generator.contour(numbers, level).coordinates)
      for (const ring of polygon) split(ring, out, (x, y) => isInside(numbers, nx, ny, x, y));
  return out;
}

/** Whether a point of a line lies between elements that have values. */
function isInside(values: number[], nx: number, ny: number, x: number, y: number): boolean {
  if (x <= 0 || y <= 0 || x >= nx || y >= ny) return false;
  for (const iy of [Math.floor(y - 0.5), Math.ceil(y - 0.5)])
    for (const ix of [Math.floor(x - 0.5), Math.ceil(x - 0.5)]) if (Number.isNaN(values[iy * nx + ix])) return false;
  return true;
}

/** Cuts a closed ring (whose last point is the first) at the points that are not inside. */
function split(ring: number[][], out: Line[], inside: (x: number, y: number) => boolean): void {
  const n = ring.length - 1;
  const kept = ring.slice(0, n).map((p) => inside(p[0]!, p[1]!));
  const gap = kept.indexOf(false);
  if (gap < 0) {
    out.push({ points: ring.slice(0, n).flat(), closed: true });
    return;
  }
  let points: number[] = [];
  for (let k = 1; k <= n; ++k) {
    const i = (gap + k) % n;
    if (kept[i]) points.push(ring[i]![0]!, ring[i]![1]!);
    if (!kept[i] || k === n) {
      if (points.length > 2) out.push({ points, closed: false });
      points = [];
    }
  }
}
