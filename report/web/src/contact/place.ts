// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Frame, FrameSet, Patch } from "../data";

// Where patches lie: which one carries most, how grids lie to each other in track, and so where they are drawn.

/** Two places on the plane of a patch nearer than this [mm] may be of one contact. */
const NEAR_MM = 15;

/** A patch as drawn: x = grid x + ox, s = grid s + os [mm]. */
export interface Item {
  patch: Patch;
  /** Its place in the frame. */
  index: number;
  ox: number;
  os: number;
}

export type Vector = [number, number, number];

/** Numbers of a frame's patches, the one with the greatest normal force first; without forces in their own order. */
export function byLoad(frame: Frame): number[] {
  const load = (k: number): number => Math.abs(frame.patches[k]?.numbers["fn_N"] ?? 0);
  return frame.patches.map((_, k) => k).sort((a, b) => load(b) - load(a) || a - b);
}

/** p_track of a place on a patch's plane. */
export function toTrack(patch: Patch, x: number, s: number): Vector {
  const r = patch.rotation;
  const o = patch.origin_mm;
  return [o[0] + r[0]! * x + r[1]! * s, o[1] + r[3]! * x + r[4]! * s, o[2] + r[6]! * x + r[7]! * s];
}

/** Components of a vector of the track in the axes (x, s, n) of a patch. */
export function inAxesOf(patch: Patch, v: Vector): Vector {
  const r = patch.rotation;
  return [
    r[0]! * v[0] + r[3]! * v[1] + r[6]! * v[2],
    r[1]! * v[0] + r[4]! * v[1] + r[7]! * v[2],
    r[2]! * v[0] + r[5]! * v[1] + r[8]! * v[2],
  ];
}

/** x and s in the grid of a patch of a place in track. */
export function onGridOf(patch: Patch, p: Vector): [number, number] {
  const [x, s] = inAxesOf(patch, [p[0] - patch.origin_mm[0], p[1] - patch.origin_mm[1], p[2] - patch.origin_mm[2]]);
  return [x, s];
}

/** From the contact reference of `base` to that of `patch`, in the axes of base. */
function between(base: Patch, patch: Patch, shift = 0): Vector {
  const a = toTrack(base, ...base.reference_mm);
  const b = toTrack(patch, ...patch.reference_mm);
  return inAxesOf(base, [b[0] - a[0] + shift, b[1] - a[1], b[2] - a[2]]);
}

function item(patch: Patch, index: number, dx: number, ds: number): Item {
  return { patch, index, ox: dx - patch.reference_mm[0], os: ds - patch.reference_mm[1] };
}

/**
 * A patch drawn in the axes whose origin is the contact reference of `base`, by its place in track. `chord`: across the whole
 * distance counts, also that along the normal, as between patches on tread and flange.
 */
export function placed(base: Patch, patch: Patch, index: number, chord: boolean): Item {
  if (patch === base) return item(patch, index, 0, 0);
  const [dx, ds, dn] = between(base, patch);
  return item(patch, index, dx, chord ? Math.sign(ds) * Math.hypot(ds, dn) : ds);
}

/** Which patches of a frame are wanted: the k-th by load, those of a name, or all. */
export type Choice = { kind: "load"; rank: number } | { kind: "name"; name: string } | { kind: "all" };

export function chosen(frame: Frame, choice: Choice): number[] {
  const order = byLoad(frame);
  switch (choice.kind) {
    case "load":
      return order.slice(choice.rank, choice.rank + 1);
    case "name":
      return order.filter((k) => frame.patches[k]?.name === choice.name).slice(0, 1);
    case "all":
      return order;
  }
}

/** The patches of a frame to draw, about the contact reference of the first one. */
export function itemsOf(frame: Frame, choice: Choice): Item[] {
  const order = chosen(frame, choice);
  const base = frame.patches[order[0] ?? -1];
  if (!base) return [];
  return order.map((k) => placed(base, frame.patches[k]!, k, true));
}

/** The same of another representation: the patches nearest to those of the first, in the first one's axes. */
export function matchedItems(first: readonly Item[], frame: Frame, choice: Choice): Item[] {
  const base = first[0]?.patch;
  if (!base) return itemsOf(frame, choice);
  if (choice.kind === "all") return byLoad(frame).map((k) => placed(base, frame.patches[k]!, k, true));
  let best: Item | null = null;
  let least = NEAR_MM;
  frame.patches.forEach((patch, k) => {
    const distance = Math.hypot(...between(base, patch));
    if (distance >= least) return;
    least = distance;
    best = placed(base, patch, k, false);
  });
  return best ? [best] : [];
}

/**
 * The nominal patch (the main one of the set's nominal frame) about the reference of `base`: by its place in track along with the
 * wheel's centre where both frames have a wheel and the places are near, else with both references at one point.
 */
export function nominalItem(set: FrameSet, frame: Frame, base: Patch): Item | null {
  const nominal = set.nominal === null ? undefined : set.frames[set.nominal];
  if (!nominal || nominal === frame) return null;
  const index = byLoad(nominal)[0];
  const patch = index === undefined ? undefined : nominal.patches[index];
  if (!patch || index === undefined) return null;
  if (nominal.wheel && frame.wheel) {
    const [dx, ds] = between(base, patch, frame.wheel.origin_mm[0] - nominal.wheel.origin_mm[0]);
    if (Math.hypot(dx, ds) < NEAR_MM) return item(patch, index, dx, ds);
  }
  return item(patch, index, 0, 0);
}
