// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import type { ReportData } from "../src/data";
import { Store } from "../src/store";

let waiting: (() => void)[] = [];

function nextFrame(): void {
  const now = waiting;
  waiting = [];
  for (const call of now) call();
}

beforeEach(() => {
  waiting = [];
  Object.assign(globalThis, { requestAnimationFrame: (call: () => void): number => waiting.push(call) });
});

function data(count: number, frames: (number | null)[] | null = null): ReportData {
  const axis = { label: "t", unit: "s", scale: "linear" as const, values: [] };
  return {
    format: "treadmark report 1", kind: "run", title: "", fields: [], sets: [], surfaces: [], views: [], blobs: [], document: null,
    timeline: { label: "case", names: null, count, frames, axes: [axis, axis] },
  };
}

test("many steps in one frame of the browser are told once, the last of them", () => {
  const store = new Store(data(100));
  const told: number[] = [];
  const off = store.onStep((k) => told.push(k));
  for (let k = 1; k < 50; ++k) store.setStep(k);
  assert.equal(store.step, 49);
  assert.deepEqual(told, []);
  nextFrame();
  assert.deepEqual(told, [49]);
  store.setStep(49);
  nextFrame();
  assert.deepEqual(told, [49]);
  off();
  store.setStep(3);
  nextFrame();
  assert.deepEqual(told, [49]);
});

test("steps are rounded and stay within the timeline; what is no number changes nothing", () => {
  const store = new Store(data(10));
  store.setStep(3.6);
  assert.equal(store.step, 4);
  store.setStep(99);
  assert.equal(store.step, 9);
  store.setStep(-5);
  assert.equal(store.step, 0);
  store.setStep(NaN);
  assert.equal(store.step, 0);
  store.setAxis(2);
  assert.equal(store.axis, 0);
});

test("a step's frame, null where there is none", () => {
  const store = new Store(data(3, [0, null, 1]));
  assert.equal(store.frame(), 0);
  assert.equal(store.frame(1), null);
  assert.equal(store.frame(2), 1);
  assert.equal(store.frame(7), null);
  assert.equal(new Store(data(3)).frame(), null);
});
