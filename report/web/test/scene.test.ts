// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { test } from "node:test";

import type { Patch } from "../src/data";
import { arrowsOfPatch } from "../src/scene/arrows";
import { normalAt, pointAt } from "../src/scene/cloud";
import { coarseIndex, meanSpacing, strideFor } from "../src/scene/detail";
import { drape } from "../src/scene/drape";
import { eye, orbitOf, panned, pictureAxes, presets, turned, type Subject } from "../src/scene/orbit";
import { roundLength } from "../src/scene/overlay";
import { elementCorners, lift, mainPatch, meshOfPatch, quadColours, shownElements } from "../src/scene/patch";
import { firstHit, meetsSphere } from "../src/scene/pick";
import { colourRange, packedRange } from "../src/scene/ranges";
import { contactPoint, wheelRadius } from "../src/scene/subject";
import { exaggerated, meshOfGrid, type SurfaceGrid, type SurfaceMesh } from "../src/scene/surface";
import { columnMajor, compose, relative, toInner, toOuter, type Place, type Vec3 } from "../src/scene/vec";

const near = (a: number, b: number, tolerance = 1e-6): void => assert.ok(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);
const nearVector = (a: ArrayLike<number>, b: ArrayLike<number>, tolerance = 1e-6): void => {
  assert.equal(a.length, b.length);
  for (let k = 0; k < b.length; ++k) near(a[k]!, b[k]!, tolerance);
};

/** A drum about the y axis: x = r sin, z = r cos, `across` points from y = 0 at 10 mm. */
function drum(stations: number, across: number, r: number, deviation: ((i: number) => number) | null = null): SurfaceGrid {
  const [x, y, z, d]: number[][] = [[], [], [], []];
  for (let i = 0; i < stations; ++i)
    for (let j = 0; j < across; ++j) {
      const theta = (2 * Math.PI * i) / stations;
      x!.push(r * Math.sin(theta));
      y!.push(10 * j);
      z!.push(r * Math.cos(theta));
      d!.push(deviation?.(i) ?? 0);
    }
  return { body: "wheel", nu: stations, nv: across, x: x!, y: y!, z: z!, deviation: deviation ? d! : null, closed: true };
}

/** A level rail at height z, stations every 10 mm from 0, points every 5 mm from -10. */
function plate(nu: number, nv: number, z: number, reversed = false): SurfaceGrid {
  const points = Array.from({ length: nu * nv }, (_, k) => [10 * Math.floor(k / nv), (reversed ? -1 : 1) * (5 * (k % nv) - 10)] as const);
  return { body: "rail", nu, nv, x: points.map((p) => p[0]), y: points.map((p) => p[1]), z: points.map(() => z), deviation: null, closed: false };
}

function patchOf(changes: Partial<Patch> = {}): Patch {
  return {
    name: "patch 1", nx: 3, ny: 2, x0_mm: -1, s0_mm: 0, dx_mm: 1, ds_mm: 2, origin_mm: [0, 0, 0], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1],
    reference_mm: [0, 1], values: {}, numbers: {}, ...changes,
  };
}

function facesOf(mesh: SurfaceMesh): number[][] {
  return mesh.blocks.flatMap(({ index }) => Array.from({ length: index.length / 3 }, (_, f) => [...index.slice(3 * f, 3 * f + 3)]));
}

test("an open grid has two triangles a cell", () => {
  assert.equal(meshOfGrid(plate(4, 5, 0)).triangles, 2 * 3 * 4);
});

test("a closed grid has a cell more around, and its seam closes", () => {
  const mesh = meshOfGrid(drum(36, 3, 460));
  assert.equal(mesh.triangles, 2 * 36 * 2);
  assert.equal(mesh.nu, 37);
  nearVector(mesh.positions.slice(-9), mesh.positions.slice(0, 9));
  nearVector(mesh.normals.slice(-9), mesh.normals.slice(0, 9));
});

