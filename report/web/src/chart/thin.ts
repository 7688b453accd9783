// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

/** A run of points without gaps, as indices of the data. */
export type Run = number[];

/**
 * The points of a line that a screen can show. Successive points in the same column of pixels become the first, the least, the
 * greatest and the last of them, so that a peak of one point survives. Gaps (NaN in place) end a run. Points outside of
 * [left, right] are left out except those next to it, to which the line leads.
 * column: pixel abscissa of point i; y: value of point i; both NaN where there is none.
 */
export function thin(count: number, column: (i: number) => number, y: (i: number) => number, left: number, right: number): Run[] {
  const runs: Run[] = [];
  let run: Run = [];
  let at = NaN; // column of the current group
  let first = -1;
  let last = -1;
  let least = -1;
  let greatest = -1;
  let outside = -1; // the point before, when it lies outside

  const flush = (): void => {
    if (first < 0) return;
    const picked = [first, Math.min(least, greatest), Math.max(least, greatest), last];
    for (const i of picked) if (run[run.length - 1] !== i) run.push(i);
    first = -1;
  };
  const end = (): void => {
    flush();
    if (run.length > 0) runs.push(run);
    run = [];
    outside = -1;
  };

  for (let i = 0; i < count; ++i) {
    const px = column(i);
    const value = y(i);
    if (Number.isNaN(px) || Number.isNaN(value)) {
      end();
      continue;
    }
    if (px < left || px > right) {
      flush();
      const tail = run[run.length - 1];
      if (tail !== undefined && tail === i - 1 && outside !== i - 1) run.push(i);
      // A line may cross the window between two points that both lie outside of it.
      else if (outside === i - 1 && outside >= 0 && (column(outside) < left) !== (px < left)) {
        if (run[run.length - 1] !== outside) run.push(outside);
        run.push(i);
      }
      outside = i;
      continue;
    }
    const group = Math.floor(px);
    if (outside >= 0) {
      if (run[run.length - 1] !== outside) {
        if (run.length > 0) runs.push(run);
        run = [outside];
      }
      outside = -1;
    }
    if (first >= 0 && group === at) {
      last = i;
      if (value < y(least)) least = i;
      if (value > y(greatest)) greatest = i;
    } else {
      flush();
      at = group;
      first = last = least = greatest = i;
    }
  }
  end();
  return runs;
}
