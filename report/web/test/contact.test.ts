// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { test } from "node:test";

import { arrowPath, sampleArrows, strideOf } from "../src/contact/arrows";
import { contactOutline, division, edgeLines, slipOutline, type Line } from "../src/contact/edges";
import { isolines } from "../src/contact/isolines";
import { labelPlaces } from "../src/contact/bars";
import { layOut, legendPlaces } from "../src/contact/layout";
import { paint } from "../src/contact/raster";
import { colourRange, extent, mostOf, withMargin } from "../src/contact/scales";
import { brief, numberName } from "../src/contact/text";

/** The same numbers on every machine. */
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 1664525 + 1013904223) % 4294967296;
    return state / 4294967296;
  };
}

function randomStates(nx: number, ny: number, seed: number, most = 3): Float32Array {
  const next = random(seed);
  return Float32Array.from({ length: nx * ny }, () => Math.floor(next() * (most + 1)));
}

/** Length of lines that run along the grid, the last point joined to the first where they are closed. */
function length(lines: readonly Line[]): number {
  let sum = 0;
  for (const { points, closed } of lines) {
    const n = points.length / 2;
    for (let i = 0; i < (closed ? n : n - 1); ++i) {
      const j = (i + 1) % n;
      const dx = Math.abs(points[2 * j]! - points[2 * i]!);
      const dy = Math.abs(points[2 * j + 1]! - points[2 * i + 1]!);
      assert.ok(dx === 0 || dy === 0, "lines run along edges");
      sum += dx + dy;
    }
  }
  return sum;
}

function area(lines: readonly Line[]): number {
  let twice = 0;
  for (const { points, closed } of lines) {
    assert.ok(closed, "an outline is closed");
    const n = points.length / 2;
    for (let i = 0; i < n; ++i) {
      const j = (i + 1) % n;
      twice += points[2 * i]! * points[2 * j + 1]! - points[2 * j]! * points[2 * i + 1]!;
    }
  }
  return twice / 2;
}

/** Edges of elements that lie between two kinds, counted one by one. */
function countEdges(state: ArrayLike<number>, nx: number, ny: number, counts: (a: number, b: number) => boolean): number {
  const at = (x: number, y: number): number => (x < 0 || y < 0 || x >= nx || y >= ny ? 0 : state[y * nx + x]!);
  let n = 0;
  for (let y = -1; y < ny; ++y)
    for (let x = -1; x < nx; ++x) {
      if (counts(at(x, y), at(x + 1, y))) ++n;
      if (counts(at(x, y), at(x, y + 1))) ++n;
    }
  return n;
}

test("outlines have the length and the area of the elements they enclose", () => {
  for (let seed = 1; seed <= 20; ++seed) {
    const [nx, ny] = [5 + (seed % 7), 3 + (seed % 5)];
    const state = randomStates(nx, ny, seed);
    const contact = contactOutline(state, nx, ny);
    assert.equal(
      length(contact),
      countEdges(state, nx, ny, (a, b) => a > 0 !== b > 0),
    );
    assert.equal(area(contact), state.filter((v) => v > 0).length);
    const slip = slipOutline(state, nx, ny);
    assert.equal(area(slip), state.filter((v) => v >= 2).length);
    assert.equal(
      length(division(state, nx, ny)),
      countEdges(state, nx, ny, (a, b) => a > 0 && b > 0 && a !== b),
    );
  }
});

test("an outline turns at its corners alone", () => {
  const state = new Float32Array(12 * 9);
  for (let y = 2; y < 7; ++y) for (let x = 3; x < 9; ++x) state[y * 12 + x] = 1;
  const lines = contactOutline(state, 12, 9);
  assert.equal(lines.length, 1);
  assert.equal(lines[0]!.points.length, 8);
  assert.equal(area(lines), 30);
});

test("a division through a patch is one open line from edge to edge", () => {
  const state = new Float32Array(8 * 4).map((_, i) => (i % 8 < 5 ? 1 : 2));
  const lines = division(state, 8, 4);
  assert.equal(lines.length, 1);
  assert.equal(lines[0]!.closed, false);
  assert.equal(lines[0]!.points.length, 4);
  assert.deepEqual(new Set(lines[0]!.points), new Set([5, 0, 4]));
});

test("holes and no contact", () => {
  const ring = Uint8Array.from([1, 1, 1, 1, 0, 1, 1, 1, 1]);
  const lines = edgeLines(ring, 3, 3, () => true);
  assert.equal(lines.length, 2);
  assert.equal(area(lines), 8);
  assert.deepEqual(contactOutline(new Float32Array(9), 3, 3), []);
});

