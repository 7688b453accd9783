// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { LiveData } from "../data";
import { labelWithUnit } from "../numbers";
import { backendKey, BESIDE, controls, CREEPAGE, ROLLING, rollings, shapeKey, shownValue, type Changes } from "./state";

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
  /** where: "wheel", "rail", either behind BESIDE, or empty: what it is decides. */
  file(where: string, file: File): void;
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
  /** What is solved at the same place to compare with. */
  readonly beside = make("div", "live-panel");
  private readonly refreshes: ((changes: Changes, numbers: Readonly<Record<string, number>>, own: string) => void)[] = [];
  /** By body and name. */
  private readonly checks = new Map<string, Check>();

  constructor(
    private readonly live: LiveData,
    private readonly target: Target,
  ) {
    for (const body of ["wheel", "rail"] as const) {
      this.element.append(this.shape(body));
      this.beside.append(this.shape(body, BESIDE));
    }
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

  private show(box: HTMLDetailsElement, body: "wheel" | "rail", name: string): void {
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

  /** A choice of names; the first one says nothing of the case. */
  private choice(control: string, label: string, nothing: string, names: readonly string[], key: string): HTMLSelectElement {
    const select = make("select", "");
    select.dataset["control"] = control;
    select.setAttribute("aria-label", label);
    select.add(new Option(nothing, ""));
    for (const name of names) select.add(new Option(name, name));
    select.addEventListener("change", () => {
      if (select.value !== "file") this.target.change(key, select.value);
    });
    return select;
  }

  private shape(body: "wheel" | "rail", side = ""): HTMLElement {
    const where = side + body;
    const beside = side === "" ? "" : ", beside";
    const box = make("fieldset", "live-shape");
    box.append(make("legend", "", (body === "wheel" ? "Wheel" : "Rail") + beside));
    const nothing = side === "" ? "as the case says" : "the same";
    const select = this.choice(where, `Profile of the ${body}${beside}`, nothing, this.live.profiles[body], shapeKey(where, "standard"));
    const own = new Option("", "file");
    own.hidden = true;
    select.add(own);
    const input = make("input", "");
    input.type = "file";
    input.dataset["control"] = `${where}-file`;
    input.setAttribute("aria-label", `File with a profile of the ${body}${beside}`);
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) this.target.file(where, file);
      input.value = "";
    });
    for (const name of ["dragover", "drop"] as const)
      box.addEventListener(name, (event) => {
        event.preventDefault();
        event.stopPropagation();
        const file = event.dataTransfer?.files[0];
        if (name === "drop" && file) this.target.file(where, file);
      });
    const evidence = make("details", "live-evidence");
    evidence.hidden = true;
    box.append(select, input);
    const key = backendKey(where);
    const backend = side === "" ? null : this.choice(key, `Representation of the ${body}${beside}`, "in the same representation", this.live.backends, key);
    if (backend) box.append(backend);
    box.append(evidence);
    this.refreshes.push((changes) => {
      const file = changes.get(shapeKey(where, "file"));
      own.hidden = file === undefined;
      own.text = file ?? "";
      select.value = file === undefined ? (changes.get(shapeKey(where, "standard")) ?? "") : "file";
      if (backend) backend.value = changes.get(key) ?? "";
      this.show(evidence, body, file ?? "");
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
