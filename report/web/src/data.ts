// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// The data of a report as the page holds them in #treadmark-data. C++ decides what is shown; the scripts show it.

export interface ReportData {
  format: "treadmark report 1";
  kind: "live" | "run" | "check" | "compare" | "bench" | "import" | "simulation" | "assessment" | "evolution" | "sweep" | "overlay";
  title: string;
  timeline: Timeline | null;
  /** Quantities that patches may have, in the order of the menu. */
  fields: FieldInfo[];
  /** Contact fields; run and simulation: one set; compare: one a candidate, the truth first; overlay: one a result. */
  sets: FrameSet[];
  surfaces: SurfaceData[];
  /** A view's id is the id of its <figure>. */
  views: View[];
  /** base64 of zlib (RFC 1950) streams. */
  blobs: string[];
  /** result.json, compare.json, ... as it lies in the folder. */
  document: unknown;
  /** Of pages that solve. */
  live?: LiveData;
}

/** What a page that solves starts from, and how treadmark.h names what the views show. */
export interface LiveData {
  /** Of the program that wrote the page, as tm_version_text begins. */
  version: string;
  /** The case, and the files that it names, as base64. */
  toml: string;
  files: Record<string, string>;
  /** Names of `treadmark list profiles`. */
  profiles: { wheel: string[]; rail: string[] };
  /** Of `treadmark list backends`, what needs no further library. */
  backends: string[];
  /** A field is one column times the factor, or the length of two. `shift`: of cases that are one, or are none. */
  fields: { name: string; columns: string[]; factor: number; shift?: boolean }[];
  /** Of Patch.numbers. */
  numbers: { key: string; name: string; factor: number; shift?: boolean }[];
}

/** An array of numbers: plain (null = NaN), or packed in a blob. */
export type Numbers = (number | null)[] | Packed;

/**
 * Numbers in an inflated blob. Those of several bytes are shuffled: all lowest bytes first, then the next ones, and so on.
 * u8, u16: value = low + step * code; with `none` the greatest code is NaN. f32: IEEE float, NaN possible.
 */
export interface Packed {
  blob: number;
  /** In bytes, in the inflated blob. */
  offset: number;
  count: number;
  type: "u8" | "u16" | "f32";
  low?: number;
  step?: number;
  none?: boolean;
  /** Instead of a blob: f32 numbers as they are. */
  values?: Float32Array;
}

export interface Axis {
  label: string;
  unit: string;
  scale: "linear" | "log";
  values: Numbers;
  /** Of a category axis, whose values are 0 .. n-1. */
  labels?: string[];
}

export interface Timeline {
  /** What a step is: "case", "instant", "run". */
  label: string;
  /** One a step; null: built from the first axis, "t = 0.123 s". */
  names: string[] | null;
  count: number;
  /** The step that is shown first, 0 unless given. */
  start?: number;
  /** A step's frame in every set; NaN = none; null: no fields. */
  frames: Numbers | null;
  /** What linked charts may have as x, at least one, `count` values each. */
  axes: Axis[];
}

export interface FieldInfo {
  name: string;
  label: string;
  unit: string;
  kind: "sequential" | "diverging" | "state";
  /** What it is in elements outside contact, where it is anything there. */
  outside?: "zero" | "value";
}

export interface FrameSet {
  name: string;
  /** Frame whose outline of contact is the nominal one. */
  nominal: number | null;
  frames: Frame[];
}

export interface Frame {
  name: string;
  status: "ok" | "no_contact" | "not_converged" | "failed";
  message: string;
  patches: Patch[];
  wheel: Placed | null;
  rail: Placed | null;
  /** What was left out of the file for its size. */
  trimmed?: string;
}

/** p_track = origin + R p_body, R row by row; the wheel's includes its pitch. */
export interface Placed {
  surface: number;
  origin_mm: [number, number, number];
  rotation: number[];
}

