// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { test } from "node:test";

import { thin } from "../src/chart/thin";

test("least and greatest value of every column of pixels survive", () => {
  const n = 20000;
  const width = 700;
  const column = (i: number): number => (i / n) * width;
  let seed = 7;
  const noise = Array.from({ length: n }, () => (seed = (seed * 16807) % 2147483647) / 2147483647);
  const values = noise.map((v, i) => (i % 1571 === 700 ? 50 : 0) + v);
  const runs = thin(n, column, (i) => values[i]!, 0, width);
  assert.equal(runs.length, 1);
  const kept = runs[0]!;
  assert.ok(kept.length <= 4 * width + 4, `${kept.length} points`);
  kept.forEach((i, k) => assert.ok(k === 0 || i > kept[k - 1]!, "in order"));
  for (let c = 0; c < width; ++c) {
    const all = values.filter((_, i) => Math.floor(column(i)) === c);
    const some = kept.filter((i) => Math.floor(column(i)) === c).map((i) => values[i]!);
    assert.equal(Math.max(...some), Math.max(...all));
    assert.equal(Math.min(...some), Math.min(...all));
  }
});

test("gaps end a run; few points stay as they are", () => {
  const y = [1, 2, NaN, 3, NaN, NaN, 4, 5];
  assert.deepEqual(thin(8, (i) => 10 * i, (i) => y[i]!, 0, 100), [[0, 1], [3], [6, 7]]);
});

test("one point beyond either end of the window stays, as does a line across it", () => {
  assert.deepEqual(thin(10, (i) => 10 * i, (i) => i, 35, 62), [[3, 4, 5, 6, 7]]);
  assert.deepEqual(thin(2, (i) => -50 + 1000 * i, (i) => i, 0, 100), [[0, 1]]);
  assert.deepEqual(thin(4, (i) => -50 - i, (i) => i, 0, 100), []);
});

test("a path that turns back keeps its points", () => {
  const x = [0, 10, 20, 10, 0];
  assert.deepEqual(thin(5, (i) => x[i]!, (i) => i, 0, 20), [[0, 1, 2, 3, 4]]);
});
