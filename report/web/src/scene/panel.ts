// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { presets, type BodyStyle, type ViewName } from "./orbit";
import type { FieldInfo } from "../data";

/** What the reader chose to see. */
export interface Options {
  field: string;
  sameScale: boolean;
  wheel: BodyStyle;
  rail: BodyStyle;
  arrows: boolean;
  mesh: boolean;
  section: boolean;
  deviation: boolean;
  exaggeration: number;
}

export interface Offered {
  fields: readonly FieldInfo[];
  wheel: boolean;
  rail: boolean;
  arrows: boolean;
  deviation: boolean;
}

export interface Panel {
  element: HTMLElement;
  /** Shows the options as they are now. */
  refresh(view: ViewName | null): void;
}

function element<K extends keyof HTMLElementTagNameMap>(tag: K, className: string, text = ""): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text) made.textContent = text;
  return made;
}

/** A panel that is being made: its row of views, and options that call `changed` when the reader sets them. */
export interface PanelMaker extends Panel {
  choice: (name: string, label: string, entries: readonly (readonly [string, string])[], get: () => string, set: (value: string) => void) => void;
  tick: (name: string, label: string, title: string, get: () => boolean, set: (value: boolean) => void) => void;
}

export interface ViewButton {
  name: ViewName;
  label: string;
  title: string;
}

export function startPanel(buttons: readonly ViewButton[], changed: () => void, view: (name: ViewName) => void, fullScreen: () => void): PanelMaker {
  const bar = element("div", "scene-bar");
  const refreshers: ((view: ViewName | null) => void)[] = [];

  const views = element("div", "scene-views");
  views.setAttribute("role", "group");
  views.setAttribute("aria-label", "View");
  for (const { name, label, title } of buttons) {
    const button = element("button", "", label);
    button.type = "button";
    button.title = `${title} (key ${presets.findIndex((preset) => preset.name === name) + 1})`;
    button.dataset["view"] = name;
    button.addEventListener("click", () => view(name));
    refreshers.push((current) => button.setAttribute("aria-pressed", String(current === name)));
    views.append(button);
  }
  const large = element("button", "scene-large", "Full screen");
  large.type = "button";
  large.addEventListener("click", fullScreen);
  const row = element("div", "scene-row");
  row.append(views);
  if (document.fullscreenEnabled) row.append(large);
  bar.append(row);

  const more = element("details", "scene-options");
  more.append(element("summary", "", "Display"));
  const list = element("div", "scene-row");
  more.append(list);
  more.open = window.matchMedia("(min-width: 700px)").matches;
  bar.append(more);

  const choice: PanelMaker["choice"] = (name, label, entries, get, set) => {
    const frame = element("label", "scene-choice", `${label} `);
    const select = element("select", "");
    select.name = name;
    for (const [value, text] of entries) {
      const option = element("option", "", text);
      option.value = value;
      select.append(option);
    }
    select.addEventListener("change", () => {
      set(select.value);
      changed();
    });
    refreshers.push(() => (select.value = get()));
    frame.append(select);
    list.append(frame);
  };
  const tick: PanelMaker["tick"] = (name, label, title, get, set) => {
    const frame = element("label", "scene-tick");
    const box = element("input", "");
    box.type = "checkbox";
    box.name = name;
    box.addEventListener("change", () => {
      set(box.checked);
      changed();
    });
    refreshers.push(() => (box.checked = get()));
    frame.title = title;
    frame.append(box, ` ${label}`);
    list.append(frame);
  };
  return { element: bar, refresh: (current) => refreshers.forEach((refresh) => refresh(current)), choice, tick };
}

/** The row of views and the options, which change `options` and then call `changed`. */
export function makePanel(options: Options, offered: Offered, changed: () => void, view: (name: ViewName) => void, fullScreen: () => void): Panel {
  const panel = startPanel(presets.filter((preset) => preset.name !== "whole" || offered.wheel), changed, view, fullScreen);
  const { choice, tick } = panel;
  const styles = [
    ["solid", "solid"],
    ["cut", "cut away"],
    ["glass", "see-through"],
    ["hidden", "hidden"],
  ] as const;
  if (offered.fields.length > 0) {
    choice("field", "Patch", offered.fields.map((field) => [field.name, field.label] as const), () => options.field, (v) => (options.field = v));
    choice(
      "scale",
      "Scale",
      [
        ["all", "of all steps"],
        ["step", "of this step"],
      ],
      () => (options.sameScale ? "all" : "step"),
      (v) => (options.sameScale = v === "all"),
    );
  }
  if (offered.wheel) choice("wheel", "Wheel", styles, () => options.wheel, (v) => (options.wheel = v as BodyStyle));
  if (offered.rail) choice("rail", "Rail", styles, () => options.rail, (v) => (options.rail = v as BodyStyle));
  if (offered.arrows) tick("arrows", "Tractions", "Arrows of the tractions on the rail", () => options.arrows, (v) => (options.arrows = v));
  tick("section", "Section", "The bodies' sections across the track at the contact", () => options.section, (v) => (options.section = v));
  tick("mesh", "Mesh", "Lines of the surfaces' points and edges of the elements", () => options.mesh, (v) => (options.mesh = v));
  if (offered.deviation) {
    tick("deviation", "Deviation", "Surfaces coloured by their deviation from the mean section", () => options.deviation, (v) => (options.deviation = v));
    const factors = [1, 10, 50].map((factor) => [String(factor), `× ${factor}`] as const);
    choice("exaggeration", "Deviation shown", factors, () => String(options.exaggeration), (v) => (options.exaggeration = Number(v)));
  }
  return panel;
}
