// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { ChartView } from "../data";
import { addDownloads } from "../download";
import { svgToPng } from "../svg";
import type { Store } from "../store";
import { Chart } from "./chart";

/** Panels of curves above each other over a common axis. */
export function mountChart(figure: HTMLElement, view: ChartView, store: Store): void {
  const frame = figure.querySelector<HTMLElement>(".plot");
  if (!frame) return;
  const title = figure.querySelector("figcaption")?.textContent ?? view.id;
  const chart = new Chart(frame, title, view, store);
  addDownloads(figure, { svg: () => chart.svg(), png: () => svgToPng(chart.svg()), csv: () => chart.csv() }, view.id);
}
