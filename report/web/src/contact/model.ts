// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { FieldInfo, Frame, FrameSet, Patch, ReportData } from "../data";
import { decode } from "../packed";
import { difference } from "./difference";
import type { Box } from "./fields";
import { byLoad, inAxesOf, itemsOf, matchedItems, nominalItem, toTrack, type Choice, type Item } from "./place";
import { around, EMPTY_WINDOW, itemBox, mostOf, rangeOf, union, withMargin, type Range } from "./scales";

/** A panel of the picture: one set's patches at a step. */
export interface PanelModel {
  /** Place of the set in the view and in the data. */
  k: number;
  set: number;
  name: string;
  frame: Frame | null;
  items: Item[];
  /** What is drawn with a dashed outline to compare with. */
  other: Item | null;
}

const NOTHING: Range = { low: Infinity, high: -Infinity };

/** What can be said about the fields of a view without drawing them; results are kept. */
export class Model {
  readonly sets: FrameSet[];
  /** Frames that any step shows, each once. */
  frames: number[] = [];
  private readonly panelsOf = new Map<string, PanelModel[]>();
  private readonly ranges = new Map<string, Range>();
  private readonly windows = new Map<string, Box>();
  private readonly differences = new WeakMap<Patch, { truth: Patch | null; fields: Map<string, Float32Array | null> }>();

  constructor(
    readonly data: ReportData,
    readonly setNumbers: readonly number[],
  ) {
    this.sets = setNumbers.flatMap((k) => data.sets[k] ?? []);
    this.renew();
  }

  /** Forgets what was said: the data are others. */
  renew(): void {
    this.frames = framesOf(this.data, this.sets);
    for (const kept of [this.panelsOf, this.ranges, this.windows]) kept.clear();
  }

  /** All sets at a frame: the first about its own contact reference, the others where they lie to it in track. */
  panels(frame: number | null, choice: Choice): PanelModel[] {
    const key = `${frame} ${JSON.stringify(choice)}`;
    let panels = this.panelsOf.get(key);
    if (!panels) this.panelsOf.set(key, (panels = this.compose(frame, choice)));
    return panels;
  }

  private compose(number: number | null, choice: Choice): PanelModel[] {
    let first: Item[] = [];
    return this.sets.map((set, k) => {
      const frame = (number === null ? undefined : set.frames[number]) ?? null;
      const items = frame ? (k === 0 ? itemsOf(frame, choice) : matchedItems(first, frame, choice)) : [];
      if (k === 0) first = items;
      const base = items[0]?.patch;
      const nominal = frame && base ? nominalItem(set, frame, base) : null;
      // The nominal patch is placed about this panel's main patch, which may lie beside the first set's.
      const own = items[0];
      if (nominal && own) {
        nominal.ox += own.ox + own.patch.reference_mm[0];
        nominal.os += own.os + own.patch.reference_mm[1];
      }
      const other = nominal ?? (k > 0 ? (first[0] ?? null) : null);
      return { k, set: this.setNumbers[k] ?? k, name: set.name, frame, items, other };
    });
  }

  private over(key: string, frames: readonly number[], part: (set: FrameSet, k: number, frame: number) => Range): Range {
    const full = `${key} ${frames.length === 1 ? frames[0] : "all"}`;
    let range = this.ranges.get(full);
    if (!range) {
      range = NOTHING;
      for (const frame of frames) this.sets.forEach((set, k) => (range = union(range ?? NOTHING, part(set, k, frame))));
      this.ranges.set(full, range);
    }
    return range;
  }

  /** Least and greatest value of a field in all sets and patches of frames. */
  range(name: string, frames: readonly number[]): Range {
    return this.over(name, frames, (set, _, frame) =>
      (set.frames[frame]?.patches ?? []).reduce((range, patch) => union(range, rangeOf(patch, name, this.data.blobs)), NOTHING),
    );
  }

  /** Range of nearly all differences to the first set. */
  differenceRange(name: string, frames: readonly number[], choice: Choice): Range {
    return this.over(`${name} difference ${JSON.stringify(choice)}`, frames, (_, k, frame) => {
      if (k === 0) return NOTHING;
      const panels = this.panels(frame, choice);
      const truth = panels[0]?.items ?? [];
      return (panels[k]?.items ?? []).reduce((range, item) => {
        const values = this.difference(item, truth, name);
        return values ? union(range, mostOf(values)) : range;
      }, NOTHING);
    });
  }

