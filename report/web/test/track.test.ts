// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { test } from "node:test";

import type { Patch, Placed, SurfaceData } from "../src/data";
import { cutOf, sectionAt, sideNames } from "../src/section";
import { MOST_PANELS, somePanels, trackBox } from "../src/track";
import { Packer } from "./pack";

const near = (value: number, wanted: number, bound: number): void => assert.ok(Math.abs(value - wanted) <= bound, `${value}, not ${wanted}`);

test("a round wheel is cut where its circle says, at its lower side, wherever its stations lie", () => {
  const radius = 460;
  const nu = 720;
  const blobs: string[] = [];
  const packer = new Packer(blobs);
  const grid = (f: (angle: number, y: number) => number): number[] => Array.from({ length: nu * 2 }, (_, i) => f((2 * Math.PI * Math.floor(i / 2)) / nu, 30 * (i % 2)));
  const surface: SurfaceData = {
    body: "wheel",
    name: "wheel",
    nu,
    nv: 2,
    x: packer.f32(grid((angle) => radius * Math.sin(angle))),
    y: packer.f32(grid((_, y) => y)),
    z: packer.f32(grid((angle) => radius * Math.cos(angle))),
    deviation: null,
    closed: true,
  };
  packer.close();
  const pitch = 0.3;
  const [c, s] = [Math.cos(pitch), Math.sin(pitch)];
  const at: Placed = { surface: 0, origin_mm: [5, 740, -radius], rotation: [c, 0, s, 0, 1, 0, -s, 0, c] };
  const cut = sectionAt(surface, at, 25, blobs);
  // A chord between stations lies below the circle by R (pi / nu)^2 / 2 at most.
  const chord = (radius * (Math.PI / nu) ** 2) / 2;
  assert.deepEqual(cut.map(([y]) => Math.round(y)), [740, 770]);
  for (const [, z] of cut) near(z, Math.sqrt(radius ** 2 - 20 ** 2) - radius, chord + 1e-3);
  assert.ok(sectionAt(surface, at, 5 + radius + 1, blobs).every(([y]) => Number.isNaN(y)));
});

test("a patch lies in the track as its plane is turned", () => {
  const blobs: string[] = [];
  const packer = new Packer(blobs);
  const angle = 0.5;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  // 5 x 3 elements of which the middle 3 x 1 are in contact.
  const state = Array.from({ length: 15 }, (_, i) => (Math.floor(i / 5) === 1 && i % 5 > 0 && i % 5 < 4 ? 1 : 0));
  const patch: Patch = {
    name: "patch 1",
    nx: 5,
    ny: 3,
    x0_mm: -2,
    s0_mm: -1,
    dx_mm: 1,
    ds_mm: 1,
    origin_mm: [100, 750, 3],
    rotation: [1, 0, 0, 0, c, -s, 0, s, c],
    reference_mm: [0, 0],
    values: { state: packer.bytes(state) },
    numbers: {},
  };
  packer.close();
  const box = trackBox(patch, blobs);
  assert.ok(box);
  near(box.x0, 98.5, 1e-12);
  near(box.x1, 101.5, 1e-12);
  near(box.y0, 750 - 0.5 * c, 1e-12);
  near(box.y1, 750 + 0.5 * c, 1e-12);
});

test("of many frames some are drawn, the one shown first among them", () => {
  assert.deepEqual(somePanels([3, 5, 8], 5), [3, 5, 8]);
  const many = Array.from({ length: 400 }, (_, k) => 2 * k);
  for (const first of [0, 46, 798, 400]) {
    const some = somePanels(many, first);
    assert.ok(some.length === MOST_PANELS);
    assert.ok(some.includes(first), String(first));
    assert.deepEqual(some, [...new Set(some)].sort((a, b) => a - b));
  }
});

test("the gauge side is the one towards the middle of the track", () => {
  assert.deepEqual(sideNames(750), ["gauge side", "field side"]);
  assert.deepEqual(sideNames(-750), ["field side", "gauge side"]);
  assert.equal(sideNames(3), null);
});

test("the section goes through the most loaded contact and has all of them, as wide as they are in its plane", () => {
  const blobs: string[] = [];
  const packer = new Packer(blobs);
  // A flat rail top, and a plane above it as a wheel.
  const plane = (body: "rail" | "wheel", z: number): SurfaceData => ({
    body,
    name: body,
    nu: 2,
    nv: 3,
    x: packer.f32([-50, -50, -50, 50, 50, 50]),
    y: packer.f32([-30, 0, 30, -30, 0, 30]),
    z: packer.f32([z, z, z, z, z, z]),
    deviation: null,
    closed: false,
  });
  const surfaces = [plane("rail", 0), plane("wheel", -1)];
  const angle = 0.4;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const state = packer.bytes([0, 0, 0, 0, 1, 0, 0, 0, 0]);
  const patch = (name: string, x: number, y: number, force: number, [cos, sin]: [number, number]): Patch => ({
    name,
    nx: 3,
    ny: 3,
    x0_mm: -1,
    s0_mm: -2,
    dx_mm: 1,
    ds_mm: 2,
    origin_mm: [x, y, 0],
    rotation: [1, 0, 0, 0, cos, -sin, 0, sin, cos],
    reference_mm: [0, 0],
    values: { state },
    numbers: { fn_N: force },
  });
  const body = (surface: number): Placed => ({ surface, origin_mm: [0, 750, 0], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] });
  const frame = { name: "case 1", status: "ok" as const, message: "", patches: [patch("patch 1", 1, 745, 20e3, [1, 0]), patch("patch 2", 9, 760, 80e3, [c, s])], rail: body(0), wheel: body(1) };
  packer.close();
  const cut = cutOf(frame, surfaces, blobs);
  assert.ok(cut);
  assert.equal(cut.x, 9);
  assert.deepEqual(cut.rail, [[720, 0], [750, 0], [780, 0]]);
  assert.deepEqual(cut.wheel, [[720, -1], [750, -1], [780, -1]]);
  assert.deepEqual(cut.marks.map((mark) => mark.patch.name), ["patch 2", "patch 1"]);
  const [first, last] = cut.marks[0]!.ends!;
  near(last[1] - first[1], 2 * c, 1e-12);
  near(last[2] - first[2], 2 * s, 1e-12);
  // Another result is cut in the same plane, wherever its own contact is.
  assert.equal(cutOf(frame, surfaces, blobs, 3)?.x, 3);
  // Without contact the wheel still shows where it is.
  const away = cutOf({ ...frame, patches: [] }, surfaces, blobs);
  assert.equal(away?.x, 0);
  assert.equal(away?.wheel.length, 3);
  assert.equal(cutOf({ ...frame, patches: [], wheel: null }, surfaces, blobs), null);
});
