// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Made-up contact of a wheel with a flat: pressure from the overlap of the bodies, tractions by a march along strips with one
// flexibility, a flange contact in some frames, and the same through coarser representations.
import type { FieldInfo, Frame, FrameSet, Patch, ReportData } from "../src/data";
import { Packer } from "./pack";

export const contactFields: FieldInfo[] = [
  { name: "pressure", label: "Pressure", unit: "MPa", kind: "sequential", outside: "zero" },
  { name: "traction", label: "Traction, magnitude", unit: "MPa", kind: "sequential", outside: "zero" },
  { name: "traction_x", label: "Traction, longitudinal", unit: "MPa", kind: "diverging", outside: "zero" },
  { name: "traction_s", label: "Traction, lateral", unit: "MPa", kind: "diverging", outside: "zero" },
  { name: "slip", label: "Slip, magnitude", unit: "1e-3", kind: "sequential" },
  { name: "friction", label: "Coefficient of friction", unit: "1", kind: "sequential" },
  { name: "gap", label: "Undeformed distance", unit: "µm", kind: "sequential", outside: "value" },
  { name: "temperature_1", label: "Temperature of the rail", unit: "°C", kind: "sequential", outside: "value" },
  { name: "state", label: "State", unit: "", kind: "state" },
];

export interface Plan {
  name: string;
  /** Radii of the undeformed distance [mm], overlap [mm], grid. */
  rx: number;
  rs: number;
  overlap: number;
  nx: number;
  ny: number;
  dx: number;
  ds: number;
  /** Place of a flat's middle, its half length and its depth [mm]; null: none. */
  flat: { at: number; half: number; depth: number } | null;
  /** Creepages (longitudinal, lateral) and spin [1/mm]. */
  creep: [number, number, number];
  friction: number;
  /** Waves on the surface [mm] and the place of the grid in track. */
  waves: number;
  y: number;
  tilt: number;
  shift: number;
}

const STIFF = 20000;
const FLEXIBILITY = 1.1e-5;

function gapAt(plan: Plan, x: number, s: number): number {
  let gap = (x * x) / (2 * plan.rx) + (s * s) / (2 * plan.rs);
  if (plan.flat) {
    const u = (x - plan.flat.at) / plan.flat.half;
    if (Math.abs(u) < 1) gap += plan.flat.depth * (1 - u * u) ** 1.5 * Math.exp(-((s / 9) ** 2));
  }
  return gap + plan.waves * Math.sin(1.9 * x + 0.4) * Math.cos(2.3 * s);
}

export function contactPatch(plan: Plan, packer: Packer): Patch {
  const { nx, ny, dx, ds } = plan;
  const x0 = -((nx - 1) / 2) * dx;
  const s0 = -((ny - 1) / 2) * ds;
  const names = contactFields.map(({ name }) => name);
  const columns = Object.fromEntries(names.map((name) => [name, new Array<number>(nx * ny).fill(0)]));
  const [xi, eta, phi] = plan.creep;
  const numbers = { fn_N: 0, fx_N: 0, fs_N: 0, pmax_MPa: 0, area_mm2: 0 };
  for (let iy = 0; iy < ny; ++iy) {
    let tx = 0;
    let ts = 0;
    let heat = 60;
    for (let ix = nx - 1; ix >= 0; --ix) {
      const i = iy * nx + ix;
      const x = x0 + ix * dx;
      const s = s0 + iy * ds;
      const gap = gapAt(plan, x, s);
      const p = STIFF * Math.sqrt(Math.max(0, (plan.overlap - gap) * plan.overlap)) * 0.9;
      const mu = plan.friction * (1 - 0.1 * Math.tanh(Math.hypot(xi, eta) * 100));
      let slip = 0;
      let state = 0;
      if (p > 0) {
        tx -= ((xi - phi * s) * dx) / FLEXIBILITY;
        ts -= ((eta + phi * x) * dx) / FLEXIBILITY;
        const size = Math.hypot(tx, ts);
        state = 1;
        if (size > mu * p) {
          slip = (1e3 * (size - mu * p) * FLEXIBILITY) / dx;
          tx *= (mu * p) / size;
          ts *= (mu * p) / size;
          state = 2;
        }
        heat += 0.03 * slip * mu * p * dx;
      } else {
        tx = ts = 0;
        heat = 60 + (heat - 60) * 0.97;
      }
      const row: Record<string, number> = {
        pressure: p,
        traction: Math.hypot(tx, ts),
        traction_x: tx,
        traction_s: ts,
        slip,
        friction: mu,
        gap: 1e3 * gap,
        temperature_1: heat,
        state,
      };
      for (const name of names) columns[name]![i] = row[name]!;
      numbers.fn_N += p * dx * ds;
      numbers.fx_N += tx * dx * ds;
      numbers.fs_N += ts * dx * ds;
      numbers.pmax_MPa = Math.max(numbers.pmax_MPa, p);
      numbers.area_mm2 += p > 0 ? dx * ds : 0;
    }
  }
  const values: Patch["values"] = {};
  for (const { name, kind } of contactFields)
    values[name] = kind === "state" ? packer.bytes(columns[name]!) : packer.codes(columns[name]!, "u16");
  const c = Math.cos(plan.tilt);
  const s = Math.sin(plan.tilt);
  return {
    name: plan.name,
    nx,
    ny,
    x0_mm: x0,
    s0_mm: s0,
    dx_mm: dx,
    ds_mm: ds,
    origin_mm: [plan.shift, plan.y, 0.002 * plan.y * plan.y],
    rotation: [1, 0, 0, 0, c, -s, 0, s, c],
    reference_mm: [0, 0],
    values,
    numbers: { ...numbers, xi, eta, phi_rad_mm: phi, mn_Nmm: null },
  };
}

