// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Timeline } from "./data";
import { decimalsFor, fixed, withUnit } from "./numbers";
import { decode } from "./packed";
import type { Store } from "./store";
import { el } from "./svg";

/** Names of the steps: as given, or made from the first axis: "t = 0.125 s". */
export function stepNamer(timeline: Timeline, blobs: string[]): (step: number) => string {
  const { names } = timeline;
  if (names) return (step) => names[step] ?? `${timeline.label} ${step + 1}`;
  const axis = timeline.axes[0];
  if (!axis) return (step) => `${timeline.label} ${step + 1}`;
  const values = decode(axis.values, blobs);
  const decimals = decimalsFor(values);
  return (step) => {
    const value = values[step];
    if (value === undefined || Number.isNaN(value)) return `${timeline.label} ${step + 1}`;
    return `${axis.label} = ${axis.labels?.[value] ?? withUnit(fixed(value, decimals), axis.unit)}`;
  };
}

/** Steps a second while playing: short timelines slowly enough to look, long ones within 20 s. */
export function playRate(count: number): number {
  return Math.max(5, count / 20);
}

const icons = {
  play: "M3 1.5v11L13 7Z",
  pause: "M3 2h3v10H3ZM8 2h3v10H8Z",
  previous: "M9.5 2v10L3 7Z",
  next: "M4.5 2v10L11 7Z",
} as const;

function icon(name: keyof typeof icons): SVGSVGElement {
  return el("svg", { viewBox: "0 0 14 14", "aria-hidden": "true" }, el("path", { d: icons[name] }));
}

function button(label: string, name: keyof typeof icons): HTMLButtonElement {
  const element = document.createElement("button");
  element.type = "button";
  element.title = label;
  element.setAttribute("aria-label", label);
  element.append(icon(name));
  return element;
}

/** Plays the timeline once from the current step, from the start if it stands at the end. */
class Player {
  private running = false;

  constructor(
    private readonly store: Store,
    private readonly count: number,
    private readonly changed: (running: boolean) => void,
  ) {}

  toggle(): void {
    if (this.running) this.stop();
    else this.start();
  }

  stop(): void {
    if (!this.running) return;
    this.running = false;
    this.changed(false);
  }

  private start(): void {
    if (this.store.step >= this.count - 1) this.store.setStep(0);
    this.running = true;
    this.changed(true);
    const rate = playRate(this.count);
    let from = this.store.step;
    let since = performance.now();
    let shown = from;
    const advance = (now: number): void => {
      if (!this.running) return;
      // Someone moved the slider: play on from there.
      if (this.store.step !== shown) {
        from = this.store.step;
        since = now;
      }
      shown = Math.min(this.count - 1, from + Math.floor((Math.max(0, now - since) / 1000) * rate));
      this.store.setStep(shown);
      if (shown >= this.count - 1) this.stop();
      else requestAnimationFrame(advance);
    };
    requestAnimationFrame(advance);
  }
}

function axisSelect(timeline: Timeline, store: Store): HTMLElement | null {
  if (timeline.axes.length < 2) return null;
  const label = document.createElement("label");
  label.className = "timeline-axis";
  const text = document.createElement("span");
  text.textContent = "Charts over";
  const select = document.createElement("select");
  select.setAttribute("aria-label", "Axis of the charts");
  timeline.axes.forEach((axis, k) => {
    const option = document.createElement("option");
    option.value = String(k);
    option.textContent = axis.unit ? `${axis.label} [${axis.unit}]` : axis.label;
    select.append(option);
  });
  select.addEventListener("change", () => store.setAxis(Number(select.value)));
  store.onAxis((axis) => (select.value = String(axis)));
  label.append(text, select);
  return label;
}

/** The bar at the foot of the window that chooses the step. */
export function mountTimeline(bar: HTMLElement, store: Store): void {
  const { timeline, blobs } = store.data;
  if (!timeline || timeline.count < 2) return;
  const { count } = timeline;
  const nameOf = stepNamer(timeline, blobs);
  const previous = button(`Previous ${timeline.label}`, "previous");
  const play = button("Play", "play");
  const next = button(`Next ${timeline.label}`, "next");
  const player = new Player(store, count, (running) => {
    play.replaceChildren(icon(running ? "pause" : "play"));
    play.title = running ? "Pause" : "Play";
    play.setAttribute("aria-label", play.title);
  });
  const buttons = document.createElement("div");
  buttons.className = "timeline-buttons";
  buttons.append(previous, play, next);

  const slider = document.createElement("input");
  slider.type = "range";
  slider.className = "timeline-slider";
  slider.min = "0";
  slider.max = String(count - 1);
  slider.step = "1";
  slider.setAttribute("aria-label", `${timeline.label} shown`);

  const name = document.createElement("div");
  name.className = "timeline-name";
  const shownName = document.createElement("span");
  shownName.className = "name";
  const shownPlace = document.createElement("span");
  shownPlace.className = "of";
  name.append(shownName, shownPlace);

  const show = (step: number): void => {
    slider.value = String(step);
    shownName.textContent = shownName.title = nameOf(step);
    shownPlace.textContent = `${timeline.label} ${step + 1} of ${count}`;
    slider.setAttribute("aria-valuetext", `${nameOf(step)}, ${step + 1} of ${count}`);
    previous.disabled = step === 0;
    next.disabled = step === count - 1;
  };
  slider.addEventListener("input", () => store.setStep(Number(slider.value)));
  previous.addEventListener("click", () => {
    player.stop();
    store.setStep(store.step - 1);
  });
  next.addEventListener("click", () => {
    player.stop();
    store.setStep(store.step + 1);
  });
  play.addEventListener("click", () => player.toggle());
  const moves: Record<string, () => number> = {
    ArrowLeft: () => store.step - 1,
    ArrowRight: () => store.step + 1,
    Home: () => 0,
    End: () => count - 1,
  };
  // From the start, before the reader has gone to anything that has keys of its own.
  document.addEventListener("keydown", (event) => {
    const move = moves[event.key];
    if (!move || event.defaultPrevented || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey || document.activeElement !== document.body) return;
    event.preventDefault();
    player.stop();
    store.setStep(move());
  });
  document.addEventListener("visibilitychange", () => {
    if (document.hidden) player.stop();
  });
  store.onStep(show);

  const row = document.createElement("div");
  row.className = "timeline-row";
  row.append(buttons, slider, name);
  const axis = axisSelect(timeline, store);
  if (axis) row.append(axis);
  bar.setAttribute("role", "group");
  bar.setAttribute("aria-label", "Timeline");
  bar.replaceChildren(row);
  bar.hidden = false;
  document.documentElement.classList.add("has-timeline");
  show(store.step);
}
