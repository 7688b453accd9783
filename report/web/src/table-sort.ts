// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

/** What a column of a table is sorted by: numbers (NaN = none), or texts. */
export type SortKey = number | string;
export type Direction = "ascending" | "descending";

const texts = new Intl.Collator("en", { numeric: true, sensitivity: "base" });

function isNone(key: SortKey): boolean {
  return key === "" || (typeof key === "number" && Number.isNaN(key));
}

/** Order of the rows by their keys. Rows without a value come last in both directions; equal ones keep their order. */
export function sortedOrder(keys: readonly SortKey[], direction: Direction): number[] {
  const sign = direction === "ascending" ? 1 : -1;
  return keys
    .map((_, row) => row)
    .sort((a, b) => {
      const ka = keys[a]!;
      const kb = keys[b]!;
      if (isNone(ka) || isNone(kb)) return Number(isNone(ka)) - Number(isNone(kb)) || a - b;
      const order = typeof ka === "number" && typeof kb === "number" ? ka - kb : texts.compare(String(ka), String(kb));
      return sign * order || a - b;
    });
}

/** The direction after a click on a column's heading: rising, falling, as it was written. */
export function nextDirection(now: Direction | null): Direction | null {
  return now === null ? "ascending" : now === "ascending" ? "descending" : null;
}
