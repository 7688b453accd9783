// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { MapView } from "./data";
import type { Store } from "./store";

export function mountMap(figure: HTMLElement, view: MapView, store: Store): void {
  const plot = figure.querySelector(".plot") ?? figure;
  plot.textContent = `${view.type} of ${store.data.title}`;
}
