// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Packed, SurfaceData } from "../data";
import { RAIL, WHEEL, type Library } from "./library";

// Wheels and rails as the views draw them, from heights of treadmark.h.

export const MILLI = 1e3;
/** Of the points across, and how far from the top or the tape line they may lie [mm]. */
const ACROSS_MM = 0.4;
const WIDEST_MM = 100;
const DEEPEST_MM = 45;
/** Stations: round a wheel, and along a rail whose sections differ [mm]. */
const ROUND = 360;
const ALONG_MM = 150;
const ALONG = 201;
/** Sections that differ less are alike [mm]. */
const ALIKE_MM = 1e-6;

/** Numbers that no blob holds. */
export function plain(values: Float32Array): Packed {
  return { blob: -1, offset: 0, count: values.length, type: "f32", values };
}

/** Heights of a section of the surface, in the plane turned about y by an angle or moved along x [mm]. */
function heights(library: Library, surface: number, body: number, station: number, y: readonly number[]): Float64Array {
  const { module } = library;
  const n = y.length;
  const at = library.room(8 * (3 * n + 12));
  const [x, z, rest] = [at, at + 16 * n, at + 24 * n];
  const [c, s] = body === WHEEL ? [Math.cos(station), Math.sin(station)] : [1, 0];
  module.HEAPF64.fill(0, x >> 3, (x >> 3) + n);
  module.HEAPF64.set(y.map((v) => v / MILLI), (x >> 3) + n);
  module.HEAPF64.set([body === WHEEL ? 0 : station / MILLI, 0, 0, c, 0, s, 0, 1, 0, -s, 0, c], rest >> 3);
  try {
    library.call("surface_heights", surface, rest, rest + 24, x, x + 8 * n, n, z, 0, 0);
    return library.doubles(z, n).map((v) => v * MILLI);
  } finally {
    module._free(at);
  }
}

function differ(a: Float64Array, b: Float64Array): boolean {
  return a.some((v, k) => Math.abs(v - b[k]!) > ALIKE_MM);
}

/** Points of a wheel or rail; null where it has none. `left`: it lies on the left-hand side. */
export function bodyOf(library: Library, surface: number, body: number, left: boolean): SurfaceData | null {
  const wide = Array.from({ length: Math.round((2 * WIDEST_MM) / ACROSS_MM) + 1 }, (_, k) => -WIDEST_MM + ACROSS_MM * k);
  const first = heights(library, surface, body, 0, wide);
  const finite = first.filter((v) => !Number.isNaN(v));
  if (finite.length < 4) return null;
  const sign = body === WHEEL ? -1 : 1;
  const top = sign * (body === WHEEL ? tapeLine(wide, first) : Math.min(...finite));
  const y = wide.filter((_, k) => sign * first[k]! - top < DEEPEST_MM);
  const section = (station: number): Float64Array => heights(library, surface, body, station, y);
  const middle = section(0);
  const tests = Array.from({ length: 24 }, (_, k) => (body === WHEEL ? (2 * Math.PI * (k + 0.5)) / 24 : ALONG_MM * ((k + 0.5) / 12 - 1)));
  const alike = !tests.some((station) => differ(section(station), middle));
  const nu = body === WHEEL ? ROUND : alike ? 2 : ALONG;
  const nv = y.length;
  const [px, py, pz] = [0, 1, 2].map(() => new Float32Array(nu * nv)) as [Float32Array, Float32Array, Float32Array];
  for (let iu = 0; iu < nu; ++iu) {
    const station = body === WHEEL ? (2 * Math.PI * iu) / nu - Math.PI : ALONG_MM * ((2 * iu) / (nu - 1) - 1);
    const z = alike ? middle : section(station);
    for (let iv = 0; iv < nv; ++iv) {
      const k = left ? nv - 1 - iv : iv;
      const to = iu * nv + iv;
      px[to] = body === WHEEL ? z[k]! * Math.sin(station) : station;
      py[to] = (left ? -1 : 1) * y[k]!;
      pz[to] = body === WHEEL ? z[k]! * Math.cos(station) : z[k]!;
    }
  }
  const name = body === RAIL ? "rail" : "wheel";
  return { body: name, name, nu, nv, x: plain(px), y: plain(py), z: plain(pz), deviation: null, closed: body === WHEEL };
}

/** Radius at y = 0, or the middle one where the wheel does not reach there. */
function tapeLine(y: readonly number[], z: Float64Array): number {
  const at = z[y.findIndex((v) => v >= 0)]!;
  if (!Number.isNaN(at)) return at;
  const radii = [...z].filter((v) => !Number.isNaN(v)).sort((a, b) => a - b);
  return radii[radii.length >> 1]!;
}
