// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { PAPER_WIDTH } from "./print";

/** Letters of tables on paper [px], as the style sheet has them (8 pt). */
const PAPER_FONT = 10.7;
/** Rows of which a second copy would cost too much. */
const MOST_ROWS = 5000;

/** Columns of each part of a table that is wider than a page: the first one leads every part. */
export function columnParts(widths: readonly number[], room: number): number[][] {
  const lead = widths[0] ?? 0;
  const parts: number[][] = [];
  let used = Infinity;
  for (let column = 1; column < widths.length; ++column) {
    const width = widths[column]!;
    if (used + width > room) {
      parts.push([0]);
      used = lead;
    }
    parts.at(-1)!.push(column);
    used += width;
  }
  return parts;
}

/** Widths on paper, or somewhat more, of the columns [px]. */
function widthsOf(table: HTMLTableElement): number[] {
  const before = table.style.width;
  table.style.width = "1px";
  const cells = [...(table.tHead?.rows[0]?.cells ?? [])];
  const widths = cells.map((cell) => (cell.offsetWidth * PAPER_FONT) / parseFloat(getComputedStyle(cell).fontSize));
  table.style.width = before;
  return widths;
}

function partOf(table: HTMLTableElement, columns: readonly number[], first: boolean): HTMLTableElement {
  const part = table.cloneNode(true) as HTMLTableElement;
  part.removeAttribute("id");
  if (!first && part.caption) part.caption.textContent += " (continued)";
  for (const row of part.rows) [...row.cells].forEach((cell, k) => columns.includes(k) || cell.remove());
  return part;
}

/** On paper, which does not scroll, tables that are too wide go on below themselves. */
export function mountPaperTables(): void {
  const lists: { list: HTMLElement; frame: HTMLElement }[] = [];
  window.addEventListener("beforeprint", () => {
    for (const table of document.querySelectorAll<HTMLTableElement>(".table-frame > table.data")) {
      const frame = table.parentElement;
      if (!frame || table.rows.length > MOST_ROWS) continue;
      const widths = widthsOf(table);
      if (widths.reduce((sum, width) => sum + width, 0) <= PAPER_WIDTH) continue;
      const list = document.createElement("div");
      list.className = "paper-tables";
      list.append(...columnParts(widths, PAPER_WIDTH).map((columns, k) => partOf(table, columns, k === 0)));
      frame.classList.add("in-parts");
      frame.after(list);
      lists.push({ list, frame });
    }
  });
  window.addEventListener("afterprint", () => {
    for (const { list, frame } of lists.splice(0)) {
      frame.classList.remove("in-parts");
      list.remove();
    }
  });
}
