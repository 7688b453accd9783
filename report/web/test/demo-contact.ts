// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Made-up contact of the demo page: half-ellipsoids of pressure with a strip of adhesion, a wheel with a flat, a rail.
import type { FieldInfo, Frame, Patch, Placed, SurfaceData } from "../src/data";
import { Packer } from "./pack";

export const demoFields: FieldInfo[] = [
  { name: "pressure", label: "Pressure", unit: "MPa", kind: "sequential", outside: "zero" },
  { name: "traction", label: "Traction, magnitude", unit: "MPa", kind: "sequential", outside: "zero" },
  { name: "traction_x", label: "Traction, longitudinal", unit: "MPa", kind: "diverging", outside: "zero" },
  { name: "traction_s", label: "Traction, lateral", unit: "MPa", kind: "diverging", outside: "zero" },
  { name: "slip", label: "Slip velocity, magnitude", unit: "mm/s", kind: "sequential" },
  { name: "gap", label: "Gap", unit: "µm", kind: "sequential", outside: "value" },
  { name: "state", label: "State", unit: "", kind: "state" },
];

const wheelRadius = 460;
const railCrown = 300;

/** Height of the rail's head below its top at a lateral place. */
function railDrop(y: number): number {
  const side = Math.abs(y) - 26;
  const crown = (y * y) / (2 * railCrown);
  return side <= 0 ? crown : crown + 13 - Math.sqrt(Math.max(0, 169 - Math.min(13, side) ** 2)) + Math.max(0, side - 13) * 20;
}

/** Radius of the wheel at a lateral place: cone of 1:40, flange on the inner side. */
function wheelProfile(y: number): number {
  const flange = 28 * Math.exp(-(((y + 48) / 11) ** 2));
  return wheelRadius - (y + 0) / 40 + flange - 0.0004 * Math.max(0, y) ** 2;
}

export function demoSurfaces(blobs: string[]): SurfaceData[] {
  const packer = new Packer(blobs);
  const wheel: number[][] = [[], [], [], []];
  const stations = 240;
  const across = 100;
  for (let i = 0; i < stations; ++i) {
    const angle = (2 * Math.PI * i) / stations;
    const away = ((angle - 1.2 + Math.PI) % (2 * Math.PI)) - Math.PI;
    for (let j = 0; j < across; ++j) {
      const y = -62 + (125 * j) / (across - 1);
      const flat = Math.max(0, 1 - (away / 0.09) ** 2) * 0.6 * Math.exp(-((y / 25) ** 2));
      const wear = 0.05 * Math.sin(14 * angle) * Math.exp(-(((y - 5) / 20) ** 2));
      const deviation = wear - flat;
      const radius = wheelProfile(y) + deviation;
      wheel[0]!.push(radius * Math.sin(angle));
      wheel[1]!.push(y);
      wheel[2]!.push(radius * Math.cos(angle));
      wheel[3]!.push(deviation);
    }
  }
  const rail: number[][] = [[], [], [], []];
  const railStations = 81;
  const railAcross = 90;
  for (let i = 0; i < railStations; ++i) {
    const x = -400 + (800 * i) / (railStations - 1);
    for (let j = 0; j < railAcross; ++j) {
      const y = -38.5 + (77 * j) / (railAcross - 1);
      const deviation = 0.04 * Math.cos((2 * Math.PI * x) / 60) * Math.exp(-((y / 14) ** 2));
      rail[0]!.push(x);
      rail[1]!.push(y);
      rail[2]!.push(railDrop(y) - deviation);
      rail[3]!.push(deviation);
    }
  }
  const surface = (body: "wheel" | "rail", nu: number, nv: number, v: number[][], closed: boolean): SurfaceData => ({
    body,
    name: body === "wheel" ? "Wheel with a flat" : "Corrugated rail",
    nu,
    nv,
    x: packer.codes(v[0]!, "u16"),
    y: packer.codes(v[1]!, "u16"),
    z: packer.codes(v[2]!, "u16"),
    deviation: packer.codes(v[3]!, "u16"),
    closed,
  });
  const surfaces = [surface("wheel", stations, across, wheel, true), surface("rail", railStations, railAcross, rail, false)];
  packer.close();
  return surfaces;
}

function rotationX(angle: number): number[] {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return [1, 0, 0, 0, c, -s, 0, s, c];
}

interface PatchPlan {
  name: string;
  a: number;
  b: number;
  p0: number;
  friction: number;
  creep: number;
  y: number;
  tilt: number;
}

