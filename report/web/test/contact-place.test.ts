// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { test } from "node:test";

import { csvOf, plain } from "../src/contact/csv";
import { difference } from "../src/contact/difference";
import { contactBox, fieldOf, learnFields, shownValue, TRACTION } from "../src/contact/fields";
import { choicesOf, isApart, Model } from "../src/contact/model";
import { elementOf, peakOf } from "../src/contact/pick";
import { itemsOf, matchedItems, nominalItem, toTrack } from "../src/contact/place";
import { curvePath, sectionOf } from "../src/contact/section";
import type { Frame, Patch, ReportData } from "../src/data";
import { contactFields, contactReport } from "./contact-demo";
import { Packer } from "./pack";

learnFields(contactFields);

interface Simple {
  name?: string;
  nx: number;
  ny: number;
  dx?: number;
  ds?: number;
  x0?: number;
  s0?: number;
  origin?: [number, number, number];
  rotation?: number[];
  reference?: [number, number];
  fn?: number;
  pressure: (x: number, s: number) => number;
}

function simple(blobs: string[], plan: Simple): Patch {
  const { nx, ny, dx = 1, ds = 1 } = plan;
  const x0 = plan.x0 ?? (-(nx - 1) / 2) * dx;
  const s0 = plan.s0 ?? (-(ny - 1) / 2) * ds;
  const pressure = Array.from({ length: nx * ny }, (_, i) => Math.max(0, plan.pressure(x0 + (i % nx) * dx, s0 + Math.floor(i / nx) * ds)));
  const packer = new Packer(blobs);
  const values = {
    pressure: packer.f32(pressure),
    traction_x: packer.f32(pressure.map((p) => 0.3 * p)),
    traction_s: packer.f32(pressure.map((p) => -0.4 * p)),
    gap: packer.f32(pressure.map((p) => 100 - p)),
    state: packer.bytes(pressure.map((p) => (p > 0 ? 1 : 0))),
  };
  packer.close();
  return {
    name: plan.name ?? "patch 1",
    nx,
    ny,
    x0_mm: x0,
    s0_mm: s0,
    dx_mm: dx,
    ds_mm: ds,
    origin_mm: plan.origin ?? [0, 0, 0],
    rotation: plan.rotation ?? [1, 0, 0, 0, 1, 0, 0, 0, 1],
    reference_mm: plan.reference ?? [0, 0],
    values,
    numbers: { fn_N: plan.fn ?? 1 },
  };
}

function frame(patches: Patch[], wheelX: number | null = null): Frame {
  const wheel =
    wheelX === null
      ? null
      : { surface: 0, origin_mm: [wheelX, 0, -460] as [number, number, number], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
  return { name: "case", status: "ok", message: "", patches, wheel, rail: null };
}

const bump = (x: number, s: number): number => 50 - x * x - s * s;

function near(actual: number, expected: number, tolerance = 1e-6): void {
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);
}

test("the most loaded patch comes first, whatever its place in the file", () => {
  const blobs: string[] = [];
  const small = simple(blobs, { name: "patch 1", nx: 5, ny: 5, pressure: bump, fn: 10, reference: [1, 2] });
  const large = simple(blobs, { name: "patch 2", nx: 5, ny: 5, pressure: bump, fn: 90, reference: [-3, 0] });
  const both = frame([small, large]);
  const [main] = itemsOf(both, { kind: "load", rank: 0 });
  assert.equal(main!.index, 1);
  assert.equal(main!.ox, 3);
  const [second] = itemsOf(both, { kind: "load", rank: 1 });
  assert.deepEqual([second!.index, second!.ox, second!.os], [0, -1, -2]);
  assert.equal(itemsOf(both, { kind: "name", name: "patch 1" })[0]!.index, 0);
  assert.deepEqual(itemsOf(both, { kind: "load", rank: 2 }), []);
});

