// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Timeline } from "./data";
import { decode } from "./packed";
import type { Store } from "./store";
import { stepNamer } from "./timeline";

/** Width of pictures on paper [px]: what A4 leaves within margins and frames. */
export const PAPER_WIDTH = 650;

/** Height of a page of Letter within margins [px]; A4 has more. */
export const PAPER_HEIGHT = 940;

/** So many steps at most: a page each, or more. */
export const MOST_ON_PAPER = 200;

/** Steps that differ: of a history those at which there is another frame of contact. */
export function allSteps(timeline: Timeline, blobs: string[]): number[] {
  const every = Array.from({ length: timeline.count }, (_, k) => k);
  if (!timeline.frames) return every;
  const frames = decode(timeline.frames, blobs);
  const known = new Set<number>();
  return every.filter((k) => {
    const frame = frames[k] ?? NaN;
    if (Number.isNaN(frame) || known.has(frame)) return false;
    known.add(frame);
    return true;
  });
}

/** Steps from 0 of a list from 1, as "1-5, 8"; "" none, "all" those of `all`. What is wrong is said. */
export function parseSteps(text: string, count: number, all: () => number[]): number[] | string {
  const plain = text.trim().toLowerCase();
  const steps = new Set<number>();
  if (plain === "all") for (const step of all()) steps.add(step);
  else if (plain !== "")
    for (const part of plain.split(/[,;]/)) {
      const match = /^\s*(\d+)\s*(?:[-–]\s*(\d+)\s*)?$/.exec(part);
      if (!match) return `“${part.trim()}” is no number and no range such as 1-5`;
      const first = Number(match[1]);
      const last = Number(match[2] ?? match[1]);
      if (first < 1 || last > count || first > last) return `“${part.trim()}” is not within 1 to ${count}`;
      for (let k = first; k <= last && steps.size <= MOST_ON_PAPER; ++k) steps.add(k - 1);
    }
  if (steps.size > MOST_ON_PAPER) return `at most ${MOST_ON_PAPER} at once`;
  return [...steps].sort((a, b) => a - b);
}

/** A copy of an element as it looks just now, whose ids are not those of the original. */
export function copyOf(element: HTMLElement | SVGElement, suffix: string): Element {
  const copy = element.cloneNode(true) as Element;
  const painted = copy.querySelectorAll("canvas");
  element.querySelectorAll("canvas").forEach((from, k) => {
    const to = painted[k];
    if (to && from.width > 0 && from.height > 0) to.getContext("2d")?.drawImage(from, 0, 0);
  });
  for (const one of [copy, ...copy.querySelectorAll("*")])
    for (const { name, value } of [...one.attributes])
      if (name === "id") one.id = `${value}-${suffix}`;
      else if (value.startsWith("url(#")) one.setAttribute(name, value.replace(")", `-${suffix})`));
  return copy;
}

/** On paper a figure shows the chosen steps one below the other; `pictures` are of the step that the store then has. */
export function onPaper(figure: HTMLElement, store: Store, pictures: (suffix: string) => Element[]): void {
  const { timeline, blobs } = store.data;
  if (!timeline) return;
  const nameOf = stepNamer(timeline, blobs);
  const list = document.createElement("div");
  list.className = "paper-steps";
  window.addEventListener("beforeprint", () => {
    list.replaceChildren();
    for (const step of store.paper) {
      const box = document.createElement("div");
      const name = document.createElement("p");
      box.className = "paper-step";
      name.className = "paper-name";
      name.textContent = `${timeline.label} ${step + 1} of ${timeline.count}: ${nameOf(step)}`;
      box.append(name, ...store.at(step, () => pictures(`paper-${step}`)));
      list.append(box);
    }
    if (store.paper.length === 0) return;
    figure.append(list);
    figure.classList.add("on-paper");
  });
  window.addEventListener("afterprint", () => {
    list.remove();
    list.replaceChildren();
    figure.classList.remove("on-paper");
  });
}

/** A tick for each section that shall come on paper; with how many pages that may be. */
function sectionTicks(): HTMLElement | null {
  const sections = [...document.querySelectorAll<HTMLElement>("main > section")];
  if (sections.length < 2) return null;
  const box = document.createElement("fieldset");
  const legend = document.createElement("legend");
  const count = (): void => {
    const high = sections.reduce((sum, one) => sum + (one.classList.contains("not-printed") ? 0 : one.offsetHeight), 0);
    legend.textContent = `Sections, about ${Math.max(1, Math.ceil((0.85 * high) / PAPER_HEIGHT))} pages`;
  };
  box.append(legend);
  for (const section of sections) {
    const label = document.createElement("label");
    const tick = document.createElement("input");
    tick.type = "checkbox";
    tick.checked = true;
    tick.addEventListener("change", () => {
      section.classList.toggle("not-printed", !tick.checked);
      count();
    });
    label.append(tick, section.querySelector("h2")?.textContent ?? section.id);
    box.append(label);
  }
  box.addEventListener("focusin", count);
  count();
  return box;
}

/** Prints, and chooses the sections and the steps that come on paper. */
export function mountPrint(toolbar: HTMLElement, store: Store): void {
  const { timeline, blobs } = store.data;
  const menu = document.createElement("details");
  menu.className = "print-menu";
  const summary = document.createElement("summary");
  summary.textContent = "Print";
  const form = document.createElement("form");
  const input = document.createElement("input");
  const note = document.createElement("p");
  note.className = "print-note";
  note.setAttribute("role", "status");
  const button = document.createElement("button");
  button.textContent = "Print";
  const take = (): boolean => {
    if (!timeline) return true;
    const steps = parseSteps(input.value, timeline.count, () => allSteps(timeline, blobs));
    const wrong = typeof steps === "string";
    store.paper = wrong ? [] : steps;
    note.textContent = wrong ? steps : "";
    input.setAttribute("aria-invalid", String(wrong));
    return !wrong;
  };
  if (timeline && timeline.count > 1) {
    const label = document.createElement("label");
    input.placeholder = "the one shown";
    input.size = 14;
    input.title = `As 1-5, 8 or all; empty: the ${timeline.label} that is shown`;
    label.append(`Which ${timeline.label}s, as 1-5, 8 or all`, input);
    input.addEventListener("input", take);
    form.append(label);
  }
  const ticks = sectionTicks();
  if (ticks) form.append(ticks);
  form.append(button, note);
  menu.append(summary, form);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    if (take()) window.print();
  });
  toolbar.prepend(menu);
}