function demoPatch(plan: PatchPlan, packer: Packer): Patch {
  const nx = 80;
  const ny = 60;
  const dx = (2.5 * 8) / nx;
  const ds = (2.5 * 6) / ny;
  const columns: Record<string, number[]> = {};
  for (const field of demoFields) columns[field.name] = [];
  let force = 0;
  let tangential = 0;
  for (let j = 0; j < ny; ++j) {
    for (let i = 0; i < nx; ++i) {
      const x = (i - (nx - 1) / 2) * dx;
      const s = (j - (ny - 1) / 2) * ds;
      const inside = 1 - (x / plan.a) ** 2 - (s / plan.b) ** 2;
      const p = inside > 0 ? plan.p0 * Math.sqrt(inside) : 0;
      const edge = plan.a * Math.sqrt(Math.max(0, 1 - (s / plan.b) ** 2));
      const share = 1 - plan.creep;
      const shifted = 1 - ((x - plan.creep * edge) / Math.max(1e-9, share * edge)) ** 2;
      const stuck = inside > 0 && shifted > 0 && plan.creep < 1;
      const bound = plan.friction * p;
      const t = stuck ? bound - plan.friction * plan.p0 * share * Math.sqrt(shifted) * (edge / plan.a) : bound;
      const turn = 0.6 * (s / plan.b) + 0.2;
      columns.pressure!.push(p);
      columns.traction!.push(t);
      columns.traction_x!.push(-t * Math.cos(turn));
      columns.traction_s!.push(t * Math.sin(turn));
      columns.slip!.push(inside > 0 && !stuck ? 40 * plan.creep * (edge - x) : 0);
      columns.gap!.push(inside > 0 ? 0 : Math.min(200, 30 * -inside * Math.sqrt(-inside)));
      columns.state!.push(inside <= 0 ? 0 : stuck ? 1 : 2);
      force += p * dx * ds;
      tangential += -t * Math.cos(turn) * dx * ds;
    }
  }
  const values: Patch["values"] = {};
  for (const field of demoFields) {
    const column = columns[field.name]!;
    values[field.name] = field.kind === "state" ? packer.bytes(column) : packer.codes(column, field.name === "pressure" ? "u16" : "u8");
  }
  return {
    name: plan.name,
    nx,
    ny,
    x0_mm: (-(nx - 1) / 2) * dx,
    s0_mm: (-(ny - 1) / 2) * ds,
    dx_mm: dx,
    ds_mm: ds,
    origin_mm: [0, plan.y, railDrop(plan.y)],
    rotation: rotationX(plan.tilt),
    reference_mm: [0, 0],
    values,
    numbers: { fn_N: force, ft_N: tangential, pmax_MPa: plan.p0, area_mm2: Math.PI * plan.a * plan.b, share_of_slip: plan.creep, energy_J: null },
  };
}

/** Frame of a lateral displacement; a flange contact beyond 6 mm; `travel` turns the wheel and moves it forward. */
export function demoFrame(name: string, lateral: number, creep: number, travel: number, blobs: string[]): Frame {
  const packer = new Packer(blobs);
  const yc = 0.8 * lateral;
  const patches: Patch[] = [];
  const status = lateral > 9.3 ? "not_converged" : "ok";
  patches.push(
    demoPatch({ name: "tread", a: 6.5 - 0.15 * lateral, b: 4.4 + 0.12 * lateral, p0: 1050 - 25 * lateral, friction: 0.35, creep, y: yc, tilt: yc / railCrown }, packer),
  );
  if (lateral > 6) {
    const grow = Math.min(1, (lateral - 6) / 3);
    patches.push(demoPatch({ name: "flange", a: 2 + 5 * grow, b: 0.8 + 0.7 * grow, p0: 700 + 1700 * grow, friction: 0.3, creep: 0.9, y: -33, tilt: -0.9 }, packer));
  }
  packer.close();
  const roll = -travel / wheelRadius;
  const c = Math.cos(roll);
  const s = Math.sin(roll);
  const wheel: Placed = { surface: 0, origin_mm: [0, lateral, -wheelRadius], rotation: [c, 0, s, 0, 1, 0, -s, 0, c] };
  const rail: Placed = { surface: 1, origin_mm: [-(travel % 60), 0, 0], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
  return { name, status, message: status === "ok" ? "" : "the residual stayed at 3e-4 after 200 iterations", patches, wheel, rail };
}
