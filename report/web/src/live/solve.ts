// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Frame, LiveData, Packed, Patch, Placed, SurfaceData } from "../data";
import { bodyOf, MILLI, plain } from "./bodies";
import { FAILED, RAIL, WHEEL, type Library } from "./library";

// Solves cases as the worker of a page does, and gives what the views show.

/** A case: the text of its file, and keys that differ. */
export interface Given {
  toml: string;
  /** Of the case in its file, 1 unless said. */
  number?: number;
  changes: readonly string[];
  /** The wheel turns by this share faster than at its nominal radius. */
  creepage?: number;
}

export interface Remark {
  name: string;
  text: string;
  patch: number;
  grave: boolean;
}

export interface Solved {
  frame: Frame;
  /** Rail and wheel, if they are others than those of the answer before. */
  surfaces: SurfaceData[] | null;
  remarks: Remark[];
  /** In track axes [N]. */
  force: [number, number, number];
  milliseconds: number;
  /** Of the case, in SI by their names in treadmark.h. */
  numbers: Record<string, number>;
  /** Its elements are coarser than those of the case. */
  coarse: boolean;
}

/** Folder of the files that were given; deep, so that those above a case have places of their own. */
const FOLDER = `${"/up".repeat(16)}/case`;
const STATUS = ["ok", "no_contact", "not_converged", "failed"] as const;
const NONE: Solved["force"] = [NaN, NaN, NaN];

/** Keys on which the surfaces do not depend, where they are not sampled for their place. */
const MOTIONS = /^(wheelset\.(y|yaw|roll|pitch|vpitch|velocity|rolling|vertical_force|longitudinal_force)\w*|track\.(gauge|cant)\w*|friction\.\w+|discretisation\.\w+)=/;

/** Where a name in the folder leads to. */
function placeOf(name: string): string {
  const parts: string[] = [];
  for (const part of `${FOLDER}/${name}`.split("/"))
    if (part === "..") parts.pop();
    else if (part !== "" && part !== ".") parts.push(part);
  return `/${parts.join("/")}`;
}

export class Solver {
  private key = "";
  private pair = 0;
  private surfaces: [number, number] = [0, 0];
  private shown: SurfaceData[] = [];
  /** Whether an answer had them. */
  private told = false;
  /** Of the case of the surfaces: whether it is one of a shift, whose slip and creepages are lengths. */
  private shift = false;

  /** Errors: the program is of another version than the page. */
  constructor(
    private readonly library: Library,
    private readonly live: LiveData,
  ) {
    const [own = ""] = library.text(library.ask("version_text")).split("\n");
    if (own !== live.version)
      throw new Error(`the page was written by Treadmark ${live.version}, and the program in it is ${own}: make that anew by scripts/web.sh`);
    library.module.FS.mkdirTree(FOLDER);
    library.module.FS.chdir(FOLDER);
  }

  addFile(name: string, bytes: Uint8Array): void {
    const { FS } = this.library.module;
    const path = placeOf(name);
    FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
    FS.writeFile(path, bytes);
    this.key = "";
  }

  /** Does something with a case; it is freed. */
  with<T>({ toml, number = 1, changes, creepage }: Given, task: (c: number) => T): T {
    const { library } = this;
    const c = library.make("case_parse", toml, new TextEncoder().encode(toml).length, 0, number);
    try {
      for (const change of changes) library.call("case_set", c, change);
      if (creepage !== undefined) {
        const [speed, radius] = ["velocity", "nominal_radius"].map((name) => library.number("case_get_number", c, `wheelset.${name}`)) as [number, number];
        // As text, for the words of what is wrong with it.
        library.call("case_set", c, `wheelset.vpitch_rad_s=${(-speed / radius) * (1 + creepage)}`);
      }
      return task(c);
    } finally {
      library.ask("case_free", c);
    }
  }

  /** The case as a file. */
  text(given: Given): string {
    return this.with(given, (c) => this.library.textOf("case_text", c));
  }

  /** As `treadmark geometry` of the case. */
  geometry(given: Given): unknown {
    const file = "case-of-the-page.toml";
    this.library.module.FS.writeFile(placeOf(file), new TextEncoder().encode(this.text(given)));
    return JSON.parse(this.library.textBySettings("geometry", [`case=${file}`]));
  }

  check(name: string, body: string): unknown {
    return JSON.parse(this.library.textOf("check_profile", name, body === "" ? 0 : body));
  }

  private prepare({ toml, number }: Given, changes: readonly string[], c: number): void {
    const { library } = this;
    const sampled = [toml, ...changes].some((text) => text.includes("backend"));
    const key = JSON.stringify([toml, number, changes.filter((change) => sampled || !MOTIONS.test(change))]);
    if (key === this.key) return;
    [this.key, this.told] = ["", false];
    library.ask("pair_free", this.pair);
    this.surfaces.forEach((one) => library.ask("surface_free", one));
    [this.pair, this.surfaces] = [0, [0, 0]];
    for (const body of [RAIL, WHEEL]) this.surfaces[body] = library.make("surface_of_case", c, body);
    this.pair = library.make("pair_create", ...this.surfaces);
    const text = library.textOf("case_text", c);
    const left = /^side = "left"$/m.test(text);
    this.shift = /^regime = "shift"$/m.test(text);
    this.shown = [RAIL, WHEEL].flatMap((body) => bodyOf(library, this.surfaces[body]!, body, left) ?? []);
    this.key = key;
  }