test("patches of one picture lie as far apart as in track", () => {
  const blobs: string[] = [];
  const a = 0.6;
  const tread = simple(blobs, { nx: 5, ny: 5, pressure: bump, fn: 90, origin: [2, 10, 1], reference: [0.5, 0] });
  const flange = simple(blobs, {
    nx: 5,
    ny: 5,
    pressure: bump,
    fn: 10,
    origin: [4, -20, 41],
    rotation: [1, 0, 0, 0, Math.cos(a), -Math.sin(a), 0, Math.sin(a), Math.cos(a)],
  });
  const [, other] = itemsOf(frame([tread, flange]), { kind: "all" });
  near(other!.ox, 4 - 2.5);
  near(other!.os, -Math.hypot(30, 40));
});

test("the same contact through another representation is found by its place in track", () => {
  const blobs: string[] = [];
  const truth = itemsOf(frame([simple(blobs, { nx: 5, ny: 5, pressure: bump, fn: 5, origin: [0, 10, 0], reference: [1, 0] })]), {
    kind: "load",
    rank: 0,
  });
  const far = simple(blobs, { nx: 5, ny: 5, pressure: bump, fn: 99, origin: [0, -30, 0] });
  const same = simple(blobs, { nx: 5, ny: 5, pressure: bump, fn: 1, origin: [0.25, 10.5, 0], reference: [1, 0] });
  const [found, ...others] = matchedItems(truth, frame([far, same]), { kind: "load", rank: 0 });
  assert.equal(others.length, 0);
  assert.equal(found!.patch, same);
  near(found!.ox, 0.25 - 1);
  near(found!.os, 0.5);
  assert.deepEqual(matchedItems(truth, frame([far]), { kind: "load", rank: 0 }), []);
});

test("patches far apart are told, to be shown together", () => {
  const blobs: string[] = [];
  const at = (y: number): Frame => frame([simple(blobs, { nx: 5, ny: 5, pressure: bump, fn: 5, origin: [0, y, 0] })]);
  const report = contactReport("compare", 2);
  const model = (y: number): Model =>
    new Model({ ...report, blobs, timeline: null, sets: [at(0), at(y)].map((one, k) => ({ name: `run ${k}`, nominal: null, frames: [one] })) }, [0, 1]);
  assert.equal(isApart(model(14)), false);
  assert.equal(isApart(model(16)), true);
  assert.deepEqual(choicesOf(model(16)), []);
  assert.deepEqual(choicesOf(model(16), true).map(({ label }) => label), ["all patches", "most loaded"]);
});

test("the nominal patch lies by the wheel's centre, or reference on reference", () => {
  const blobs: string[] = [];
  const nominal = simple(blobs, { nx: 5, ny: 5, pressure: bump, origin: [100, 0, 0] });
  const now = simple(blobs, { nx: 5, ny: 5, pressure: bump, origin: [353, 1, 0] });
  const set = (a: Frame, b: Frame): { name: string; nominal: number; frames: Frame[] } => ({ name: "run", nominal: 0, frames: [a, b] });
  const [first, second] = [frame([nominal], 100), frame([now], 350)];
  const item = nominalItem(set(first, second), second, now);
  near(item!.ox, -3);
  near(item!.os, -1);
  const still = frame([now]);
  const plain = nominalItem(set(frame([nominal]), still), still, now);
  assert.deepEqual([plain!.ox, plain!.os], [0, 0]);
  assert.equal(nominalItem(set(first, second), first, nominal), null);
});

