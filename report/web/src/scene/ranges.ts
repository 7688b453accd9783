// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { FieldInfo, FrameSet, Packed } from "../data";

export interface Range {
  low: number;
  high: number;
}

/** Least and greatest number that packed values can take: the packer lets its codes span just the numbers there are. Null: not known. */
export function packedRange(packed: Packed): Range | null {
  if (packed.type === "f32") return null;
  const codes = (packed.type === "u8" ? 255 : 65535) - (packed.none ? 1 : 0);
  const low = packed.low ?? 0;
  return { low, high: low + (packed.step ?? 1) * codes };
}

export function rangeOf(values: ArrayLike<number>, elements: ArrayLike<number>): Range | null {
  const range = { low: Infinity, high: -Infinity };
  for (let k = 0; k < elements.length; ++k) {
    const value = values[elements[k]!]!;
    if (value < range.low) range.low = value;
    if (value > range.high) range.high = value;
  }
  return range.low <= range.high ? range : null;
}

export function union(a: Range | null, b: Range | null): Range | null {
  if (!a || !b) return a ?? b;
  return { low: Math.min(a.low, b.low), high: Math.max(a.high, b.high) };
}

/** Range of a field over all frames of a set, without unpacking what need not be; `measure` unpacks. */
export function rangeOfSet(set: FrameSet, field: string, measure: (packed: Packed) => Range | null): Range | null {
  let range: Range | null = null;
  for (const frame of set.frames)
    for (const patch of frame.patches) {
      const packed = patch.values[field];
      if (packed) range = union(range, packedRange(packed) ?? measure(packed));
    }
  return range;
}

/** Ends of the colour map: about zero for a diverging field, from zero for a sequential one whose values lie near enough to it. */
export function colourRange(range: Range | null, kind: FieldInfo["kind"]): Range {
  if (!range) return { low: 0, high: 1 };
  if (kind === "diverging") {
    const size = Math.max(Math.abs(range.low), Math.abs(range.high)) || 1;
    return { low: -size, high: size };
  }
  const low = range.low > 0 && range.low < 0.6 * range.high ? 0 : range.low;
  return range.high > low ? { low, high: range.high } : { low, high: low + (Math.abs(low) || 1) };
}
