// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The view in space in a browser that draws with the processor: pictures of its views, pictures a second while stepping, picking.
// usage: node test/scene.browser.mjs [--out DIR] [--browser FILE] [--only rate,light,dark,phone,phone-dark] [--fast N]: pictures a second wanted
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs } from "node:util";

import { build } from "esbuild";
import { chromium } from "playwright-core";

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({
  options: { out: { type: "string", default: join(here, "..", "dist", "scene") }, browser: { type: "string", default: "/usr/bin/chromium" }, only: { type: "string", default: "" }, fast: { type: "string", default: "30" } },
});
const out = resolve(values.out);
mkdirSync(out, { recursive: true });

const common = { absWorkingDir: here, bundle: true, logLevel: "warning" };
await build({ ...common, entryPoints: ["scene-page.ts"], outfile: join(out, "page.js"), format: "iife", target: "es2020", minify: true });
await build({ ...common, entryPoints: ["scene-demo.ts"], outfile: join(out, "demo.mjs"), format: "esm", platform: "node" });
const { sceneDemo } = await import(pathToFileURL(join(out, "demo.mjs")).href);
const style = ["style.css", "scene.css"].map((name) => readFileSync(join(here, "..", "..", name), "utf8")).join("\n");
const script = readFileSync(join(out, "page.js"), "utf8").replace(/<\/script/gi, "<\\/script");
const data = JSON.stringify(sceneDemo()).replace(/</g, "\\u003c");

function page(theme) {
  return `<!doctype html><html lang="en" data-theme="${theme}"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Scene</title><style>${style}</style></head><body><main><section><figure class="view" id="scene" data-view="scene">
<figcaption>Wheel on rail</figcaption><div class="plot"></div></figure></section></main>
<script type="application/json" id="treadmark-data">${data}</script><script>${script}</script></body></html>`;
}

const browser = await chromium.launch({
  executablePath: values.browser,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const failures = [];
const check = (holds, what) => {
  if (!holds) failures.push(what);
  console.log(`${holds ? "ok  " : "FAIL"} ${what}`);
};

async function settle(tab) {
  let before = "";
  for (let k = 0; k < 40; ++k) {
    await tab.waitForTimeout(300);
    const now = await tab.getAttribute("#scene", "data-pictures");
    if (now === before) return;
    before = now;
  }
}

async function open(theme, width, height, scale = 1) {
  const file = join(out, `scene-${theme}.html`);
  writeFileSync(file, page(theme));
  const context = await browser.newContext({ viewport: { width, height }, deviceScaleFactor: scale, hasTouch: width < 500 });
  const tab = await context.newPage();
  tab.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall/.test(message.text())) failures.push(`console: ${message.text()}`);
  });
  tab.on("pageerror", (error) => failures.push(`page: ${error.message}`));
  await tab.goto(pathToFileURL(file).href);
  await tab.waitForFunction(() => document.getElementById("scene").dataset.ready === "true", null, { polling: 200, timeout: 60000 });
  await settle(tab);
  return tab;
}

async function pictures(theme, name, width, height, scale) {
  const tab = await open(theme, width, height, scale);
  const shot = async (what) => {
    await settle(tab);
    await tab.locator("#scene").screenshot({ path: join(out, `${name}-${what}.png`) });
  };
  await tab.evaluate(() => window.store.setStep(8));
  for (const view of ["contact", "along", "above", "below", "whole"]) {
    await tab.click(`[data-view="${view}"]`);
    await shot(view);
  }
  await tab.click('[data-view="whole"]');
  if (width < 700) await tab.click(".scene-options summary");
  await tab.locator("[name=deviation]").check();
  await tab.locator("[name=exaggeration]").selectOption("50");
  await tab.locator("[name=mesh]").check();
  await shot("deviation");
  await tab.locator("[name=exaggeration]").selectOption("1");
  await tab.locator("[name=field]").selectOption("state");
  await tab.click('[data-view="contact"]');
  await tab.evaluate(() => window.store.setStep(13));
  await shot("flat");
  const box = await tab.locator(".scene-canvas").boundingBox();
  await tab.locator("[name=field]").selectOption("pressure");
  await tab.locator("[name=deviation]").uncheck();
  await tab.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await shot("picked");
  check(Number(await tab.getAttribute("#scene", "data-picked")) > 100, `${name}: a click on the middle of the patch reads its pressure`);
  const wide = await tab.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  check(wide <= 0, `${name}: the page does not scroll sideways`);
  await tab.context().close();
}

