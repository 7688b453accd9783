// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A report with made-up numbers, for work on the views without the program.
import { createHash } from "node:crypto";

import type { ChartView, Frame, MapView, Numbers, ReportData, View } from "../src/data";
import { demoFields, demoFrame, demoSurfaces } from "./demo-contact";
import { Packer } from "./pack";

const steps = <T>(n: number, f: (k: number) => T): T[] => Array.from({ length: n }, (_, k) => f(k));
const lateralOf = (k: number): number => -2.5 + 0.5 * k;

function demoMap(blobs: string[]): MapView {
  const packer = new Packer(blobs);
  const nx = 220;
  const ny = 90;
  const values: number[] = [];
  for (let j = 0; j < ny; ++j)
    for (let i = 0; i < nx; ++i) {
      const u = (i - 140) / 18;
      const v = (j - 45) / 16;
      const wave = 12 * Math.sin(i / 9) * Math.cos(j / 14);
      values.push(i < 8 && j < 20 ? NaN : wave - 160 * Math.exp(-u * u - v * v));
    }
  const circle = steps(40, (k): [number, number] => [70 + 12 * Math.cos((2 * Math.PI * k) / 39), 2.3 + 14 * Math.sin((2 * Math.PI * k) / 39)]);
  const map: MapView = {
    type: "map",
    id: "deviation",
    x: { label: "Place around the wheel", unit: "mm" },
    y: { label: "Place across", unit: "mm" },
    value: { label: "Deviation from the mean section", unit: "µm", kind: "diverging" },
    nx,
    ny,
    x0: 0,
    dx: 0.5,
    y0: -20,
    dy: 0.5,
    values: packer.codes(values, "u16"),
    marks: [{ label: "flat", points: circle }],
  };
  packer.close();
  return map;
}

const figures: { id: string; type: string; title: string; note: string; section: string }[] = [
  { id: "scene", type: "scene", title: "Wheel on rail", note: "Deviations are drawn to scale.", section: "contact" },
  { id: "contact", type: "contact", title: "Contact patches", note: "Tractions act on the rail.", section: "contact" },
  { id: "forces", type: "chart", title: "Forces and pressure by case", note: "Click or drag to choose a case.", section: "cases" },
  { id: "profile", type: "chart", title: "Pressure along the patch", note: "", section: "cases" },
  { id: "convergence", type: "chart", title: "Error by size of the elements", note: "", section: "checks" },
  { id: "solvers", type: "chart", title: "Time by solver", note: "", section: "checks" },
  { id: "deviation", type: "map", title: "Deviation of the wheel", note: "", section: "checks" },
  { id: "sketch", type: "picture", title: "A picture of the program", note: "", section: "checks" },
];

function forcesChart(): ChartView {
  const n = 26;
  return {
    type: "chart",
    id: "forces",
    linked: true,
    x: null,
    panels: [
      {
        label: "Force",
        unit: "kN",
        scale: "linear",
        series: [
          { name: "Normal, tread", y: steps(n, (k) => 80 - Math.max(0, lateralOf(k) - 6) * 14), marks: "both" },
          { name: "Normal, flange", y: steps(n, (k) => (lateralOf(k) > 6 ? (lateralOf(k) - 6) * 15 : null)), marks: "both" },
          { name: "Creep, lateral", y: steps(n, (k) => 22 * Math.tanh(lateralOf(k) / 4)), marks: "line", dashed: true },
        ],
        levels: [{ value: 80, label: "static load" }],
      },
      {
        label: "Largest pressure",
        unit: "MPa",
        scale: "log",
        series: [{ name: "Largest pressure", y: steps(n, (k) => (lateralOf(k) > 6 ? 1400 * Math.exp((lateralOf(k) - 6) / 3) : 1050 - 25 * lateralOf(k))), marks: "both" }],
        levels: [{ value: 1500, label: "limit of the material" }],
      },
    ],
    by_step: null,
  };
}

