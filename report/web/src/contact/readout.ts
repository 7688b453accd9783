// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { FieldInfo } from "../data";
import { centre } from "./csv";
import { shownValue } from "./fields";
import type { Model, PanelModel } from "./model";
import { elementOf, type Found, type Place } from "./pick";
import { numberName } from "./text";
import { ValueTable, type ValueRow } from "./value-table";

/** The tables beside the pictures: numbers of the patches, and the values of one element. */
export class Readout {
  readonly numbers = new ValueTable("data-number");
  readonly element = new ValueTable("data-readout");
  private readonly fieldRows: ValueRow[];
  private numberRows: (ValueRow & { factor: number })[] = [];

  constructor(
    private readonly model: Model,
    private readonly fields: readonly FieldInfo[],
  ) {
    this.fieldRows = [
      { key: "x", label: "x", unit: "mm" },
      { key: "s", label: "s", unit: "mm" },
      ...fields.map(({ name, label, unit }) => ({ key: name, label, unit })),
    ];
  }

  /** Numbers of the first patch that each panel shows. */
  fillNumbers(panels: readonly PanelModel[]): void {
    const keys = new Set<string>();
    for (const panel of panels) for (const key of Object.keys(panel.items[0]?.patch.numbers ?? {})) keys.add(key);
    // Without any patch the rows stay, so that what is below does not jump.
    if (keys.size > 0) this.numberRows = [...keys].map((key) => ({ key, ...numberName(key) }));
    const rows = this.numberRows;
    const only = panels.length === 1 ? panels[0] : undefined;
    const title = (only?.items[0]?.patch.name ?? "") || "Patch";
    this.numbers.fill(
      title,
      rows,
      panels.map(({ name }) => name),
      (r, c) => {
        const value = panels[c]?.items[0]?.patch.numbers[rows[r]?.key ?? ""] ?? null;
        return value === null ? null : value * (rows[r]?.factor ?? 1);
      },
    );
  }

  /** Values of the element at a place in every panel; `caption` says what place that is. */
  fillElement(panels: readonly PanelModel[], place: Omit<Place, "set">, caption: string): void {
    const { blobs } = this.model.data;
    const found = panels.map((panel) => elementOf(panel, place.x, place.s, blobs));
    this.element.fill(
      caption,
      this.fieldRows,
      panels.map(({ name }) => name),
      (r, c) => {
        const at = found[c];
        return at ? this.value(at, r) : null;
      },
    );
  }

  private value(at: Found, row: number): number | string | null {
    if (row < 2) return centre(at.item, at.ix, at.iy)[row] ?? null;
    const field = this.fields[row - 2];
    if (!field) return null;
    const value = shownValue(at.item.patch, field.name, at.iy * at.item.patch.nx + at.ix, this.model.data.blobs);
    return field.kind === "state" ? (stateNames[value] ?? null) : value;
  }
}

export const stateNames: readonly string[] = ["exterior", "adhesion", "slip", "plastic"];