export const basePlan: Plan = {
  name: "patch 1",
  rx: 460,
  rs: 330,
  overlap: 0.075,
  nx: 80,
  ny: 60,
  dx: 0.25,
  ds: 0.3,
  flat: null,
  creep: [-0.0012, 0.0009, 0.00028],
  friction: 0.35,
  waves: 0,
  y: 0,
  tilt: 0.03,
  shift: 0,
};

const wheel: Frame["wheel"] = { surface: 0, origin_mm: [0, 0, -460], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] };

/** A frame of a flat that comes through; in the last third of the frames with a flange contact. */
export function flatFrame(k: number, count: number, blobs: string[], change: Partial<Plan> = {}): Frame {
  const packer = new Packer(blobs);
  const at = 18 - (36 * k) / Math.max(1, count - 1);
  const away = k === 0;
  const plan: Plan = {
    ...basePlan,
    flat: away ? null : { at, half: 9, depth: 0.09 },
    overlap: 0.075 + 0.03 * Math.exp(-((at / 6) ** 2)),
    ...change,
  };
  const patches = [contactPatch(plan, packer)];
  if (k > (2 * count) / 3)
    patches.push(
      contactPatch(
        {
          ...plan,
          name: "patch 2",
          rx: 250,
          rs: 40,
          overlap: 0.02 + 0.03 * (k / count),
          y: -31,
          tilt: -1.05,
          flat: null,
          nx: 60,
          ny: 50,
          ds: 0.12,
          creep: [-0.004, 0.002, 0.001],
        },
        packer,
      ),
    );
  packer.close();
  const angle = ((1.2 * at) / 460) * (180 / Math.PI);
  const name = away ? "no flat" : `pitch ${angle.toFixed(2)}°`;
  return { name, status: "ok", message: "", patches, wheel, rail: wheel };
}

/** A report with one view: of a run of `count` frames, or of three cases through five representations. */
export function contactReport(kind: "run" | "compare", count: number): ReportData {
  const blobs: string[] = [];
  const frames = (change: Partial<Plan>): Frame[] => Array.from({ length: count }, (_, k) => flatFrame(k, count, blobs, change));
  const set = (name: string, nominal: number | null, change: Partial<Plan> = {}): FrameSet => ({ name, nominal, frames: frames(change) });
  const sets = [set(kind === "run" ? "run" : "exact", kind === "run" ? 0 : null)];
  if (kind === "compare") {
    sets.push(set("spline 1 mm", null, { waves: 0.001 }));
    sets.push(set("mesh 2 mm", null, { waves: 0.006, shift: 0.3 }));
    sets.push(set("voxels 1 mm", null, { waves: 0.003, nx: 40, ny: 30, dx: 0.5, ds: 0.6, y: 0.4 }));
    sets.push(set("voxels 4 mm", null, { waves: 0.01, shift: -0.5 }));
  } else if (count > 5) {
    const run = sets[0]!.frames;
    run[3] = { ...run[3]!, status: "no_contact", patches: [], message: "" };
    run[4] = {
      ...run[4]!,
      status: "not_converged",
      message: "the residual stayed at 3e-4 after 200 iterations",
      trimmed: "slip and friction left out for size",
    };
  }
  return {
    format: "treadmark report 1",
    kind,
    title: kind === "run" ? "Wheel with a flat" : "Representations of a wheel with a flat",
    timeline: {
      label: "case",
      names: sets[0]!.frames.map(({ name }) => name),
      count,
      frames: Array.from({ length: count }, (_, k) => k),
      axes: [{ label: "case", unit: "", scale: "linear", values: Array.from({ length: count }, (_, k) => k + 1) }],
    },
    fields: contactFields,
    sets,
    surfaces: [],
    views: [{ type: "contact", id: "contact", sets: sets.map((_, k) => k) }],
    blobs,
    document: null,
  };
}
