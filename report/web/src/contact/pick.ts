// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { contactBox, elementAt, shownValue } from "./fields";
import type { PanelModel } from "./model";
import type { Item } from "./place";

/** A place of the picture [mm] that the reader chose, and the set in whose panel. */
export interface Place {
  x: number;
  s: number;
  set: number;
}

export interface Found {
  item: Item;
  ix: number;
  iy: number;
}

/** The element of a panel at a place: of the patches whose grids cover it, one in contact there goes first. */
export function elementOf(panel: PanelModel, x: number, s: number, blobs: string[]): Found | null {
  let found: Found | null = null;
  for (const item of panel.items) {
    const at = elementAt(item.patch, x - item.ox, s - item.os);
    if (!at) continue;
    if (Number.isFinite(shownValue(item.patch, "pressure", at.iy * item.patch.nx + at.ix, blobs))) return { item, ...at };
    found ??= { item, ...at };
  }
  return found;
}

/** The element with the value that is the largest in size. */
export function peakOf(panel: PanelModel, valueOf: (item: Item, element: number) => number, blobs: string[]): Found | null {
  let best: Found | null = null;
  let most = -1;
  for (const item of panel.items) {
    const { nx, ny } = item.patch;
    for (let i = 0; i < nx * ny; ++i) {
      const size = Math.abs(valueOf(item, i));
      if (!(size > most)) continue;
      most = size;
      best = { item, ix: i % nx, iy: Math.floor(i / nx) };
    }
  }
  return best ?? middle(panel, blobs);
}

/** An element in the middle of contact. */
function middle(panel: PanelModel, blobs: string[]): Found | null {
  const item = panel.items[0];
  const box = item && contactBox(item.patch, blobs);
  return item && box ? { item, ix: Math.round((box.x0 + box.x1) / 2), iy: Math.round((box.y0 + box.y1) / 2) } : null;
}