test("a difference compares the nearest elements in track, also of other grids and turned axes", () => {
  const blobs: string[] = [];
  const truth = simple(blobs, { nx: 41, ny: 31, dx: 0.5, ds: 0.5, pressure: bump, origin: [3, 4, 5] });
  const a = Math.PI / 2;
  const turned = simple(blobs, {
    nx: 13,
    ny: 11,
    dx: 1.5,
    ds: 1.25,
    pressure: (x, s) => 2 * bump(x, s),
    origin: [3, 4, 5],
    rotation: [Math.cos(a), -Math.sin(a), 0, Math.sin(a), Math.cos(a), 0, 0, 0, 1],
  });
  const values = difference(turned, truth, "pressure", blobs)!;
  const mine = fieldOf(turned, "pressure", blobs)!;
  const theirs = fieldOf(truth, "pressure", blobs)!;
  let compared = 0;
  for (let i = 0; i < values.length; ++i) {
    const p = toTrack(turned, turned.x0_mm + (i % 13) * 1.5, turned.s0_mm + Math.floor(i / 13) * 1.25);
    let best = 0;
    let least = Infinity;
    for (let k = 0; k < 41 * 31; ++k) {
      const q = toTrack(truth, truth.x0_mm + (k % 41) * 0.5, truth.s0_mm + Math.floor(k / 41) * 0.5);
      const distance = Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      if (distance < least - 1e-9) [least, best] = [distance, k];
    }
    if (least > 0.2) continue;
    ++compared;
    if (mine[i] === 0 && theirs[best] === 0) assert.ok(Number.isNaN(values[i]));
    else near(values[i]!, mine[i]! - theirs[best]!, 1e-4);
  }
  assert.ok(compared > 30, `${compared} elements compared`);
  assert.ok(difference(truth, truth, "pressure", blobs)!.every((v) => Number.isNaN(v) || v === 0));
  const alone = difference(truth, null, "pressure", blobs)!;
  near(alone[15 * 41 + 20]!, 50, 1e-4);
});

test("values outside contact are shown of those fields alone that mean something there", () => {
  const blobs: string[] = [];
  const patch = simple(blobs, { nx: 21, ny: 21, pressure: bump });
  const corner = 0;
  const middle = 10 * 21 + 10;
  assert.ok(Number.isNaN(shownValue(patch, "pressure", corner, blobs)));
  assert.equal(shownValue(patch, "gap", corner, blobs), 100);
  assert.equal(shownValue(patch, "state", corner, blobs), 0);
  near(shownValue(patch, TRACTION, middle, blobs), 25, 1e-4);
  assert.deepEqual(contactBox(patch, blobs), { x0: 3, x1: 17, y0: 3, y1: 17 });
  assert.equal(contactBox(simple(blobs, { nx: 3, ny: 3, pressure: () => 0 }), blobs), null);
});

test("the peak is the value that is largest in size, and the element of a place the nearest", () => {
  const blobs: string[] = [];
  const patch = simple(blobs, {
    nx: 21,
    ny: 15,
    dx: 0.5,
    ds: 0.4,
    pressure: (x, s) => 30 - (x - 2) ** 2 - (s + 1.2) ** 2,
    reference: [1, 0.4],
  });
  const items = itemsOf(frame([patch]), { kind: "load", rank: 0 });
  const panel = { k: 0, set: 0, name: "run", frame: frame([patch]), items, other: null };
  const peak = peakOf(panel, (item, i) => -shownValue(item.patch, "pressure", i, blobs), blobs)!;
  near(patch.x0_mm + peak.ix * 0.5, 2);
  near(patch.s0_mm + peak.iy * 0.4, -1.2);
  const found = elementOf(panel, 1.1, -1.7, blobs)!;
  assert.deepEqual([found.ix, found.iy], [peak.ix, peak.iy]);
  assert.equal(elementOf(panel, 40, 0, blobs), null);
});

test("sections run through the element, with zero pressure outside contact", () => {
  const blobs: string[] = [];
  const patch = simple(blobs, { nx: 21, ny: 9, pressure: bump, reference: [2, 0] });
  const item = itemsOf(frame([patch]), { kind: "load", rank: 0 })[0]!;
  const section = sectionOf(item, "x", 10, 4, "pressure", blobs)!;
  assert.equal(section.at[0], -12);
  section.values.forEach((v, k) => near(v, Math.max(0, 50 - (k - 10) ** 2), 1e-4));
  const path = curvePath(
    { at: [0, 1, 2, 3, 4, 5], values: [0, 0, 3, 4, NaN, 2] },
    (x) => x,
    (v) => v,
  );
  assert.equal(path, "M1.0 0.0L2.0 3.0L3.0 4.0M5.0 2.0");
});

