// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// Comma-separated values after RFC 4180, and tab-separated ones for spreadsheets.

export type Cell = string | number | null | undefined;

/** The shortest text that reads back as the same number; nothing where there is none. */
export function plain(cell: Cell): string {
  if (cell === null || cell === undefined) return "";
  if (typeof cell === "number") return Number.isFinite(cell) ? String(cell) : Number.isNaN(cell) ? "" : cell > 0 ? "inf" : "-inf";
  return cell;
}

export function quoted(text: string): string {
  return /[",\r\n]/.test(text) || text !== text.trim() ? `"${text.replace(/"/g, '""')}"` : text;
}

export function toCsv(rows: readonly (readonly Cell[])[]): string {
  return rows.map((row) => row.map((cell) => quoted(plain(cell))).join(",") + "\r\n").join("");
}

export function toTsv(rows: readonly (readonly Cell[])[]): string {
  return rows.map((row) => row.map((cell) => plain(cell).replace(/[\t\r\n]+/g, " ")).join("\t") + "\n").join("");
}
