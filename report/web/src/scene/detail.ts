// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Block, SurfaceMesh } from "./surface";

/** Cells of a grid joined to one: stations and points across. */
export interface Stride {
  stations: number;
  points: number;
}

const greatestStride = 32;

/** The greatest power of two of which that many sizes are not longer than a limit. */
export function strideFor(size: number, limit: number): number {
  let stride = 1;
  while (2 * stride <= greatestStride && 2 * stride * size <= limit) stride *= 2;
  return stride;
}

/** Mean distances of neighbours along the stations and across [mm], from some of them. */
export function meanSpacing({ nu, nv, positions, there }: SurfaceMesh): [number, number] {
  const between = (step: number, usable: (k: number) => boolean): number => {
    let [sum, count] = [0, 0];
    const stride = Math.max(1, Math.floor((nu * nv) / 4000));
    for (let k = 0; k + step < nu * nv; k += stride) {
      if (!there[k] || !there[k + step] || !usable(k)) continue;
      const [a, b] = [3 * k, 3 * (k + step)];
      sum += Math.hypot(positions[a]! - positions[b]!, positions[a + 1]! - positions[b + 1]!, positions[a + 2]! - positions[b + 2]!);
      count += 1;
    }
    return count > 0 ? sum / count : 1;
  };
  return [between(nv, () => true), between(1, (k) => k % nv !== nv - 1)];
}

/** Faces of a block with several cells joined to one; cells with a missing point stay as they are. */
export function coarseIndex(mesh: SurfaceMesh, block: Block, { stations, points }: Stride): Uint32Array {
  if (stations === 1 && points === 1) return block.index;
  const { nv, there, turned } = mesh;
  const [firstStation, lastStation] = block.stations;
  const [firstPoint, lastPoint] = block.points;
  const faces: number[] = [];
  const face = (a: number, b: number, c: number): void => void (turned ? faces.push(a, c, b) : faces.push(a, b, c));
  const cell = (i0: number, i1: number, j0: number, j1: number): void => {
    const corners = [i0 * nv + j0, i1 * nv + j0, i1 * nv + j1, i0 * nv + j1].filter((corner) => there[corner]);
    if (corners.length >= 3) face(corners[0]!, corners[1]!, corners[2]!);
    if (corners.length === 4) face(corners[0]!, corners[2]!, corners[3]!);
  };
  const complete = (i0: number, i1: number, j0: number, j1: number): boolean => {
    for (let i = i0; i <= i1; ++i) for (let j = j0; j <= j1; ++j) if (!there[i * nv + j]) return false;
    return true;
  };
  for (let i0 = firstStation; i0 < lastStation; i0 += stations) {
    const i1 = Math.min(lastStation, i0 + stations);
    for (let j0 = firstPoint; j0 < lastPoint; j0 += points) {
      const j1 = Math.min(lastPoint, j0 + points);
      if (complete(i0, i1, j0, j1)) cell(i0, i1, j0, j1);
      else for (let i = i0; i < i1; ++i) for (let j = j0; j < j1; ++j) cell(i, i + 1, j, j + 1);
    }
  }
  return Uint32Array.from(faces);
}
