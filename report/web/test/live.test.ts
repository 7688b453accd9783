// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";

import type { LiveData } from "../src/data";
import { CallError, Library, type Module } from "../src/live/library";
import { Solver } from "../src/live/solve";
import { besideOf, changed, CREEPAGE, fromAddress, givenOf, ROLLING, shapeKey, toAddress, tomlOf } from "../src/live/state";

test("a change takes the place of what it contradicts", () => {
  const start = new Map([[ROLLING, "free"], ["wheel.shape.standard", "S1002"]]);
  const braked = changed(start, CREEPAGE, "-1");
  assert.deepEqual([...braked], [["wheel.shape.standard", "S1002"], [CREEPAGE, "-1"]]);
  assert.deepEqual([...changed(braked, shapeKey("wheel", "file"), "worn.csv").keys()], [CREEPAGE, "wheel.shape.file"]);
  assert.equal(changed(braked, CREEPAGE, "").has(CREEPAGE), false);
  assert.deepEqual(givenOf({ toml: "t", changes: braked }), { toml: "t", changes: ["wheel.shape.standard=S1002"], creepage: -0.01 });
  // a name that TOML would take for a number
  assert.deepEqual(givenOf({ toml: "", changes: new Map([["rail.shape.file", "1.5"]]) }), { toml: "", changes: ['rail.shape.file="1.5"'] });
});

test("an address holds case and changes, and nothing that the page does not offer", () => {
  const changes = new Map([["wheelset.y_mm", "-2.5"], ["rail.shape.standard", "54E1"], ["wheel.shape.file", "own.csv"], [CREEPAGE, "0.2"]]);
  for (const toml of ["own", 'title = "another & = one"\n']) assert.deepEqual(fromAddress(`#${toAddress({ toml, changes }, "own")}`, "own"), { toml, changes });
  assert.equal(toAddress({ toml: "own", changes: new Map<string, string>() }, "own"), "");
  assert.equal(fromAddress("#contact", "own"), null);
  const hostile = fromAddress("#influence.file=/etc/passwd&wheelset.y_mm=1&%E0%A4%A=2", "own");
  assert.deepEqual(hostile, { toml: "own", changes: new Map([["wheelset.y_mm", "1"]]) });
});

test("a result holds its case, or none", () => {
  assert.equal(tomlOf({ input: { file: "a.toml", toml: "title = 'a'" } }), "title = 'a'");
  for (const other of [null, 3, [], {}, { input: null }, { input: { toml: 3 } }]) assert.equal(tomlOf(other), null);
});

test("beside it is the same case with other shapes", () => {
  const changes = new Map([["wheelset.y_mm", "2"], ["wheel.shape.standard", "S1002"], ["beside.wheel.shape.file", "worn.csv"], ["beside.rail.backend", "spline"]]);
  const state = { toml: "t", number: 3, changes };
  assert.deepEqual(givenOf(state), { toml: "t", number: 3, changes: ["wheelset.y_mm=2", "wheel.shape.standard=S1002"] });
  assert.deepEqual(givenOf(besideOf(state)!), { toml: "t", number: 3, changes: ["wheelset.y_mm=2", 'wheel.shape.file="worn.csv"', "rail.backend=spline"] });
  assert.equal(besideOf({ toml: "t", changes: new Map([["wheelset.y_mm", "2"]]) }), null);
  assert.deepEqual([...changed(changes, "beside.wheel.shape.standard", "EPS").keys()], ["wheelset.y_mm", "wheel.shape.standard", "beside.rail.backend", "beside.wheel.shape.standard"]);
  assert.deepEqual(fromAddress(`#${toAddress(state, "own")}`, "own"), state);
  for (const number of ["0", "-1", "1.5", "x"]) assert.equal(fromAddress(`#number=${number}`, "own")?.number, undefined);
});

// ---- the program for browsers against the one beside it ----

const { TREADMARK_WEB: web = "", TREADMARK: program = "" } = process.env;
const skip = existsSync(join(web, "treadmark-web.wasm")) ? false : "needs the program for browsers: scripts/web.sh";

const live: LiveData = {
  version: skip ? "" : (/^treadmark (.*)/.exec(spawnSync(program, ["--version"], { encoding: "utf8" }).stdout)?.[1] ?? ""),
  toml: "",
  files: {},
  profiles: { wheel: [], rail: [] },
  backends: [],
  fields: [{ name: "pressure", columns: ["pressure"], factor: 1e-6 }],
  numbers: [{ key: "pmax_MPa", name: "pmax", factor: 1e-6 }, { key: "fx_N", name: "fx", factor: 1 }, { key: "approach_mm", name: "approach", factor: 1e3 }],
};