  /** As it is, or at elements of a size [mm] where its own are smaller. names: numbers that the answer tells. Errors: CallError. */
  solve(given: Given, element: number | null, name: string, names: readonly string[] = []): Solved {
    return this.with(given, (c) => {
      const { library } = this;
      const of = (number: string): number => library.number("case_get_number", c, number);
      const numbers = Object.fromEntries(names.map((one) => [one, of(one)]));
      const coarse = element !== null && !(MILLI * of("discretisation.dx") >= element);
      const sizes = coarse ? ["dx", "ds"].map((size) => `discretisation.${size}_mm=${element}`) : [];
      for (const size of sizes) library.call("case_set", c, size);
      this.prepare(given, [...given.changes, ...sizes], c);
      library.call("pair_reset", this.pair);
      const begin = performance.now();
      const status = library.call("pair_solve", this.pair, c, library.out(0));
      const s = library.pointer(0);
      const milliseconds = performance.now() - begin;
      try {
        const shown = this.shownOf(s, status, name);
        const surfaces = this.told ? null : this.shown;
        this.told = true;
        return { ...shown, surfaces, milliseconds, numbers, coarse };
      } finally {
        library.ask("solution_free", s);
      }
    });
  }

  private shownOf(s: number, status: number, name: string): Pick<Solved, "frame" | "remarks" | "force"> {
    const { library } = this;
    const message = library.text(library.ask("solution_message", s));
    const frame: Frame = { name, status: STATUS[status] ?? "failed", message, patches: [], wheel: null, rail: null };
    const remarks = Array.from({ length: library.ask("solution_remarks", s) }, (_, i): Remark => {
      library.call("solution_remark", s, i, ...[0, 1, 2, 3].map((k) => library.out(k)));
      return { name: library.text(library.pointer(0)), text: library.text(library.pointer(1)), patch: library.pointer(2), grave: library.pointer(3) !== 0 };
    });
    if (status >= FAILED) return { frame, remarks, force: NONE };
    frame.rail = this.placed(s, RAIL);
    frame.wheel = this.placed(s, WHEEL);
    frame.patches = Array.from({ length: library.ask("solution_patches", s) }, (_, k) => this.patch(s, k));
    const force = ["x", "y", "z"].map((axis) => library.number("solution_number", s, `force_on_rail.f${axis}_tr`)) as Solved["force"];
    return { frame, remarks, force };
  }

  /** What a function says of a place: origin [mm] and rotation by rows. */
  private pose(name: string, ...of: number[]): { origin_mm: [number, number, number]; rotation: number[] } {
    const { library } = this;
    library.call(name, ...of, library.out(0), library.out(3));
    const origin = [0, 1, 2].map((k) => MILLI * library.double(k)) as [number, number, number];
    return { origin_mm: origin, rotation: Array.from({ length: 9 }, (_, k) => library.double(3 + k)) };
  }

  private placed(s: number, body: number): Placed | null {
    const surface = this.shown.findIndex((one) => one.body === (body === RAIL ? "rail" : "wheel"));
    return surface < 0 ? null : { surface, ...this.pose("solution_pose", s, body) };
  }

  private patch(s: number, k: number): Patch {
    const { library, live } = this;
    library.call("patch_grid", s, k, ...[0, 1, 2, 3, 4, 5].map((at) => library.out(at)));
    const [nx, ny] = [library.pointer(0), library.pointer(1)];
    const [x0, s0, dx, ds] = [2, 3, 4, 5].map((at) => MILLI * library.double(at)) as [number, number, number, number];
    const pose = this.pose("patch_pose", s, k);
    const { origin_mm: o, rotation: r } = pose;
    const at = ["x", "y", "z"].map((axis, i) => MILLI * library.number("patch_number", s, k, `reference.${axis}_tr`) - o[i]!);
    const reference = [0, 1].map((axis) => r[axis]! * at[0]! + r[3 + axis]! * at[1]! + r[6 + axis]! * at[2]!) as [number, number];
    const column = (name: string): Float64Array | null => {
      library.call("patch_field", s, k, name, library.out(0));
      return library.pointer(0) === 0 ? null : library.doubles(library.pointer(0), nx * ny);
    };
    const values: Record<string, Packed> = {};
    const keep = (name: string, f: (i: number) => number): void => {
      const kept = new Float32Array(nx * ny);
      for (let i = 0; i < kept.length; ++i) kept[i] = f(i);
      values[name] = plain(kept);
    };
    library.call("patch_states", s, k, library.out(0));
    const states = library.pointer(0);
    if (states !== 0) keep("state", (i) => library.module.HEAPU8[states + i]!);
    for (const { name, columns, factor, shift = this.shift } of live.fields) {
      if (shift !== this.shift) continue;
      const [a, b] = columns.map(column);
      if (!a || (columns.length > 1 && !b)) continue;
      keep(name, b ? (i) => factor * Math.sqrt(a[i]! * a[i]! + b[i]! * b[i]!) : (i) => factor * a[i]!);
    }
    const numbers: Patch["numbers"] = {};
    for (const { key, name, factor, shift = this.shift } of live.numbers) {
      if (shift !== this.shift) continue;
      const value = library.number("patch_number", s, k, name);
      if (!Number.isNaN(value)) numbers[key] = factor * value;
    }
    return { name: `patch ${k + 1}`, nx, ny, x0_mm: x0, s0_mm: s0, dx_mm: dx, ds_mm: ds, ...pose, reference_mm: reference, values, numbers };
  }
}
