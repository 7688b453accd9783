// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Writes pages that hold the contact view alone, and with --shots pictures of them; prints how long a step takes to draw.
// usage: node test/contact-demo.mjs --out DIR [--shots] [--check] [--browser FILE]      (--check: uses the view and checks what it shows)
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import assert from "node:assert/strict";
import { parseArgs } from "node:util";

import { build } from "esbuild";
import { chromium } from "playwright-core";

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({
  options: {
    out: { type: "string", default: "dist" },
    shots: { type: "boolean", default: false },
    check: { type: "boolean", default: false },
    browser: { type: "string", default: "/usr/bin/chromium" },
  },
});
const out = resolve(values.out);
mkdirSync(out, { recursive: true });
const made = join(out, "contact-demo.mjs");
await build({
  absWorkingDir: here,
  entryPoints: ["contact-demo.ts"],
  outfile: made,
  bundle: true,
  platform: "node",
  format: "esm",
  target: "node18",
});
const { contactReport } = await import(pathToFileURL(made).href);
const starter = `
  import { mountContact } from "../src/contact/index";
  import { Store } from "../src/store";
  const data = JSON.parse(document.getElementById("treadmark-data").textContent);
  const store = new Store(data);
  window.store = store;
  if (matchMedia("(prefers-color-scheme: dark)").matches) store.setTheme("dark");
  for (const view of data.views) mountContact(document.getElementById(view.id), view, store);`;
const bundle = await build({
  stdin: { contents: starter, resolveDir: here, loader: "ts" },
  bundle: true,
  minify: true,
  format: "iife",
  charset: "ascii",
  target: "es2020",
  write: false,
});
const script = bundle.outputFiles[0].text;
const style = ["style.css", "contact.css"].map((name) => readFileSync(join(here, "..", "..", name), "utf8")).join("\n");

function page(report) {
  const data = JSON.stringify(report).replace(/</g, "\\u003c");
  return `<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>${report.title}</title>
<style>${style}</style></head><body data-kind="${report.kind}"><main><section><h2>${report.title}</h2>
<figure class="view" id="contact" data-view="contact"><figcaption>Contact patches</figcaption><div class="plot"></div><p class="view-note">Tractions act on the rail.</p></figure>
</section></main><script type="application/json" id="treadmark-data">${data}</script><script>${script}</script></body></html>`;
}

const pages = { run: page(contactReport("run", 26)), long: page(contactReport("run", 400)), compare: page(contactReport("compare", 6)) };
for (const [name, text] of Object.entries(pages)) {
  writeFileSync(join(out, `contact-${name}.html`), text);
  console.log(`contact-${name}.html: ${(text.length / 1e6).toFixed(2)} MB`);
}

/** Mean time of a step [ms] while every picture of the browser shows another step, as when the slider is drawn. */
const timeSteps = `new Promise((done) => {
  const count = store.data.timeline.count;
  let k = 0;
  const start = performance.now();
  const next = () => {
    if (k === 200) return done((performance.now() - start) / k);
    store.setStep((++k * 7) % count);
    requestAnimationFrame(next);
  };
  next();
})`;

