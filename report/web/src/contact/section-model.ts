// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { seriesColour, seriesDash } from "../colours";
import type { FieldInfo } from "../data";
import type { Options } from "./controls";
import { centre } from "./csv";
import { FRICTION_BOUND, TRACTION, type Box } from "./fields";
import type { Model, PanelModel } from "./model";
import { elementOf, type Found } from "./pick";
import { sectionOf, type Curve } from "./section";
import type { CurveLook, SectionContent } from "./section-charts";
import { colourRange, union, type Range } from "./scales";
import type { Style } from "./style";
import { titled } from "./text";

/** What the section charts show at a step. */
export interface Sections {
  looks: CurveLook[];
  contents: SectionContent[];
  range: Range;
  title: string;
}

/** Whether sections show pressure, traction and friction bound together: of one set, for the fields that these belong to. */
function isTriple(model: Model, options: Options, fields: readonly FieldInfo[]): boolean {
  const has = (name: string): boolean => fields.some((field) => field.name === name);
  return (
    options.shown.size === 1 &&
    has("pressure") &&
    has("traction_x") &&
    has("traction_s") &&
    /^(pressure|traction|friction|state)/.test(options.field) &&
    model.sets.length > 0
  );
}

function curve(found: Found | null, along: "x" | "s", name: string, field: string, blobs: string[]): Curve | null {
  const section = found && sectionOf(found.item, along, found.ix, found.iy, field, blobs);
  return section && { name, ...section };
}

export function sectionsOf(
  model: Model,
  options: Options,
  style: Style,
  fields: readonly FieldInfo[],
  panels: readonly PanelModel[],
  frames: readonly number[],
  window: Box,
  place: { x: number; s: number },
): Sections {
  const { blobs } = model.data;
  const found = panels.map((panel) => elementOf(panel, place.x, place.s, blobs));
  const triple = isTriple(model, options, fields);
  const unit = fields.find(({ name }) => name === "pressure")?.unit ?? "";
  const friction = fields.some(({ name }) => name === "friction");
  const wanted = triple
    ? [
        { panel: 0, field: "pressure", name: "pressure" },
        { panel: 0, field: TRACTION, name: "traction, magnitude" },
        ...(friction ? [{ panel: 0, field: FRICTION_BOUND, name: "friction bound μp" }] : []),
      ]
    : panels.map(({ name }, panel) => ({ panel, field: style.field.name, name: model.sets.length > 1 ? name : style.field.label }));
  const looks = wanted.map(({ name }, k) => ({ name, colour: seriesColour(k), dash: seriesDash(k) }));
  let range = style.colouring.range;
  if (style.colouring.states) range = { low: 0, high: 3 };
  if (triple)
    range = colourRange(
      wanted.reduce((sum, { field }) => union(sum, model.range(field, frames)), { low: 0, high: 0 }),
      "sequential",
    );
  const at = found.find((f) => f !== null);
  const [x, s] = at ? centre(at.item, at.ix, at.iy) : [place.x, place.s];
  const curves = (along: "x" | "s"): Curve[] =>
    wanted.map(({ panel, field, name }) => curve(found[panel] ?? null, along, name, field, blobs) ?? { name, at: [], values: [] });
  const said = (v: number): string => v.toFixed(2).replace("-", "−");
  return {
    looks,
    range,
    title: triple ? titled("Pressure, traction", unit) : titled(style.field.label, style.field.unit),
    contents: [
      {
        title: `Along x at s = ${said(s)} mm`,
        axis: "x, forward [mm]",
        domain: { low: window.x0, high: window.x1 },
        at: x,
        curves: curves("x"),
      },
      { title: `Along s at x = ${said(x)} mm`, axis: "s [mm]", domain: { low: window.y0, high: window.y1 }, at: s, curves: curves("s") },
    ],
  };
}
