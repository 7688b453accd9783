// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { formatNumber, labelWithUnit } from "../numbers";
import { swatch } from "./marks";
import type { Plot } from "./model";

/** The line above a panel: its label, and a button a series that hides and shows it, with the value at the cursor. */
export class PanelHead {
  readonly element = document.createElement("div");
  private readonly values: HTMLElement[] = [];
  private readonly buttons: HTMLButtonElement[] = [];

  constructor(plot: Plot, p: number, withValues: boolean, toggle: (series: number) => void) {
    const panel = plot.panels[p]!;
    this.element.className = "panel-head legend";
    const label = document.createElement("span");
    label.className = "panel-label";
    label.textContent = labelWithUnit(panel.label, panel.unit);
    this.element.append(label);
    const only = panel.series.length === 1 && (panel.series[0]?.name === "" || panel.series[0]?.name === panel.label);
    panel.series.forEach((series, s) => {
      const value = document.createElement("span");
      value.className = "now";
      this.values.push(value);
      if (only) {
        if (withValues) this.element.append(value);
        return;
      }
      const button = document.createElement("button");
      button.type = "button";
      button.title = `Hide or show ${series.name}`;
      const name = document.createElement("span");
      name.className = "series-name";
      name.textContent = series.name;
      button.append(swatch(series), name);
      if (withValues) button.append(value);
      button.addEventListener("click", () => toggle(s));
      this.buttons[s] = button;
      this.element.append(button);
    });
  }

  /** Which series are shown; their values at the cursor where `index` is given. */
  update(plot: Plot, p: number, index: number | null): void {
    plot.panels[p]!.series.forEach((series, s) => {
      this.buttons[s]?.setAttribute("aria-pressed", String(!series.hidden));
      const value = this.values[s];
      if (value && index !== null) value.textContent = formatNumber(series.y[index], 4);
    });
  }
}
