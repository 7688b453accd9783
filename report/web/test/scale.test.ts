// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { test } from "node:test";

import { extentOf, linearTicks, logTicks, makeScale, moved, padded, withLevels, zoomed } from "../src/chart/scale";

test("extent leaves out NaN, infinity and, on log axes, what is not positive", () => {
  assert.deepEqual(extentOf([[3, NaN, -1], [Infinity, 2]], false), [-1, 3]);
  assert.deepEqual(extentOf([[3, 0, -1, 0.5]], true), [0.5, 3]);
  assert.equal(extentOf([[NaN]], false), null);
});

test("no value has no place on the screen", () => {
  assert.ok(Number.isNaN(makeScale([0, 1], [0, 100], false)(NaN)));
  assert.ok(Number.isNaN(makeScale([1, 10], [0, 100], true)(0)));
  const log = makeScale([1, 100], [0, 200], true);
  assert.ok(Math.abs(log(10) - 100) < 1e-9);
  assert.ok(Math.abs(log.invert(100) - 10) < 1e-9);
});

test("constant values get a domain of some width; zero stays an end", () => {
  const [a, b] = padded([5, 5], false, 0.05);
  assert.ok(a < 5 && b > 5);
  assert.equal(padded([0, 10], false, 0.05)[0], 0);
  assert.equal(padded(null, true, 0.05)[0], 1);
});

test("levels near the data widen the range, those far away do not", () => {
  assert.deepEqual(withLevels([0, 10], [15], false), [0, 15]);
  assert.deepEqual(withLevels([0, 10], [1000], false), [0, 10]);
  assert.deepEqual(withLevels(null, [2, 3], false), [2, 3]);
});

test("labels have the decimals that their distance needs", () => {
  assert.deepEqual(linearTicks([0, 1], 5).map((t) => t.label), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
  assert.deepEqual(linearTicks([0.25, 0.42], 2).map((t) => t.label), ["0.3", "0.4"]);
  assert.deepEqual(linearTicks([-20, 20], 4).map((t) => t.label), ["−20", "−10", "0", "10", "20"]);
});

test("forces that differ by a tolerance are no trend", () => {
  const [low, high] = padded([99.9992, 100.00004], false, 0.06, 0.01);
  assert.ok(high - low > 0.99 && low < 99.6 && high > 100.4);
  assert.deepEqual(padded([90, 100], false, 0, 0.01), [90, 100]);
});

test("an axis has two labels at least", () => {
  for (const domain of [[1000, 1950], [1.04, 1.96], [-0.3, 0.3], [417.1, 417.9]] as [number, number][])
    for (const count of [1, 2, 3]) assert.ok(linearTicks(domain, count).length >= 2, `${domain.join(" ")}, ${count}`);
});

test("log ticks: powers of ten; 1, 2, 5 over few decades; never none", () => {
  assert.deepEqual(logTicks([1, 1e6], 8).filter((t) => t.label).map((t) => t.label), ["1", "10", "100", "1000", "10000", "10⁵", "10⁶"]);
  assert.deepEqual(logTicks([1, 100], 6).filter((t) => t.label).map((t) => t.value), [1, 2, 5, 10, 20, 50, 100]);
  assert.ok(logTicks([900, 1100], 5).filter((t) => t.label).length >= 2);
});

test("zoom keeps the place under the pointer and stays within the whole", () => {
  const next = zoomed([0, 100], [0, 100], 25, 0.5, false);
  assert.deepEqual(next, [12.5, 62.5]);
  assert.deepEqual(zoomed(next, [0, 100], 25, 10, false), [0, 100]);
  const log = zoomed([1, 100], [1, 100], 10, 0.5, true);
  assert.ok(Math.abs(log[0] * log[1] - 100) < 1e-9 && Math.abs(log[1] / log[0] - 10) < 1e-9);
  assert.deepEqual(moved([80, 90], [0, 100], 5, false), [90, 100]);
});

test("what differs by less than the least span of its quantity is no trend", () => {
  const [low, high] = padded([99.9995, 100], false, 0.05, 0.01);
  assert.ok(high - low >= 1 && low < 99.9995 && high > 100, `${low} ${high}`);
  const [from, to] = padded([90, 100], false, 0.05, 0.01);
  assert.ok(to - from < 12, `${from} ${to}`);
});

test("an axis has two numbers at least, so that their distance is told", () => {
  for (const domain of [[1000, 1950], [0, 2000], [1400, 1600], [-0.3, 0.9], [999.6, 1000.4]] as [number, number][])
    for (const count of [1, 2, 3]) assert.ok(linearTicks(domain, count).length >= 2, `${domain.join(" ")}, ${count}`);
});
