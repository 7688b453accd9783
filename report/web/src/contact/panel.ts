// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { linearTicks } from "../chart/scale";
import type { Box } from "./fields";
import type { Layout, PanelPlace } from "./layout";
import type { ToPixels } from "./lines";
import { fitted, put, say, show, svg, textWidth } from "./svg";

/** What a panel shows; paths are in pixels of the drawing. */
export interface PanelContent {
  title: string;
  /** Said in place of a picture. */
  note: string;
  slip: string;
  /** Isolines, those to be light and those to be dark. */
  light: string;
  dark: string;
  reference: string;
  division: string;
  outline: string;
  arrows: string;
  cross: string;
  mark: string;
}

const INK = "var(--text)";
const AXIS = "var(--line-strong)";
/** Of the outline to compare with. */
export const OTHER = "var(--cursor)";

type LineName = keyof Omit<PanelContent, "title" | "note">;

/** Lines from the lowest to the highest: what they are called and how they look. Some have a casing to stand out on any colour. */
const looks: { name: LineName; attributes: Record<string, string | number> }[] = [
  { name: "dark", attributes: { stroke: "#000000", "stroke-opacity": 0.5, "stroke-width": 0.9 } },
  { name: "light", attributes: { stroke: "#ffffff", "stroke-opacity": 0.62, "stroke-width": 0.9 } },
  { name: "cross", attributes: { stroke: INK, "stroke-opacity": 0.55, "stroke-width": 1, "stroke-dasharray": "1 3" } },
  { name: "outline", attributes: { stroke: "var(--surface)", "stroke-width": 3.4, "stroke-opacity": 0.55, "stroke-linejoin": "miter" } },
  { name: "outline", attributes: { stroke: INK, "stroke-width": 1.5, "stroke-linejoin": "miter" } },
  { name: "division", attributes: { stroke: "#10151a", "stroke-width": 3.2, "stroke-opacity": 0.75 } },
  { name: "division", attributes: { stroke: "#ffffff", "stroke-width": 1.5 } },
  { name: "reference", attributes: { stroke: "var(--surface)", "stroke-width": 3.6, "stroke-opacity": 0.5 } },
  { name: "reference", attributes: { stroke: OTHER, "stroke-width": 1.8, "stroke-dasharray": "6 3" } },
  { name: "arrows", attributes: { stroke: "#ffffff", "stroke-width": 2.8, "stroke-opacity": 0.8 } },
  { name: "arrows", attributes: { stroke: "#10151a", "stroke-width": 1.15 } },
];

/** The drawing of one panel: axes, lines over the picture, texts. */
export class PanelNodes {
  readonly group: SVGGElement;
  private readonly clip: SVGRectElement;
  private readonly frame: SVGRectElement;
  private readonly axes: SVGGElement;
  private readonly lines: { name: LineName; path: SVGPathElement }[];
  private readonly slip: SVGPathElement;
  private readonly marks: [SVGPathElement, SVGPathElement];
  private readonly origin: SVGPathElement;
  private readonly title: SVGTextElement;
  private titleWidth = 0;
  private inside = 0; // its width
  private readonly note: SVGTextElement;
  private drawn = "";

  constructor(parent: SVGSVGElement, id: string, hatch: string) {
    this.group = svg("g", {}, parent);
    const path = svg("clipPath", { id }, this.group);
    this.clip = svg("rect", {}, path);
    this.axes = svg("g", { fill: "var(--muted)", "font-size": 11.5 }, this.group);
    const inside = svg("g", { "clip-path": `url(#${id})`, fill: "none", "stroke-linejoin": "round" }, this.group);
    svg("g", { class: "cells" }, inside);
    this.slip = svg("path", { fill: `url(#${hatch})`, "fill-rule": "evenodd" }, inside);
    this.lines = looks.map(({ name, attributes }) => ({ name, path: svg("path", attributes, inside) }));
    this.origin = svg("path", { stroke: INK, "stroke-width": 1.4 }, inside);
    const mark = { "stroke-linejoin": "miter" };
    this.marks = [
      svg("path", { ...mark, stroke: "#ffffff", "stroke-width": 4 }, inside),
      svg("path", { ...mark, stroke: "#10151a", "stroke-width": 1.8 }, inside),
    ];
    this.frame = svg("rect", { fill: "none", stroke: AXIS, "shape-rendering": "crispEdges" }, this.group);
    this.title = svg("text", { fill: INK, "font-size": 12, "font-weight": 600 }, this.group);
    this.note = svg("text", { fill: "var(--muted)", "font-size": 13, "text-anchor": "middle" }, this.group);
  }

