// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { learnFields } from "./contact/fields";
import type { ReportData } from "./data";
import { decode } from "./packed";

export type Theme = "light" | "dark";

/** The picked element of a patch, shared by the contact view and the scene. */
export interface PickedPoint {
  set: number;
  patch: number;
  ix: number;
  iy: number;
}

/** Calls its listeners at most once a frame of the browser, with the state as it is then. */
class Signal<T> {
  private readonly listeners = new Set<(value: T) => void>();
  private pending = false;

  constructor(private readonly current: () => T) {}

  on(listener: (value: T) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  raise(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      const value = this.current();
      for (const listener of [...this.listeners]) listener(value);
    });
  }
}

/** What the views share: the data, the current step, the axis of linked charts, the picked element, the theme. */
export class Store {
  readonly data: ReportData;
  /** Steps that come on paper; none: what is shown. */
  paper: number[] = [];
  private currentStep: number;
  private currentAxis = 0;
  private currentPoint: PickedPoint | null = null;
  private currentTheme: Theme = "light";
  private readonly steps = new Signal(() => this.currentStep);
  private readonly axes = new Signal(() => this.currentAxis);
  private readonly points = new Signal(() => this.currentPoint);
  private readonly themes = new Signal(() => this.currentTheme);
  private readonly renewals = new Signal(() => this.data);

  constructor(data: ReportData) {
    this.data = data;
    this.currentStep = data.timeline?.start ?? 0;
    learnFields(data.fields);
  }

  get step(): number {
    return this.currentStep;
  }

  /** Rounded and clamped to the timeline; nothing happens where there is none. */
  setStep(step: number): void {
    const count = this.data.timeline?.count ?? 0;
    if (count === 0 || !Number.isFinite(step)) return;
    const clamped = Math.min(count - 1, Math.max(0, Math.round(step)));
    if (clamped === this.currentStep) return;
    this.currentStep = clamped;
    this.steps.raise();
  }

  /** Does something as if at another step; nobody is told. */
  at<T>(step: number, task: () => T): T {
    const now = this.currentStep;
    this.currentStep = step;
    try {
      return task();
    } finally {
      this.currentStep = now;
    }
  }

  onStep(listener: (step: number) => void): () => void {
    return this.steps.on(listener);
  }

  get axis(): number {
    return this.currentAxis;
  }

  setAxis(axis: number): void {
    const count = this.data.timeline?.axes.length ?? 0;
    if (axis === this.currentAxis || !Number.isInteger(axis) || axis < 0 || axis >= count) return;
    this.currentAxis = axis;
    this.axes.raise();
  }

  onAxis(listener: (axis: number) => void): () => void {
    return this.axes.on(listener);
  }

  get point(): PickedPoint | null {
    return this.currentPoint;
  }

  setPoint(point: PickedPoint | null): void {
    this.currentPoint = point;
    this.points.raise();
  }

  onPoint(listener: (point: PickedPoint | null) => void): () => void {
    return this.points.on(listener);
  }

  get theme(): Theme {
    return this.currentTheme;
  }

  setTheme(theme: Theme): void {
    if (theme === this.currentTheme) return;
    this.currentTheme = theme;
    this.themes.raise();
  }

  onTheme(listener: (theme: Theme) => void): () => void {
    return this.themes.on(listener);
  }

  /** Tells that the data are others: of pages that solve. */
  renew(): void {
    this.renewals.raise();
  }

  onRenewal(listener: () => void): () => void {
    return this.renewals.on(listener);
  }

  /** Frame of a step (the current one) in every set; null = none. */
  frame(step: number = this.currentStep): number | null {
    const frames = this.data.timeline?.frames;
    if (!frames) return null;
    const frame = decode(frames, this.data.blobs)[step];
    return frame === undefined || Number.isNaN(frame) ? null : frame;
  }
}
