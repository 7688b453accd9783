// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";

import type { Packed } from "../src/data";
import { decode } from "../src/packed";
import { Packer } from "./pack";

test("bytes written by hand: low and step, the code of no value, the shuffle of two bytes", () => {
  // u8 codes 0, 10, 255; then u16 codes 0x0102, 0xffff as low bytes first, then high bytes.
  const blobs = [deflateSync(Buffer.from([0, 10, 255, 0x02, 0xff, 0x01, 0xff])).toString("base64")];
  assert.deepEqual([...decode({ blob: 0, offset: 0, count: 3, type: "u8", low: -1, step: 0.5, none: true }, blobs)], [-1, 4, NaN]);
  assert.deepEqual([...decode({ blob: 0, offset: 0, count: 3, type: "u8" }, blobs)], [0, 10, 255]);
  assert.deepEqual([...decode({ blob: 0, offset: 3, count: 2, type: "u16", none: true }, blobs)], [258, NaN]);
  assert.deepEqual([...decode({ blob: 0, offset: 3, count: 2, type: "u16" }, blobs)], [258, 65535]);
});

test("floats come back bit by bit, from any offset", () => {
  const blobs: string[] = [];
  const packer = new Packer(blobs);
  packer.bytes([1, 2, 3]);
  const values = [0, -0, 1.5, -3.25e-20, 3.4e38, Infinity, NaN, Math.PI].map(Math.fround);
  const packed = packer.f32(values);
  packer.close();
  assert.equal(packed.offset, 3);
  const got = decode(packed, blobs);
  values.forEach((v, i) => assert.ok(Object.is(got[i], v), `value ${i}: ${got[i]} is not ${v}`));
});

test("codes are within half a step; decoded once", () => {
  const blobs: string[] = [];
  const packer = new Packer(blobs);
  const values = Array.from({ length: 1000 }, (_, i) => (i % 97 === 0 ? NaN : 500 * Math.sin(i)));
  const packed = packer.codes(values, "u16");
  packer.close();
  const got = decode(packed, blobs);
  values.forEach((v, i) => {
    if (Number.isNaN(v)) assert.ok(Number.isNaN(got[i]));
    else assert.ok(Math.abs(got[i]! - v) <= 0.51 * packed.step! + 1e-4, `value ${i}`);
  });
  assert.equal(decode(packed, blobs), got);
});

test("plain numbers: null is NaN; what does not fit is an error", () => {
  assert.deepEqual([...decode([1, null, 2.5], [])], [1, NaN, 2.5]);
  const blobs = [deflateSync(Buffer.from([1, 2, 3])).toString("base64")];
  const long: Packed = { blob: 0, offset: 0, count: 2, type: "u16" };
  assert.throws(() => decode(long, blobs), /too short/);
  assert.throws(() => decode({ ...long, blob: 7 }, blobs), /no blob 7/);
});
