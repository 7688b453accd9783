// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { PlotPanel } from "./model";
import type { PanelScales } from "./panel";

/** A point of a panel. */
export interface Hit {
  series: number;
  index: number;
  x: number;
  y: number;
}

/** The point nearest to a place on the screen; distance along x counts more, as one moves along curves. */
export function nearestPoint(panel: PlotPanel, scales: PanelScales, atX: number, atY: number, left: number, right: number): Hit | null {
  let best: Hit | null = null;
  let bestDistance = Infinity;
  panel.series.forEach((series, s) => {
    if (series.hidden) return;
    const n = Math.min(series.x.length, series.y.length);
    for (let i = 0; i < n; ++i) {
      const x = scales.x(series.x[i]!);
      // Written so that NaN is left out.
      if (!(x >= left - 0.5 && x <= right + 0.5)) continue;
      const dx = x - atX;
      if (4 * dx * dx > bestDistance) continue;
      const y = scales.y(series.y[i]!);
      const distance = 4 * dx * dx + (y - atY) * (y - atY);
      if (distance < bestDistance) {
        bestDistance = distance;
        best = { series: s, index: i, x, y };
      }
    }
  });
  return best;
}

/** The step whose x is nearest to a pixel; of equally near ones the one nearest to the current step. */
export function nearestStep(xs: ArrayLike<number>, scale: (v: number) => number, atX: number, current: number): number | null {
  let best: number | null = null;
  let bestDistance = Infinity;
  for (let i = 0; i < xs.length; ++i) {
    const distance = Math.abs(scale(xs[i]!) - atX);
    if (distance < bestDistance || (distance === bestDistance && best !== null && Math.abs(i - current) < Math.abs(best - current))) {
      bestDistance = distance;
      best = i;
    }
  }
  return best;
}

/** In each series of a panel the point at the same abscissa as the hit, if there is one within half a pixel. */
export function companions(panel: PlotPanel, scales: PanelScales, hit: Hit): (number | null)[] {
  return panel.series.map((series, s) => {
    if (series.hidden) return null;
    if (s === hit.series) return hit.index;
    const same = series.x[hit.index];
    const valid = (i: number): boolean => !Number.isNaN(series.y[i] ?? NaN);
    if (same !== undefined && Math.abs(scales.x(same) - hit.x) < 0.5 && valid(hit.index)) return hit.index;
    const n = Math.min(series.x.length, series.y.length);
    // Of long histories the shared index is all that is looked for: a search for each movement would be slow.
    if (n > 5000) return null;
    for (let i = 0; i < n; ++i) if (Math.abs(scales.x(series.x[i]!) - hit.x) < 0.5 && valid(i)) return i;
    return null;
  });
}
