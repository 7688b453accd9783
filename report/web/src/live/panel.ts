// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { LiveData } from "../data";
import { labelWithUnit } from "../numbers";
import { controls, CREEPAGE, ROLLING, rollings, shapeKey, shownValue, type Changes } from "./state";

// The fields of a page that solves.

export function make<K extends keyof HTMLElementTagNameMap>(tag: K, className: string, text = ""): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  if (className) element.className = className;
  if (text) element.textContent = text;
  return element;
}

export function button(text: string, name: string, hint: string, pressed: () => void): HTMLButtonElement {
  const element = make("button", "", text);
  element.type = "button";
  element.title = hint;
  element.dataset["control"] = name;
  element.addEventListener("click", pressed);
  return element;
}

export interface Target {
  change(key: string, value: string): void;
  file(body: string, file: File): void;
}

/** What `treadmark check` says of a profile. */
export interface Check {
  body: string;
  facts: [string, string][];
  notes: string[];
  warnings: [string, string][];
}

export class Panel {
  readonly element = make("div", "live-panel");
  private readonly refreshes: ((changes: Changes, numbers: Readonly<Record<string, number>>, own: string) => void)[] = [];
  private readonly evidence = { wheel: make("details", "live-evidence"), rail: make("details", "live-evidence") };
  /** By body and name. */
  private readonly checks = new Map<string, Check>();

  constructor(
    live: LiveData,
    private readonly target: Target,
  ) {
    for (const body of ["wheel", "rail"] as const) this.element.append(this.shape(body, live.profiles[body]));
    const grid = make("div", "live-fields");
    grid.append(this.rolling());
    for (const control of controls) grid.append(this.number(control));
    this.element.append(grid);
  }

  /** Shows what holds. `own`: the key of the control that the reader is at, whose text stays as it is typed. */
  refresh(changes: Changes, numbers: Readonly<Record<string, number>>, own: string): void {
    for (const one of this.refreshes) one(changes, numbers, own);
  }

  /** How a file was read, to be shown while it is used. */
  learn(body: "wheel" | "rail", name: string, check: Check): void {
    this.checks.set(`${body} ${name}`, check);
  }

  private show(body: "wheel" | "rail", name: string): void {
    const box = this.evidence[body];
    const check = this.checks.get(`${body} ${name}`);
    box.hidden = !check;
    if (!check || box.dataset["name"] === name) return;
    box.dataset["name"] = name;
    box.replaceChildren();
    box.open = true;
    const facts = make("dl", "facts");
    facts.tabIndex = 0;  // it may scroll
    for (const [term, text] of check.facts) {
      const div = make("div", "");
      div.append(make("dt", "", term), make("dd", "", text));
      facts.append(div);
    }
    box.append(make("summary", "", `${name}, as it is read`), facts);
    for (const text of check.notes) box.append(make("p", "view-note", text));
    for (const [kind, text] of check.warnings) box.append(make("div", "banner warning", `${kind}: ${text}`));
  }

  private shape(body: "wheel" | "rail", names: readonly string[]): HTMLElement {
    const box = make("fieldset", "live-shape");
    box.append(make("legend", "", body === "wheel" ? "Wheel" : "Rail"));
    const select = make("select", "");
    select.dataset["control"] = body;
    select.setAttribute("aria-label", `Profile of the ${body}`);
    select.add(new Option("as the case says", ""));
    for (const name of names) select.add(new Option(name, name));
    const own = new Option("", "file");
    own.hidden = true;
    select.add(own);
    select.addEventListener("change", () => {
      if (select.value !== "file") this.target.change(shapeKey(body, "standard"), select.value);
    });
    const input = make("input", "");
    input.type = "file";
    input.dataset["control"] = `${body}-file`;
    input.setAttribute("aria-label", `File with a profile of the ${body}`);
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) this.target.file(body, file);
      input.value = "";
    });
    for (const name of ["dragover", "drop"] as const)
      box.addEventListener(name, (event) => {
        event.preventDefault();
        event.stopPropagation();
        const file = event.dataTransfer?.files[0];
        if (name === "drop" && file) this.target.file(body, file);
      });
    const evidence = this.evidence[body];
    evidence.hidden = true;
    box.append(select, input, evidence);
    this.refreshes.push((changes) => {
      const file = changes.get(shapeKey(body, "file"));
      own.hidden = file === undefined;
      own.text = file ?? "";
      select.value = file === undefined ? (changes.get(shapeKey(body, "standard")) ?? "") : "file";
      this.show(body, file ?? "");
    });
    return box;
  }

  private rolling(): HTMLElement {
    const label = make("label", "live-field");
    const select = make("select", "");
    select.dataset["control"] = "rolling";
    for (const [value, text] of rollings) select.add(new Option(text, value));
    select.addEventListener("change", () => {
      if (select.value === CREEPAGE) this.target.change(CREEPAGE, "0");
      else this.target.change(ROLLING, select.value);
    });
    label.append(make("span", "live-label", "The wheel rolls"), select);
    this.refreshes.push((changes) => (select.value = changes.has(CREEPAGE) ? CREEPAGE : (changes.get(ROLLING) ?? "")));
    return label;
  }

  private number(control: (typeof controls)[number]): HTMLElement {
    const { key, label: name, unit, low, high, step, perShown } = control;
    const box = make("div", "live-field");
    const text = make("span", "live-label", name);
    const field = make("input", "");
    const slider = make("input", "");
    field.type = "number";
    field.step = "any";
    slider.type = "range";
    [slider.min, slider.max, slider.step] = [low, high, step].map(String) as [string, string, string];
    field.dataset["control"] = key;
    slider.dataset["slider"] = key;
    field.setAttribute("aria-label", labelWithUnit(name, unit));
    slider.setAttribute("aria-label", `${labelWithUnit(name, unit)}, slider`);
    const told = (from: HTMLInputElement): void => {
      const value = from.valueAsNumber;
      field.setAttribute("aria-invalid", String(!Number.isFinite(value)));
      if (Number.isFinite(value)) this.target.change(key, String(Number((value * perShown).toPrecision(12))));
      else this.target.change(key, "not a number");
    };
    field.addEventListener("input", () => told(field));
    slider.addEventListener("input", () => told(slider));
    box.append(text, field, make("span", "unit", unit), slider);
    this.refreshes.push((changes, numbers, own) => {
      box.hidden = key === CREEPAGE && !changes.has(CREEPAGE);
      const value = shownValue(control, changes, numbers);
      const kept = own === key ? document.activeElement : null;
      if (kept !== field) {
        const text = Number.isFinite(value) ? String(Number(value.toPrecision(8))) : "";
        if (field.value !== text) field.value = text;  // what is written anew is laid out anew
        if (field.getAttribute("aria-invalid") === "true") field.setAttribute("aria-invalid", "false");
      }
      if (kept !== slider && Number.isFinite(value)) slider.value = String(value);
    });
    return box;
  }
}
