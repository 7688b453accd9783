// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Box } from "./fields";

// Geometry of the drawing in pixels: panels of one window (mm, equal scale on both axes) side by side, colour bars and legend.

export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface PanelPlace extends Rect {
  /** Whether this panel carries the labels of the s axis and the x axis. */
  labelS: boolean;
  labelX: boolean;
}

export interface Layout {
  width: number;
  height: number;
  /** Pixels a mm. */
  scale: number;
  panels: PanelPlace[];
  bars: (Rect & { vertical: boolean })[];
  /** Left end and baseline of each row of the legend. */
  legend: { x: number; y: number; width: number };
}

export interface LayoutWish {
  /** Pixels there are. */
  width: number;
  count: number;
  window: Box;
  titles: boolean;
  bars: number;
  legendRows: number;
  /** Greatest height of a panel. */
  panelHeight: number;
}

export const LEGEND_ROW = 19;
const LEFT = 50;
const RIGHT = 8;
const TITLE = 22;
const TOP = 8;
const BOTTOM = 46;
const GAP_X = 16;
const GAP_Y = 12;
const BAR = 13;
/** Room of a colour bar with its numbers and title. */
const BAR_RIGHT = 82;
const BAR_BELOW = 56;
const NARROW = 520;
/** Room that a legend gets also beside a narrow picture. */
const LEGEND_WIDTH = 620;

interface Tiling {
  columns: number;
  rows: number;
  scale: number;
}

/** Greatest height of all rows together, in heights of a panel: panels to compare should be in sight together. */
const TOTAL_HEIGHT = 2.2;

/** The number of columns with the largest panels that are not too high together; of equal ones the widest. */
function tile(count: number, width: number, window: Box, panelHeight: number): Tiling {
  let best: Tiling = { columns: count, rows: 1, scale: 0 };
  for (let columns = 1; columns <= count; ++columns) {
    const panelWidth = (width - GAP_X * (columns - 1)) / columns;
    const scale = Math.min(panelWidth / (window.x1 - window.x0), panelHeight / (window.y1 - window.y0));
    const rows = Math.ceil(count / columns);
    const fits = rows * scale * (window.y1 - window.y0) <= TOTAL_HEIGHT * panelHeight || columns === count;
    if (scale >= best.scale && fits) best = { columns, rows, scale };
  }
  return best;
}

export function layOut(wish: LayoutWish): Layout {
  const { window, count, bars } = wish;
  const below = wish.width < NARROW;
  const barsWidth = below || bars === 0 ? 0 : BAR_RIGHT * bars;
  const room = Math.max(60, wish.width - LEFT - RIGHT - barsWidth);
  const { columns, rows, scale } = tile(Math.max(1, count), room, window, wish.panelHeight);
  const w = (window.x1 - window.x0) * scale;
  const h = (window.y1 - window.y0) * scale;
  const title = wish.titles ? TITLE : TOP;
  const panels: PanelPlace[] = [];
  for (let k = 0; k < count; ++k) {
    const column = k % columns;
    const row = Math.floor(k / columns);
    panels.push({
      x: LEFT + column * (w + GAP_X),
      y: title + row * (h + GAP_Y + (wish.titles ? TITLE : 0)),
      width: w,
      height: h,
      labelS: column === 0,
      labelX: k + columns >= count,
    });
  }
  const right = LEFT + columns * w + (columns - 1) * GAP_X;
  const bottom = title + rows * h + (rows - 1) * (GAP_Y + (wish.titles ? TITLE : 0)) + BOTTOM;
  const barLength = Math.min(rows * h, 480);
  const barPlaces = Array.from({ length: bars }, (_, k) =>
    below
      ? { x: LEFT, y: bottom + 2 + k * BAR_BELOW, width: Math.max(60, right - LEFT), height: BAR, vertical: false }
      : { x: right + 16 + k * BAR_RIGHT, y: title, width: BAR, height: Math.max(60, barLength), vertical: true },
  );
  const legendY = bottom + (below ? bars * BAR_BELOW : 0) + 12;
  const needed = below ? wish.width : Math.max(right + RIGHT + barsWidth, LEGEND_WIDTH);
  return {
    width: Math.min(wish.width, Math.ceil(needed)),
    height: Math.ceil(legendY - 12 + wish.legendRows * LEGEND_ROW + (wish.legendRows > 0 ? 6 : 0)),
    scale,
    panels,
    bars: barPlaces,
    legend: { x: below ? 6 : LEFT, y: legendY, width: Math.min(wish.width, needed) - (below ? 12 : LEFT) },
  };
}

/** Rows of a legend: items of given widths, one after the other, a new row where the room ends. Gives the place of each. */
export function legendPlaces(widths: readonly number[], room: number, gap = 16): { x: number; row: number }[] {
  let x = 0;
  let row = 0;
  return widths.map((width) => {
    if (x > 0 && x + width > room) {
      x = 0;
      ++row;
    }
    const place = { x, row };
    x += width + gap;
    return place;
  });
}
