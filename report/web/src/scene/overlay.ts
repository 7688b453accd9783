// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { linearTicks } from "../chart/scale";
import { STATE_COLOURS, colourMap, css } from "../colours";
import type { FieldInfo } from "../data";
import { formatNumber, labelWithUnit } from "../numbers";
import type { Layers } from "./layers";
import { millimetresPerPixel, outlook, pictureAxes, type Orbit } from "./orbit";
import type { Palette } from "./palette";
import type { Range } from "./ranges";

type Pen = CanvasRenderingContext2D;

const font = (size: number, weight = 400): string => `${weight} ${size}px system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif`;

/** The greatest of 1, 2 and 5 times a power of ten that is not greater than a length. */
export function roundLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  return ([5, 2, 1].find((f) => f * power <= most * 1.0000001) ?? 1) * power;
}

function plate(pen: Pen, palette: Palette, x: number, y: number, width: number, height: number): void {
  pen.fillStyle = palette.plate;
  pen.beginPath();
  pen.roundRect(x, y, width, height, 4);
  pen.fill();
}

function mapStrip(pen: Pen, kind: "sequential" | "diverging", x: number, y: number, width: number, height: number, upright: boolean): void {
  const colour = colourMap(kind);
  const gradient = upright ? pen.createLinearGradient(0, y + height, 0, y) : pen.createLinearGradient(x, 0, x + width, 0);
  for (let k = 0; k <= 24; ++k) gradient.addColorStop(k / 24, css(colour(k / 24)));
  pen.fillStyle = gradient;
  pen.fillRect(x, y, width, height);
}

/** Upright at the right edge, its title above. */
export function drawColourBar(pen: Pen, palette: Palette, field: FieldInfo, range: Range, right: number, top: number, height: number): void {
  pen.font = font(12, 600);
  const title = labelWithUnit(field.label, field.unit);
  pen.textBaseline = "middle";
  if (field.kind === "state") {
    const states = STATE_COLOURS.filter((state) => state.alpha > 0);
    const width = Math.max(pen.measureText(title).width, 90);
    plate(pen, palette, right - width - 16, top - 6, width + 22, 22 + 18 * states.length + 8);
    pen.textAlign = "right";
    pen.fillStyle = palette.text;
    pen.fillText(title, right, top + 8);
    pen.font = font(12);
    states.forEach((state, k) => {
      const y = top + 22 + 18 * k;
      pen.fillStyle = css(state.rgb);
      pen.fillRect(right - 14, y, 14, 12);
      pen.fillStyle = palette.text;
      pen.fillText(state.name, right - 20, y + 6.5);
    });
    return;
  }
  const marks = linearTicks([range.low, range.high], height > 150 ? 4 : 2);
  pen.font = font(12, 600);
  const titleWidth = pen.measureText(title).width;
  pen.font = font(12);
  const widest = Math.max(...marks.map(({ label }) => pen.measureText(label).width));
  const width = Math.max(titleWidth, 24 + widest);
  plate(pen, palette, right - width - 8, top - 6, width + 14, height + 42);
  pen.textAlign = "right";
  pen.fillStyle = palette.text;
  pen.font = font(12, 600);
  pen.fillText(title, right, top + 8);
  const y0 = top + 24;
  mapStrip(pen, field.kind, right - 14, y0, 14, height, true);
  pen.font = font(12);
  for (const { value, label } of marks) {
    const y = y0 + height * (1 - (value - range.low) / (range.high - range.low));
    pen.fillStyle = palette.text;
    pen.fillRect(right - 18, y - 0.5, 4, 1);
    pen.fillText(label, right - 21, y + 0.5);
  }
}

/** Lying, of a deviation, at the bottom right. */
export function drawDeviationBar(pen: Pen, palette: Palette, span: number, title: string, right: number, bottom: number, width: number): void {
  pen.font = font(12, 600);
  const wide = Math.max(width, pen.measureText(title).width);
  plate(pen, palette, right - wide - 8, bottom - 47, wide + 14, 52);
  mapStrip(pen, "diverging", right - width, bottom - 28, width, 11, false);
  pen.textBaseline = "middle";
  pen.fillStyle = palette.text;
  pen.textAlign = "right";
  pen.fillText(title, right, bottom - 37);
  pen.font = font(12);
  pen.textAlign = "center";
  for (const { value, label } of linearTicks([-span, span], 3)) {
    const x = right - width + (width * (value + span)) / (2 * span);
    pen.fillRect(x - 0.5, bottom - 17, 1, 4);
    pen.fillText(label, Math.min(x, right - 10), bottom - 6);
  }
}

/** A dot and what it stands for, its right end given. */
export function drawKey(pen: Pen, palette: Palette, colour: string, text: string, right: number, y: number): void {
  pen.font = font(12);
  const width = pen.measureText(text).width;
  plate(pen, palette, right - width - 22, y - 10, width + 28, 20);
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  pen.fillStyle = palette.text;
  pen.fillText(text, right, y + 0.5);
  pen.fillStyle = colour;
  pen.fillRect(right - width - 16, y - 4, 8, 8);
}

