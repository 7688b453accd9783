// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A wheel with a flat that rolls along a rail, with made-up contact: data for work on the view in space.
import type { Frame, Packed, Patch, ReportData, SurfaceData } from "../src/data";
import { Packer } from "./pack";

type Point = [number, number];

const radius = 460;
const flatDepth = 0.9;
const flatAt = 0.35;
const steps = 26;
const roll = -1 / 40;

/** Across (to the right) and down from the tread's running circle: flange on the left. */
const wheelNodes: Point[] = [
  [-66, 2], [-65, 10], [-61, 19], [-55, 25.6], [-47.5, 28], [-41, 25.2], [-36.5, 17.5], [-32.2, 8.6], [-27, 3.1], [-20, 1.15],
  [-10, 0.45], [0, 0], [15, -0.45], [35, -1.3], [55, -2.9], [60, -3.6], [65, -8],
];

function spline(nodes: Point[], count: number): Point[] {
  const at = (k: number): Point => nodes[Math.min(nodes.length - 1, Math.max(0, k))]!;
  return Array.from({ length: count }, (_, i) => {
    const t = (i / (count - 1)) * (nodes.length - 1);
    const k = Math.min(nodes.length - 2, Math.floor(t));
    const f = t - k;
    const mix = (c: 0 | 1): number => {
      const [a, b, d, e] = [at(k - 1)[c], at(k)[c], at(k + 1)[c], at(k + 2)[c]];
      return b + 0.5 * f * (d - a + f * (2 * a - 5 * b + 4 * d - e + f * (3 * (b - d) + e - a)));
    };
    return [mix(0), mix(1)];
  });
}

/** Head of a rail like 60E1: arcs of 300, 80 and 13 mm and a flank of 1:20, by steps along its length. */
function railProfile(): Point[] {
  const half: Point[] = [[0, 0]];
  const ds = 0.5;
  let [y, z, angle] = [0, 0, 0];
  for (let s = 0; s < 58; s += ds) {
    const curve = y < 10.3 ? 1 / 300 : y < 26 ? 1 / 80 : angle < Math.atan(20) ? 1 / 13 : 0;
    y += ds * Math.cos(angle);
    z += ds * Math.sin(angle);
    angle = Math.min(Math.atan(20), angle + ds * curve);
    half.push([y, z]);
  }
  return [...half.slice(1).reverse().map(([a, b]): Point => [-a, b]), ...half];
}

function interpolate(profile: Point[], y: number): number {
  for (let k = 0; k + 1 < profile.length; ++k) {
    const [a, b] = [profile[k]!, profile[k + 1]!];
    if (a[0] <= y && y <= b[0] && b[0] > a[0]) return a[1] + ((y - a[0]) / (b[0] - a[0])) * (b[1] - a[1]);
  }
  return NaN;
}

export interface SceneDemoSize {
  stations: number;
  points: number;
  elements: number;
}

function wheelSurface(packer: Packer, { stations, points }: SceneDemoSize): SurfaceData {
  const profile = spline(wheelNodes, points);
  const [x, y, z, deviation]: number[][] = [[], [], [], []];
  for (let i = 0; i < stations; ++i) {
    const theta = (2 * Math.PI * i) / stations;
    const from = Math.abs(Math.atan2(Math.sin(theta - flatAt), Math.cos(theta - flatAt)));
    for (const [across, down] of profile) {
      const mean = radius + down;
      const cut = Math.min(mean, (mean - flatDepth) / Math.cos(Math.min(1.2, from)));
      const r = cut + 0.03 * Math.sin(6 * theta) + 0.012 * Math.sin(across / 5);
      x!.push(r * Math.sin(theta));
      y!.push(across);
      z!.push(r * Math.cos(theta));
      deviation!.push(r - mean);
    }
  }
  const f = (v: number[] | undefined): Packed => packer.f32(v ?? []);
  return { body: "wheel", name: "wheel", nu: stations, nv: points, x: f(x), y: f(y), z: f(z), deviation: f(deviation), closed: true };
}

function railSurface(packer: Packer): SurfaceData {
  const profile = railProfile();
  const [x, y, z, deviation]: number[][] = [[], [], [], []];
  const stations = 240;
  for (let i = 0; i < stations; ++i) {
    const at = -800 + (2400 * i) / (stations - 1);
    for (const [across, down] of profile) {
      const dip = 0.15 * Math.exp(-(((at - 250) / 60) ** 2)) * Math.exp(-((across / 20) ** 2));
      const hole = i === 84 && Math.abs(across) < 1.2;
      x!.push(hole ? NaN : at);
      y!.push(across);
      z!.push(down + dip);
      deviation!.push(-dip);
    }
  }
  const f = (v: number[] | undefined): Packed => packer.f32(v ?? []);
  return { body: "rail", name: "rail", nu: stations, nv: profile.length, x: f(x), y: f(y), z: f(z), deviation: f(deviation), closed: false };
}

