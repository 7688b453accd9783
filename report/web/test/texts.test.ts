// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { test } from "node:test";

import { colourMap, css, lut, seriesColour, seriesDash, toLab } from "../src/colours";
import { toCsv, toTsv } from "../src/csv";
import { fileName } from "../src/download";
import { decimalsFor, fixed, formatNumber } from "../src/numbers";
import { columnParts } from "../src/paper-tables";
import { allSteps, MOST_ON_PAPER, parseSteps } from "../src/print";
import { nextDirection, sortedOrder } from "../src/table-sort";
import { nextChoice, parseChoice } from "../src/theme";
import { playRate, stepNamer } from "../src/timeline";

test("CSV: quotes, commas and line ends are quoted; numbers in full; no value is empty", () => {
  const rows = [["p, max", 'a "b"', "two\nlines"], [1 / 3, NaN, null], ["", -1e-30, Infinity]];
  assert.equal(toCsv(rows), '"p, max","a ""b""","two\nlines"\r\n0.3333333333333333,,\r\n,-1e-30,inf\r\n');
});

test("TSV has no tabs or line ends within cells", () => {
  assert.equal(toTsv([["a\tb", "c\nd", 2.5]]), "a b\tc d\t2.5\n");
});

test("steps for paper are numbers, ranges or all; what is none of them is said", () => {
  const all = (): number[] => [0, 3];
  assert.deepEqual(parseSteps("", 9, all), []);
  assert.deepEqual(parseSteps(" 8, 1-3;2 ", 9, all), [0, 1, 2, 7]);
  assert.deepEqual(parseSteps("All", 9, all), [0, 3]);
  for (const [text, words] of [["0", "1 to 9"], ["3-12", "1 to 9"], ["5-2", "1 to 9"], ["1,,2", "no number"], ["-3", "no number"], ["two", "“two”"]] as const)
    assert.ok(String(parseSteps(text, 9, all)).includes(words), text);
  assert.equal(parseSteps("1-999999999", 1e9, all), `at most ${MOST_ON_PAPER} at once`);
});

test("tables wider than paper go on below themselves, each part led by the first column", () => {
  assert.deepEqual(columnParts([10, 20, 30, 25, 70, 100, 5], 70), [[0, 1, 2], [0, 3], [0, 4], [0, 5], [0, 6]]);
  assert.deepEqual(columnParts([10, 20, 30], 70), [[0, 1, 2]]);
});

test("all steps of a history are those at which there is another frame", () => {
  const timeline = { label: "instant", names: null, count: 6, frames: [null, 0, 0, 1, null, 1], axes: [] };
  assert.deepEqual(allSteps(timeline, []), [1, 3]);
  assert.deepEqual(allSteps({ ...timeline, count: 2, frames: null }, []), [0, 1]);
});

test("names of files are plain", () => {
  assert.equal(fileName("Druck / p₀ (größte)", "csv"), "Druck-p0-gro-te.csv");
  assert.equal(fileName("../..", "svg"), "treadmark.svg");
});

test("rows are sorted by number, without a value last both ways, equal ones in place", () => {
  const keys = [3, NaN, -1, 10, 3];
  assert.deepEqual(sortedOrder(keys, "ascending"), [2, 0, 4, 3, 1]);
  assert.deepEqual(sortedOrder(keys, "descending"), [3, 0, 4, 2, 1]);
  assert.deepEqual(sortedOrder(["case 10", "case 9", "", "Case 1"], "ascending"), [3, 1, 0, 2]);
  assert.equal(nextDirection(nextDirection(nextDirection(null))), null);
});

test("names of steps: given, or from the first axis with enough decimals", () => {
  const axis = { label: "t", unit: "s", scale: "linear" as const, values: [0, 0.00025, 0.0005] };
  const timeline = { label: "instant", names: null, count: 3, frames: null, axes: [axis] };
  assert.equal(stepNamer(timeline, [])(1), "t = 0.00025 s");
  assert.equal(stepNamer(timeline, [])(0), "t = 0.00000 s");
  assert.equal(stepNamer({ ...timeline, names: ["first"] }, [])(0), "first");
  assert.equal(stepNamer({ ...timeline, names: ["first"] }, [])(2), "instant 3");
  assert.equal(stepNamer({ ...timeline, axes: [{ ...axis, values: [null, 1, 2] }] }, [])(0), "instant 1");
});

test("a long timeline plays within 20 s, a short one slowly", () => {
  assert.equal(20000 / playRate(20000), 20);
  assert.equal(playRate(10), 5);
});

test("numbers as people read them", () => {
  assert.equal(formatNumber(1234.5678), "1235");
  assert.equal(formatNumber(123456), "123456");
  assert.equal(formatNumber(-0.00123456), "−0.001235");
  assert.equal(formatNumber(1.234567e-7), "1.235·10⁻⁷");
  assert.equal(formatNumber(NaN), "–");
  assert.equal(formatNumber(0.5), "0.5");
  assert.equal(fixed(-0.0001, 2), "0.00");
  assert.equal(decimalsFor([0, 0.25, 0.5]), 2);
  assert.equal(decimalsFor([1, 2, 3]), 0);
});

test("the sequential colours grow in lightness evenly; the diverging ones are neutral in the middle", () => {
  const sequential = colourMap("sequential");
  const lightness = Array.from({ length: 65 }, (_, k) => toLab(sequential(k / 64))[0]);
  const mean = (lightness[64]! - lightness[0]!) / 64;
  lightness.slice(1).forEach((l, k) => {
    const gain = l - lightness[k]!;
    assert.ok(gain > 0.3 * mean && gain < 2 * mean, `at ${k}: ${gain} of ${mean}`);
  });
  const diverging = colourMap("diverging");
  const [, a, b] = toLab(diverging(0.5));
  assert.ok(Math.hypot(a, b) < 0.01);
  assert.ok(toLab(diverging(0.5))[0] > toLab(diverging(0))[0] && toLab(diverging(0.5))[0] > toLab(diverging(1))[0]);
  assert.equal(css(sequential(1)), `rgb(${[...lut("sequential").slice(-4, -1)].join(",")})`);
});

test("the theme: unknown choices are auto; three in turn", () => {
  assert.equal(parseChoice("purple"), "auto");
  assert.equal(nextChoice(nextChoice(nextChoice("auto"))), "auto");
});

test("eight lines have eight colours and eight dashes", () => {
  const eight = Array.from({ length: 8 }, (_, k) => k);
  assert.equal(new Set(eight.map(seriesColour)).size, 8);
  assert.equal(new Set(eight.map(seriesDash)).size, 8);
});