/** Processor time of all processes of the browser so far [ms]; Linux counts it in hundredths of a second. */
function processorTime(root) {
  const all = readdirSync("/proc").filter((name) => /^\d+$/.test(name)).map((id) => {
    try {
      const text = readFileSync(`/proc/${id}/stat`, "utf8");
      const words = text.slice(text.lastIndexOf(")") + 2).split(" ");
      return { id, parent: words[1], time: 10 * (Number(words[11]) + Number(words[12])) };
    } catch {
      return null;
    }
  }).filter((process) => process);
  const family = new Set([String(root)]);
  for (let size = 0; size < family.size; ) {
    size = family.size;
    for (const { id, parent } of all) if (family.has(parent)) family.add(id);
  }
  return all.filter(({ id }) => family.has(id)).reduce((sum, { time }) => sum + time, 0);
}

async function rate(options) {
  const tab = await open("light", 990, 900);
  const box = await tab.locator(".scene-canvas").boundingBox();
  for (const [view, style] of options) {
    await tab.click(`[data-view="${view}"]`);
    if (style) await tab.locator("[name=wheel]").selectOption(style);
    await settle(tab);
    const [countBefore, timeBefore] = [Number(await tab.getAttribute("#scene", "data-pictures")), processorTime(process.pid)];
    const measured = await tab.evaluate(
      () =>
        new Promise((resolve) => {
          const figure = document.getElementById("scene");
          const warm = 30;
          let k = 0;
          let start = 0;
          let from = 0;
          const until = performance.now() + 7000;
          const next = (time) => {
            if (k === warm) [start, from] = [time, Number(figure.dataset.pictures)];
            globalThis.drawnTriangles = figure.dataset.drawn;
            if (k === warm + 90 || (k > warm && time > until)) return resolve(((Number(figure.dataset.pictures) - from) / (time - start)) * 1000);
            window.store.setStep(k++ % 26);
            requestAnimationFrame(next);
          };
          requestAnimationFrame(next);
        }),
    );
    const each = (processorTime(process.pid) - timeBefore) / (Number(await tab.getAttribute("#scene", "data-pictures")) - countBefore);
    const drawn = await tab.evaluate(() => document.querySelector(".scene-canvas").width);
    check(measured >= Number(values.fast), `${box.width.toFixed(0)} x ${box.height.toFixed(0)}, ${view} ${style ?? ""}: ${measured.toFixed(1)} pictures a second while stepping, ${each.toFixed(0)} ms of processor time each, drawn ${drawn} wide with ${await tab.evaluate(() => globalThis.drawnTriangles)} triangles`);
  }
  await tab.context().close();
}

const jobs = {
  rate: () => rate([["contact"], ["along"], ["above"], ["below"], ["whole"], ["whole", "glass"]]),
  light: () => pictures("light", "light", 990, 900),
  dark: () => pictures("dark", "dark", 990, 900),
  phone: () => pictures("light", "phone", 390, 844, 2),
  "phone-dark": () => pictures("dark", "phone-dark", 390, 844, 2),
};
for (const [name, job] of Object.entries(jobs)) if (!values.only || values.only.split(",").includes(name)) await job();
await browser.close();
for (const failure of failures) console.log(`failed: ${failure}`);
process.exitCode = failures.length > 0 ? 1 : 0;
