// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { deflateSync } from "node:zlib";

import type { Packed } from "../src/data";

/** Bytes of `width` little-endian bytes a word, all lowest bytes first. */
function shuffle(bytes: Uint8Array, width: number): Uint8Array {
  const count = bytes.length / width;
  const out = new Uint8Array(bytes.length);
  for (let i = 0; i < count; ++i) for (let k = 0; k < width; ++k) out[k * count + i] = bytes[i * width + k]!;
  return out;
}

/** Collects arrays in one blob as the program packs them; written apart from src/packed.ts. */
export class Packer {
  private readonly parts: Uint8Array[] = [];
  private length = 0;

  constructor(
    private readonly blobs: string[],
    private readonly index = blobs.length,
  ) {
    blobs[index] = "";
  }

  private put(bytes: Uint8Array): number {
    const offset = this.length;
    this.parts.push(bytes);
    this.length += bytes.length;
    return offset;
  }

  f32(values: readonly number[]): Packed {
    const view = new DataView(new ArrayBuffer(4 * values.length));
    values.forEach((v, i) => view.setFloat32(4 * i, v, true));
    return { blob: this.index, offset: this.put(shuffle(new Uint8Array(view.buffer), 4)), count: values.length, type: "f32" };
  }

  /** Codes of 8 or 16 bits between the least and the greatest value; NaN has the greatest code. */
  codes(values: readonly number[], type: "u8" | "u16"): Packed {
    const none = values.some((v) => Number.isNaN(v));
    const top = (type === "u8" ? 255 : 65535) - (none ? 1 : 0);
    let low = Infinity;
    let high = -Infinity;
    for (const v of values) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
    if (low > high) low = high = 0;
    const step = high > low ? (high - low) / top : 1;
    const width = type === "u8" ? 1 : 2;
    const view = new DataView(new ArrayBuffer(width * values.length));
    values.forEach((v, i) => {
      const code = Number.isNaN(v) ? top + 1 : Math.round((v - low) / step);
      if (width === 1) view.setUint8(i, code);
      else view.setUint16(2 * i, code, true);
    });
    const offset = this.put(shuffle(new Uint8Array(view.buffer), width));
    return { blob: this.index, offset, count: values.length, type, low, step, ...(none ? { none } : {}) };
  }

  /** Raw codes that are values themselves (states). */
  bytes(values: readonly number[]): Packed {
    return { blob: this.index, offset: this.put(Uint8Array.from(values)), count: values.length, type: "u8" };
  }

  close(): void {
    this.blobs[this.index] = deflateSync(Buffer.concat(this.parts)).toString("base64");
  }
}
