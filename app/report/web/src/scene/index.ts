// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { SceneView } from "../data";
import type { Store } from "../store";

export function mountScene(figure: HTMLElement, view: SceneView, store: Store): void {
  const plot = figure.querySelector(".plot") ?? figure;
  plot.textContent = `${view.type} of ${store.data.title}`;
}