  /** Draws the axes, if they are not those already there. */
  place(place: PanelPlace, window: Box, scale: number): void {
    const key = JSON.stringify([place, window]);
    if (key === this.drawn) return;
    this.drawn = key;
    this.inside = place.width;
    for (const rect of [this.clip, this.frame])
      for (const side of ["x", "y", "width", "height"] as const) put(rect, side, place[side].toFixed(2));
    put(this.title, "x", place.x.toFixed(1));
    put(this.title, "y", (place.y - 8).toFixed(1));
    put(this.note, "x", (place.x + place.width / 2).toFixed(1));
    put(this.note, "y", (place.y + place.height / 2 + 4).toFixed(1));
    this.axes.replaceChildren();
    this.drawX(place, window, scale);
    this.drawS(place, window, scale);
    const at = toPixels(place, window, scale);
    put(this.origin, "d", `M${at.x - 6} ${at.y}H${at.x + 6}M${at.x} ${at.y - 6}V${at.y + 6}`);
  }

  private drawX(place: PanelPlace, window: Box, scale: number): void {
    const bottom = place.y + place.height;
    for (const { value, label } of linearTicks([window.x0, window.x1], Math.max(3, place.width / 60))) {
      const x = place.x + (value - window.x0) * scale;
      svg("path", { d: `M${x.toFixed(1)} ${bottom.toFixed(1)}v5`, stroke: AXIS, "shape-rendering": "crispEdges" }, this.axes);
      if (place.labelX)
        svg("text", { x: x.toFixed(1), y: (bottom + 17).toFixed(1), "text-anchor": "middle" }, this.axes).textContent = label;
    }
    if (!place.labelX) return;
    const middle = place.x + place.width / 2;
    svg(
      "text",
      { x: middle.toFixed(1), y: (bottom + 34).toFixed(1), "text-anchor": "middle", fill: INK, "font-size": 12 },
      this.axes,
    ).textContent = "x, forward [mm]";
  }

  private drawS(place: PanelPlace, window: Box, scale: number): void {
    for (const { value, label } of linearTicks([window.y0, window.y1], Math.max(4, place.height / 45))) {
      const y = place.y + (window.y1 - value) * scale;
      svg("path", { d: `M${place.x.toFixed(1)} ${y.toFixed(1)}h-5`, stroke: AXIS, "shape-rendering": "crispEdges" }, this.axes);
      if (place.labelS)
        svg("text", { x: (place.x - 8).toFixed(1), y: (y + 4).toFixed(1), "text-anchor": "end" }, this.axes).textContent = label;
    }
    if (!place.labelS) return;
    const middle = place.y + place.height / 2;
    const turn = `translate(${(place.x - 38).toFixed(1)} ${middle.toFixed(1)}) rotate(-90)`;
    svg("text", { transform: turn, "text-anchor": "middle", fill: INK, "font-size": 12 }, this.axes).textContent = "s [mm]";
  }

  /** Shows what changes from step to step. */
  fill(content: PanelContent, width: number): void {
    for (const { name, path } of this.lines) put(path, "d", content[name]);
    put(this.slip, "d", content.slip);
    for (const mark of this.marks) put(mark, "d", content.mark);
    if (this.title.dataset["full"] !== content.title || this.titleWidth !== width) {
      this.title.dataset["full"] = content.title;
      this.titleWidth = width;
      say(this.title, fitted(content.title, width));
    }
    say(this.note, content.note);
    show(this.origin, content.note === "");
    show(this.axes, textWidth(content.note, "13px system-ui, sans-serif") < this.inside); // else the note would lie on their numbers
  }
}

/** Transformation from mm of the picture to pixels within a panel. */
export function toPixels(place: PanelPlace, window: Box, scale: number): ToPixels {
  return { x: place.x - window.x0 * scale, y: place.y + window.y1 * scale, scale };
}

/** Which panel a pixel is in, and where [mm]. */
export function locate(layout: Layout, window: Box, px: number, py: number): { panel: number; x: number; s: number } | null {
  const panel = layout.panels.findIndex((p) => px >= p.x && px <= p.x + p.width && py >= p.y && py <= p.y + p.height);
  const place = layout.panels[panel];
  if (!place) return null;
  return { panel, x: window.x0 + (px - place.x) / layout.scale, s: window.y1 - (py - place.y) / layout.scale };
}
