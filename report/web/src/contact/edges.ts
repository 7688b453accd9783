// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Decoded } from "../packed";

/** Corners of elements in counts of elements (x, y, x, y, ...): (0, 0) is the outer corner of the first element. */
export interface Line {
  points: number[];
  closed: boolean;
}

/** Directed unit edges that leave each corner of the grid, to be taken one by one. */
class Edges {
  private readonly from: number[][] = [];
  private readonly arriving: Int32Array;
  count = 0;

  constructor(
    private readonly stride: number,
    corners: number,
  ) {
    this.arriving = new Int32Array(corners);
  }

  add(x0: number, y0: number, x1: number, y1: number): void {
    const a = y0 * this.stride + x0;
    const b = y1 * this.stride + x1;
    (this.from[a] ??= []).push(b);
    this.arriving[b] = (this.arriving[b] ?? 0) + 1;
    ++this.count;
  }

  /** Takes edges from a corner on until there is none. */
  private walk(start: number): Line {
    const line = [start];
    for (let at = start; ;) {
      const next = this.from[at]?.pop();
      if (next === undefined) break;
      this.arriving[next] = this.arriving[next]! - 1;
      line.push(next);
      at = next;
      if (at === start) break;
    }
    const closed = line.length > 2 && line[0] === line[line.length - 1];
    return { points: this.corners(line, closed), closed };
  }

  /** The corners at which the line turns. */
  private corners(line: number[], closed: boolean): number[] {
    const out: number[] = [];
    const n = closed ? line.length - 1 : line.length;
    for (let i = 0; i < n; ++i) {
      const at = line[i]!;
      const before = closed ? line[(i + n - 1) % n] : line[i - 1];
      const after = closed ? line[(i + 1) % n] : line[i + 1];
      if (before !== undefined && after !== undefined && at - before === after - at) continue;
      out.push(at % this.stride, Math.floor(at / this.stride));
    }
    return out;
  }

  /** Open lines begin where more edges leave than arrive; what is left are loops. */
  lines(): Line[] {
    const out: Line[] = [];
    const starts = Object.keys(this.from).map(Number);
    for (const start of starts) while ((this.from[start]?.length ?? 0) > this.arriving[start]!) out.push(this.walk(start));
    for (const start of starts) while ((this.from[start]?.length ?? 0) > 0) out.push(this.walk(start));
    return out;
  }
}

/**
 * Lines along the edges between elements of two kinds; elements off the grid are of kind 0. `separates(a, b)` says whether an
 * edge between kinds a and b belongs to the lines. The greater kind lies on the left, so outlines run counterclockwise (y up).
 */
export function edgeLines(kinds: ArrayLike<number>, nx: number, ny: number, separates: (a: number, b: number) => boolean): Line[] {
  const edges = new Edges(nx + 1, (nx + 1) * (ny + 1));
  const kind = (ix: number, iy: number): number => (ix < 0 || iy < 0 || ix >= nx || iy >= ny ? 0 : kinds[iy * nx + ix]!);
  for (let iy = 0; iy < ny; ++iy)
    for (let ix = 0; ix <= nx; ++ix) {
      const left = kind(ix - 1, iy);
      const right = kind(ix, iy);
      if (left === right || !separates(left, right)) continue;
      if (left > right) edges.add(ix, iy, ix, iy + 1);
      else edges.add(ix, iy + 1, ix, iy);
    }
  for (let iy = 0; iy <= ny; ++iy)
    for (let ix = 0; ix < nx; ++ix) {
      const below = kind(ix, iy - 1);
      const above = kind(ix, iy);
      if (below === above || !separates(below, above)) continue;
      if (above > below) edges.add(ix, iy, ix + 1, iy);
      else edges.add(ix + 1, iy, ix, iy);
    }
  return edges.lines();
}

/** Outline of contact: between elements with a state and those without. */
export function contactOutline(state: Decoded, nx: number, ny: number): Line[] {
  return edgeLines(
    Uint8Array.from(state, (v) => (v > 0 ? 1 : 0)),
    nx,
    ny,
    () => true,
  );
}

/** Lines between adhesion, slip and plastic elements. */
export function division(state: Decoded, nx: number, ny: number): Line[] {
  return edgeLines(state, nx, ny, (a, b) => a > 0 && b > 0);
}

/** Outline of the elements that slide. */
export function slipOutline(state: Decoded, nx: number, ny: number): Line[] {
  return edgeLines(
    Uint8Array.from(state, (v) => (v >= 2 ? 1 : 0)),
    nx,
    ny,
    () => true,
  );
}
