// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { SERIES_COUNT, seriesDash } from "../colours";
import type { Axis, ChartView, Numbers, Series } from "../data";
import { countOf, decode } from "../packed";
import type { Store } from "../store";
import type { Domain } from "./scale";
import { extentOf, padded, withLevels } from "./scale";

/** A series with its numbers, ready to be drawn. */
export interface PlotSeries {
  name: string;
  /** Index of colour and marker. */
  look: number;
  line: boolean;
  points: boolean;
  dash: string;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  texts: string[] | null;
  steps: ArrayLike<number> | null;
  hidden: boolean;
}

export interface PlotPanel {
  label: string;
  unit: string;
  log: boolean;
  leastSpan: number;
  series: PlotSeries[];
  levels: { value: number; label: string }[];
}

export interface Plot {
  x: { label: string; unit: string; log: boolean; labels: string[] | null; values: ArrayLike<number> };
  panels: PlotPanel[];
  toScale: boolean;
}

/** Series that occur in several panels keep their colour; else each panel counts anew. */
function looks(view: ChartView): number[][] {
  const names = new Map<string, number>();
  let shared = false;
  for (const panel of view.panels)
    for (const { name } of panel.series) {
      if (names.has(name)) shared = true;
      else names.set(name, names.size);
    }
  return view.panels.map((panel) => panel.series.map((series, k) => (shared ? (names.get(series.name) ?? k) : k)));
}

function dashOf(series: Series, look: number, lines: number): string {
  if (series.dashed) return (look > 0 && seriesDash(look)) || "6 4";
  // Beyond two lines colours alone do not tell them apart; markers do, and colours used twice.
  if (look >= SERIES_COUNT) return seriesDash(1 + (look % (SERIES_COUNT - 1)));
  return lines > 2 && (series.marks ?? "line") === "line" ? seriesDash(look) : "";
}

const nothing: ArrayLike<number> = [];

/** Keys of the series that the reader has hidden: panel and series. */
export function seriesKey(panel: number, series: number): string {
  return `${panel}:${series}`;
}

/** The chart at the current step and axis. */
export function plotOf(view: ChartView, store: Store, hidden: ReadonlySet<string>): Plot {
  const { blobs, timeline } = store.data;
  const axis: Axis | null = view.linked ? (timeline?.axes[store.axis] ?? null) : view.x;
  const now = view.by_step ? (view.by_step[store.step] ?? { x: [], y: [] }) : null;
  const read = (numbers: Numbers | undefined): ArrayLike<number> => (numbers ? decode(numbers, blobs) : nothing);
  const common = now && countOf(now.x) > 0 ? read(now.x) : read(axis?.values);
  const look = looks(view);
  const panels = view.panels.map((panel, p): PlotPanel => {
    const lines = panel.series.filter((series) => (series.marks ?? "line") === "line").length;
    return {
      label: panel.label,
      unit: panel.unit,
      log: panel.scale === "log",
      leastSpan: panel.least_span ?? 0,
      levels: panel.levels,
      series: panel.series.map((series, s): PlotSeries => {
        const marks = series.marks ?? "line";
        return {
          name: series.name,
          look: look[p]?.[s] ?? s,
          line: marks !== "points",
          points: marks !== "line",
          dash: dashOf(series, look[p]?.[s] ?? s, lines),
          x: series.x && !now ? read(series.x) : common,
          y: now ? read(now.y[p]?.[s]) : read(series.y),
          texts: series.texts ?? null,
          steps: series.steps ? read(series.steps) : null,
          hidden: hidden.has(seriesKey(p, s)),
        };
      }),
    };
  });
  const x = { label: axis?.label ?? "", unit: axis?.unit ?? "", log: axis?.scale === "log", labels: axis?.labels ?? null, values: common };
  return { x, panels, toScale: view.to_scale ?? false };
}

const mostValuesToScan = 3e6;

/** Extents over all steps, so that the axes of a chart that changes with the step stay; null: too many numbers, or no such chart. */
export function extentsOfAllSteps(view: ChartView, store: Store): { x: Domain | null; y: (Domain | null)[] } | null {
  const all = view.by_step;
  if (!all) return null;
  const total = all.reduce((sum, step) => sum + step.y.reduce((of, panel) => of + panel.reduce((n, y) => n + countOf(y), 0), 0), 0);
  if (total > mostValuesToScan) return null;
  const { blobs } = store.data;
  return {
    x: extentOf(all.map((step) => decode(step.x, blobs)), view.x?.scale === "log"),
    y: view.panels.map((panel, p) => extentOf(all.flatMap((step) => (step.y[p] ?? []).map((y) => decode(y, blobs))), panel.scale === "log")),
  };
}

/** The whole range of x. */
export function wholeX(plot: Plot, fixed: Domain | null): Domain {
  if (plot.x.labels) return [-0.6, plot.x.labels.length - 0.4];
  const arrays = plot.panels.flatMap((panel) => panel.series.map((series) => series.x));
  const extent = fixed ?? extentOf([plot.x.values, ...arrays], plot.x.log);
  const points = plot.panels.some((panel) => panel.series.some((series) => series.points));
  return padded(extent, plot.x.log, points ? 0.03 : 0);
}

/** The range of y of what can be seen in a window of x. */
export function rangeY(panel: PlotPanel, window: Domain | null, fixed: Domain | null): Domain {
  const shown = panel.series.filter((series) => !series.hidden);
  let extent = fixed;
  if (!extent && !window) extent = extentOf(shown.map((series) => series.y), panel.log);
  if (!extent && window) {
    const [from, to] = window;
    const seen = shown.map((series) => {
      const values: number[] = [];
      const n = Math.min(series.x.length, series.y.length);
      for (let i = 0; i < n; ++i) {
        // Points next to the window belong to lines that enter it.
        const near = [series.x[i - 1], series.x[i], series.x[i + 1]];
        if (near.some((x) => x !== undefined && x >= from && x <= to)) values.push(series.y[i]!);
      }
      return values;
    });
    extent = extentOf(seen, panel.log);
  }
  const levels = panel.levels.map((level) => level.value);
  return padded(window ? extent : withLevels(extent, levels, panel.log), panel.log, 0.06, panel.leastSpan);
}

/** Whether values never fall or never rise. */
export function isMonotone(values: ArrayLike<number>): boolean {
  let up = true;
  let down = true;
  for (let i = 1; i < values.length; ++i) {
    if (values[i]! < values[i - 1]!) up = false;
    if (values[i]! > values[i - 1]!) down = false;
  }
  return up || down;
}