function profileChart(): ChartView {
  const x = steps(121, (i) => -9 + 0.15 * i);
  const section = (k: number, scale: number): Numbers => x.map((v) => scale * (1050 - 25 * lateralOf(k)) * Math.sqrt(Math.max(0, 1 - (v / (6.5 - 0.15 * lateralOf(k))) ** 2)));
  return {
    type: "chart",
    id: "profile",
    linked: false,
    x: { label: "Place along the patch", unit: "mm", scale: "linear", values: [] },
    panels: [{ label: "Pressure", unit: "MPa", scale: "linear", series: [{ name: "Pressure", y: [] }, { name: "Bound of friction", y: [], dashed: true }], levels: [] }],
    by_step: steps(26, (k) => ({ x, y: [[section(k, 1), section(k, 0.35)]] })),
  };
}

function convergenceChart(): ChartView {
  const h = [0.8, 0.4, 0.2, 0.1, 0.05];
  return {
    type: "chart",
    id: "convergence",
    linked: false,
    x: { label: "Size of an element", unit: "mm", scale: "log", values: h },
    panels: [
      {
        label: "Error of the largest pressure",
        unit: "%",
        scale: "log",
        series: [
          { name: "Boundary elements", y: h.map((v) => 3.1 * v ** 1.6), marks: "both", texts: h.map((v) => `${Math.round(20 / v)} × ${Math.round(15 / v)} elements`) },
          { name: "Half-ellipsoid by strips", y: h.map((v) => 4 * v + 0.9), marks: "both" },
          { name: "Measured once", x: [0.3, 0.15], y: [0.7, null], marks: "points", steps: [3, 4] },
        ],
        levels: [{ value: 1, label: "1 %" }],
      },
    ],
    by_step: null,
  };
}

function solversChart(): ChartView {
  const labels = ["Strips", "Boundary elements", "Boundary elements with tangential tractions", "Hertz"];
  return {
    type: "chart",
    id: "solvers",
    linked: false,
    x: { label: "Solver", unit: "", scale: "linear", values: [0, 1, 2, 3], labels },
    panels: [{ label: "Median time", unit: "ms", scale: "log", series: [{ name: "One core", y: [2.1, 48, 390, 0.02], marks: "points" }, { name: "Four cores", y: [1.2, 17, 160, 0.02], marks: "points" }], levels: [] }],
    by_step: null,
  };
}

/** Chart of many instants: thin peaks in a long history. */
function historyChart(n: number): ChartView {
  const noise = (k: number): number => Math.sin(k * 0.37) * 3 + Math.sin(k * 0.013) * 6 + (k % 1571 === 700 ? 60 : 0);
  return {
    type: "chart",
    id: "forces",
    linked: true,
    x: null,
    panels: [
      { label: "Normal force", unit: "kN", scale: "linear", series: [{ name: "Left", y: steps(n, (k) => 80 + noise(k)) }, { name: "Right", y: steps(n, (k) => (k > 9000 && k < 9500 ? null : 78 - 0.7 * noise(k + 400))), dashed: true }], levels: [{ value: 120, label: "limit" }] },
      { label: "Lateral place", unit: "mm", scale: "linear", series: [{ name: "Wheelset", y: steps(n, (k) => 3 * Math.sin(k / 900)) }], levels: [] },
    ],
    by_step: null,
  };
}

