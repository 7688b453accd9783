// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Numbers and names as readers see them.

import { ROUNDING } from "../numbers";

/** Four significant digits, with a minus sign; 0 for rounding errors, "–" where there is no number. */
export function brief(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size < ROUNDING) return "0";
  const text = size >= 1e6 || size < 1e-3 ? power(value) : size >= 1e4 ? value.toFixed(0) : trimmed(value.toPrecision(4));
  return text.replace("-", "−");
}

function trimmed(text: string): string {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

function power(value: number): string {
  const [mantissa = "", exponent = "0"] = value.toExponential(2).split("e");
  const digits = String(Math.abs(Number(exponent))).replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(d)] ?? d);
  return `${trimmed(mantissa)}·10${Number(exponent) < 0 ? "⁻" : ""}${digits}`;
}

/** "Pressure [MPa]". */
export function titled(label: string, unit: string): string {
  return unit === "" || unit === "1" ? label : `${label} [${unit}]`;
}

const words: Record<string, string> = {
  fn: "normal force Fₙ",
  fx: "longitudinal force Fₓ",
  fs: "lateral force Fₛ",
  mn: "spin moment Mₙ",
  pmax: "largest pressure pₘₐₓ",
  xi: "longitudinal creepage ξ",
  eta: "lateral creepage η",
  phi: "spin φ",
  dissipated: "friction power",
  t_gamma: "wear number Tγ",
  x_tr: "x in the track",
  y_tr: "y in the track",
  angle: "contact angle",
  rail_curvature_1: "rail, greater curvature",
  rail_curvature_2: "rail, lesser curvature",
  wheel_curvature_1: "wheel, greater curvature",
  wheel_curvature_2: "wheel, lesser curvature",
  pmax_refinement: "pₘₐₓ, change by smaller elements",
};

/** Units of the data that tables show otherwise. */
const shownAs: Record<string, { unit: string; factor: number }> = {
  N: { unit: "kN", factor: 1e-3 },
  rad: { unit: "°", factor: 180 / Math.PI },
};

/** "pmax_MPa" as words and unit, and by what its value is multiplied for that unit. */
export function numberName(key: string): { label: string; unit: string; factor: number } {
  const match = /^(.+?)_(k?N|Nmm|Nm|mm2|mm_s|rad_mm|per_m|mm|um|MPa|GPa|Pa|J|W|rad_s|mrad|rad|deg|C|percent|s|kB|MB)$/.exec(key);
  const name = match?.[1] ?? key;
  const unit =
    { mm2: "mm²", um: "µm", mm_s: "mm/s", rad_s: "rad/s", rad_mm: "rad/mm", per_m: "1/m", deg: "°", C: "°C", percent: "%", Nmm: "N·mm" }[
      match?.[2] ?? ""
    ] ??
    match?.[2] ??
    "";
  return { label: words[name] ?? name.replace(/_/g, " "), ...(shownAs[unit] ?? { unit, factor: 1 }) };
}
