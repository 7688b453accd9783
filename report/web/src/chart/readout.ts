// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { formatNumber, withUnit } from "../numbers";
import { swatch } from "./marks";
import type { Plot } from "./model";
import type { PanelScales } from "./panel";
import type { Hit } from "./nearest";
import { companions } from "./nearest";

function span(className: string, text: string): HTMLSpanElement {
  const element = document.createElement("span");
  element.className = className;
  element.textContent = text;
  return element;
}

/** The abscissa of a point as text. */
export function abscissaText(plot: Plot, value: number): string {
  const { label, unit, labels } = plot.x;
  if (labels) return labels[value] ?? String(value);
  const text = withUnit(formatNumber(value, 6), unit);
  return label ? `${label} ${text}` : text;
}

/** Fills a readout with the nearest point and what lies at the same abscissa; returns it as one text too. */
export function fillReadout(box: HTMLElement, plot: Plot, p: number, scales: PanelScales, hit: Hit): string {
  const panel = plot.panels[p]!;
  const nearest = panel.series[hit.series]!;
  const heading = abscissaText(plot, nearest.x[hit.index]!);
  const head = document.createElement("div");
  head.className = "head";
  head.textContent = heading;
  box.replaceChildren(head);
  const said: string[] = [heading];
  companions(panel, scales, hit).forEach((index, s) => {
    const series = panel.series[s];
    if (index === null || !series) return;
    const row = document.createElement("div");
    row.className = s === hit.series ? "row nearest" : "row";
    const value = withUnit(formatNumber(series.y[index], 5), panel.unit);
    row.append(swatch(series), span("label", series.name || panel.label), span("value", value));
    box.append(row);
    if (s === hit.series) said.push(`${series.name || panel.label} ${value}`);
  });
  const text = nearest.texts?.[hit.index];
  if (text) {
    const note = document.createElement("div");
    note.textContent = text;
    box.append(note);
    said.push(text);
  }
  return said.join(", ");
}

/** Beside a point of its container, on the side with room. */
export function placeReadout(box: HTMLElement, x: number, y: number, width: number, height: number): void {
  box.hidden = false;
  const own = box.getBoundingClientRect();
  const left = x + 14 + own.width > width ? x - 14 - own.width : x + 14;
  const top = Math.min(Math.max(0, y - own.height / 2), Math.max(0, height - own.height));
  box.style.left = `${Math.max(0, Math.min(left, width - own.width))}px`;
  box.style.top = `${top}px`;
}
