// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { cross, dot, sub, type Vec3 } from "./vec";

export interface Hit {
  triangle: number;
  distance: number;
}

function corner(positions: ArrayLike<number>, k: number): Vec3 {
  return [positions[3 * k]!, positions[3 * k + 1]!, positions[3 * k + 2]!];
}

/** The nearest triangle that a ray meets, from either side; `direction` is a unit vector. */
export function firstHit(positions: ArrayLike<number>, index: ArrayLike<number>, origin: Vec3, direction: Vec3): Hit | null {
  let best: Hit | null = null;
  for (let f = 0; f < index.length; f += 3) {
    const a = corner(positions, index[f]!);
    const ab = sub(corner(positions, index[f + 1]!), a);
    const ac = sub(corner(positions, index[f + 2]!), a);
    const p = cross(direction, ac);
    const determinant = dot(ab, p);
    if (Math.abs(determinant) < 1e-14) continue;
    const from = sub(origin, a);
    const u = dot(from, p) / determinant;
    if (u < -1e-9 || u > 1 + 1e-9) continue;
    const q = cross(from, ab);
    const v = dot(direction, q) / determinant;
    if (v < -1e-9 || u + v > 1 + 1e-9) continue;
    const distance = dot(ac, q) / determinant;
    if (distance > 0 && (!best || distance < best.distance)) best = { triangle: f / 3, distance };
  }
  return best;
}

/** Whether a ray passes through a sphere. */
export function meetsSphere(centre: Vec3, radius: number, origin: Vec3, direction: Vec3): boolean {
  const to = sub(centre, origin);
  const along = dot(to, direction);
  return dot(to, to) - along * along <= radius * radius && (along > 0 || dot(to, to) <= radius * radius);
}
