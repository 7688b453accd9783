// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
/** An arrow at the centre of an element: its column and row, and the vector. */
export interface Arrow {
  ix: number;
  iy: number;
  x: number;
  s: number;
}

/**
 * Every n-th element of contact in each direction, with its traction. The elements hit the middle of the grid's blocks, whatever
 * the contact is, so that arrows stay where they are from step to step.
 */
export function sampleArrows(
  tx: ArrayLike<number>,
  ts: ArrayLike<number>,
  state: ArrayLike<number>,
  nx: number,
  ny: number,
  strideX: number,
  strideY: number,
): Arrow[] {
  const out: Arrow[] = [];
  for (let iy = Math.floor((strideY - 1) / 2); iy < ny; iy += strideY)
    for (let ix = Math.floor((strideX - 1) / 2); ix < nx; ix += strideX) {
      const i = iy * nx + ix;
      const x = tx[i]!;
      const s = ts[i]!;
      if (state[i]! > 0 && Number.isFinite(x) && Number.isFinite(s) && (x !== 0 || s !== 0)) out.push({ ix, iy, x, s });
    }
  return out;
}

/** How many elements apart arrows are that should be about `spacing` pixels apart. */
export function strideOf(elementPixels: number, spacing: number): number {
  return Math.max(1, Math.round(spacing / elementPixels));
}

/**
 * Path of arrows in pixels: from the centre along the vector, with an open head. `place` gives the pixel of an element's centre,
 * `scale` the pixels of a unit of the vector (s upwards). Arrows shorter than a pixel are left out.
 */
export function arrowPath(arrows: readonly Arrow[], place: (ix: number, iy: number) => [number, number], scale: number): string {
  let path = "";
  for (const { ix, iy, x, s } of arrows) {
    const dx = x * scale;
    const dy = -s * scale;
    const length = Math.hypot(dx, dy);
    if (length < 1) continue;
    const [cx, cy] = place(ix, iy);
    const [x0, y0] = [cx - dx / 2, cy - dy / 2];
    const [x1, y1] = [cx + dx / 2, cy + dy / 2];
    const head = Math.min(4.5, 0.5 * length) / length;
    const [hx, hy] = [dx * head, dy * head];
    const wing = 0.5;
    path +=
      `M${x0.toFixed(1)} ${y0.toFixed(1)}L${x1.toFixed(1)} ${y1.toFixed(1)}` +
      `M${(x1 - hx + wing * hy).toFixed(1)} ${(y1 - hy - wing * hx).toFixed(1)}L${x1.toFixed(1)} ${y1.toFixed(1)}` +
      `L${(x1 - hx - wing * hy).toFixed(1)} ${(y1 - hy + wing * hx).toFixed(1)}`;
  }
  return path;
}
