// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { scaleLinear, scaleLog } from "d3-scale";

import { formatNumber, powerOfTen } from "../numbers";

export type Domain = [number, number];

/** From a domain to pixels and back, with its ticks. */
export interface Scale {
  readonly log: boolean;
  readonly domain: Domain;
  (value: number): number;
  invert(pixel: number): number;
  ticks(count: number): Tick[];
}

export interface Tick {
  value: number;
  label: string;
}

/** Least and greatest finite value (on log axes: positive ones); null where there is none. */
export function extentOf(arrays: Iterable<ArrayLike<number>>, log: boolean): Domain | null {
  let low = Infinity;
  let high = -Infinity;
  for (const values of arrays) {
    for (let i = 0; i < values.length; ++i) {
      const v = values[i]!;
      if (!Number.isFinite(v) || (log && v <= 0)) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return low <= high ? [low, high] : null;
}

/** A domain with some room at both ends; one narrower than a share of its values, or of no width, is widened about its middle. */
export function padded(extent: Domain | null, log: boolean, share: number, leastSpan = 0): Domain {
  if (!extent) return log ? [1, 10] : [0, 1];
  let [low, high] = extent;
  if (log) {
    if (high / low < 1.0001) return [low / 2, high * 2];
    const room = (high / low) ** share;
    return [low / room, high * room];
  }
  if (high - low <= 1e-12 * Math.max(Math.abs(low), Math.abs(high))) {
    const room = Math.abs(high) > 0 ? 0.1 * Math.abs(high) : 1;
    return [low - room, high + room];
  }
  const lacking = leastSpan * Math.max(Math.abs(low), Math.abs(high)) - (high - low);
  if (lacking > 0) [low, high] = [low - lacking / 2, high + lacking / 2];
  const room = share * (high - low);
  // Zero as an end of the data stays the end of the axis.
  low = low >= 0 && low < room ? 0 : low - room;
  high = high <= 0 && high > -room ? 0 : high + room;
  return [low, high];
}

/** The extent with levels that do not squash the data: none may make the range more than three times as wide. */
export function withLevels(extent: Domain | null, levels: readonly number[], log: boolean): Domain | null {
  const usable = levels.filter((v) => Number.isFinite(v) && (!log || v > 0));
  if (!extent) return extentOf([usable], log);
  const to = (v: number): number => (log ? Math.log(v) : v);
  const width = Math.max(to(extent[1]) - to(extent[0]), log ? 0.3 : 1e-9 * Math.abs(extent[1]));
  let [low, high] = extent;
  for (const level of usable) {
    if (to(level) < to(extent[0]) - 1.5 * width || to(level) > to(extent[1]) + 1.5 * width) continue;
    low = Math.min(low, level);
    high = Math.max(high, level);
  }
  return [low, high];
}

/** Labels of evenly spaced values with as many decimals as their distance needs. */
export function linearTicks(domain: Domain, count: number): Tick[] {
  // One number alone does not say what the distances are.
  let values: number[] = [];
  for (let more = Math.max(1, count); values.length < 2 && more <= count + 4; ++more) values = scaleLinear().domain(domain).ticks(more);
  const gap = values.length > 1 ? Math.abs(values[1]! - values[0]!) : Math.abs(values[0] ?? 1);
  const largest = Math.max(...values.map(Math.abs), 0);
  if (largest >= 1e6 || (largest > 0 && largest < 1e-3)) return values.map((value) => ({ value, label: formatNumber(value, 6) }));
  const decimals = gap > 0 ? Math.max(0, -Math.floor(Math.log10(gap) + 1e-9)) : 0;
  return values.map((value) => ({ value, label: (Object.is(value, -0) ? 0 : value).toFixed(decimals).replace("-", "−") }));
}

function logLabel(value: number): string {
  const exponent = Math.round(Math.log10(value));
  const power = Math.abs(Math.log10(value) - exponent) < 1e-9;
  if (power && (exponent < -3 || exponent > 4)) return powerOfTen(exponent);
  return formatNumber(value, 3);
}

/** Powers of ten; between them 2 and 5 where there is room; as on linear axes within a narrow range. Empty labels: minor ticks. */
export function logTicks(domain: Domain, count: number): Tick[] {
  const from = Math.floor(Math.log10(domain[0]) + 1e-9);
  const to = Math.ceil(Math.log10(domain[1]) - 1e-9);
  const decades = Math.log10(domain[1] / domain[0]);
  if (decades < 0.7) return linearTicks(domain, count).filter((tick) => tick.value > 0);
  const every = Math.max(1, Math.ceil((to - from) / Math.max(1, count)));
  const labelled = decades < 1.4 ? [1, 2, 3, 5, 7] : decades < 3 && count >= 4 ? [1, 2, 5] : [1];
  const ticks: Tick[] = [];
  for (let exponent = from; exponent <= to; ++exponent) {
    for (let digit = 1; digit <= 9; ++digit) {
      const value = Number(`${digit}e${exponent}`);
      if (value < domain[0] * (1 - 1e-9) || value > domain[1] * (1 + 1e-9)) continue;
      const shown = labelled.includes(digit) && (exponent - from) % every === 0;
      if (shown || decades < 5) ticks.push({ value, label: shown ? logLabel(value) : "" });
    }
  }
  return ticks;
}

export function makeScale(domain: Domain, range: Domain, log: boolean): Scale {
  const inner = (log ? scaleLog() : scaleLinear()).domain(domain).range(range);
  // The library answers undefined where there is no number.
  const scale = (value: number): number => (Number.isNaN(value) || (log && value <= 0) ? NaN : inner(value));
  return Object.assign(scale, {
    log,
    domain,
    invert: (pixel: number): number => inner.invert(pixel),
    ticks: (count: number): Tick[] => (log ? logTicks(domain, count) : linearTicks(domain, count)),
  });
}

/** A domain scaled about a value by a factor below 1 to come closer; within `whole`, never narrower than a millionth of it. */
export function zoomed(domain: Domain, whole: Domain, about: number, factor: number, log: boolean): Domain {
  const to = (v: number): number => (log ? Math.log(v) : v);
  const back = (v: number): number => (log ? Math.exp(v) : v);
  const full = to(whole[1]) - to(whole[0]);
  const width = Math.min(full, Math.max(1e-6 * full, (to(domain[1]) - to(domain[0])) * factor));
  const share = (to(about) - to(domain[0])) / (to(domain[1]) - to(domain[0]));
  const start = Math.min(Math.max(to(about) - share * width, to(whole[0])), to(whole[1]) - width);
  return width >= full ? whole : [back(start), back(start + width)];
}

/** A domain moved by a share of its width, within `whole`. */
export function moved(domain: Domain, whole: Domain, share: number, log: boolean): Domain {
  const to = (v: number): number => (log ? Math.log(v) : v);
  const back = (v: number): number => (log ? Math.exp(v) : v);
  const width = to(domain[1]) - to(domain[0]);
  const start = Math.min(Math.max(to(domain[0]) + share * width, to(whole[0])), to(whole[1]) - width);
  return [back(start), back(start + width)];
}