function demoData(kind: "run" | "simulation"): ReportData {
  const blobs: string[] = [];
  const surfaces = demoSurfaces(blobs);
  const long = kind === "simulation";
  const frames: Frame[] = long
    ? steps(400, (k) => demoFrame(`t = ${(k * 0.0025).toFixed(4)} s`, 3 + 6.2 * Math.sin(k / 40), 0.3 + 0.25 * Math.sin(k / 25), 20 * k, blobs))
    : steps(26, (k) => demoFrame(`y = ${lateralOf(k).toFixed(1)} mm`, lateralOf(k), 0.15 + 0.03 * k, 0, blobs));
  const count = long ? 20000 : 26;
  const packer = new Packer(blobs);
  const views: View[] = figures.flatMap((figure): View[] => {
    switch (figure.id) {
      case "scene":
        return [{ type: "scene", id: "scene", set: 0 }];
      case "contact":
        return [{ type: "contact", id: "contact", sets: [0] }];
      case "forces":
        return [long ? historyChart(count) : forcesChart()];
      case "profile":
        return long ? [] : [profileChart()];
      case "convergence":
        return [convergenceChart()];
      case "solvers":
        return [solversChart()];
      case "deviation":
        return [demoMap(blobs)];
      default:
        return [{ type: "picture", id: "sketch" }];
    }
  });
  const data: ReportData = {
    format: "treadmark report 1",
    kind,
    title: long ? "Simulation of a wheelset" : "Lateral displacement of a worn wheel",
    timeline: {
      label: long ? "instant" : "case",
      names: long ? null : frames.map((frame, k) => `case ${k + 1}: ${frame.name}`),
      count,
      frames: long ? packer.f32(steps(count, (k) => (k % 50 === 0 ? k / 50 : Math.floor(k / 50)))) : steps(26, (k) => (k === 20 ? null : k)),
      axes: long
        ? [
            { label: "t", unit: "s", scale: "linear", values: steps(count, (k) => k * 5e-5) },
            { label: "Distance along the track", unit: "m", scale: "linear", values: steps(count, (k) => k * 1e-3 + 12) },
          ]
        : [
            { label: "Case", unit: "", scale: "linear", values: steps(26, (k) => k + 1) },
            { label: "Lateral displacement", unit: "mm", scale: "linear", values: steps(26, lateralOf) },
          ],
    },
    fields: demoFields,
    sets: [{ name: "run", nominal: long ? 0 : 5, frames }],
    surfaces,
    views,
    blobs,
    document: { note: "made-up numbers" },
  };
  packer.close();
  return data;
}

function html(text: string): string {
  return text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
}

const picture = `<svg xmlns="http://www.w3.org/2000/svg" width="640" height="180" viewBox="0 0 640 180"><rect width="640" height="180" fill="white"/><circle cx="160" cy="90" r="70" fill="none" stroke="black"/><path d="M40 165H600" stroke="black"/><text x="300" y="90" font-family="sans-serif">Sketch</text></svg>`;

function figureHtml(figure: (typeof figures)[number]): string {
  const plot = figure.type === "picture" ? `<img class="picture" alt="${html(figure.title)}" src="data:image/svg+xml;base64,${Buffer.from(picture).toString("base64")}">` : "";
  const note = figure.note ? `<p class="view-note">${html(figure.note)}</p>` : "";
  return `<figure class="view" id="${figure.id}" data-view="${figure.type}"><figcaption>${html(figure.title)}</figcaption><div class="plot">${plot}</div>${note}</figure>`;
}

function tableHtml(): string {
  const rows = steps(26, (k) => {
    const value = (v: number, digits = 4): string => (Number.isNaN(v) ? '<td class="number">–</td>' : `<td class="number" data-value="${v}">${Number(v.toPrecision(digits))}</td>`);
    const y = lateralOf(k);
    const flange = y > 6 ? (y - 6) * 15 + 1 / 3 : NaN;
    return `<tr data-step="${k}">${value(k + 1)}<td>y = ${y.toFixed(1)} mm</td>${value(y)}${value(80 / 3 + 50)}${value(flange)}${value(1050 - 25.123456789 * y)}${value(0.15 + 0.03 * k)}<td>${y > 9.3 ? "not converged" : "ok"}</td></tr>`;
  });
  const heads = [["Case", ""], ["Name", ""], ["y", "mm"], ["Normal force", "kN"], ["Flange force", "kN"], ["Largest pressure", "MPa"], ["Creep", "%"], ["Status", ""]];
  const th = heads.map(([label, unit]) => `<th scope="col" data-unit="${unit ?? ""}">${label ?? ""}${unit ? ` <span class="unit">[${unit}]</span>` : ""}</th>`).join("");
  return `<div class="table-frame"><table class="data" id="table-cases" data-name="cases"><caption>Cases</caption>\n<thead><tr>${th}</tr></thead>\n<tbody>\n${rows.join("\n")}\n</tbody></table></div>`;
}

