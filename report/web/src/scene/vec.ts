// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

export type Vec3 = [number, number, number];

export function sub(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function add(a: Vec3, b: Vec3, factor = 1): Vec3 {
  return [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
}

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function length(a: Vec3): number {
  return Math.hypot(a[0], a[1], a[2]);
}

/** A rigid place: p_outer = origin + rotation p_inner, the rotation row by row. */
export interface Place {
  origin: Vec3;
  rotation: readonly number[];
}

export function toOuter({ origin: o, rotation: r }: Place, p: Vec3): Vec3 {
  return [
    o[0] + r[0]! * p[0] + r[1]! * p[1] + r[2]! * p[2],
    o[1] + r[3]! * p[0] + r[4]! * p[1] + r[5]! * p[2],
    o[2] + r[6]! * p[0] + r[7]! * p[1] + r[8]! * p[2],
  ];
}

/** Direction of the inner axes in the outer ones. */
export function turn(r: readonly number[], d: Vec3): Vec3 {
  return toOuter({ origin: [0, 0, 0], rotation: r }, d);
}

/** The inverse of turn. */
export function turnBack(r: readonly number[], d: Vec3): Vec3 {
  return [
    r[0]! * d[0] + r[3]! * d[1] + r[6]! * d[2],
    r[1]! * d[0] + r[4]! * d[1] + r[7]! * d[2],
    r[2]! * d[0] + r[5]! * d[1] + r[8]! * d[2],
  ];
}

export function toInner(place: Place, p: Vec3): Vec3 {
  return turnBack(place.rotation, sub(p, place.origin));
}

/** The place of `inner` in the axes in which `outer` is given: p_outer = compose(outer, inner) p_inner. */
export function compose(outer: Place, inner: Place): Place {
  const a = outer.rotation;
  const b = inner.rotation;
  const rotation: number[] = [];
  for (let i = 0; i < 3; ++i)
    for (let j = 0; j < 3; ++j)
      rotation.push(a[3 * i]! * b[j]! + a[3 * i + 1]! * b[3 + j]! + a[3 * i + 2]! * b[6 + j]!);
  return { origin: toOuter(outer, inner.origin), rotation };
}

/** The place of b in the axes of a, both given in the same axes. */
export function relative(a: Place, b: Place): Place {
  const r = a.rotation;
  const transposed = [r[0]!, r[3]!, r[6]!, r[1]!, r[4]!, r[7]!, r[2]!, r[5]!, r[8]!];
  return compose({ origin: turn(transposed, sub([0, 0, 0], a.origin)), rotation: transposed }, b);
}

/** Sixteen numbers, column by column, as three.js takes them. */
export function columnMajor({ origin: o, rotation: r }: Place): number[] {
  return [r[0]!, r[3]!, r[6]!, 0, r[1]!, r[4]!, r[7]!, 0, r[2]!, r[5]!, r[8]!, 0, o[0], o[1], o[2], 1];
}
