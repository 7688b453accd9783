// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { STATE_COLOURS } from "../colours";
import type { Range } from "./scales";

/** What gives an element its colour. */
export interface Colouring {
  /** 256 colours of four bytes, for values from low to high; of states: a colour a state. */
  table: Uint8Array;
  range: Range;
  states: boolean;
}

/** Colours of the states 0, 1, 2, ... as a table. */
export function stateTable(): Uint8Array {
  return Uint8Array.from(STATE_COLOURS.flatMap(({ rgb, alpha }) => [...rgb, Math.round(255 * alpha)]));
}

/**
 * Writes the colours of elements, four bytes each, the row of the greatest s first (pictures grow downwards). Without value or
 * outside contact (`contact` given and 0 there) an element is transparent.
 */
export function paint(
  pixels: Uint8ClampedArray,
  values: ArrayLike<number>,
  contact: ArrayLike<number> | null,
  nx: number,
  ny: number,
  colouring: Colouring,
): void {
  const words = new Uint32Array(pixels.buffer, pixels.byteOffset, nx * ny);
  const table = new Uint32Array(colouring.table.slice().buffer);
  const last = table.length - 1;
  const { low, high } = colouring.range;
  const offset = colouring.states ? 0 : low;
  const scale = colouring.states ? 1 : last / (high - low);
  for (let iy = 0; iy < ny; ++iy) {
    let to = (ny - 1 - iy) * nx;
    for (let ix = 0, i = iy * nx; ix < nx; ++ix, ++i, ++to) {
      const v = values[i]!;
      if (Number.isNaN(v) || (contact !== null && contact[i] === 0)) {
        words[to] = 0;
        continue;
      }
      const k = Math.round((v - offset) * scale);
      words[to] = table[k < 0 ? 0 : k > last ? last : k]!;
    }
  }
}