test("a missing point inside takes the six triangles of four cells to four, one at the corner takes one", () => {
  const grid = plate(4, 5, 0);
  (grid.x as number[])[1 * 5 + 2] = NaN;
  assert.equal(meshOfGrid(grid).triangles, 24 - 4);
  const corner = plate(4, 5, 0);
  (corner.z as number[])[0] = NaN;
  const mesh = meshOfGrid(corner);
  assert.equal(mesh.triangles, 24 - 1);
  assert.ok(facesOf(mesh).every((face) => !face.includes(0)));
  assert.ok(mesh.positions.every((v) => Number.isFinite(v)) && mesh.normals.every((v) => Number.isFinite(v)));
});

test("grids with one station or one point across have no triangles", () => {
  assert.equal(meshOfGrid(plate(1, 5, 0)).triangles, 0);
  assert.equal(meshOfGrid(plate(5, 1, 0)).triangles, 0);
});

test("large grids come in several blocks that together hold each cell once", () => {
  const mesh = meshOfGrid(drum(900, 120, 460));
  assert.ok(mesh.blocks.length > 5);
  assert.equal(mesh.triangles, 2 * 900 * 119);
  const faces = new Set(facesOf(mesh).map((face) => [...face].sort((a, b) => a - b).join()));
  assert.equal(faces.size, mesh.triangles);
  for (const { index, stations, points } of mesh.blocks)
    assert.ok(
      index.every((v) => {
        const [i, j] = [Math.floor(v / 120), v % 120];
        return i >= stations[0] && i <= stations[1] && j >= points[0] && j <= points[1];
      }),
    );
});

test("normals of a rail point up, whichever way its points go; faces turn with them", () => {
  for (const reversed of [false, true]) {
    const mesh = meshOfGrid(plate(4, 5, 3, reversed));
    for (let k = 0; k < mesh.normals.length; k += 3) nearVector(mesh.normals.slice(k, k + 3), [0, 0, -1]);
    const p = (v: number): Vec3 => [mesh.positions[3 * v]!, mesh.positions[3 * v + 1]!, mesh.positions[3 * v + 2]!];
    for (const [a, b, c] of facesOf(mesh)) {
      const [pa, pb, pc] = [p(a!), p(b!), p(c!)];
      assert.ok((pb[0] - pa[0]) * (pc[1] - pa[1]) - (pb[1] - pa[1]) * (pc[0] - pa[0]) < 0);
    }
  }
});

test("normals of a wheel point away from its axle", () => {
  const mesh = meshOfGrid(drum(72, 3, 460));
  for (let k = 0; k < mesh.normals.length; k += 3) {
    const [x, z] = [mesh.positions[k]! + mesh.centre[0], mesh.positions[k + 2]! + mesh.centre[2]];
    near(mesh.normals[k]! * (x / 460) + mesh.normals[k + 2]! * (z / 460), 1, 2e-3);
  }
  near(wheelRadius(mesh), 460, 1e-3);
});

test("exaggeration moves points along the normal by one less than the factor times the deviation", () => {
  const mesh = meshOfGrid(drum(72, 3, 459.1, () => -0.9));
  assert.equal(exaggerated(mesh, 1, true).positions, mesh.positions);
  const { positions } = exaggerated(mesh, 10, true);
  for (let k = 0; k < positions.length; k += 3) near(Math.hypot(positions[k]! + mesh.centre[0], positions[k + 2]! + mesh.centre[2]), 459.1 - 9 * 0.9, 1e-2);
  const partly = meshOfGrid(drum(72, 3, 460, (i) => (i === 5 ? NaN : 0)));
  nearVector(exaggerated(partly, 50, true).positions, partly.positions);
});