const browser = await chromium.launch({
  executablePath: values.browser,
  args: ["--no-sandbox", "--disable-gpu", "--disable-frame-rate-limit", "--disable-gpu-vsync"],
});
for (const name of Object.keys(pages)) {
  const tab = await browser.newPage({ viewport: { width: 1280, height: 1000 } });
  const failures = [];
  tab.on("pageerror", (error) => failures.push(error.message));
  const start = Date.now();
  await tab.goto(pathToFileURL(join(out, `contact-${name}.html`)).href);
  await tab.waitForFunction("document.querySelector('#contact .cells') !== null");
  const opened = Date.now() - start;
  const cdp = await tab.context().newCDPSession(tab);
  await cdp.send("Performance.setTimeDomain", { timeDomain: "threadTicks" });
  await cdp.send("Performance.enable");
  const metrics = async () =>
    Object.fromEntries((await cdp.send("Performance.getMetrics")).metrics.map(({ name, value }) => [name, value]));
  const cold = await tab.evaluate(timeSteps);
  const before = await metrics();
  const warm = await tab.evaluate(timeSteps);
  const after = await metrics();
  const parts = ["ScriptDuration", "RecalcStyleDuration", "LayoutDuration", "TaskDuration"].map(
    (part) => `${part.replace("Duration", "").toLowerCase()} ${((1000 * (after[part] - before[part])) / 200).toFixed(1)}`,
  );
  console.log(
    `${name}: opened in ${opened} ms, step ${cold.toFixed(1)} ms first, ${warm.toFixed(1)} ms again (${parts.join(", ")})${failures.map((text) => `; FAILED: ${text}`).join("")}`,
  );
  await tab.close();
}
if (values.shots) {
  const shot = async (name, options, prepare = async () => undefined) => {
    const [kind] = name.split("-");
    const context = await browser.newContext(options);
    const tab = await context.newPage();
    tab.on("pageerror", (error) => console.log(`${name}: ${error.stack}`));
    await tab.goto(pathToFileURL(join(out, `contact-${kind}.html`)).href);
    await tab.waitForTimeout(300);
    await prepare(tab);
    await tab.waitForTimeout(300);
    await tab.locator("#contact").screenshot({ path: join(out, `shot-${name}.png`) });
    await context.close();
  };
  const step = (k) => (tab) => tab.evaluate(`store.setStep(${k})`);
  const set = (control, value) => (tab) => tab.locator(`[data-control="${control}"]`).selectOption(value);
  const tick = (control) => (tab) => tab.locator(`[data-control="${control}"]`).check();
  const all =
    (...tasks) =>
    async (tab) => {
      for (const task of tasks) await task(tab);
    };
  const wide = { viewport: { width: 1280, height: 1000 } };
  const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true };
  await shot("run-first", wide);
  await shot(
    "run-flat",
    wide,
    all(step(13), tick("arrows"), (tab) => tab.locator('[data-control="peak"]').click()),
  );
  await shot("run-state", wide, all(step(9), set("field", "state"), tick("arrows")));
  await shot("run-traction", wide, all(step(16), set("field", "traction_x"), tick("slip")));
  await shot("run-all", wide, all(step(24), set("patch", "2")));
  await shot("run-gap", wide, all(step(12), set("field", "gap")));
  await shot("run-none", wide, step(3));
  await shot("run-dark", { ...wide, colorScheme: "dark" }, all(step(11), tick("arrows")));
  await shot("run-phone", phone, all(step(13), tick("arrows")));
  await shot("compare-first", wide, step(2));
  await shot("compare-difference", wide, all(step(2), tick("difference")));
  await shot("compare-phone", { ...phone, colorScheme: "dark" }, step(2));
}

