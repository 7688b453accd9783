// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { brief } from "./text";

/** A row of numbers: its key (for data-...), its name, its unit. */
export interface ValueRow {
  key: string;
  label: string;
  unit: string;
}

/** A table of numbers whose texts change from step to step; rows and columns are made anew only when they differ. */
export class ValueTable {
  readonly element: HTMLTableElement;
  private readonly caption: HTMLTableCaptionElement;
  private made = "";
  private cells: HTMLTableCellElement[][] = [];

  /** `attribute`: the data attribute that holds a row's key on its cells. */
  constructor(private readonly attribute: string) {
    this.element = document.createElement("table");
    this.element.className = "contact-values";
    this.caption = this.element.createCaption();
  }

  private make(rows: readonly ValueRow[], columns: readonly string[]): void {
    const key = JSON.stringify([rows, columns]);
    if (key === this.made) return;
    this.made = key;
    this.element.tHead?.remove();
    for (const body of [...this.element.tBodies]) body.remove();
    if (columns.length > 1) {
      const head = this.element.createTHead().insertRow();
      for (const name of ["", ...columns]) {
        const th = document.createElement("th");
        th.scope = "col";
        th.textContent = name;
        head.append(th);
      }
    }
    const body = this.element.createTBody();
    this.cells = rows.map((row) => {
      const tr = body.insertRow();
      const th = document.createElement("th");
      th.scope = "row";
      th.textContent = row.label;
      if (row.unit !== "" && row.unit !== "1") {
        const unit = document.createElement("span");
        unit.className = "unit";
        unit.textContent = ` [${row.unit}]`;
        th.append(unit);
      }
      tr.append(th);
      return columns.map((_, k) => {
        const td = tr.insertCell();
        td.className = "number";
        td.setAttribute(this.attribute, row.key);
        td.dataset["set"] = String(k);
        return td;
      });
    });
  }

  /** Shows numbers (or texts), row by row; those that do not exist have no data-value. */
  fill(
    caption: string,
    rows: readonly ValueRow[],
    columns: readonly string[],
    value: (row: number, column: number) => number | string | null,
  ): void {
    this.make(rows, columns);
    if (this.caption.textContent !== caption) this.caption.textContent = caption;
    this.element.hidden = rows.length === 0;
    this.cells.forEach((cells, r) => {
      cells.forEach((cell, c) => {
        const v = value(r, c);
        const text = typeof v === "string" ? v : brief(v);
        if (cell.textContent !== text) cell.textContent = text;
        const exact = v === null || (typeof v === "number" && !Number.isFinite(v)) ? null : String(v);
        if (exact === null) delete cell.dataset["value"];
        else if (cell.dataset["value"] !== exact) cell.dataset["value"] = exact;
      });
    });
  }
}
