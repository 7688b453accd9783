// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { svg } from "./svg";

/** The elements of a view that stay: pictures, what is beside them, sections. */
export interface Skeleton {
  root: HTMLElement;
  status: HTMLElement;
  left: HTMLElement;
  picture: HTMLElement;
  canvas: HTMLCanvasElement;
  drawing: SVGSVGElement;
  /** Colour bars and legend. */
  furniture: SVGGElement;
  tip: HTMLElement;
  /** Says what keys picked. */
  live: HTMLElement;
  side: HTMLElement;
  sections: HTMLElement;
}

function add<K extends keyof HTMLElementTagNameMap>(name: K, className: string, parent: HTMLElement): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  made.className = className;
  parent.append(made);
  return made;
}

export function makeSkeleton(figure: HTMLElement, controls: HTMLElement, id: string, many: boolean): Skeleton {
  const plot = figure.querySelector<HTMLElement>(".plot") ?? figure;
  plot.replaceChildren();
  const root = add("div", many ? "contact contact-many" : "contact", plot);
  root.append(controls);
  const status = add("p", "contact-status", root);
  const body = add("div", "contact-body", root);
  const left = add("div", "contact-left", body);
  const picture = add("div", "contact-picture", left);
  picture.tabIndex = 0;
  picture.setAttribute("role", "application");
  picture.setAttribute("aria-roledescription", "contact patch");
  picture.setAttribute("aria-label", "Contact patch: arrow keys move the picked element, Home picks the peak, Page keys step");
  const canvas = add("canvas", "", picture);
  const drawing = svg("svg", { "font-family": "var(--sans)", "font-size": 12, "aria-hidden": "true" }, picture);
  hatch(drawing, id);
  const tip = add("div", "readout contact-tip", picture);
  tip.hidden = true;
  const live = add("output", "visually-hidden", left);
  const side = add("div", "contact-side", body);
  const sections = add("div", "contact-sections", root);
  return { root, status, left, picture, canvas, drawing, furniture: svg("g", {}, drawing), tip, live, side, sections };
}

/** Thin light and dark lines side by side, to be seen on any colour. */
function hatch(drawing: SVGSVGElement, id: string): void {
  const pattern = svg(
    "pattern",
    { id: `${id}-hatch`, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
    svg("defs", {}, drawing),
  );
  svg("rect", { x: 0, y: 0, width: 1, height: 6, fill: "#ffffff", "fill-opacity": 0.75 }, pattern);
  svg("rect", { x: 1, y: 0, width: 0.8, height: 6, fill: "#10151a", "fill-opacity": 0.6 }, pattern);
}
