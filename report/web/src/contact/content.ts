// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { arrowPath, sampleArrows, strideOf } from "./arrows";
import type { Options } from "./controls";
import { fieldOf, lineValues, stateOf, type Box } from "./fields";
import type { Layout } from "./layout";
import { levelLines, linesOf, pathOf, type ToPixels } from "./lines";
import type { Model, PanelModel } from "./model";
import { toPixels, type PanelContent } from "./panel";
import type { Cells } from "./painter";
import type { Found } from "./pick";
import type { Item } from "./place";
import { isLight, type ArrowScale, type Style } from "./style";

/** Pixels between arrows. */
export const ARROW_SPACING = 19;

/** What a step is drawn from. */
export interface Scene {
  model: Model;
  options: Options;
  style: Style;
  window: Box;
  layout: Layout;
  arrows: ArrowScale | null;
  /** Patches of the first set, which differences are taken from. */
  truth: readonly Item[];
}

function isDifference(scene: Scene, panel: PanelModel): boolean {
  return scene.style.difference !== null && panel.k > 0;
}

/** The coloured elements of a panel. */
export function cellsOf(scene: Scene, panel: PanelModel): Cells[] {
  const { model, style } = scene;
  const { blobs } = model.data;
  return panel.items.flatMap((item) => {
    if (style.difference && isDifference(scene, panel)) {
      const values = model.difference(item, scene.truth, style.field.name);
      return values ? [{ item, values, contact: null, colouring: style.difference.colouring }] : [];
    }
    const values = fieldOf(item.patch, style.field.name, blobs);
    const contact = style.everywhere ? null : stateOf(item.patch, blobs);
    return values ? [{ item, values, contact, colouring: style.colouring }] : [];
  });
}

/** Value of an element as the panel shows it, for the search of the peak. */
export function panelValue(scene: Scene, panel: PanelModel, item: Item, element: number): number {
  const { model, style } = scene;
  const values = isDifference(scene, panel)
    ? model.difference(item, scene.truth, style.field.name)
    : lineValues(item.patch, style.field.name, model.data.blobs);
  return values?.[element] ?? NaN;
}

/** What is said in a panel without a picture; empty where there is one. */
function noteOf(panel: PanelModel, cells: readonly Cells[]): string {
  if (!panel.frame) return "no fields in this step";
  if (panel.frame.patches.length === 0) return panel.frame.status === "failed" ? "failed" : "no contact";
  if (panel.items.length === 0) return "no such patch in this step";
  return cells.length === 0 ? "the file has not got this field here" : "";
}

function titleOf(scene: Scene, panel: PanelModel): string {
  const names = panel.items.map(({ patch }) => patch.name).filter((name) => name !== "");
  const patches = (panel.frame?.patches.length ?? 0) > 1 ? names.slice(0, 3).join(", ") : "";
  const difference = isDifference(scene, panel) ? " – difference" : "";
  const name = scene.model.sets.length > 1 ? panel.name : (panel.frame?.name ?? "");
  return [name + difference, patches].filter((text) => text !== "").join(" · ");
}

function isolinePaths(scene: Scene, panel: PanelModel, to: ToPixels): { light: string; dark: string } {
  const { style, model } = scene;
  const difference = isDifference(scene, panel) ? style.difference : null;
  const { levels, colouring } = difference ?? style;
  const kind = difference || style.field.kind === "diverging" ? "diverging" : "sequential";
  const out = { light: "", dark: "" };
  if (levels.length === 0) return out;
  for (const item of panel.items) {
    const { nx, ny } = item.patch;
    const values = difference
      ? model.difference(item, scene.truth, style.field.name)
      : lineValues(item.patch, style.field.name, model.data.blobs);
    if (!values) continue;
    levelLines(values, nx, ny, levels).forEach(
      (lines, k) => (out[isLight(levels[k]!, colouring, kind) ? "light" : "dark"] += pathOf(lines, item, to)),
    );
  }
  return out;
}

function arrowsOf(scene: Scene, item: Item, to: ToPixels): string {
  const { patch, ox, os } = item;
  const { blobs } = scene.model.data;
  const tx = fieldOf(patch, "traction_x", blobs);
  const ts = fieldOf(patch, "traction_s", blobs);
  if (!tx || !ts || !scene.arrows) return "";
  const strideX = strideOf(patch.dx_mm * to.scale, ARROW_SPACING);
  const strideY = strideOf(patch.ds_mm * to.scale, ARROW_SPACING);
  const arrows = sampleArrows(tx, ts, stateOf(patch, blobs), patch.nx, patch.ny, strideX, strideY);
  const place = (ix: number, iy: number): [number, number] => [
    to.x + (patch.x0_mm + ix * patch.dx_mm + ox) * to.scale,
    to.y - (patch.s0_mm + iy * patch.ds_mm + os) * to.scale,
  ];
  return arrowPath(arrows, place, scene.arrows.pixels);
}

/** Outline of one element. */
function markOf({ item, ix, iy }: Found, to: ToPixels): string {
  return pathOf([{ points: [ix, iy, ix + 1, iy, ix + 1, iy + 1, ix, iy + 1], closed: true }], item, to);
}

/** Everything that lies over the picture of a panel. */
export function contentOf(
  scene: Scene,
  panel: PanelModel,
  place: number,
  cells: readonly Cells[],
  cut: { x: number; s: number },
  picked: Found | null,
): PanelContent {
  const { options, model, window, layout } = scene;
  const { blobs } = model.data;
  const rect = layout.panels[place]!;
  const to = toPixels(rect, window, layout.scale);
  const over = (wanted: boolean, path: (item: Item) => string): string => (wanted ? panel.items.map(path).join("") : "");
  const note = noteOf(panel, cells);
  const x = to.x + cut.x * to.scale;
  const y = to.y - cut.s * to.scale;
  return {
    title: titleOf(scene, panel),
    note,
    slip: over(options.slip, (item) => pathOf(linesOf(item.patch, blobs).slip, item, to)),
    ...isolinePaths(scene, panel, to),
    reference: options.other && panel.other && note === "" ? pathOf(linesOf(panel.other.patch, blobs).outline, panel.other, to) : "",
    division: over(options.division && !scene.style.colouring.states, (item) => pathOf(linesOf(item.patch, blobs).division, item, to)),
    outline: over(true, (item) => pathOf(linesOf(item.patch, blobs).outline, item, to)),
    arrows: over(options.arrows, (item) => arrowsOf(scene, item, to)),
    cross: note === "" ? `M${rect.x} ${y.toFixed(1)}h${rect.width}M${x.toFixed(1)} ${rect.y}v${rect.height}` : "",
    mark: picked ? markOf(picked, to) : "",
  };
}
