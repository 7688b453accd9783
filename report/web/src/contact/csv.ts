// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { quoted } from "../csv";
import type { FieldInfo, Patch } from "../data";
import { fieldOf, gridEdges } from "./fields";
import type { Item } from "./place";

/** The shortest text that reads back as the same number in the single precision that it came in; empty where there is none. */
export function plain(value: number): string {
  if (!Number.isFinite(value)) return "";
  const single = Math.fround(value);
  for (let digits = 6; digits < 9; ++digits) {
    const text = Number(value.toPrecision(digits));
    if (Math.fround(text) === single) return String(text);
  }
  return String(Number(value.toPrecision(9)));
}

/** A head of a column: the name with its unit, in ASCII. */
function head(field: FieldInfo): string {
  const unit = field.unit === "1" || field.unit === "" ? "" : `_${field.unit}`;
  return `${field.name}${unit}`
    .replace(/[µμ]/g, "u")
    .replace(/°/g, "")
    .replace(/%/g, "percent")
    .replace(/²/g, "2")
    .replace(/[^\w./-]+/g, "_");
}

/**
 * A table of the elements of patches: x_mm and s_mm in the axes of the picture (whose origin is the contact reference), then
 * every field. With several parts each line begins with the name of its part.
 */
export function csvOf(parts: readonly { name: string; item: Item }[], fields: readonly FieldInfo[], blobs: string[]): string {
  const many = parts.length > 1;
  const shown = fields.filter((field) => parts.some(({ item }) => fieldOf(item.patch, field.name, blobs) !== null));
  const lines = [[...(many ? ["patch"] : []), "x_mm", "s_mm", ...shown.map(head)].join(",")];
  for (const { name, item } of parts) {
    const columns = shown.map((field) => fieldOf(item.patch, field.name, blobs));
    const start = many ? `${quoted(name)},` : "";
    for (let i = 0; i < item.patch.nx * item.patch.ny; ++i) {
      const [x, s] = centre(item, i % item.patch.nx, Math.floor(i / item.patch.nx));
      lines.push(`${start}${plain(x)},${plain(s)}${columns.map((c) => `,${plain(c?.[i] ?? NaN)}`).join("")}`);
    }
  }
  return `${lines.join("\n")}\n`;
}

/** Centre of an element in the axes of the picture [mm]. */
export function centre(item: Item, ix: number, iy: number): [number, number] {
  const p: Patch = item.patch;
  return [p.x0_mm + ix * p.dx_mm + item.ox, p.s0_mm + iy * p.ds_mm + item.os];
}

/** Whether a place of the picture lies on the grid of an item. */
export function covers(item: Item, x: number, s: number): boolean {
  const box = gridEdges(item.patch);
  return x - item.ox >= box.x0 && x - item.ox <= box.x1 && s - item.os >= box.y0 && s - item.os <= box.y1;
}