/** The page as the program writes it. */
export function demoPage(kind: "run" | "simulation", style: string, script: string): string {
  const data = demoData(kind);
  const ids = new Set(data.views.map((view) => view.id));
  const figuresOf = (section: string): string => figures.filter((f) => f.section === section && ids.has(f.id)).map(figureHtml).join("\n");
  const cards = [
    ["Largest pressure", "2403 MPa", "case 26, flange"],
    ["Normal force", "80.0 kN", "all cases"],
    ["Share of slip", "93 %", "case 26"],
    ["Frictional power", "1.42 kW", "at 30 m/s"],
    ["Time", "3.8 s", "26 cases"],
  ].map(([a, b, c]) => `<div class="card"><span class="card-label">${a}</span><span class="card-value">${b}</span><span class="card-note">${c}</span></div>`).join("");
  const facts = [
    ["Version", "0.2.0"],
    ["Case file", "lateral-displacement.toml"],
    ["Wheel", "S1002, worn, with a flat of 60 mm"],
    ["Rail", "60E1, corrugated, inclined 1:40"],
    ["Elements", "80 × 60, 0.25 mm"],
    ["Checksum", "9f2c6b1e0a7d4c5a8812f0b3d7e6a94410c3f2b7"],
  ].map(([a, b]) => `<div><dt>${a}</dt><dd>${b}</dd></div>`).join("");
  const section = (id: string, title: string, body: string): string => `<section id="${id}" aria-labelledby="${id}-title"><h2 id="${id}-title">${title}</h2>\n${body}\n</section>`;
  const hash = (text: string): string => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
  const csp = `default-src 'none'; style-src ${hash(`\n${style}`)}; script-src ${hash(`\n${script}\n`)}; img-src data: blob:; base-uri 'none'; form-action 'none'`;
  return `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${csp}"><meta name="color-scheme" content="light dark">
<title>${html(data.title)}</title><style>
${style}</style></head>
<body data-kind="${kind}">
<header class="page-head"><h1>${html(data.title)}</h1><p class="lead">Run of 26 cases with made-up numbers, for work on the page.</p>
<nav class="sections" aria-label="Sections"><a href="#overview">Overview</a><a href="#contact-section">Contact</a><a href="#cases">Cases</a><a href="#checks">Checks</a><a href="#input">Input</a></nav></header>
<div id="toolbar"></div>
<div id="timeline" hidden></div>
<main>
${section("overview", "Overview", `<div class="banner warning" role="alert"><strong>Two cases did not converge.</strong> Cases 25 and 26 stopped at a residual of 3e-4.</div>
<div class="banner failed" role="alert"><strong>One case failed.</strong> Case 21: the bodies have no contact at this displacement.</div>
<div class="banner note" role="status"><strong>Fields were thinned.</strong> The file holds every second frame.</div>
<div class="cards">${cards}</div><dl class="facts">${facts}</dl>`)}
${section("contact-section", "Contact", figuresOf("contact"))}
${section("cases", "Cases", figuresOf("cases") + tableHtml())}
${section("checks", "Checks", figuresOf("checks"))}
${section("input", "Input", `<p>The case file as it was read.</p><pre class="listing">[wheel]\nprofile = "S1002"\n\n[rail]\nprofile = "60E1"\ninclination = 0.025</pre>`)}
</main>
<footer><p>Made by Treadmark 0.2.0 (demo).</p></footer>
<script type="application/json" id="treadmark-data">${JSON.stringify(data).replace(/</g, "\\u003c")}</script>
<script>
${script}
</script>
</body></html>
`;
}
