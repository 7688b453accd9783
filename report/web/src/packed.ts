// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { unzlibSync } from "fflate";

import type { Numbers, Packed } from "./data";

export type Decoded = Float64Array | Float32Array;

const inflated = new WeakMap<string[], Map<number, Uint8Array>>();
const decoded = new WeakMap<object, Decoded>();

/** Bytes of base64 text. */
export function fromBase64(text: string): Uint8Array {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** The inflated bytes of a blob; inflated at its first use and kept. */
function blobBytes(blobs: string[], index: number): Uint8Array {
  let ofThese = inflated.get(blobs);
  if (!ofThese) inflated.set(blobs, (ofThese = new Map<number, Uint8Array>()));
  const known = ofThese.get(index);
  if (known) return known;
  const text = blobs[index];
  if (text === undefined) throw new Error(`the report has no blob ${index}`);
  const bytes = unzlibSync(fromBase64(text));
  ofThese.set(index, bytes);
  return bytes;
}

const widths = { u8: 1, u16: 2, f32: 4 } as const;

function unpack(packed: Packed, blobs: string[]): Float32Array {
  if (packed.values) return packed.values;
  const bytes = blobBytes(blobs, packed.blob);
  const { offset, count } = packed;
  if (offset + count * widths[packed.type] > bytes.length) throw new Error(`blob ${packed.blob} is too short`);
  const values = new Float32Array(count);
  if (packed.type === "f32") {
    const words = new Uint32Array(values.buffer);
    for (let i = 0; i < count; ++i) {
      words[i] =
        bytes[offset + i]! |
        (bytes[offset + count + i]! << 8) |
        (bytes[offset + 2 * count + i]! << 16) |
        (bytes[offset + 3 * count + i]! << 24);
    }
    return values;
  }
  const low = packed.low ?? 0;
  const step = packed.step ?? 1;
  const wide = packed.type === "u16";
  const nothing = packed.none ? (wide ? 65535 : 255) : -1;
  for (let i = 0; i < count; ++i) {
    const code = wide ? bytes[offset + i]! | (bytes[offset + count + i]! << 8) : bytes[offset + i]!;
    values[i] = code === nothing ? NaN : low + step * code;
  }
  return values;
}

/** The numbers, NaN where there is none. Decoded once and kept while the description lives; not to be written to. */
export function decode(numbers: Numbers, blobs: string[]): Decoded {
  const known = decoded.get(numbers);
  if (known) return known;
  const values = Array.isArray(numbers) ? Float64Array.from(numbers, (v) => v ?? NaN) : unpack(numbers, blobs);
  decoded.set(numbers, values);
  return values;
}

/** How many numbers there are, without decoding them. */
export function countOf(numbers: Numbers): number {
  return Array.isArray(numbers) ? numbers.length : numbers.count;
}