export interface Patch {
  name: string;
  nx: number;
  ny: number;
  /** Centre of the first element; x is forward (columns), s along the rail's profile (rows). */
  x0_mm: number;
  s0_mm: number;
  dx_mm: number;
  ds_mm: number;
  /** Of the grid's axes (x, s, n) in track axes. */
  origin_mm: [number, number, number];
  rotation: number[];
  /** Contact reference in the grid's axes. */
  reference_mm: [number, number];
  /** By FieldInfo.name, nx*ny, row after row of growing s, in the unit of FieldInfo; "state": 0 exterior 1 adhesion 2 slip 3 plastic. */
  values: Record<string, Packed>;
  /** fn_N, pmax_MPa, ... to show beside the picture. */
  numbers: Record<string, number | null>;
}

export interface SurfaceData {
  body: "wheel" | "rail";
  name: string;
  /** Stations. */
  nu: number;
  /** Points across. */
  nv: number;
  /** mm in the body's axes, station after station; NaN = no surface. */
  x: Packed;
  y: Packed;
  z: Packed;
  /** mm along the outward normal from the body's mean section. */
  deviation: Packed | null;
  /** The last station joins the first. */
  closed: boolean;
}

export type View = ChartView | ContactView | SceneView | SectionView | TrackView | MapView | CloudView | PictureView;

export interface Series {
  name: string;
  y: Numbers;
  /** Own abscissae; else the axis of the chart or, linked, of the timeline. */
  x?: Numbers;
  marks?: "line" | "points" | "both";
  dashed?: boolean;
  /** Hover text a point. */
  texts?: string[];
  /** Step of the timeline that a click on a point selects. */
  steps?: Numbers;
}

export interface Panel {
  label: string;
  unit: string;
  scale: "linear" | "log";
  /** Least range of the axis as a share of its values, 0 unless given: what differs less is no trend. */
  least_span?: number;
  series: Series[];
  levels: { value: number; label: string }[];
}

export interface ChartView {
  type: "chart";
  id: string;
  /** Series are aligned with the steps; the cursor is the current step, click and drag move it. */
  linked: boolean;
  /** A unit is as long upwards as across; of one panel. */
  to_scale?: boolean;
  /** Of charts that are not linked (values may be []). */
  x: Axis | null;
  panels: Panel[];
  /** What is drawn changes with the step: y[panel][series]. */
  by_step: { x: Numbers; y: Numbers[][] }[] | null;
}

export interface ContactView {
  type: "contact";
  id: string;
  sets: number[];
}

export interface SceneView {
  type: "scene";
  id: string;
  set: number;
}

export interface SectionView {
  type: "section";
  id: string;
  set: number;
  /** Other sets, whose bodies are drawn as dashed lines in the same plane. */
  over?: number[];
}

export interface TrackView {
  type: "track";
  id: string;
  set: number;
}

export interface MapView {
  type: "map";
  id: string;
  x: { label: string; unit: string };
  y: { label: string; unit: string };
  value: { label: string; unit: string; kind: "sequential" | "diverging" };
  nx: number;
  ny: number;
  x0: number;
  dx: number;
  y0: number;
  dy: number;
  values: Packed;
  /** Those of each step of the timeline; `values` are the last ones. */
  by_step?: Packed[];
  marks: { label: string; points: [number, number][] }[];
}

/** Points in space, in the axes of their wheel or rail [mm]. */
export interface CloudView {
  type: "cloud";
  id: string;
  body: "wheel" | "rail";
  x: Packed;
  y: Packed;
  z: Packed;
  /** Of the normals from straight out (-z, or the radius) towards +y [rad]. */
  tilt: Packed;
  /** What may colour the points, from -span to span: distances along the normals; NaN = a point of the other kind. */
  quantities: { label: string; unit: string; per_mm: number; span: number; values: Packed }[];
  /** What points without values are. */
  others: string;
  caption: string[];
}

export interface PictureView {
  type: "picture";
  id: string;
}