test("isolines of a cone are circles of the right radius", () => {
  const n = 41;
  const values = Float32Array.from({ length: n * n }, (_, i) => 20 - Math.hypot((i % n) - 20, Math.floor(i / n) - 20));
  for (const level of [5, 12.5]) {
    const lines = isolines(values, n, n, [level]);
    assert.equal(lines.length, 1);
    assert.equal(lines[0]!.closed, true);
    const { points } = lines[0]!;
    for (let i = 0; i < points.length; i += 2) {
      const r = Math.hypot(points[i]! - 20.5, points[i + 1]! - 20.5);
      assert.ok(Math.abs(r - (20 - level)) < 0.12, `radius ${r}`);
    }
  }
});

test("isolines end at the border of the grid and beside elements without value", () => {
  const [nx, ny] = [10, 6];
  const ramp = Float32Array.from({ length: nx * ny }, (_, i) => i % nx);
  const [line, ...others] = isolines(ramp, nx, ny, [3.25]);
  assert.equal(others.length, 0);
  assert.equal(line!.closed, false);
  const xs = line!.points.filter((_, i) => i % 2 === 0);
  const ys = line!.points.filter((_, i) => i % 2 === 1);
  for (const x of xs) assert.ok(Math.abs(x - 3.75) < 1e-6);
  assert.equal(Math.min(...ys), 0.5);
  assert.equal(Math.max(...ys), ny - 0.5);
  for (let x = 0; x < nx; ++x) ramp[2 * nx + x] = NaN;
  const cut = isolines(ramp, nx, ny, [3.25]);
  assert.equal(cut.length, 2);
  for (const { points } of cut) for (let i = 1; i < points.length; i += 2) assert.ok(points[i]! <= 1.5 || points[i]! >= 3.5);
});

test("arrows: every n-th element of contact, from the same elements whatever the contact is", () => {
  const [nx, ny] = [20, 12];
  const state = new Float32Array(nx * ny).fill(1);
  const tx = new Float32Array(nx * ny).fill(2);
  const ts = Float32Array.from({ length: nx * ny }, (_, i) => i);
  const all = sampleArrows(tx, ts, state, nx, ny, 4, 3);
  assert.equal(all.length, 5 * 4);
  for (const { ix, iy, s } of all) {
    assert.equal(ix % 4, 1);
    assert.equal(iy % 3, 1);
    assert.equal(s, iy * nx + ix);
  }
  for (let i = 0; i < nx * ny; ++i) state[i] = i % nx < 10 ? 0 : 2;
  const half = sampleArrows(tx, ts, state, nx, ny, 4, 3);
  assert.deepEqual(
    half,
    all.filter(({ ix }) => ix >= 10),
  );
  assert.equal(strideOf(2.1, 19), 9);
  assert.equal(strideOf(40, 19), 1);
});

test("an arrow lies about its element and points along the traction, s upwards", () => {
  const path = arrowPath([{ ix: 0, iy: 0, x: 0, s: 10 }], () => [100, 50], 2);
  assert.ok(path.startsWith("M100.0 60.0L100.0 40.0"), path);
  assert.equal(
    arrowPath([{ ix: 0, iy: 0, x: 0.1, s: 0 }], () => [0, 0], 2),
    "",
  );
});

test("ranges of colours begin at zero or are symmetric, and are round", () => {
  assert.deepEqual(colourRange({ low: 3, high: 1173 }, "sequential"), { low: 0, high: 1200 });
  assert.deepEqual(colourRange({ low: 292, high: 311 }, "sequential"), { low: 290, high: 315 });
  const signed = colourRange({ low: -37, high: 412 }, "diverging");
  assert.equal(signed.low, -signed.high);
  assert.ok(signed.high >= 412 && signed.high <= 600);
  assert.deepEqual(colourRange({ low: Infinity, high: -Infinity }, "sequential"), { low: 0, high: 1 });
  const flat = colourRange({ low: 0.35, high: 0.35 }, "sequential");
  assert.ok(flat.low <= 0.35 && flat.high > flat.low);
});

test("extent leaves out what is not a number; differences keep nearly all", () => {
  assert.deepEqual(extent([NaN, 4, -2, Infinity]), { low: -2, high: 4 });
  assert.deepEqual(
    extent([1, 9, 5], (i) => i !== 1),
    { low: 1, high: 5 },
  );
  const values = Float32Array.from({ length: 1000 }, (_, i) => (i < 5 ? -900 : i / 1000));
  const { low, high } = mostOf(values);
  assert.equal(low, -high);
  assert.ok(high < 1 && high > 0.95);
});

