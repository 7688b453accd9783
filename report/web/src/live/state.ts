// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

import type { Given } from "./solve";

// What may be changed on a page that solves, and its changes as keys of case files and as an address.

/** A number of the case. */
export interface Control {
  /** In case files, with its unit. */
  key: string;
  /** In treadmark.h, in SI. */
  name: string;
  label: string;
  unit: string;
  /** Shown units a unit of SI, and units of the key a shown unit. */
  perSi: number;
  perShown: number;
  low: number;
  high: number;
  step: number;
}

const DEGREES = 180 / Math.PI;

function row(key: string, label: string, unit: string, perSi: number, low: number, high: number, step: number, perShown = 1): Control {
  return { key, name: key.replace(/_(mm|deg|N|km_h|rad_s)$/, ""), label, unit, perSi, perShown, low, high, step };
}

/** Pseudo key: how much faster than at its nominal radius a wheel turns [%], which says its pitch rate. */
export const CREEPAGE = "creepage";

export const controls: readonly Control[] = [
  row("wheelset.y_mm", "Lateral place y", "mm", 1e3, -12, 12, 0.1),
  row("wheelset.yaw_deg", "Yaw", "°", DEGREES, -3, 3, 0.01),
  row("wheelset.roll_deg", "Roll", "°", DEGREES, -1, 1, 0.01),
  row("wheelset.pitch_deg", "Pitch", "°", DEGREES, -30, 30, 0.1),
  row("wheelset.vertical_force_N", "Wheel load", "kN", 1e-3, 5, 200, 1, 1e3),
  row("wheelset.velocity_km_h", "Speed", "km/h", 3.6, 0, 400, 1),
  { ...row(CREEPAGE, "Nominal creepage", "%", 100, -5, 5, 0.01), name: "" },
  row("friction.coefficient", "Friction", "", 1, 0.02, 0.7, 0.01),
  row("track.cant_deg", "Cant of the rail", "°", DEGREES, -4, 4, 0.01),
  row("track.gauge_mm", "Gauge", "mm", 1e3, 1420, 1470, 0.1),
  row("wheelset.nominal_radius_mm", "Wheel radius", "mm", 1e3, 250, 625, 1),
];

/** How the wheel rolls. */
export const ROLLING = "wheelset.rolling";
export const rollings: readonly (readonly [string, string])[] = [
  ["", "as the case says"],
  ["free", "freely"],
  ["nominal", "at its nominal radius"],
  [CREEPAGE, "with a creepage"],
];

export type Changes = ReadonlyMap<string, string>;

/** What is solved: the text of a file with cases, which one of them (the first unless said), and what differs from it. */
export interface State {
  toml: string;
  number?: number;
  changes: Changes;
}

export const shapeKey = (body: string, kind: "standard" | "file"): string => `${body}.shape.${kind}`;
export const backendKey = (body: string): string => `${body}.backend`;

/** Before keys of what is solved at the same place to compare with. */
export const BESIDE = "beside.";
const SIDES = ["", BESIDE].flatMap((side) => ["wheel", "rail"].map((body) => side + body));

/** What a change takes the place of. */
const rivals: Readonly<Record<string, string>> = Object.fromEntries(
  [[ROLLING, CREEPAGE], ...SIDES.map((body) => [shapeKey(body, "file"), shapeKey(body, "standard")])].flatMap(([a, b]) => [
    [a!, b!],
    [b!, a!],
  ]),
);
const known = new Set([...controls.map(({ key }) => key), ...Object.keys(rivals), ...SIDES.map(backendKey)]);

/** The changes with one more; what it takes the place of goes. An empty value takes a change back. */
export function changed(before: Changes, key: string, value: string): Changes {
  const after = new Map(before);
  const rival = rivals[key];
  if (rival !== undefined) after.delete(rival);
  if (value === "") after.delete(key);
  else after.set(key, value);
  return after;
}

/** As the worker takes it: assignments of the program's --set, names of files in quotes, as they may look like numbers. */
export function givenOf({ toml, number, changes }: State): Given {
  const list = [...changes].filter(([key]) => key !== CREEPAGE && !key.startsWith(BESIDE));
  const given = { toml, ...(number === undefined ? {} : { number }), changes: list.map(([key, value]) => `${key}=${key.endsWith(".file") ? JSON.stringify(value) : value}`) };
  const creepage = changes.get(CREEPAGE);
  return creepage === undefined ? given : { ...given, creepage: Number(creepage) / 100 };
}

/** The same but for what the reader chose to see beside it; null: nothing. */
export function besideOf({ changes, ...rest }: State): State | null {
  const own = [...changes].filter(([key]) => key.startsWith(BESIDE));
  if (own.length === 0) return null;
  return { ...rest, changes: own.reduce((all, [key, value]) => changed(all, key.slice(BESIDE.length), value), changes) };
}

/** The case of a result file of a run (result.json); null: it holds none. */
export function tomlOf(result: unknown): string | null {
  const toml = (result as { input?: { toml?: unknown } } | null)?.input?.toml;
  return typeof toml === "string" ? toml : null;
}

const [CASE, NUMBER] = ["case", "number"];

/** Behind "#". `own`: the case of the page, which is not in it. */
export function toAddress({ toml, number, changes }: State, own: string): string {
  const pairs = [...(toml === own ? [] : [[CASE, toml]]), ...(number === undefined ? [] : [[NUMBER, String(number)]]), ...changes];
  return pairs.map((pair) => pair.map(encodeURIComponent).join("=")).join("&");
}

/** Of an address; null: it is one of a section. Only keys that the page offers count. */
export function fromAddress(hash: string, own: string): State | null {
  const text = hash.replace(/^#/, "");
  if (!text.includes("=")) return null;
  const changes = new Map<string, string>();
  let toml = own;
  let number: number | undefined;
  for (const pair of text.split("&")) {
    try {
      const [key = "", value = ""] = pair.split("=").map(decodeURIComponent);
      if (value === "") continue;
      if (key === CASE) toml = value;
      else if (key === NUMBER) number = Number(value);
      else if (known.has(key)) changes.set(key, value);
    } catch {
      continue;  // what is no text is no change
    }
  }
  return { toml, ...(number !== undefined && number > 0 && Number.isSafeInteger(number) ? { number } : {}), changes };
}

/** The shown value of a control. */
export function shownValue(control: Control, changes: Changes, numbers: Readonly<Record<string, number>>): number {
  const own = changes.get(control.key);
  if (own !== undefined) return Number(own) / control.perShown;
  return control.name === "" ? 0 : control.perSi * (numbers[control.name] ?? NaN);
}
