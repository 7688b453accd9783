// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { ChartView } from "../data";
import type { Store } from "../store";

export function mountChart(figure: HTMLElement, view: ChartView, store: Store): void {
  const plot = figure.querySelector(".plot") ?? figure;
  plot.textContent = `${view.type} of ${store.data.title}`;
}
