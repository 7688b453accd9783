// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Cell } from "./csv";
import { toCsv, toTsv } from "./csv";
import { fileName, named, save } from "./download";
import type { Store } from "./store";
import type { Direction, SortKey } from "./table-sort";
import { nextDirection, sortedOrder } from "./table-sort";

function textOf(element: Element): string {
  return (element.textContent ?? "").replace(/\s+/g, " ").trim();
}

/** The value of a cell in full precision; numbers that are not there are NaN. */
export function valueOf(cell: HTMLTableCellElement): SortKey {
  const full = cell.dataset["value"];
  if (full !== undefined && full !== "") {
    const value = Number(full);
    if (!Number.isNaN(value)) return value;
  }
  return cell.classList.contains("number") ? NaN : textOf(cell);
}

/** A table with headings and rows as shown, numbers in full precision. */
export function tableCells(table: HTMLTableElement): Cell[][] {
  const heads = [...(table.tHead?.rows[0]?.cells ?? [])].map(textOf);
  const rows = [...(table.tBodies[0]?.rows ?? [])].map((row) =>
    [...row.cells].map((cell): Cell => {
      const full = cell.dataset["value"];
      // The digits as they were written, not as they would be printed anew.
      if (full !== undefined && full !== "") return full;
      return cell.classList.contains("number") ? null : textOf(cell);
    }),
  );
  return [heads, ...rows];
}

function makeSortable(table: HTMLTableElement): void {
  const body = table.tBodies[0];
  const heads = [...(table.tHead?.rows[0]?.cells ?? [])];
  if (!body) return;
  const original = [...body.rows];
  heads.forEach((head, column) => {
    const cells = original.map((row) => row.cells[column]);
    if (cells.some((cell) => cell?.classList.contains("number"))) head.classList.add("number");
    if (original.length < 2) return;
    const button = document.createElement("button");
    button.type = "button";
    button.className = "sort";
    const label = document.createElement("span");
    label.append(...head.childNodes);
    button.append(label);
    head.append(button);
    button.addEventListener("click", () => {
      const now = head.getAttribute("aria-sort") as Direction | null;
      const direction = nextDirection(now);
      for (const other of heads) other.removeAttribute("aria-sort");
      if (direction) head.setAttribute("aria-sort", direction);
      const keys = cells.map((cell) => (cell ? valueOf(cell) : ""));
      const order = direction ? sortedOrder(keys, direction) : keys.map((_, row) => row);
      body.append(...order.map((row) => original[row]!));
    });
  });
}

/** Copies text; where the clipboard is closed to pages from files, by way of a selected text field. */
async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const field = document.createElement("textarea");
    field.value = text;
    field.className = "off-screen";
    document.body.append(field);
    field.select();
    // Deprecated, yet the only way without the permission above.
    const done = (document as { execCommand?: (command: string) => boolean }).execCommand?.call(document, "copy") ?? false;
    field.remove();
    return done;
  }
}

function addActions(table: HTMLTableElement, frame: Element): void {
  const name = table.dataset["name"] ?? table.id ?? "table";
  const row = document.createElement("div");
  row.className = "table-actions";
  const said = document.createElement("span");
  said.className = "said";
  said.setAttribute("aria-live", "polite");
  const add = (label: string, title: string, act: () => void): void => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = label;
    button.title = title;
    button.addEventListener("click", act);
    row.append(button);
  };
  add("Copy", `Copy ${name} for a spreadsheet, in full precision`, () => {
    void copy(toTsv(tableCells(table))).then((done) => {
      said.textContent = done ? "Copied" : "The browser did not allow it";
      setTimeout(() => (said.textContent = ""), 2500);
    });
  });
  add("CSV", `Download ${name} as CSV, in full precision`, () => {
    save(new Blob([toCsv(tableCells(table))], { type: "text/csv" }), fileName(named(name), "csv"));
  });
  row.append(said);
  const block = document.createElement("div");
  block.className = "table-block";
  frame.replaceWith(block);
  block.append(frame, row);
}

function stepOf(row: HTMLTableRowElement): number {
  return Number(row.dataset["step"] ?? NaN);
}

/** Rows that stand for steps: click or Enter chooses the step; the current one is marked. */
function linkRows(table: HTMLTableElement, store: Store): void {
  const rows = [...(table.tBodies[0]?.rows ?? [])].filter((row) => row.dataset["step"] !== undefined);
  if (rows.length === 0) return;
  const byStep = new Map<number, HTMLTableRowElement[]>();
  for (const row of rows) {
    const step = stepOf(row);
    byStep.set(step, [...(byStep.get(step) ?? []), row]);
    row.tabIndex = -1;
    row.addEventListener("click", () => {
      // A click that ends a selection of text is none.
      if (!window.getSelection()?.toString()) store.setStep(step);
    });
    row.addEventListener("keydown", (event) => {
      const sibling = event.key === "ArrowDown" ? row.nextElementSibling : event.key === "ArrowUp" ? row.previousElementSibling : null;
      if (event.key === "Enter" || event.key === " ") store.setStep(step);
      else if (sibling instanceof HTMLTableRowElement && sibling.dataset["step"] !== undefined) {
        sibling.focus();
        store.setStep(stepOf(sibling));
      } else return;
      event.preventDefault();
    });
  }
  let current: HTMLTableRowElement[] = [];
  const mark = (step: number): void => {
    for (const row of current) {
      row.classList.remove("current");
      row.removeAttribute("aria-current");
      row.tabIndex = -1;
    }
    current = byStep.get(step) ?? [];
    for (const row of current) {
      row.classList.add("current");
      row.setAttribute("aria-current", "true");
      row.tabIndex = 0;
      reveal(row);
    }
    // One row can always be reached by Tab.
    const [first] = rows;
    if (first) first.tabIndex = current.length === 0 || first === current[0] ? 0 : -1;
  };
  store.onStep(mark);
  mark(store.step);
}

/** Scrolls the table's own frame, never the page, to show a row. */
function reveal(row: HTMLTableRowElement): void {
  const frame = row.closest<HTMLElement>(".table-frame");
  if (!frame || frame.scrollHeight <= frame.clientHeight) return;
  const box = frame.getBoundingClientRect();
  const own = row.getBoundingClientRect();
  const head = row.closest("table")?.tHead?.offsetHeight ?? 0;
  if (own.top < box.top + head) frame.scrollTop -= box.top + head - own.top;
  else if (own.bottom > box.bottom) frame.scrollTop += own.bottom - box.bottom;
}

/** Makes all tables of the page sortable, copyable and linked to the timeline. */
export function mountTables(store: Store): void {
  for (const table of document.querySelectorAll<HTMLTableElement>("table.data")) {
    const frame = table.closest(".table-frame");
    makeSortable(table);
    if (frame) {
      // What scrolls must be reachable by keyboard.
      frame.setAttribute("tabindex", "0");
      frame.setAttribute("role", "region");
      frame.setAttribute("aria-label", table.caption ? textOf(table.caption) : (table.dataset["name"] ?? "table"));
      addActions(table, frame);
    }
    linkRows(table, store);
  }
}
