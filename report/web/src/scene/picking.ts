// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Body } from "./body";
import { placeOf } from "./drape";
import type { ShownPatch } from "./patches";
import { firstHit, meetsSphere } from "./pick";
import { add, toInner, turnBack, type Vec3 } from "./vec";

export interface PickedElement {
  patch: number;
  ix: number;
  iy: number;
}

const tolerance = 0.8;

/** Distance along a ray in track axes at which it meets a body; infinite where it does not. */
function distanceToBody(body: Body, origin: Vec3, direction: Vec3): number {
  if (!body.place) return Infinity;
  const from = add(toInner(body.place, origin), body.mesh.centre, -1);
  const towards = turnBack(body.place.rotation, direction);
  let least = Infinity;
  for (const block of body.mesh.blocks) {
    if (!meetsSphere(block.centre, block.radius, from, towards)) continue;
    least = Math.min(least, firstHit(body.positions, block.index, from, towards)?.distance ?? Infinity);
  }
  return least;
}

/** The element under a ray in track axes, unless a solid body hides it. */
export function pickElement(shown: readonly ShownPatch[], solids: readonly Body[], origin: Vec3, direction: Vec3): PickedElement | null {
  let best: PickedElement | null = null;
  let least = Infinity;
  shown.forEach(({ patch, mesh }, k) => {
    const place = placeOf(patch);
    const hit = firstHit(mesh.positions, mesh.index, toInner(place, origin), turnBack(place.rotation, direction));
    if (!hit || hit.distance >= least) return;
    least = hit.distance;
    const element = mesh.elements[hit.triangle >> 1]!;
    best = { patch: k, ix: element % patch.nx, iy: Math.floor(element / patch.nx) };
  });
  if (!best) return null;
  const hidden = solids.some((body) => distanceToBody(body, origin, direction) < least - tolerance);
  return hidden ? null : best;
}
