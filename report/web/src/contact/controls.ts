// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Choice } from "./place";

/** What the reader chose. */
export interface Options {
  field: string;
  choice: Choice;
  scale: "all" | "step" | "own";
  own: { low: number; high: number };
  window: "all" | "step" | "grid";
  isolines: boolean;
  division: boolean;
  slip: boolean;
  arrows: boolean;
  other: boolean;
  difference: boolean;
  /** Sets shown, by their place in the view. */
  shown: Set<number>;
}

export interface Offer {
  fields: { name: string; label: string }[];
  /** Other than the main patch; empty: each frame has one patch at most. */
  choices: { label: string; choice: Choice }[];
  /** Whether there is a timeline to speak of. */
  steps: boolean;
  tractions: boolean;
  slip: boolean;
  /** What the outline to compare with is; null: nothing. */
  other: string | null;
  sets: string[];
}

function labelled(text: string, control: HTMLElement, after = false): HTMLLabelElement {
  const label = document.createElement("label");
  const span = document.createElement("span");
  span.textContent = text;
  label.append(...(after ? [control, span] : [span, control]));
  return label;
}

function select(name: string, options: readonly [string, string][], value: string, changed: (value: string) => void): HTMLLabelElement {
  const element = document.createElement("select");
  element.dataset["control"] = name.toLowerCase();
  for (const [key, text] of options) element.add(new Option(text, key, false, key === value));
  element.addEventListener("change", () => changed(element.value));
  return labelled(name, element);
}

function check(name: string, control: string, value: boolean, changed: (value: boolean) => void): HTMLLabelElement {
  const element = document.createElement("input");
  element.type = "checkbox";
  element.checked = value;
  element.dataset["control"] = control;
  element.addEventListener("change", () => changed(element.checked));
  return labelled(name, element, true);
}

function limit(name: string, value: number, changed: (value: number) => void): HTMLInputElement {
  const element = document.createElement("input");
  element.type = "number";
  element.step = "any";
  element.setAttribute("aria-label", name);
  element.value = String(value);
  element.addEventListener("input", () => {
    if (Number.isFinite(element.valueAsNumber)) changed(element.valueAsNumber);
  });
  return element;
}

function row(...children: HTMLElement[]): HTMLDivElement {
  const div = document.createElement("div");
  div.className = "controls";
  div.append(...children);
  return div;
}

export function button(text: string, control: string, hint: string, pressed: () => void): HTMLButtonElement {
  const element = document.createElement("button");
  element.type = "button";
  element.textContent = text;
  element.title = hint;
  element.dataset["control"] = control;
  element.addEventListener("click", pressed);
  return element;
}

/** The controls above the pictures. `changed` is called after every change of `options`; `limits` gives the limits of the colours now. */
export function makeControls(
  options: Options,
  offer: Offer,
  changed: () => void,
  limits: () => { low: number; high: number },
): HTMLElement {
  const root = document.createElement("div");
  root.className = "contact-controls";
  const low = limit("Lower limit of the colours", 0, (v) => ((options.own.low = v), changed()));
  const high = limit("Upper limit of the colours", 1, (v) => ((options.own.high = v), changed()));
  const own = document.createElement("span");
  own.className = "contact-limits";
  own.append(low, "to", high);
  own.hidden = true;
  const scales: [string, string][] = offer.steps
    ? [
        ["all", "same in all steps"],
        ["step", "this step"],
        ["own", "own limits"],
      ]
    : [
        ["all", "all values"],
        ["own", "own limits"],
      ];
  const windows: [string, string][] = offer.steps
    ? [
        ["all", "same in all steps"],
        ["step", "this step"],
        ["grid", "whole grid"],
      ]
    : [
        ["all", "contact"],
        ["grid", "whole grid"],
      ];
  const first: HTMLElement[] = [
    select(
      "Field",
      offer.fields.map(({ name, label }) => [name, label]),
      options.field,
      (v) => {
        options.field = v;
        changed();
        const now = limits();
        options.own = { ...now };
        low.value = String(now.low);
        high.value = String(now.high);
      },
    ),
  ];
  if (offer.choices.length > 0) {
    const all = offer.choices;
    first.push(
      select(
        "Patch",
        all.map(({ label }, k) => [String(k), label]),
        "0",
        (v) => ((options.choice = all[Number(v)]!.choice), changed()),
      ),
    );
  }
  first.push(
    select("Colours", scales, options.scale, (v) => {
      if (v === "own") {
        options.own = { ...limits() };
        low.value = String(options.own.low);
        high.value = String(options.own.high);
      }
      options.scale = v as Options["scale"];
      own.hidden = v !== "own";
      changed();
    }),
    own,
    select("Window", windows, options.window, (v) => ((options.window = v as Options["window"]), changed())),
  );
  const second = [check("Isolines", "isolines", options.isolines, (v) => ((options.isolines = v), changed()))];
  second.push(check("Adhesion and slip", "division", options.division, (v) => ((options.division = v), changed())));
  if (offer.slip) second.push(check("Slip hatched", "slip", options.slip, (v) => ((options.slip = v), changed())));
  if (offer.tractions) second.push(check("Tractions", "arrows", options.arrows, (v) => ((options.arrows = v), changed())));
  if (offer.other !== null)
    second.push(check(`Outline of ${offer.other}`, "other", options.other, (v) => ((options.other = v), changed())));
  const choices = row(...first);
  choices.classList.add("contact-choices");
  root.append(choices, row(...second));
  if (offer.sets.length > 1) root.append(setsRow(options, offer, changed));
  return root;
}

function setsRow(options: Options, offer: Offer, changed: () => void): HTMLElement {
  const boxes = offer.sets.map((name, k) =>
    check(name, `set-${k}`, options.shown.has(k), (on) => {
      if (on) options.shown.add(k);
      else options.shown.delete(k);
      changed();
    }),
  );
  const group = document.createElement("fieldset");
  group.className = "controls contact-sets";
  const legend = document.createElement("legend");
  legend.textContent = "Shown";
  group.append(legend, ...boxes);
  const wrap = document.createElement("div");
  wrap.append(
    group,
    row(check(`Difference to ${offer.sets[0]}`, "difference", options.difference, (v) => ((options.difference = v), changed()))),
  );
  return wrap;
}
