// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Cell } from "../csv";
import { toCsv } from "../csv";
import { labelWithUnit } from "../numbers";
import type { Plot, PlotSeries } from "./model";

function headOf(plot: Plot, p: number, series: PlotSeries): string {
  const panel = plot.panels[p]!;
  const name = !series.name || series.name === panel.label ? panel.label : `${panel.label}, ${series.name}`;
  return labelWithUnit(name, panel.unit);
}

/** The numbers of a chart: a column a series; series with abscissae of their own have a column of these before them. */
export function chartCsv(plot: Plot): string {
  const all = plot.panels.flatMap((panel, p) => panel.series.map((series) => ({ series, head: headOf(plot, p, series) })));
  const xHead = labelWithUnit(plot.x.label || "x", plot.x.unit);
  const common = all.find(({ series }) => series.x === plot.x.values) ? plot.x.values : null;
  const columns: { head: string; at: (i: number) => Cell; count: number }[] = [];
  const { labels } = plot.x;
  const cell = (values: ArrayLike<number>, i: number): Cell => values[i] ?? null;
  const abscissa = (values: ArrayLike<number>, i: number): Cell => (labels ? (labels[values[i] ?? -1] ?? cell(values, i)) : cell(values, i));
  if (common) columns.push({ head: xHead, at: (i) => abscissa(common, i), count: common.length });
  for (const { series, head } of all) {
    if (series.x !== common) columns.push({ head: `${xHead} of ${series.name}`, at: (i) => abscissa(series.x, i), count: Math.min(series.x.length, series.y.length) });
    columns.push({ head, at: (i) => cell(series.y, i), count: Math.min(series.x.length, series.y.length) });
    if (series.texts) columns.push({ head: `${series.name}: text`, at: (i) => series.texts?.[i], count: series.texts.length });
  }
  const rows: Cell[][] = [columns.map((column) => column.head)];
  const count = Math.max(0, ...columns.map((column) => column.count));
  for (let i = 0; i < count; ++i) rows.push(columns.map((column) => (i < column.count ? column.at(i) : null)));
  return toCsv(rows);
}
