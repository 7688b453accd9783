// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Patch } from "../data";
import { placeOf } from "./drape";
import { mainPatch } from "./patch";
import type { Subject } from "./orbit";
import type { SurfaceMesh } from "./surface";
import { toOuter, type Place, type Vec3 } from "./vec";

/** A body's mesh where it lies in a step. */
export interface PlacedMesh {
  mesh: SurfaceMesh;
  place: Place;
}

export interface Box {
  low: Vec3;
  high: Vec3;
}

function grow(box: Box, p: Vec3): void {
  for (let k = 0; k < 3; ++k) {
    if (p[k]! < box.low[k]!) box.low[k] = p[k]!;
    if (p[k]! > box.high[k]!) box.high[k] = p[k]!;
  }
}

function empty(): Box {
  return { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
}

export function middleOf({ low, high }: Box): Vec3 {
  return [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])];
}

/** Box of the patches' grids in track axes; null without patches. */
export function boxOfPatches(patches: readonly Patch[]): Box | null {
  if (patches.length === 0) return null;
  const box = empty();
  for (const patch of patches) {
    const place = placeOf(patch);
    for (const i of [-0.5, patch.nx - 0.5])
      for (const j of [-0.5, patch.ny - 0.5])
        grow(box, toOuter(place, [patch.x0_mm + i * patch.dx_mm, patch.s0_mm + j * patch.ds_mm, 0]));
  }
  return box;
}

/** How far patches go forward or back from a place along the track [mm]. */
export function reachAlong(patches: readonly Patch[], x: number): number {
  const box = boxOfPatches(patches);
  return box ? Math.max(box.high[0] - x, x - box.low[0]) : 0;
}

/** The reference of the patch that carries most, in track axes. */
export function contactPoint(patches: readonly Patch[]): Vec3 | null {
  const patch = mainPatch(patches);
  return patch ? toOuter(placeOf(patch), [patch.reference_mm[0], patch.reference_mm[1], 0]) : null;
}

/** Greatest distance of a wheel's surface from its axle (y through the origin of its axes) [mm]. */
export function wheelRadius({ positions, centre }: SurfaceMesh): number {
  let radius = 0;
  for (let k = 0; k < positions.length; k += 3) {
    const r = Math.hypot(positions[k]! + centre[0], positions[k + 2]! + centre[2]);
    if (r > radius) radius = r;
  }
  return radius;
}

/** Extents of a mesh in its own axes. */
export function extents({ positions }: SurfaceMesh): Vec3 {
  const box = empty();
  for (let k = 0; k < positions.length; k += 3) grow(box, [positions[k]!, positions[k + 1]!, positions[k + 2]!]);
  return [box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]];
}

/** What the views show, in track axes. */
export function subjectOf(patches: readonly Patch[], wheel: PlacedMesh | null, rail: PlacedMesh | null): Subject {
  const railSize = rail ? extents(rail.mesh) : null;
  const radius = wheel ? wheelRadius(wheel.mesh) : 460;
  const box = boxOfPatches(patches);
  let contact: Vec3 = [0, 0, 0];
  if (box) contact = middleOf(box);
  else if (wheel) contact = [wheel.place.origin[0], wheel.place.origin[1] + wheel.mesh.centre[1], wheel.place.origin[2] + radius - 25];
  else if (rail) contact = toOuter(rail.place, rail.mesh.centre);
  return {
    contact,
    size: box ? Math.max(box.high[0] - box.low[0], box.high[1] - box.low[1]) : Math.min(400, railSize?.[1] ?? 60),
    railWidth: Math.min(160, Math.max(40, railSize?.[1] ?? 75)),
    wheelCentre: wheel ? [wheel.place.origin[0], contact[1], wheel.place.origin[2]] : contact,
    wheelRadius: radius,
  };
}