test("places: a quarter turn about y takes z to x; compose and relative undo each other", () => {
  const a: Place = { origin: [10, 750, -460], rotation: [0, 0, 1, 0, 1, 0, -1, 0, 0] };
  nearVector(toOuter(a, [1, 2, 3]), [10 + 3, 750 + 2, -460 - 1]);
  nearVector(toInner(a, [13, 752, -461]), [1, 2, 3]);
  const b: Place = { origin: [1, 2, 3], rotation: [1, 0, 0, 0, 0, -1, 0, 1, 0] };
  const both = compose(a, b);
  nearVector(toOuter(both, [4, 5, 6]), toOuter(a, toOuter(b, [4, 5, 6])));
  const again = relative(a, both);
  nearVector(again.origin, b.origin);
  nearVector(again.rotation, b.rotation);
  nearVector(columnMajor(a), [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 10, 750, -460, 1]);
});

test("shown elements are those in contact", () => {
  const patch = patchOf();
  assert.deepEqual([...shownElements(patch, [0, 1, 2, 0, 3, 0], null)], [1, 2, 4]);
  assert.deepEqual([...shownElements(patch, null, [5, 0, 0, 0, 0, 1])], [0, 5]);
  assert.equal(shownElements(patch, null, null).length, 6);
});

test("the quad of an element lies about its centre, lifted towards the wheel", () => {
  const patch = patchOf();
  const flat = new Float32Array(12);
  const corners = elementCorners(patch, flat, 2, 1);
  nearVector(corners.flat(), [0.5, 1, -lift, 1.5, 1, -lift, 1.5, 3, -lift, 0.5, 3, -lift]);
  const mesh = meshOfPatch(patch, Uint32Array.of(0, 5), flat);
  assert.equal(mesh.index.length, 12);
  nearVector(mesh.positions.slice(12), corners.flat());
});

