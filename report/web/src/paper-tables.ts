// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { PAPER_WIDTH } from "./print";

/** Texts get as much before they are broken into lines [px]. */
const TEXT_WIDTH = 130;
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

/** Widths that columns need on paper [px]: those of a copy that looks as there. */
function widthsOf(table: HTMLTableElement): number[] {
  const frame = document.createElement("div");
  frame.className = "paper-tables measured";
  const copy = table.cloneNode(true) as HTMLTableElement;
  copy.removeAttribute("id");
  copy.caption?.remove();
  frame.append(copy);
  document.body.append(frame);
  const cells = [...(copy.tHead?.rows[0]?.cells ?? [])];
  const [least, most] = ["1px", "max-content"].map((width) => {
    copy.style.width = width;
    return cells.map((cell) => cell.offsetWidth);
  }) as [number[], number[]];
  const numbers = cells.map((cell) => cell.classList.contains("number"));
  frame.remove();
  return least.map((width, k) => (numbers[k] ? width : Math.max(width, Math.min(most[k]!, TEXT_WIDTH))));
}

/** A part of a table below its name, which may be wider than it. */
function partOf(table: HTMLTableElement, columns: readonly number[], first: boolean): HTMLElement[] {
  const part = table.cloneNode(true) as HTMLTableElement;
  part.removeAttribute("id");
  const name = document.createElement("p");
  name.className = "paper-name";
  const caption = part.caption?.textContent ?? "";
  name.textContent = first ? caption : `${caption.replace(/[.;:].*$/s, "")} (continued)`;
  part.caption?.remove();
  for (const row of part.rows) [...row.cells].forEach((cell, k) => columns.includes(k) || cell.remove());
  return [name, part];
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
      list.append(...columnParts(widths, PAPER_WIDTH).flatMap((columns, k) => partOf(table, columns, k === 0)));
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