async function library(): Promise<Library> {
  const create = createRequire(import.meta.url)(join(web, "treadmark-web.js")) as (how: object) => Promise<Module>;
  return new Library(await create({ wasmBinary: readFileSync(join(web, "treadmark-web.wasm")) }));
}

async function solver(): Promise<Solver> {
  return new Solver(await library(), live);
}

test("a program of another version solves nothing", { skip }, async () => {
  const one = await library();
  assert.throws(() => new Solver(one, { ...live, version: `${live.version}1` }), /written by Treadmark .*, and the program in it is .*scripts\/web\.sh/);
});

const base = `rail.shape.standard = "60E1"
wheel.shape.standard = "S1002"
track = { gauge_mm = 1435, cant = "1:40" }
wheelset = { nominal_radius_mm = 460, vertical_force_N = 80e3, velocity_m_s = 20, vpitch_rad_s = -43.5, flange_back_distance_mm = 1360, flange_back_position_mm = -70 }
friction.coefficient = 0.3
discretisation = { dx_mm = 1, ds_mm = 1 }
`;

/** Changes of the base case: standard, yawed, hollow, with a flat, left, canted, free, braked, fine, without contact, doubted. */
const cases: Record<string, string[]> = {
  "exact theory": [],
  "fine elements": ["discretisation.dx_mm=0.5", "discretisation.ds_mm=0.5"],
  "flange root": ["wheelset.y_mm=5.5"],
  "flange": ["wheelset.y_mm=8"],
  "away from the flange": ["wheelset.y_mm=-7"],
  "yawed": ["wheelset.yaw_deg=0.5"],
  "rolled": ["wheelset.roll_deg=0.3"],
  "left side": ["case.side=left", "wheelset.y_mm=-3"],
  "other cant": ["track.cant_deg=2.9"],
  "wide gauge": ["track.gauge_mm=1445"],
  "free": ["wheelset.rolling=free"],
  "braked": ["wheelset.vpitch_rad_s=-43"],
  "little friction": ["friction.coefficient=0.05"],
  "falling friction": ["friction.law=linear", "friction.amplitude_1=0.1", "friction.half_velocity_1_m_s=0.5"],
  "other rail": ["rail.shape.standard=54E1"],
  "cone": ["wheel.shape.standard=cone 1:20"],
  "flat": ["wheel.flats=[{ length_mm = 40, depth_mm = 0.5 }]", "wheelset.pitch_deg=2"],
  "no contact": ["wheelset.y_mm=300"],
  "unusual load": ["wheelset.vertical_force_N=2e6"],
  "own file": ["wheel.shape.file=own.csv"],
  "offsets": ["wheel.shape.file=own.nvdb", "wheelset.pitch_deg=2"],
};

interface Native {
  cases: { status: string; patches: { pmax_MPa: number; fx_N: number; approach_mm: number }[]; remarks: { name: string }[] }[];
}