test("windows get a margin and never become a strip", () => {
  const square = withMargin({ x0: -5, x1: 5, y0: -4, y1: 4 }, 0.1);
  assert.deepEqual(square, { x0: -6, x1: 6, y0: -5, y1: 5 });
  const strip = withMargin({ x0: 0, x1: 30, y0: -1, y1: 1 }, 0);
  assert.ok(Math.abs(strip.y1 - strip.y0 - 10) < 1e-9);
  assert.ok(Math.abs(strip.y1 + strip.y0) < 1e-9);
});

test("panels have one scale, fit the width and do not overlap", () => {
  for (const width of [320, 390, 700, 1150])
    for (const count of [1, 2, 3, 4, 7]) {
      const window = { x0: -9, x1: 9, y0: -7, y1: 7 };
      const layout = layOut({ width, count, window, titles: true, bars: 2, legendRows: 1, panelHeight: 300 });
      assert.equal(layout.panels.length, count);
      assert.ok(layout.width <= width);
      for (const p of layout.panels) {
        assert.ok(Math.abs(p.width / 18 - layout.scale) < 1e-9 && Math.abs(p.height / 14 - layout.scale) < 1e-9);
        assert.ok(p.x + p.width <= layout.width + 1e-9 && p.y + p.height <= layout.height);
        assert.ok(p.height <= 300 + 1e-9);
        for (const q of layout.panels)
          assert.ok(p === q || p.x + p.width < q.x || q.x + q.width < p.x || p.y + p.height < q.y || q.y + q.height < p.y);
      }
      for (const bar of layout.bars) assert.ok(bar.x + bar.width <= layout.width && bar.y + bar.height <= layout.height);
    }
  assert.deepEqual(legendPlaces([50, 50, 50], 120, 10), [
    { x: 0, row: 0 },
    { x: 60, row: 0 },
    { x: 0, row: 1 },
  ]);
});

test("the picture has the greatest s on top, clamps colours and leaves out what has none", () => {
  const table = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) table.set([i, 0, 0, 255], 4 * i);
  const pixels = new Uint8ClampedArray(4 * 6);
  paint(pixels, [0, 40, 100, NaN, 500, -5], [1, 1, 1, 1, 1, 0], 3, 2, { table, range: { low: 0, high: 100 }, states: false });
  const shown = Array.from({ length: 6 }, (_, i) => (pixels[4 * i + 3] === 0 ? null : pixels[4 * i]));
  assert.deepEqual(shown, [null, 255, null, 0, 102, 255]);
});

test("numbers as readers see them", () => {
  assert.equal(brief(1234.567), "1235");
  assert.equal(brief(-0.00123456), "−0.001235");
  assert.equal(brief(0.000123456), "1.23·10⁻⁴");
  assert.equal(brief(123379.4), "123379");
  assert.equal(brief(12.5), "12.5");
  assert.equal(brief(NaN), "–");
  assert.equal(brief(-8.81e-19), "0");
  assert.equal(brief(-3.5e-11), "−3.5·10⁻¹¹");
  assert.deepEqual(numberName("pmax_MPa"), { label: "largest pressure pₘₐₓ", unit: "MPa", factor: 1 });
  assert.deepEqual(numberName("area_mm2"), { label: "area", unit: "mm²", factor: 1 });
  assert.deepEqual(numberName("xi"), { label: "longitudinal creepage ξ", unit: "", factor: 1 });
  assert.deepEqual(numberName("fn_N"), { label: "normal force Fₙ", unit: "kN", factor: 1e-3 });
  assert.equal(numberName("angle_rad").unit, "°");
  assert.deepEqual(numberName("rail_curvature_1_per_m"), { label: "rail, greater curvature", unit: "1/m", factor: 1 });
});

test("numbers below a colour bar touch neither each other nor what lies beyond its ends", () => {
  for (let length = 60; length <= 500; ++length)
    for (const count of [2, 3, 5, 6, 9]) {
      const at = Array.from({ length: count }, (_, k) => (length * k) / (count - 1));
      const widths = at.map((_, k) => (k === 0 ? 8 : 30));
      const places = labelPlaces(at, widths, length);
      assert.notEqual(places[count - 1], null);
      let end = 0;
      places.forEach((place, k) => {
        if (place === null) return;
        assert.ok(place - widths[k]! / 2 >= end - 1e-9, `${count} on ${length}`);
        end = place + widths[k]! / 2 + (k < count - 1 ? 5 : 0);
      });
      assert.ok(end <= length + 1e-9);
    }
  assert.deepEqual(labelPlaces([0, 50, 100], [10, 10, 10], 100), [5, 50, 95]);
});
