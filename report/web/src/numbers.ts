// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// Numbers as people read them.

const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** 10 to a whole power, with raised digits. */
export function powerOfTen(exponent: number): string {
  const digits = [...String(Math.abs(exponent))].map((digit) => superscripts[Number(digit)] ?? "").join("");
  return `10${exponent < 0 ? "⁻" : ""}${digits}`;
}

function withMinus(text: string): string {
  return text.replace("-", "−");
}

/** Below this, in the units that tables show, there is nothing but rounding. */
export const ROUNDING = 1e-12;

/** A number with so many significant digits; powers of ten where it is very large or small; a dash where there is none. */
export function formatNumber(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const magnitude = Math.abs(value);
  if (magnitude >= 1e6 || magnitude < 1e-4) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${withMinus(String(Number(mantissa)))}·${powerOfTen(Number(exponent))}`;
  }
  const rounded = Number(value.toPrecision(digits));
  // Digits before the point are never dropped: 12345, not 12340.
  return withMinus(String(magnitude >= 10 ** digits ? Math.round(value) : rounded));
}

/** A number with its unit; no blank before degrees. */
export function withUnit(text: string, unit: string): string {
  if (!unit || text === "–") return text;
  return unit === "°" ? `${text}°` : `${text} ${unit}`;
}

/** "Force [kN]", or the label alone. */
export function labelWithUnit(label: string, unit: string): string {
  return unit ? `${label} [${unit}]` : label;
}

/** Decimals that tell neighbouring values apart, at most 9. */
export function decimalsFor(values: ArrayLike<number>): number {
  let least = Infinity;
  for (let i = 1; i < values.length; ++i) {
    const gap = Math.abs(values[i]! - values[i - 1]!);
    if (gap > 0 && gap < least) least = gap;
  }
  if (!Number.isFinite(least)) return 3;
  // A value such as 0.25 needs more decimals than the magnitude of its gap says.
  for (let decimals = Math.max(0, -Math.floor(Math.log10(least) + 1e-9)); decimals < 9; ++decimals) {
    const scaled = least * 10 ** decimals;
    if (Math.abs(scaled - Math.round(scaled)) < 0.02 * Math.max(1, scaled)) return Math.min(9, decimals);
  }
  return 9;
}

export function fixed(value: number, decimals: number): string {
  return Number.isNaN(value) ? "–" : withMinus(value.toFixed(decimals).replace(/^-(0(?:\.0*)?)$/, "$1"));
}