  /** A field of a patch minus that of the nearest of the truth's patches. */
  difference(item: Item, truth: readonly Item[], name: string): Float32Array | null {
    const patch = item.patch;
    const other = nearest(patch, truth);
    let kept = this.differences.get(patch);
    if (kept?.truth !== other) this.differences.set(patch, (kept = { truth: other, fields: new Map<string, Float32Array | null>() }));
    let values = kept?.fields.get(name);
    if (values === undefined) {
      values = difference(patch, other, name, this.data.blobs);
      kept?.fields.set(name, values);
    }
    return values;
  }

  /** The window around what sets show at frames: contact, or whole grids, and the outlines to compare with. */
  window(frames: readonly number[], choice: Choice, shown: ReadonlySet<number>, whole: boolean, other: boolean): Box {
    const key = JSON.stringify([frames.length === 1 ? frames[0] : "all", choice, [...shown].sort(), whole, other]);
    let window = this.windows.get(key);
    if (!window) {
      const boxes: Box[] = [];
      for (const frame of frames)
        for (const panel of this.panels(frame, choice)) {
          if (!shown.has(panel.k)) continue;
          const items = other && panel.other && panel.items.length > 0 && !whole ? [...panel.items, panel.other] : panel.items;
          for (const item of items) {
            const box = itemBox(item, whole, this.data.blobs);
            if (box) boxes.push(box);
          }
        }
      const box = around(boxes);
      window = box ? withMargin(box) : EMPTY_WINDOW;
      this.windows.set(key, window);
    }
    return window;
  }

  /** Fields that patches of the view have, in the order of the menu. */
  fields(): FieldInfo[] {
    const there = new Set<string>();
    for (const patch of this.patches()) for (const name of Object.keys(patch.values)) there.add(name);
    return this.data.fields.filter(({ name }) => there.has(name));
  }

  /** All patches of the frames. */
  *patches(): Generator<Patch> {
    for (const frame of this.frames) for (const set of this.sets) yield* set.frames[frame]?.patches ?? [];
  }
}

function framesOf(data: ReportData, sets: readonly FrameSet[]): number[] {
  const packed = data.timeline?.frames;
  if (!packed) return sets[0]?.frames.length ? [0] : [];
  return [...new Set(decode(packed, data.blobs))].filter((k) => !Number.isNaN(k));
}

function nearest(patch: Patch, items: readonly Item[]): Patch | null {
  const here = toTrack(patch, ...patch.reference_mm);
  let best: Patch | null = null;
  let least = Infinity;
  for (const { patch: other } of items) {
    const there = toTrack(other, ...other.reference_mm);
    const distance = Math.hypot(...inAxesOf(patch, [there[0] - here[0], there[1] - here[1], there[2] - here[2]]));
    if (distance < least) {
      least = distance;
      best = other;
    }
  }
  return best;
}

/** Whether at some step a set's patches all lie too far from the first set's most loaded one to be of one contact. */
export function isApart(model: Model): boolean {
  return model.frames.some((frame) =>
    model.panels(frame, { kind: "load", rank: 0 }).some((panel) => panel.items.length === 0 && (panel.frame?.patches.length ?? 0) > 0),
  );
}

/**
 * What the reader may choose beside the most loaded patch: the others by load or by name, and all together. `allFirst`: these are
 * what is shown at first.
 */
export function choicesOf(model: Model, allFirst = false): { label: string; choice: Choice }[] {
  let most = 0;
  const names = new Set<string>();
  for (const frame of model.frames)
    for (const set of model.sets) {
      const found = set.frames[frame];
      if (!found) continue;
      most = Math.max(most, found.patches.length);
      for (const k of byLoad(found)) names.add(found.patches[k]?.name ?? "");
    }
  if (model.data.live) most = 3;
  if (most < 2 && !allFirst) return [];
  const ranks = ["most loaded", "second by load", "third by load"];
  const out: { label: string; choice: Choice }[] = ranks.slice(0, most).map((label, rank) => ({ label, choice: { kind: "load", rank } }));
  out.splice(allFirst ? 0 : out.length, 0, { label: "all patches", choice: { kind: "all" } });
  if (names.size > 1 && names.size <= 40)
    for (const name of [...names].sort(byNumber)) out.push({ label: name, choice: { kind: "name", name } });
  return out;
}

function byNumber(a: string, b: string): number {
  return a.localeCompare(b, "en", { numeric: true });
}
