// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { seriesColour } from "../colours";
import { el } from "../svg";
import type { PlotSeries } from "./model";

/** Outline of a marker about (x, y); the shapes differ so that colour is not needed to tell series apart. */
export function markerPath(look: number, x: number, y: number, r: number): string {
  const p = (v: number): string => v.toFixed(1);
  switch (look % 6) {
    case 1: {
      const h = r * 0.9;
      return `M${p(x - h)} ${p(y - h)}h${p(2 * h)}v${p(2 * h)}h${p(-2 * h)}Z`;
    }
    case 2:
      return `M${p(x)} ${p(y - 1.25 * r)}L${p(x + 1.15 * r)} ${p(y + 0.8 * r)}H${p(x - 1.15 * r)}Z`;
    case 3:
      return `M${p(x)} ${p(y - 1.3 * r)}L${p(x + 1.3 * r)} ${p(y)}L${p(x)} ${p(y + 1.3 * r)}L${p(x - 1.3 * r)} ${p(y)}Z`;
    case 4:
      return `M${p(x)} ${p(y + 1.25 * r)}L${p(x + 1.15 * r)} ${p(y - 0.8 * r)}H${p(x - 1.15 * r)}Z`;
    case 5: {
      const w = 0.42 * r;
      const l = 1.25 * r;
      return `M${p(x - w)} ${p(y - l)}H${p(x + w)}V${p(y - w)}H${p(x + l)}V${p(y + w)}H${p(x + w)}V${p(y + l)}H${p(x - w)}V${p(y + w)}H${p(x - l)}V${p(y - w)}H${p(x - w)}Z`;
    }
    default:
      return `M${p(x - r)} ${p(y)}a${p(r)} ${p(r)} 0 1 0 ${p(2 * r)} 0a${p(r)} ${p(r)} 0 1 0 ${p(-2 * r)} 0Z`;
  }
}

/** A sample of how a series is drawn, for legends and readouts; its group is at (x, y). */
export function sampleOf(series: Pick<PlotSeries, "look" | "line" | "points" | "dash">): SVGGElement {
  const colour = `stroke:${seriesColour(series.look)}`;
  const group = el("g", { class: "sample" });
  if (series.line) group.append(el("path", { class: "line", d: "M0 6H22", style: `${colour};fill:none;stroke-width:2`, "stroke-dasharray": series.dash || "none" }));
  if (series.points) group.append(el("path", { class: "marks", d: markerPath(series.look, 11, 6, 3.6), style: `fill:${seriesColour(series.look)}` }));
  return group;
}

/** The sample as a small picture in HTML. */
export function swatch(series: Pick<PlotSeries, "look" | "line" | "points" | "dash">): SVGSVGElement {
  return el("svg", { width: 22, height: 12, viewBox: "0 0 22 12", "aria-hidden": "true" }, sampleOf(series));
}
