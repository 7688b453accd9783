// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// Colour maps that grow evenly in lightness and keep their order for readers with colour-blindness. The nodes were chosen
// in OKLab (lightness, blue-yellow and red-green); between them colours are mixed in OKLab.

export type Rgb = [number, number, number];
export type MapKind = "sequential" | "diverging";

type Lab = [number, number, number];

function toLinear(c: number): number {
  const v = c / 255;
  return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
}

function fromLinear(v: number): number {
  const c = v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
  return Math.min(255, Math.max(0, 255 * c));
}

/** OKLab of sRGB 0..255. */
export function toLab([r8, g8, b8]: Rgb): Lab {
  const r = toLinear(r8);
  const g = toLinear(g8);
  const b = toLinear(b8);
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

function fromLab([lightness, a, b]: Lab): Rgb {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    fromLinear(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    fromLinear(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    fromLinear(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

/** Nodes at equal distances, from deep blue over teal and green to pale yellow; from blue over near white to orange-brown. */
const nodes: Record<MapKind, Rgb[]> = {
  sequential: [
    [24, 22, 68],
    [36, 63, 118],
    [34, 104, 136],
    [38, 142, 136],
    [98, 176, 115],
    [178, 201, 92],
    [250, 226, 114],
  ],
  diverging: [
    [14, 52, 102],
    [46, 110, 172],
    [136, 184, 220],
    [242, 241, 238],
    [240, 176, 112],
    [202, 106, 30],
    [116, 50, 8],
  ],
};

const nodesLab: Record<MapKind, Lab[]> = {
  sequential: nodes.sequential.map(toLab),
  diverging: nodes.diverging.map(toLab),
};

function mix(kind: MapKind, t: number): Rgb {
  const lab = nodesLab[kind];
  const at = Math.min(1, Math.max(0, t)) * (lab.length - 1);
  const i = Math.min(lab.length - 2, Math.floor(at));
  const f = at - i;
  const from = lab[i]!;
  const to = lab[i + 1]!;
  const part = (k: 0 | 1 | 2): number => from[k] + f * (to[k] - from[k]);
  return fromLab([part(0), part(1), part(2)]);
}

/** Colour 0..255 at t in 0..1 (clamped); the middle of the diverging map is neutral. */
export function colourMap(kind: MapKind): (t: number) => Rgb {
  return (t) => {
    const [r, g, b] = mix(kind, Number.isNaN(t) ? 0 : t);
    return [Math.round(r), Math.round(g), Math.round(b)];
  };
}

const tables = new Map<string, Uint8Array>();

/** The map as `size` colours of four bytes (r, g, b, 255); made once and kept. */
export function lut(kind: MapKind, size = 256): Uint8Array {
  const key = `${kind} ${size}`;
  const known = tables.get(key);
  if (known) return known;
  const table = new Uint8Array(4 * size);
  const colour = colourMap(kind);
  for (let i = 0; i < size; ++i) {
    table.set(colour(i / Math.max(1, size - 1)), 4 * i);
    table[4 * i + 3] = 255;
  }
  tables.set(key, table);
  return table;
}

/** Of the states of an element: exterior (transparent), adhesion, slip, plastic; they differ in lightness too. */
export const STATE_COLOURS: readonly { name: string; rgb: Rgb; alpha: number }[] = [
  { name: "exterior", rgb: [128, 128, 128], alpha: 0 },
  { name: "adhesion", rgb: [46, 110, 172], alpha: 1 },
  { name: "slip", rgb: [240, 176, 112], alpha: 1 },
  { name: "plastic", rgb: [150, 40, 60], alpha: 1 },
];

/** CSS text of a colour. */
export function css([r, g, b]: Rgb): string {
  return `rgb(${r},${g},${b})`;
}

/** Lines of charts: a colour of the style sheet (--series-1 ...), a dash and a marker each, so that none needs its colour alone. */
export const SERIES_COUNT = 8;
const dashes = ["", "8 4", "2 3", "10 3 2 3", "16 4", "10 3 2 3 2 3", "5 5", "1.5 5"];

export function seriesColour(index: number): string {
  return `var(--series-${(index % SERIES_COUNT) + 1})`;
}

export function seriesDash(index: number): string {
  return dashes[index % dashes.length] ?? "";
}
