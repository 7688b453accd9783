// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Box } from "./fields";
import { gridEdges } from "./fields";
import type { Layout, PanelPlace, Rect } from "./layout";
import type { Item } from "./place";
import { paint, type Colouring } from "./raster";

/** The coloured elements of a patch. */
export interface Cells {
  item: Item;
  values: ArrayLike<number>;
  /** Elements whose value here is 0 are left out; null: none is. */
  contact: ArrayLike<number> | null;
  colouring: Colouring;
}

/** Pixels that the grid of an item fills. */
export function rectOf(item: Item, place: PanelPlace, window: Box, scale: number): Rect {
  const box = gridEdges(item.patch);
  return {
    x: place.x + (box.x0 + item.ox - window.x0) * scale,
    y: place.y + (window.y1 - box.y1 - item.os) * scale,
    width: (box.x1 - box.x0) * scale,
    height: (box.y1 - box.y0) * scale,
  };
}

/** Paints elements as a small picture of one pixel each and scales it up with hard edges. */
export class Painter {
  private readonly small = document.createElement("canvas");
  private readonly context = this.small.getContext("2d", { willReadFrequently: true });
  private data: ImageData | null = null;

  private one(cells: Cells): void {
    const { nx, ny } = cells.item.patch;
    if (this.data?.width !== nx || this.data.height !== ny) {
      this.data = new ImageData(nx, ny);
      this.small.width = nx;
      this.small.height = ny;
    }
    paint(this.data.data, cells.values, cells.contact, nx, ny, cells.colouring);
    this.context?.putImageData(this.data, 0, 0);
  }

  /** Draws the panels on a canvas that lies under the drawing. */
  draw(canvas: HTMLCanvasElement, layout: Layout, window: Box, panels: readonly (readonly Cells[])[]): void {
    const ratio = Math.min(3, globalThis.devicePixelRatio || 1);
    const width = Math.round(layout.width * ratio);
    const height = Math.round(layout.height * ratio);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
      canvas.style.width = `${layout.width}px`;
      canvas.style.height = `${layout.height}px`;
    }
    const context = canvas.getContext("2d");
    if (!context) return;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    panels.forEach((cells, k) => {
      const place = layout.panels[k];
      if (!place) return;
      context.save();
      context.beginPath();
      context.rect(place.x, place.y, place.width, place.height);
      context.clip();
      context.clearRect(place.x - 1, place.y - 1, place.width + 2, place.height + 2);
      context.imageSmoothingEnabled = false;
      for (const one of cells) {
        this.one(one);
        const to = rectOf(one.item, place, window, layout.scale);
        context.drawImage(this.small, to.x, to.y, to.width, to.height);
      }
      context.restore();
    });
  }

  /** The elements as a PNG for a file, several pixels each: viewers that blur pictures then blur little. */
  toDataUrl(cells: Cells): string {
    this.one(cells);
    const factor = Math.max(1, Math.min(12, Math.floor(1000 / Math.max(this.small.width, this.small.height))));
    const large = document.createElement("canvas");
    large.width = this.small.width * factor;
    large.height = this.small.height * factor;
    const context = large.getContext("2d");
    if (context) {
      context.imageSmoothingEnabled = false;
      context.drawImage(this.small, 0, 0, large.width, large.height);
    }
    return large.toDataURL("image/png");
  }
}
