// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

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

/** Pseudo key: longitudinal creepage of a round wheel [%], which says its pitch rate. */
export const CREEPAGE = "creepage";

export const controls: readonly Control[] = [
  row("wheelset.y_mm", "Lateral place y", "mm", 1e3, -12, 12, 0.1),
  row("wheelset.yaw_deg", "Yaw", "°", DEGREES, -3, 3, 0.01),
  row("wheelset.roll_deg", "Roll", "°", DEGREES, -1, 1, 0.01),
  row("wheelset.pitch_deg", "Pitch", "°", DEGREES, -30, 30, 0.1),
  row("wheelset.vertical_force_N", "Wheel load", "kN", 1e-3, 5, 200, 1, 1e3),
  row("wheelset.velocity_km_h", "Speed", "km/h", 3.6, 0, 400, 1),
  { ...row(CREEPAGE, "Creepage ξ", "%", 100, -5, 5, 0.01), name: "" },
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

export const shapeKey = (body: string, kind: "standard" | "file"): string => `${body}.shape.${kind}`;

/** The changes with one more; what it takes the place of goes. An empty value takes a change back. */
export function changed(before: Changes, key: string, value: string): Changes {
  const after = new Map(before);
  const rivals: Record<string, string[]> = {
    [ROLLING]: [CREEPAGE],
    [CREEPAGE]: [ROLLING],
    ...Object.fromEntries(["wheel", "rail"].flatMap((body) => [
      [shapeKey(body, "file"), [shapeKey(body, "standard")]],
      [shapeKey(body, "standard"), [shapeKey(body, "file")]],
    ])),
  };
  for (const rival of rivals[key] ?? []) after.delete(rival);
  if (value === "") after.delete(key);
  else after.set(key, value);
  return after;
}

/** As assignments of the program's --set. `numbers`: of the case with the other changes, in SI. */
export function assignments(changes: Changes, numbers: Readonly<Record<string, number>>): string[] {
  const list = [...changes].filter(([key]) => key !== CREEPAGE).map(([key, value]) => `${key}=${value}`);
  const creepage = changes.get(CREEPAGE);
  if (creepage !== undefined) {
    const [v, r] = [numbers["wheelset.velocity"] ?? NaN, numbers["wheelset.nominal_radius"] ?? NaN];
    list.push(`wheelset.vpitch_rad_s=${(-v / r) * (1 + Number(creepage) / 100)}`);
  }
  return list;
}

/** Behind "#"; files that were dropped are not in it. */
export function toAddress(changes: Changes): string {
  return [...changes].filter(([key]) => !key.endsWith(".file")).map((pair) => pair.map(encodeURIComponent).join("=")).join("&");
}

/** Of an address; null: it is one of a section. Only keys that the page offers count. */
export function fromAddress(hash: string): Changes | null {
  const text = hash.replace(/^#/, "");
  if (!text.includes("=")) return null;
  const known = new Set([...controls.map(({ key }) => key), ROLLING, shapeKey("wheel", "standard"), shapeKey("rail", "standard")]);
  const changes = new Map<string, string>();
  for (const pair of text.split("&")) {
    try {
      const [key = "", value = ""] = pair.split("=").map(decodeURIComponent);
      if (known.has(key) && value !== "") changes.set(key, value);
    } catch {
      continue;  // what is no text is no change
    }
  }
  return changes;
}

/** The shown value of a control. */
export function shownValue(control: Control, changes: Changes, numbers: Readonly<Record<string, number>>): number {
  const own = changes.get(control.key);
  if (own !== undefined) return Number(own) / control.perShown;
  return control.name === "" ? 0 : control.perSi * (numbers[control.name] ?? NaN);
}