/** Uses the view as a reader does. */
async function check() {
  const context = await browser.newContext({ viewport: { width: 1280, height: 1400 }, acceptDownloads: true });
  const tab = await context.newPage();
  const failures = [];
  tab.on("pageerror", (error) => failures.push(error.message));
  await tab.goto(pathToFileURL(join(out, "contact-run.html")).href);
  await tab.waitForSelector("#contact .cells", { state: "attached" });
  const settle = () => tab.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
  const value = (field) => tab.locator(`[data-readout="${field}"]`).first().getAttribute("data-value");
  const text = (field) => tab.locator(`[data-readout="${field}"]`).first().textContent();
  const report = contactReport("run", 26);

  await tab.locator('[data-control="peak"]').click();
  await settle();
  const exact = report.sets[0].frames[0].patches[0].numbers.pmax_MPa;
  assert.ok(Math.abs(Number(await value("pressure")) / exact - 1) < 1e-3, "the peak is the largest pressure");
  assert.ok(Math.abs(Number(await tab.locator('[data-number="pmax_MPa"]').getAttribute("data-value")) - exact) === 0, "numbers are exact");
  const picked = await tab.evaluate("store.point");
  assert.equal(picked.set, 0);

  const picture = tab.locator(".contact-picture");
  await picture.focus();
  const x = Number(await value("x"));
  for (const key of ["ArrowRight", "ArrowRight", "ArrowUp"]) await picture.press(key);
  await settle();
  assert.ok(Math.abs(Number(await value("x")) - x - 0.5) < 1e-6, "arrow keys move by elements");
  assert.deepEqual(await tab.evaluate("store.point"), { ...picked, ix: picked.ix + 2, iy: picked.iy + 1 });
  await picture.press("PageDown");
  await settle();
  assert.equal(await tab.evaluate("store.step"), 1);
  assert.deepEqual(await tab.evaluate("store.point"), { ...picked, ix: picked.ix + 2, iy: picked.iy + 1 }, "the picked place stays");
  await picture.press("Home");
  await picture.press("Escape");
  await settle();
  assert.equal(await tab.evaluate("store.point"), null);

  await tab.evaluate("store.setPoint({ set: 0, patch: 0, ix: 30, iy: 25 })");
  await settle();
  assert.ok(Math.abs(Number(await value("x")) - (-9.875 + 30 * 0.25)) < 1e-6, "another view picks");

  const box = await tab.locator(".contact-picture svg").boundingBox();
  await tab.mouse.click(box.x + box.width * 0.35, box.y + box.height * 0.45);
  await settle();
  const here = await value("x");
  assert.equal(await value("x"), here);
  assert.equal(await text("state"), await value("state"));
  await tab.mouse.move(5, 5);
  await settle();
  assert.equal(await value("x"), here, "what was clicked stays when the pointer leaves");

  await tab.evaluate("store.setStep(3)");
  await settle();
  assert.equal(await value("pressure"), null);
  assert.match(await tab.locator(".contact-picture").textContent(), /no contact/);
  await tab.evaluate("store.setStep(4)");
  await settle();
  assert.match(await tab.locator(".contact-status").textContent(), /not converged.*residual.*left out/);

  for (const [part, names] of [
    ["left", ["SVG", "PNG", "CSV"]],
    ["sections", ["SVG", "PNG", "CSV"]],
  ])
    for (const name of names) {
      const [download] = await Promise.all([
        tab.waitForEvent("download"),
        tab.locator(`.contact-${part} .downloads button`, { hasText: name }).click(),
      ]);
      const file = join(out, `file-${part}.${name.toLowerCase()}`);
      await download.saveAs(file);
      const bytes = readFileSync(file);
      assert.ok(bytes.length > 1000, `${file} holds something`);
      if (name === "PNG") assert.equal(bytes.toString("latin1", 1, 4), "PNG");
      if (name === "SVG") {
        assert.ok(!bytes.includes("var(--"), "a file has no variables of the page");
        assert.equal(bytes.includes("data:image/png;base64,"), part === "left");
      }
    }
  assert.equal(readFileSync(join(out, "file-left.csv"), "utf8").trimEnd().split("\n").length, 1 + 80 * 60);
  assert.deepEqual(failures, []);
  await context.close();

  const hand = await browser.newContext({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const phone = await hand.newPage();
  await phone.goto(pathToFileURL(join(out, "contact-compare.html")).href);
  await phone.waitForSelector("#contact .cells", { state: "attached" });
  assert.ok(await phone.evaluate("document.documentElement.scrollWidth <= innerWidth"), "nothing is wider than a phone");
  await phone.locator('[data-control="difference"]').check();
  for (const field of ["state", "gap", "traction_s"]) await phone.locator('[data-control="field"]').selectOption(field);
  await hand.close();
  console.log("checks passed");
}
if (values.check) await check();
await browser.close();