test("CSV: numbers of single precision with the digits that they have, heads without signs", () => {
  assert.equal(plain(Math.fround(0.3)), "0.3");
  assert.equal(plain(Math.fround(1 / 3)), "0.33333334");
  for (const value of [1909.41, 0.1, 2 / 3, 1e-20, 123456.78].map(Math.fround)) assert.equal(Math.fround(Number(plain(value))), value);
  assert.equal(plain(NaN), "");
  const blobs: string[] = [];
  const patch = simple(blobs, { nx: 2, ny: 2, pressure: () => 7, reference: [0, 0] });
  const item = itemsOf(frame([patch]), { kind: "load", rank: 0 })[0]!;
  const percent = contactFields.map((field) => (field.name === "pressure" ? { ...field, unit: "%" } : field));
  assert.match(csvOf([{ name: "patch 1", item }], percent, blobs), /^x_mm,s_mm,pressure_percent,/);
});

test("CSV: a line an element with every field, places as in the picture", () => {
  const blobs: string[] = [];
  const patch = simple(blobs, { nx: 3, ny: 2, pressure: () => 7, reference: [0.5, 0] });
  const item = itemsOf(frame([patch]), { kind: "load", rank: 0 })[0]!;
  const lines = csvOf([{ name: "patch 1", item }], contactFields, blobs)
    .trimEnd()
    .split("\n");
  assert.equal(lines[0], "x_mm,s_mm,pressure_MPa,traction_MPa,traction_x_MPa,traction_s_MPa,gap_um,state");
  assert.equal(lines.length, 7);
  assert.deepEqual(lines[1]!.split(",").slice(0, 3), ["-1.5", "-0.5", "7"]);
  assert.deepEqual(lines[6]!.split(",").slice(0, 3), ["0.5", "0.5", "7"]);
  const two = csvOf(
    [
      { name: 'a, "b"', item },
      { name: "c", item },
    ],
    contactFields,
    blobs,
  )
    .trimEnd()
    .split("\n");
  assert.equal(two.length, 13);
  assert.ok(two[1]!.startsWith('"a, ""b""",'));
});

test("window and ranges cover all steps", () => {
  const data: ReportData = contactReport("run", 9);
  const model = new Model(data, [0]);
  assert.deepEqual(model.frames, [0, 1, 2, 3, 4, 5, 6, 7, 8]);
  const all = model.window(model.frames, { kind: "load", rank: 0 }, new Set([0]), false, false);
  let most = 0;
  for (const k of model.frames) {
    const one = model.window([k], { kind: "load", rank: 0 }, new Set([0]), false, false);
    if (k !== 3) assert.ok(one.x0 >= all.x0 && one.x1 <= all.x1 && one.y0 >= all.y0 && one.y1 <= all.y1);
    for (const patch of data.sets[0]!.frames[k]!.patches) most = Math.max(most, patch.numbers["pmax_MPa"]!);
  }
  near(model.range("pressure", model.frames).high, most, 0.05);
  assert.deepEqual(
    choicesOf(model).map(({ label }) => label),
    ["most loaded", "second by load", "all patches", "patch 1", "patch 2"],
  );
});

test("representations are drawn about the truth's contact reference", () => {
  const model = new Model(contactReport("compare", 2), [0, 1, 2, 3, 4]);
  const panels = model.panels(1, { kind: "load", rank: 0 });
  near(panels[2]!.items[0]!.ox, 0.3);
  assert.equal(panels[2]!.other, panels[0]!.items[0]);
  const range = model.differenceRange("pressure", model.frames, { kind: "load", rank: 0 });
  assert.ok(range.high > 0 && range.low === -range.high);
  assert.ok(model.difference(panels[0]!.items[0]!, panels[0]!.items, "pressure")!.every((v) => Number.isNaN(v) || v === 0));
});