/** `axes`: of x, y and z in the picture, right, up and towards the eye. */
function drawTriad(pen: Pen, palette: Palette, axes: readonly (readonly [number, number, number])[], x: number, y: number): void {
  const reach = 26;
  const order = [0, 1, 2].sort((a, b) => axes[a]![2] - axes[b]![2]);
  pen.lineCap = "round";
  for (const k of order) {
    const [right, up] = axes[k]!;
    const [ex, ey] = [x + reach * right, y - reach * up];
    pen.strokeStyle = pen.fillStyle = palette.axes[k]!;
    pen.lineWidth = 2;
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(ex, ey);
    pen.stroke();
    const size = Math.hypot(right, up);
    if (size > 0.25) {
      const [dx, dy] = [right / size, -up / size];
      pen.beginPath();
      pen.moveTo(ex + 4 * dx, ey + 4 * dy);
      pen.lineTo(ex - 3 * dx - 3.2 * dy, ey - 3 * dy + 3.2 * dx);
      pen.lineTo(ex - 3 * dx + 3.2 * dy, ey - 3 * dy - 3.2 * dx);
      pen.fill();
    }
    pen.font = font(13, 600);
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    const [tx, ty] = size > 0.25 ? [ex + (12 * right) / size, ey - (12 * up) / size] : [x + 9, y + 10];
    pen.lineWidth = 3;
    pen.strokeStyle = palette.plate;
    pen.strokeText("xyz"[k]!, tx, ty);
    pen.fillText("xyz"[k]!, tx, ty);
  }
}

function drawScale(pen: Pen, palette: Palette, perPixel: number, x: number, y: number, most: number): void {
  const span = roundLength(most * perPixel);
  const width = span / perPixel;
  const text = span >= 1 ? `${formatNumber(span)} mm` : `${formatNumber(1000 * span)} µm`;
  pen.font = font(12);
  plate(pen, palette, x - 6, y - 20, Math.max(width, pen.measureText(text).width) + 12, 27);
  pen.strokeStyle = pen.fillStyle = palette.text;
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.moveTo(x, y - 4);
  pen.lineTo(x, y + 2);
  pen.moveTo(x, y - 1);
  pen.lineTo(x + width, y - 1);
  pen.moveTo(x + width, y - 4);
  pen.lineTo(x + width, y + 2);
  pen.stroke();
  pen.textAlign = "left";
  pen.textBaseline = "alphabetic";
  pen.fillText(text, x, y - 8);
}

/** Around an element whose corners are given in pixels, with its value beside it. */
export function drawMarker(pen: Pen, palette: Palette, corners: readonly [number, number][], text: string, width: number): void {
  const x = corners.reduce((sum, c) => sum + c[0], 0) / corners.length;
  const y = corners.reduce((sum, c) => sum + c[1], 0) / corners.length;
  const reach = Math.max(...corners.map((c) => Math.hypot(c[0] - x, c[1] - y)));
  const outline = (): void => {
    pen.beginPath();
    if (reach < 6) pen.arc(x, y, 7, 0, 2 * Math.PI);
    else corners.forEach((c, k) => (k === 0 ? pen.moveTo(...c) : pen.lineTo(...c)));
    pen.closePath();
  };
  pen.lineJoin = "round";
  for (const [colour, size] of [
    [palette.markRim, 4.5],
    [palette.mark, 2],
  ] as const) {
    pen.strokeStyle = colour;
    pen.lineWidth = size;
    outline();
    pen.stroke();
  }
  if (!text) return;
  pen.font = font(13, 600);
  const textWidth = pen.measureText(text).width;
  const left = x + reach + 14 + textWidth > width ? x - Math.max(8, reach) - 18 - textWidth : x + Math.max(8, reach) + 8;
  plate(pen, palette, left - 5, y - 32, textWidth + 10, 22);
  pen.fillStyle = palette.text;
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.fillText(text, left, y - 20.5);
}

/** Lines of text at the top left, the first one strong. */
export function drawCaption(pen: Pen, palette: Palette, lines: readonly string[], x: number, y: number, most: number): void {
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  lines.forEach((line, k) => {
    pen.font = font(k === 0 ? 13 : 12, k === 0 ? 600 : 400);
    let text = line;
    while (text.length > 4 && pen.measureText(text).width > most) text = `${text.slice(0, -2).trimEnd()}…`;
    plate(pen, palette, x - 5, y - 10 + 20 * k, pen.measureText(text).width + 10, 20);
    pen.fillStyle = k === 0 ? palette.text : palette.faint;
    pen.fillText(text, x, y + 20 * k + 0.5);
  });
}

/** The directions of the axes at the bottom left of a picture, and beside them its scale. */
export function showAxes(layers: Layers, palette: Palette, orbit: Orbit, style: string, width: number, height: number, withScale: boolean): void {
  const { right, up } = pictureAxes(orbit);
  const out = outlook(orbit);
  const axes = [0, 1, 2].map((k) => [right[k]!, up[k]!, out[k]!] as const);
  layers.show("triad", { x: 0, y: height - 96, width: 96, height: 96 }, `${style} ${axes.flat().join(" ")}`, (pen) =>
    drawTriad(pen, palette, axes, 46, height - 48),
  );
  const perPixel = millimetresPerPixel(orbit, height);
  layers.show("scale", withScale ? { x: 96, y: height - 40, width: 150, height: 36 } : null, `${style} ${perPixel}`, (pen) =>
    drawScale(pen, palette, perPixel, 104, height - 14, Math.min(120, 0.22 * width)),
  );
}