test("a patch lies on the ground: on a sloping plane its corners follow it, without ground they stay in the plane", () => {
  const place: Place = { origin: [-20, 0, 0], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
  const grid = plate(5, 5, 0);
  for (let k = 0; k < 25; ++k) (grid.z as number[])[k] = 0.1 * grid.y[k]!;
  const mesh = meshOfGrid(grid);
  const patch = patchOf({ origin_mm: [0, 1, 0.25] });
  const heights = drape(patch, { place, centre: mesh.centre, positions: mesh.positions, blocks: mesh.blocks });
  for (let j = 0; j <= 2; ++j) for (let i = 0; i <= 3; ++i) near(heights[4 * j + i]!, 0.1 * (1 + 2 * j - 1) - 0.25, 1e-5);
  assert.ok(drape(patch, null).every((h) => h === 0));
  const away = drape(patchOf({ origin_mm: [500, 0, 0] }), { place, centre: mesh.centre, positions: mesh.positions, blocks: mesh.blocks });
  assert.ok(away.every((h) => h === 0));
});

test("of two surfaces over each other the patch lies on the one at the contact", () => {
  const place: Place = { origin: [-20, 0, 0], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
  const [top, bottom] = [meshOfGrid(plate(5, 5, 0.01)), meshOfGrid(plate(5, 5, 0.9))];
  for (const meshes of [
    [top, bottom],
    [bottom, top],
  ]) {
    const [a, b] = [meshes[0]!, meshes[1]!];
    const shifted = b.blocks.map((block) => ({ ...block, index: block.index.map((v) => v + 25) }));
    const positions = new Float32Array([...a.positions, ...b.positions.map((v, k) => (k % 3 === 2 ? v + b.centre[2] - a.centre[2] : v))]);
    const heights = drape(patchOf(), { place, centre: a.centre, positions, blocks: [...a.blocks, ...shifted] });
    assert.ok(heights.every((h) => Math.abs(h - 0.01) < 1e-5));
  }
});

test("a ray meets the element under it and its distance is right", () => {
  const mesh = meshOfPatch(patchOf(), Uint32Array.of(0, 2, 4), new Float32Array(12));
  const at = (x: number, s: number): number | null => {
    const hit = firstHit(mesh.positions, mesh.index, [x, s, -50], [0, 0, 1]);
    if (hit) near(hit.distance, 50 - lift, 1e-5);
    return hit ? mesh.elements[hit.triangle >> 1]! : null;
  };
  assert.equal(at(-1.2, 0.4), 0);
  assert.equal(at(1.3, -0.7), 2);
  assert.equal(at(0.4, 2.6), 4);
  assert.equal(at(0, 0), null);
  assert.equal(firstHit(mesh.positions, mesh.index, [-1.2, 0.4, -50], [0, 0, -1]), null);
});

test("the nearest of several triangles is met; spheres behind are not", () => {
  const positions = [0, 0, 5, 4, 0, 5, 0, 4, 5, 0, 0, 2, 4, 0, 2, 0, 4, 2];
  assert.equal(firstHit(positions, [0, 1, 2, 3, 4, 5], [1, 1, 0], [0, 0, 1])?.triangle, 1);
  assert.ok(meetsSphere([0, 0, 10], 2, [1, 1, 0], [0, 0, 1]));
  assert.ok(!meetsSphere([0, 0, -10], 2, [1, 1, 0], [0, 0, 1]));
  assert.ok(!meetsSphere([5, 0, 10], 2, [1, 1, 0], [0, 0, 1]));
});

test("arrows point with the traction and are longest for the greatest one", () => {
  const patch = patchOf({ nx: 4, ny: 4, dx_mm: 1, ds_mm: 1 });
  const elements = Uint32Array.from({ length: 16 }, (_, k) => k);
  const tx = Array.from({ length: 16 }, (_, k) => (k === 5 ? 0 : k < 8 ? 100 : 50));
  const arrows = arrowsOfPatch(patch, elements, tx, Array<number>(16).fill(0), new Float32Array(25), 100);
  assert.equal(arrows.count, 15);
  assert.equal(arrows.index.length, 2 * 9 * 15);
  const light = 7 * 15;
  const span = (k: number): number => arrows.positions[3 * (light + 7 * k + 6)]! - arrows.positions[3 * (light + 7 * k)]!;
  near(span(0), 1.7, 1e-5);
  near(span(14), 0.85, 1e-5);
});

test("the camera looks forward from behind, down with forward upwards, and keeps z down", () => {
  nearVector(eye({ target: [1, 2, 3], distance: 10, azimuth: 0, elevation: 0 }), [-9, 2, 3]);
  const above = pictureAxes({ target: [0, 0, 0], distance: 1, azimuth: 0, elevation: 89.5 });
  nearVector(above.right, [0, 1, 0], 0.01);
  nearVector(above.up, [1, 0, 0], 0.01);
  nearVector(pictureAxes({ target: [0, 0, 0], distance: 1, azimuth: 0, elevation: 0 }).up, [0, 0, -1]);
  assert.equal(turned({ target: [0, 0, 0], distance: 1, azimuth: 350, elevation: 80 }, 20, 30).azimuth, 10);
  assert.ok(turned({ target: [0, 0, 0], distance: 1, azimuth: 0, elevation: 80 }, 0, 30).elevation < 90);
  const moved = panned({ target: [0, 0, 0], distance: 100, azimuth: 0, elevation: 0 }, 10, 0, 400);
  assert.ok(moved.target[1] < 0 && moved.target[0] === 0);
});

test("every view looks at something at a distance", () => {
  const subject: Subject = { contact: [1, 2, 3], size: 14, railWidth: 72, wheelCentre: [1, 2, -457], wheelRadius: 488 };
  for (const preset of presets) {
    const orbit = orbitOf(preset, subject, 2);
    assert.ok(orbit.distance > 20 && orbit.distance < 5000, preset.name);
    nearVector(orbit.target, preset.name === "whole" ? subject.wheelCentre : subject.contact);
  }
});

test("the contact point is the reference of the patch that carries most", () => {
  const light = patchOf({ numbers: { fn_N: 1000 } });
  const heavy = patchOf({ origin_mm: [5, 750, 0], rotation: [1, 0, 0, 0, 0, -1, 0, 1, 0], numbers: { fn_N: 9000 } });
  assert.equal(mainPatch([light, heavy]), heavy);
  nearVector(contactPoint([light, heavy])!, [5, 750, 1]);
  assert.equal(contactPoint([]), null);
});

test("ranges of packed numbers and of colour maps", () => {
  assert.deepEqual(packedRange({ blob: 0, offset: 0, count: 1, type: "u8", low: -1, step: 0.5, none: true }), { low: -1, high: -1 + 0.5 * 254 });
  assert.equal(packedRange({ blob: 0, offset: 0, count: 1, type: "f32" }), null);
  assert.deepEqual(colourRange({ low: -3, high: 8 }, "diverging"), { low: -8, high: 8 });
  assert.deepEqual(colourRange({ low: 10, high: 100 }, "sequential"), { low: 0, high: 100 });
  assert.deepEqual(colourRange({ low: 90, high: 100 }, "sequential"), { low: 90, high: 100 });
  assert.ok(colourRange(null, "sequential").high > 0);
});

test("a quad has one colour at its four corners", () => {
  const colours = quadColours(Uint32Array.of(7, 9), (element, out, at) => out.set([element, 1, 2, 255], at));
  assert.deepEqual([...colours.slice(16)], [9, 1, 2, 255, 9, 1, 2, 255, 9, 1, 2, 255, 9, 1, 2, 255]);
});

test("round numbers for scales", () => {
  assert.equal(roundLength(37), 20);
  assert.equal(roundLength(0.0051), 0.005);
});

test("joined cells cover the same area with the same way round, and holes stay", () => {
  const grid = plate(12, 9, 0, true);
  (grid.x as number[])[5 * 9 + 3] = NaN;
  const mesh = meshOfGrid(grid);
  const block = mesh.blocks[0]!;
  const area = (index: Uint32Array): number => {
    let sum = 0;
    for (let f = 0; f < index.length; f += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => mesh.positions.slice(3 * index[f + k]!, 3 * index[f + k]! + 2)) as [Float32Array, Float32Array, Float32Array];
      const twice = (b[0]! - a[0]!) * (c[1]! - a[1]!) - (b[1]! - a[1]!) * (c[0]! - a[0]!);
      assert.ok(twice < 0);
      sum -= 0.5 * twice;
    }
    return sum;
  };
  near(area(block.index), 110 * 40 - 4 * 25, 1e-3);
  for (const stride of [
    { stations: 2, points: 1 },
    { stations: 4, points: 4 },
    { stations: 16, points: 16 },
  ])
    near(area(coarseIndex(mesh, block, stride)), area(block.index), 1e-3);
  assert.ok(coarseIndex(mesh, block, { stations: 4, points: 4 }).length < 0.6 * block.index.length);
  nearVector(meanSpacing(meshOfGrid(plate(12, 9, 0))), [10, 5], 1e-5);
});

test("cells are joined while they stay small in the picture", () => {
  assert.equal(strideFor(2, 1.5), 1);
  assert.equal(strideFor(0.7, 1.5), 2);
  assert.equal(strideFor(0.7, 7), 8);
  assert.equal(strideFor(1e-9, 7), 32);
});

test("normals of points lean from straight out towards +y", () => {
  nearVector(normalAt("rail", [5, 1, 2], 0), [0, 0, -1]);
  nearVector(normalAt("rail", [5, 1, 2], Math.PI / 2), [0, 1, 0]);
  nearVector(normalAt("wheel", [300, 7, 400], 0), [0.6, 0, 0.8]);
  nearVector(normalAt("wheel", [0, 7, -400], Math.PI / 6), [0, 0.5, -Math.sqrt(0.75)]);
});

test("the front one of the points under the pointer is meant", () => {
  const seen: ([number, number, number] | null)[] = [[10, 10, 50], [12, 10, 20], [40, 10, 5], null];
  const at = (x: number, y: number): number => pointAt((k) => seen[k] ?? null, seen.length, x, y);
  assert.equal(at(10, 10), 1);
  assert.equal(at(3, 10), 0);
  assert.equal(at(41, 12), 2);
  assert.equal(at(200, 200), -1);
});