test("the program for browsers gives the numbers of the program", { skip }, async (t) => {
  const folder = mkdtempSync(join(tmpdir(), "treadmark-live-"));
  try {
    const own = spawnSync(program, ["convert", "S1002", join(folder, "own.csv")]);
    assert.equal(own.status, 0, String(own.stderr));
    const here = await solver();
    writeFileSync(join(folder, "flat.toml"), `${base}wheel.flats = [{ length_mm = 40, depth_mm = 0.5 }]\n`);
    const offsets = spawnSync(program, ["convert", join(folder, "flat.toml"), join(folder, "own.nvdb"), "--body", "wheel", "--resolution", "2"]);
    assert.equal(offsets.status, 0, String(offsets.stderr));
    for (const name of ["own.csv", "own.nvdb"]) here.addFile(name, readFileSync(join(folder, name)));
    for (const [name, changes] of Object.entries(cases))
      await t.test(name, (one) => {
        const { frame, remarks, milliseconds } = here.solve({ toml: base, changes }, null, name);
        // the case as the page saves it
        writeFileSync(join(folder, "case.toml"), here.text({ toml: base, changes }));
        const run = spawnSync(program, ["--quiet", "run", join(folder, "case.toml"), "--json", "-"], { encoding: "utf8", maxBuffer: 1 << 26 });
        const expected = (JSON.parse(run.stdout) as Native).cases[0]!;
        assert.equal(frame.status, expected.status === "doubtful" ? "ok" : expected.status);
        assert.equal(frame.patches.length, expected.patches.length);
        expected.patches.forEach((patch, k) => {
          for (const key of ["pmax_MPa", "fx_N", "approach_mm"] as const) {
            const value = frame.patches[k]!.numbers[key]!;
            assert.ok(Math.abs(value - patch[key]) <= 1e-9 * Math.max(Math.abs(patch[key]), key === "fx_N" ? 1e3 : 0), `${key}: ${value}, not ${patch[key]}`);
          }
        });
        // What the program says of profiles and of smaller elements belongs to its runs.
        const told = new Set(expected.remarks.map((remark) => remark.name));
        for (const remark of remarks) assert.ok(told.has(remark.name), `${remark.name} is said here alone`);
        one.diagnostic(`solved in ${milliseconds.toFixed(1)} ms`);
      });
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("two at a time keep their surfaces", { skip }, async () => {
  const both = await library();
  const [here, there] = [new Solver(both, live), new Solver(both, live)];
  const wheel = (name: string): string[] => [`wheel.shape.standard=${name}`];
  const pressure = (one: Solver, changes: string[]): number => one.solve({ toml: base, changes }, null, "").frame.patches[0]!.numbers["pmax_MPa"]!;
  const [own, other] = [pressure(here, wheel("S1002")), pressure(there, wheel("cone 1:20"))];
  assert.notEqual(own, other);
  const again = here.solve({ toml: base, changes: wheel("S1002") }, 2, "", ["discretisation.dx", "wheelset.y"]);
  assert.equal(again.surfaces, null);
  assert.equal(again.coarse, true);
  assert.deepEqual(again.numbers, { "discretisation.dx": 1e-3, "wheelset.y": 0 });  // of the case, not of the coarser elements
  assert.equal(here.solve({ toml: base, changes: wheel("S1002") }, 0.5, "").coarse, false);
  assert.equal(pressure(here, wheel("S1002")), own);
  assert.equal(pressure(there, wheel("cone 1:20")), other);
  // another representation of the same surface
  const sampled = pressure(there, [...wheel("S1002"), "wheel.backend=spline"]);
  assert.ok(sampled !== own && Math.abs(sampled / own - 1) < 1e-3, `${sampled}, not ${own}`);
  assert.throws(() => here.solve({ toml: base, number: 2, changes: [] }, null, ""), /no case of this number/);
});

test("solving takes a few times what the program takes", { skip }, async (t) => {
  const fine = ["discretisation.dx_mm=0.5", "discretisation.ds_mm=0.5"];
  const folder = mkdtempSync(join(tmpdir(), "treadmark-live-"));
  const middle = (times: number[]): number => times.sort((a, b) => a - b)[times.length >> 1]!;
  try {
    const here = await solver();
    for (const [name, changes] of [
      ["exact theory, 1 mm", []],
      ["exact theory, 0.5 mm", fine],
      ["KPEC and FASTSIM, 1 mm", ["solver.normal_model=kpec", "solver.tangential_model=fastsim"]],
      ["flat, 0.5 mm", [...cases["flat"]!, ...fine]],
    ] as const) {
      const given = { toml: base, changes };
      const took = middle(Array.from({ length: 15 }, () => here.solve(given, null, name).milliseconds));
      const file = join(folder, "case.toml");
      writeFileSync(file, here.text(given));
      const often = `friction.coefficient=[${Array.from({ length: 15 }, () => 0.3).join(", ")}]`;
      const run = spawnSync(program, ["--quiet", "--threads", "1", "run", file, "--set", often, "--json", "-"], { encoding: "utf8", maxBuffer: 1 << 28 });
      const there = middle((JSON.parse(run.stdout) as { cases: { seconds: number }[] }).cases.map(({ seconds }) => 1e3 * seconds));
      t.diagnostic(`${name}: ${took.toFixed(1)} ms, the program ${there.toFixed(1)} ms: ratio ${(took / there).toFixed(1)}`);
      assert.ok(took < 5000);
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("what cannot be solved is a sentence, and the next case is solved", { skip }, async () => {
  const here = await solver();
  here.addFile("hostile.csv", new TextEncoder().encode("<script>alert(1)</script>,".repeat(1000)));
  for (const changes of [["wheelset.y_mm=nan"], ["wheelset.y_mm=not a number"], ["wheel.shape.file=hostile.csv"], ["wheel.shape.file=nowhere.csv"], ["nonsense"]])
    assert.throws(() => here.solve({ toml: base, changes }, null, ""), (error: unknown) => error instanceof CallError && error.message.length > 20);
  assert.throws(() => here.solve({ toml: "[[", changes: [] }, null, ""), CallError);
  assert.throws(() => here.solve({ toml: base, changes: [], creepage: NaN }, null, ""), CallError);
  assert.equal(here.solve({ toml: base, changes: [] }, null, "").frame.status, "ok");
});