/** Made-up pressures and tractions over an ellipse with a band of slip behind. */
function demoPatch(packer: Packer, n: number, origin: [number, number, number], tilt: number, force: number, flat: number): Patch {
  const [a, b] = [(6.2 + 5 * flat) * Math.cbrt(force), (5.4 - flat) * Math.cbrt(force)];
  const [nx, ny] = [n, Math.round(0.8 * n)];
  const [dx, ds] = [(2.3 * a) / nx, (2.3 * b) / ny];
  const fields: Record<string, number[]> = { pressure: [], traction: [], traction_x: [], traction_s: [], state: [] };
  const [x0, s0] = [-0.5 * (nx - 1) * dx, -0.5 * (ny - 1) * ds];
  for (let j = 0; j < ny; ++j)
    for (let i = 0; i < nx; ++i) {
      const [x, s] = [x0 + i * dx, s0 + j * ds];
      const inside = 1 - (x / a) ** 2 - (s / b) ** 2;
      const p = inside > 0 ? (1150 * Math.cbrt(force) - 300 * flat) * Math.sqrt(inside) * (1 + 0.5 * flat * Math.cos((2.5 * x) / a)) : 0;
      const stick = 1 - ((x - 0.25 * a) / (0.7 * a)) ** 2 - (s / (0.72 * b)) ** 2;
      const share = 0.3 * (p - (stick > 0 ? 0.72 * 1150 * Math.cbrt(force) * Math.sqrt(stick) : 0));
      const size = Math.max(0, share);
      const angle = 0.5 + 0.5 * (s / b);
      fields["pressure"]!.push(p);
      fields["traction_x"]!.push(-size * Math.cos(angle));
      fields["traction_s"]!.push(size * Math.sin(angle));
      fields["traction"]!.push(size);
      fields["state"]!.push(inside <= 0 ? 0 : stick > 0 ? 1 : 2);
    }
  const values: Record<string, Packed> = {};
  for (const [name, numbers] of Object.entries(fields)) values[name] = name === "state" ? packer.bytes(numbers) : packer.codes(numbers, "u16");
  const [c, s] = [Math.cos(tilt), Math.sin(tilt)];
  return {
    name: "patch 1", nx, ny, x0_mm: x0, s0_mm: s0, dx_mm: dx, ds_mm: ds, origin_mm: origin, rotation: [1, 0, 0, 0, c, -s, 0, s, c],
    reference_mm: [0, 0], values, numbers: { fn_N: 80000 * force, pmax_MPa: 1150 * Math.cbrt(force) },
  };
}

/** Place of first contact of the section: y of the rail's axis, the wheel's height and the slope there. */
function touch(rail: Point[], wheel: Point[], shift: number): { y: number; height: number; slope: number; railZ: number } {
  const turned = rail.map(([y, z]): Point => [y * Math.cos(roll) - z * Math.sin(roll), y * Math.sin(roll) + z * Math.cos(roll)]);
  let best = { y: 0, height: Infinity, slope: 0, railZ: 0 };
  for (let y = -33; y < 33; y += 0.05) {
    const gap = interpolate(turned, y) - interpolate(wheel, y - shift);
    if (gap < best.height) {
      const slope = (interpolate(turned, y + 0.2) - interpolate(turned, y - 0.2)) / 0.4;
      best = { y, height: gap, slope, railZ: interpolate(turned, y) };
    }
  }
  return best;
}

export function sceneDemo(size: SceneDemoSize = { stations: 900, points: 120, elements: 80 }): ReportData {
  const blobs: string[] = [];
  const packer = new Packer(blobs);
  const surfaces = [wheelSurface(packer, size), railSurface(packer)];
  packer.close();
  const [wheel, rail] = [spline(wheelNodes, 600), railProfile()];
  const frames: Frame[] = Array.from({ length: steps }, (_, k) => {
    const own = new Packer(blobs);
    const x = 12 * k;
    const shift = -6 + 0.3 * k;
    const { y, height, slope, railZ } = touch(rail, wheel, shift);
    const pitch = -x / radius + 13 * (12 / radius) - flatAt;
    const flat = Math.exp(-(((k - 13) / 2) ** 2));
    const patch = demoPatch(own, size.elements, [x, 750 + y, railZ], Math.atan(slope), 0.8 + 0.4 * Math.sin(k / 4), flat);
    own.close();
    const [c, s] = [Math.cos(pitch), Math.sin(pitch)];
    const [cr, sr] = [Math.cos(roll), Math.sin(roll)];
    return {
      name: `case ${k + 1}: y = ${shift.toFixed(1)} mm`, status: "ok", message: "", patches: [patch],
      wheel: { surface: 0, origin_mm: [x, 750 + shift, height - radius + flatDepth * flat + 0.06], rotation: [c, 0, s, 0, 1, 0, -s, 0, c] },
      rail: { surface: 1, origin_mm: [0, 750, 0], rotation: [1, 0, 0, 0, cr, -sr, 0, sr, cr] },
    };
  });
  return {
    format: "treadmark report 1", kind: "run", title: "Scene",
    timeline: { label: "case", names: frames.map((f) => f.name), count: steps, frames: frames.map((_, k) => k), axes: [{ label: "case", unit: "", scale: "linear", values: frames.map((_, k) => k) }] },
    fields: [
      { name: "pressure", label: "pressure", unit: "MPa", kind: "sequential", outside: "zero" },
      { name: "state", label: "adhesion and slip", unit: "", kind: "state" },
      { name: "traction", label: "traction", unit: "MPa", kind: "sequential", outside: "zero" },
      { name: "traction_x", label: "longitudinal traction", unit: "MPa", kind: "diverging", outside: "zero" },
      { name: "traction_s", label: "lateral traction", unit: "MPa", kind: "diverging", outside: "zero" },
    ],
    sets: [{ name: "run", nominal: null, frames }], surfaces, views: [{ type: "scene", id: "scene", set: 0 }], blobs, document: null,
  };
}
