// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Opens reports of all kinds, made by the program from real results, in a browser and uses them as a reader would.
// usage: node --test test/reports.browser.mjs, with TREADMARK (program), TREADMARK_EXAMPLES and OUT (folders) and CHROMIUM in the environment;
// PICTURES=1 also takes screenshots of all pages, which no test looks at
import assert from "node:assert/strict";
import { mkdirSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import test, { after, before } from "node:test";
import { pathToFileURL } from "node:url";

import { unzipSync } from "fflate";
import { chromium } from "playwright-core";

import { clipped, flaws } from "./clipped.mjs";
import { Results } from "./results.mjs";

const folder = resolve(process.env.OUT ?? "dist/reports");
const pictures = join(folder, "screenshots");
const sizes = { desktop: { width: 1280, height: 900 }, phone: { width: 390, height: 844 } };
rmSync(folder, { recursive: true, force: true });
mkdirSync(pictures, { recursive: true });
const results = new Results(process.env.TREADMARK ?? "treadmark", process.env.TREADMARK_EXAMPLES, folder);

let browser;
before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader"],
  });
});
after(() => browser?.close());

/** Where the reader says which steps come on paper. */
const STEPS_ON_PAPER = ".print-menu input:not([type='checkbox'])";

const read = (name) => JSON.parse(readFileSync(join(folder, name), "utf8"));
const near = (value, wanted, bound, what) => assert.ok(Math.abs(value - wanted) <= bound, `${what}: ${value}, not ${wanted}`);

/** A page that complains about errors and requests when it is closed. */
class Tab {
  static async open(file, { size = "desktop", theme = "light", scripts = true } = {}) {
    const tab = new Tab();
    tab.context = await browser.newContext({ viewport: sizes[size], colorScheme: theme, acceptDownloads: true, javaScriptEnabled: scripts });
    tab.page = await tab.context.newPage();
    tab.wrong = [];
    tab.requests = [];
    tab.page.on("pageerror", (error) => tab.wrong.push(String(error)));
    tab.page.on("dialog", (dialog) => {
      tab.wrong.push(`dialog ${dialog.message()}`);
      void dialog.dismiss();
    });
    // What the processor's drawing says of its own slowness is not the page's fault.
    tab.page.on("console", (message) => ["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && tab.wrong.push(message.text()));
    tab.page.on("request", (request) => tab.requests.push(request.url()));
    await tab.page.goto(pathToFileURL(join(folder, file)).href);
    return tab;
  }

  async close() {
    assert.deepEqual(this.wrong, [], "errors of the page");
    assert.deepEqual(this.requests.filter((url) => !/^(data:|blob:)/.test(url)).slice(1), [], "requests besides the page itself");
    await this.context.close();
  }

  step() {
    return this.page.locator(".timeline-slider").evaluate((slider) => slider.valueAsNumber);
  }

  async waitForStep(step) {
    await this.page.waitForFunction((k) => document.querySelector(".timeline-slider").valueAsNumber === k, step, { polling: 50 });
  }

  async key(selector, key) {
    await this.page.locator(selector).first().focus();
    await this.page.keyboard.press(key);
  }

  value(field) {
    return this.page.locator(`[data-readout="${field}"]`).first().getAttribute("data-value");
  }

  /** Asks for the peak of a view until it has the value: on a busy machine the picture follows the slider late. */
  async waitForPeak(view, field, wanted, bound) {
    for (let tries = 1; ; ++tries) {
      await this.page.locator(`${view} [data-control='peak']`).first().click();
      try {
        await this.page.waitForFunction(
          ([name, value, most]) => Math.abs(Number(document.querySelector(`[data-readout="${name}"]`)?.getAttribute("data-value") ?? NaN) - value) <= most,
          [field, wanted, bound],
          { timeout: 2000 },
        );
        return;
      } catch (error) {
        if (tries === 30) throw new Error(`${field} is ${await this.value(field)}, not ${wanted}`, { cause: error });
      }
    }
  }

  /** Full-precision number of a table: row of a step, column by its heading. */
  cell(table, step, heading) {
    return this.page.locator(`#table-${table}`).evaluate(
      (element, [k, name]) => {
        const column = [...element.tHead.rows[0].cells].findIndex((cell) => cell.textContent.trim().startsWith(name));
        const row = [...element.tBodies[0].rows].find((one) => one.dataset.step === String(k));
        return Number(row.cells[column].dataset.value);
      },
      [step, heading],
    );
  }
}

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** What axe finds serious in a page as it is, its menu of printing open with a complaint. */
async function barriers(page) {
  const steps = page.locator(STEPS_ON_PAPER);
  const some = await steps.count();
  const menu = page.locator(".print-menu summary");
  if (await menu.count()) await menu.click();
  if (some) await steps.fill("0");
  await page.waitForTimeout(300);  // colours change gradually
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  if (some) await steps.fill("");
  return violations
    .filter(({ impact }) => ["serious", "critical"].includes(impact))
    .map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(" ")).slice(0, 3).join("; ")}`);
}

/** For people to look at, if they asked for it. */
async function screenshot(page, name, options = {}) {
  if (!process.env.PICTURES) return;
  await page.waitForTimeout(500);  // colours change gradually
  await page.screenshot({ path: join(pictures, `${name}.png`), ...options });
}

/** The page at both widths in both themes, if somebody asked for pictures. */
async function photograph(file, name, selector) {
  if (!process.env.PICTURES) return;
  for (const size of Object.keys(sizes)) {
    const tab = await Tab.open(file, { size });
    if (selector) {
      const place = tab.page.locator(selector).first();
      await place.evaluate((element) => {
        element.scrollIntoView({ block: "start", behavior: "instant" });
        window.scrollBy({ top: -60, behavior: "instant" });
      });
    }
    for (const theme of ["light", "dark"]) {
      await showTheme(tab.page, theme);
      await screenshot(tab.page, `${name}-${size}-${theme}`);
    }
    await tab.close();
  }
}

/** In the colours of a theme, which is dark or light indeed. */
async function showTheme(page, theme) {
  await page.emulateMedia({ colorScheme: theme });
  await page.waitForFunction(
    (wanted) => getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).reduce((sum, c) => sum + Number(c), 0) < 380 === wanted,
    theme === "dark",
  );
}

/** No text of the page as it is is cut off, no chart empty, no word on another. */
async function unspoilt(page, name, size) {
  assert.deepEqual(await page.evaluate(clipped, size === "paper"), [], `cut off in ${name}, ${size}`);
  assert.deepEqual(await page.evaluate(flaws, size === "desktop"), [], `flaws of ${name}, ${size}`);
  await screenshot(page, `${name}-${size}-whole`, { fullPage: true });
}

/** The same on A4, after it was read on a screen. `steps`: what the reader chooses for paper in the menu, which is open. */
async function readOnPaper(page, name, steps) {
  if (steps) {
    await page.locator(STEPS_ON_PAPER).fill(steps);
    assert.equal(await page.locator(".print-note").textContent(), "");
  }
  // Other pages would only try the browser.
  if (steps || process.env.PICTURES) await page.pdf({ path: join(pictures, `${name}.pdf`), format: "A4", preferCSSPageSize: true });
  // What is printed has gone again; for measuring it is made anew, as wide as A4 between its margins.
  await page.setViewportSize({ width: Math.floor(((210 - 2 * 14) / 25.4) * 96), height: 1016 });
  await page.emulateMedia({ media: "print" });
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  // What paper may not break through is no higher than a page.
  const high = await page.evaluate(() =>
    [...document.querySelectorAll("figure.view:not(.on-paper, .long, [data-view='contact']), figure.view svg, figure:not([data-view='contact']) .paper-step, .contact-side, .contact-values")]
      .filter((one) => one.getBoundingClientRect().height > ((297 - 2 * 14) / 25.4) * 96)
      .map((one) => `${one.closest("figure").id} ${one.className.baseVal ?? one.className}`),
  );
  assert.deepEqual(high, [], `higher than a page in ${name}`);
  await unspoilt(page, name, "paper");
  await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
}

/**
 * Every view of a page drawn at both widths, in both themes, and on A4: no text is cut off, nothing sticks out at the side, nothing stands in the
 * way of readers who use other means.
 */
async function readWhole(file, name, steps = "") {
  for (const [size, themes] of [["phone", ["light", "dark"]], ["desktop", ["dark", "light"]]]) {
    const tab = await Tab.open(file, { size });
    const { page } = tab;
    for (const view of await page.locator("figure.view").all()) {
      await view.evaluate((element) => element.scrollIntoView({ block: "center", behavior: "instant" }));
      await page.waitForTimeout(250);
    }
    const [wide, window] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
    assert.ok(wide <= window, `${name} is ${wide} wide in a window of ${window}`);
    for (const theme of themes) await showTheme(page, theme);
    await unspoilt(page, name, size);
    assert.deepEqual(await barriers(page), [], `${name}, ${size}`);
    if (size === "desktop") await readOnPaper(page, name, steps);
    await tab.close();
  }
}

test("a wheel flat in 26 positions", async () => {
  const file = results.run();
  assert.ok(statSync(join(folder, file)).size < 8e6);
  const json = read("run/result.json");
  const tab = await Tab.open(file);
  const { page } = tab;
  assert.equal(await page.locator(".banner.failed").count(), 0);
  for (let k = 0; k < 26; ++k) {
    const patch = json.cases[k].patches.reduce((a, b) => (a.fn_N > b.fn_N ? a : b));
    const most = Math.max(...json.cases[k].patches.map((one) => one.pmax_MPa));
    near(await tab.cell("cases", k, "p_max"), most, 1e-9 * most, `largest pressure of case ${k + 1}`);
    near(await tab.cell("patches", k, "F_n"), json.cases[k].patches[0].fn_N / 1e3, 1e-9 * patch.fn_N, `force of case ${k + 1}`);
  }
  // The slider moves the patches: the peak of each position that is chosen has the pressure of the result file.
  await page.locator("#patches-view [data-control='peak']").waitFor();
  for (const [key, k] of [["Home", 0], ["End", 25], ["PageUp", undefined], ["ArrowLeft", undefined]]) {
    await tab.key(".timeline-slider", key);
    const step = await tab.step();
    if (k !== undefined) assert.equal(step, k);
    const patch = json.cases[step].patches.reduce((a, b) => (a.fn_N > b.fn_N ? a : b));
    await tab.waitForPeak("#patches-view", "pressure", patch.pmax_MPa, 2e-4 * patch.pmax_MPa);
    assert.equal(await page.locator("#table-cases tr.current").getAttribute("data-step"), String(step));
  }
  // A row of the table chooses its case, another quantity is shown.
  await page.locator("#table-cases tr[data-step='12'] td").first().click();
  await tab.waitForStep(12);
  await page.locator("#patches-view [data-control='field']").selectOption("traction");
  // More than nothing, and no more than friction lets through.
  const half = 0.5 * 0.3001 * json.cases[12].patches[0].pmax_MPa;
  await tab.waitForPeak("#patches-view", "traction", half, 0.9999 * half);
  // Files: pictures and numbers.
  for (const kind of ["SVG", "PNG", "CSV"]) {
    const [file] = await Promise.all([page.waitForEvent("download"), page.locator("#patches-view .downloads button", { hasText: kind }).first().click()]);
    assert.ok(statSync(await file.path()).size > 500, kind);
  }
  await tab.close();
  await photograph(file, "run", "#contact");
  await readWhole(file, "run", "1, 13-14");
});

test("paper has the chosen cases, each with its own picture, and the view in space that was never in sight", async () => {
  const tab = await Tab.open("run.html");
  const { page } = tab;
  await page.locator(".print-menu summary").click();
  const input = page.locator(STEPS_ON_PAPER);
  await input.fill("3-99");
  assert.match(await page.locator(".print-note").textContent(), /“3-99” is not within 1 to 26/);
  await input.fill("1, 13-14");
  const pressures = await page.evaluate(() => {
    window.dispatchEvent(new Event("beforeprint"));
    const painted = (canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value > 0);
    return ["patches-view", "scene"].map((id) =>
      [...document.querySelectorAll(`#${id} .paper-step`)].map((step) => ({
        name: step.querySelector(".paper-name").textContent,
        picture: step.querySelector("canvas").toDataURL(),
        painted: id === "scene" || painted(step.querySelector("canvas")),
        text: step.textContent,
      })),
    );
  });
  const json = read("run/result.json");
  for (const steps of pressures) {
    assert.deepEqual(steps.map(({ name }) => Number(/^case (\d+) of 26/.exec(name)[1])), [1, 13, 14]);
    assert.equal(new Set(steps.map(({ picture }) => picture)).size, 3, "pictures differ");
    assert.ok(steps.every(({ painted }) => painted));
  }
  pressures[0].forEach(({ text }, k) => assert.ok(text.includes(String(Math.round(json.cases[[0, 12, 13][k]].patches[0].pmax_MPa))), text));
  // Afterwards the page is as it was.
  await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
  assert.equal(await page.locator(".paper-step, .scene-print").count(), 0);
  await tab.close();
});

test("the view in space shows wheel, rail and patch and is picked", async () => {
  const tab = await Tab.open("run.html");
  const { page } = tab;
  await page.locator("#scene").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelector("#scene").dataset.ready === "true", undefined, { polling: 200 });
  assert.ok(Number(await page.locator("#scene").getAttribute("data-triangles")) > 2000);
  const canvas = page.locator("#scene canvas").first();
  await canvas.evaluate((element) => element.scrollIntoView({ block: "center", behavior: "instant" }));
  const box = await canvas.boundingBox();
  // Somewhere near the middle there is the patch.
  let picked = null;
  for (const [dx, dy] of [[0, 0], [0, -15], [0, 15], [20, 0], [-20, 0], [30, -20], [-30, 20], [40, 10], [-40, -10], [0, 40], [0, -40]]) {
    await page.mouse.click(box.x + box.width / 2 + dx, box.y + box.height / 2 + dy);
    await page.waitForFunction(() => document.querySelector("#scene").dataset.picked, undefined, { timeout: 1000 }).catch(() => undefined);
    picked = await page.locator("#scene").getAttribute("data-picked");
    if (picked) break;
  }
  assert.ok(Number(picked) > 0, `picked ${picked}`);
  await tab.close();
  await photograph("run.html", "scene", "#scene");
});

test("contact lies in the track where the result file says, over its section, on the named side", async () => {
  const json = read("run/result.json");
  const tab = await Tab.open("run.html");
  const { page } = tab;
  await page.locator("#positions").scrollIntoViewIfNeeded();
  await page.waitForSelector("#positions .track-panel", { state: "attached" });
  const panels = await page.locator("#positions .track-panel").evaluateAll((all) =>
    all.map((panel) => {
      const ticks = [...panel.querySelectorAll("text")].map((text) => [Number(text.textContent), Number(text.getAttribute("x"))]).filter(([value]) => value > 700);
      const [[y0, x0], [y1, x1]] = [ticks[0], ticks.at(-1)];
      const dot = Number(panel.querySelector("circle").getAttribute("cx"));
      return {
        head: panel.querySelector("text").textContent,
        y: y0 + ((dot - x0) / (x1 - x0)) * (y1 - y0),
        scale: (x1 - x0) / (y1 - y0),
        sides: [...panel.querySelectorAll("text")].filter(({ textContent }) => / side$/.test(textContent)).map((text) => text.textContent),
        curves: panel.querySelectorAll("path[stroke-width='1.5']").length,
        images: panel.querySelectorAll("image").length,
      };
    }),
  );
  assert.ok(panels.length > 12 && panels.length <= 24);
  assert.ok(panels.some(({ head }) => head === `case ${1 + json.cases.findIndex((one) => one.patches[0].pmax_MPa === Math.max(...json.cases.map((c) => c.patches[0].pmax_MPa)))}`));
  for (const { head, y, scale, sides, curves, images } of panels) {
    const [patch] = json.cases[Number(head.replace("case ", "")) - 1].patches;
    near(y, patch.reference.y_tr_mm, 0.15 / scale, `y of ${head}`);  // tenths of a pixel
    assert.deepEqual(sides, ["gauge side", "field side"]);
    assert.equal(curves, 2);
    assert.ok(images >= 1);
  }
  // It wanders with the flat, and a click chooses the case.
  assert.ok(Math.max(...panels.map(({ y }) => y)) - Math.min(...panels.map(({ y }) => y)) > 1);
  await page.locator("#positions .track-hit").nth(2).click();
  await tab.waitForStep(Number(panels[2].head.replace("case ", "")) - 1);
  await tab.close();
  await photograph("run.html", "positions", "#positions");
});

test("wheel and rail are cut at the contact of the chosen case", async () => {
  const json = read("run/result.json");
  const pressures = json.cases.map((one) => one.patches[0].pmax_MPa);
  const tab = await Tab.open("run.html");
  const { page } = tab;
  const shown = () =>
    page.locator("#section svg.section-view").evaluate((svg) => {
      const texts = [...svg.querySelectorAll("text")];
      const ticks = texts.map((text) => [Number(text.textContent), Number(text.getAttribute("x"))]).filter(([value]) => value > 600);
      const [[y0, x0], [y1, x1]] = [ticks[0], ticks.at(-1)];
      const scale = (x1 - x0) / (y1 - y0);
      const xs = [...svg.querySelector(".section-width").getAttribute("d").matchAll(/[ML](\S+) /g)].map((match) => Number(match[1]));
      return {
        scale,
        y: y0 + (Number(svg.querySelector("circle").getAttribute("cx")) - x0) / scale,
        width: Math.abs(xs[1] - xs[0]) / scale,
        words: texts.map((text) => text.textContent),
        bodies: svg.querySelectorAll("path[stroke-width='2']").length,
      };
    });
  await page.locator("#section").scrollIntoViewIfNeeded();
  // The worst case comes first.
  const worst = pressures.indexOf(Math.max(...pressures));
  assert.equal(await tab.step(), worst);
  for (const [key, k] of [["", worst], ["Home", 0], ["End", 25]]) {
    if (key) await tab.key(".timeline-slider", key);
    await page.waitForFunction((n) => document.querySelector("#section svg").textContent.includes(`case ${n}, `), k + 1);
    const { scale, y, width, words, bodies } = await shown();
    const [patch] = json.cases[k].patches;
    near(y, patch.reference.y_tr_mm, 0.15 / scale, `y of case ${k + 1}`);
    assert.ok(width > 3 && width < 40, `${width} mm wide`);
    assert.ok(words.includes(`${Number((patch.fn_N / 1e3).toPrecision(4))} kN`), words.join("; "));
    for (const word of ["wheel", "rail", "gauge side", "field side"]) assert.ok(words.includes(word), word);
    assert.equal(bodies, 2);
  }
  const [csv] = await Promise.all([page.waitForEvent("download"), page.locator("#section .downloads button", { hasText: "CSV" }).click()]);
  const rows = readFileSync(await csv.path(), "utf8").trim().split("\n").map((line) => line.split(",").slice(-4));
  for (const body of ["rail", "wheel"]) assert.ok(rows.filter(([what]) => what.includes(body)).length > 50, body);
  await tab.close();
  await photograph("run.html", "section", "#section");
});

test("a picture of every case is saved in one file, all of one size, for films", async () => {
  const tab = await Tab.open("run.html");
  const { page } = tab;
  for (const [id, place] of [["section", "#section .downloads"], ["patches-view", "#patches-view .contact-left .downloads"]]) {
    await page.locator(`#${id}`).scrollIntoViewIfNeeded();
    const before = await page.locator(`#${id} svg`).first().innerHTML();
    const [file] = await Promise.all([page.waitForEvent("download"), page.locator(`${place} button`, { hasText: "PNG of every case" }).click()]);
    assert.match(file.suggestedFilename(), /\.zip$/);
    const pictures = Object.entries(unzipSync(readFileSync(await file.path())));
    assert.deepEqual(pictures.map(([name]) => name), Array.from({ length: 26 }, (_, k) => `${String(k + 1).padStart(4, "0")}.png`));
    // Width and height stand in the head of a PNG.
    assert.equal(new Set(pictures.map(([, bytes]) => String(bytes.slice(16, 24)))).size, 1, "sizes differ");
    assert.ok(new Set(pictures.map(([, bytes]) => Buffer.from(bytes).toString("base64"))).size > 12);
    await page.waitForFunction(([name, text]) => document.querySelector(`#${name} svg`).innerHTML.length === text.length, [id, before]);
  }
  await tab.close();
});

test("26 positions open and follow the slider without delay", async () => {
  const tab = await Tab.open("run.html");
  const opened = await tab.page.evaluate(() => {
    const [entry] = performance.getEntriesByType("navigation");
    return entry.loadEventEnd - entry.startTime;
  });
  const report = [`opened in ${opened.toFixed(0)} ms`];
  for (const view of ["#patches-view", "#scene", "#forces"]) {
    await tab.page.locator(view).evaluate((element) => {
      element.scrollIntoView({ block: "start", behavior: "instant" });
      window.scrollBy({ top: -60, behavior: "instant" });
    });
    if (view === "#scene") await tab.page.waitForFunction(() => document.querySelector("#scene").dataset.ready === "true", undefined, { polling: 200 });
    await tab.page.waitForTimeout(800);
    const [rate, drawn] = await tab.page.evaluate(async () => {
      const slider = document.querySelector(".timeline-slider");
      const scene = document.querySelector("#scene");
      const times = [];
      const before = Number(scene.dataset.pictures);
      for (let k = 0; k < 26; ++k) {
        slider.value = String(k);
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        await new Promise(requestAnimationFrame);
        times.push(performance.now());
      }
      const seconds = (times.at(-1) - times[0]) / 1000;
      return [(times.length - 1) / seconds, (Number(scene.dataset.pictures) - before) / seconds];
    });
    assert.ok(rate > 0);
    report.push(`${view} ${rate.toFixed(0)} steps a second${drawn > 0 ? `, ${drawn.toFixed(0)} pictures in space` : ""}`);
  }
  console.log(report.join("; "));  // times decide no test: machines are busy
  await tab.close();
});

test("400 steps in time", async () => {
  const file = results.long();
  assert.ok(statSync(join(folder, file)).size < 8e6);
  const json = read("long/result.json");
  assert.equal(json.cases.length, 401);
  const tab = await Tab.open(file);
  await tab.page.locator("#patches-view [data-control='peak']").waitFor();
  for (const step of [0, 133, 400]) {
    await tab.page.evaluate((k) => {
      const slider = document.querySelector(".timeline-slider");
      slider.value = String(k);
      slider.dispatchEvent(new Event("input", { bubbles: true }));
    }, step);
    const pressure = json.cases[step].patches.reduce((a, b) => (a.fn_N > b.fn_N ? a : b)).pmax_MPa;
    await tab.waitForPeak("#patches-view", "pressure", pressure, 6e-3 * pressure);  // one byte a number at this length
  }
  await tab.close();
});

test("an interrupted run says so on top and shows what there is", async () => {
  const file = await results.interrupted();
  const json = read("interrupted/result.json");
  assert.equal(json.complete, false);
  const tab = await Tab.open(file);
  const banner = tab.page.locator("main .banner").first();
  assert.match(await banner.textContent(), new RegExp(`Interrupted\\. ${json.cases.length} of 3000 cases`));
  assert.match(await banner.getAttribute("class"), /failed/);
  assert.equal(await tab.page.locator("#table-cases tbody tr").count(), Math.min(json.cases.length, 1000));
  await tab.close();
});

test("names and messages with markup are text; cases without contact are named", async () => {
  const file = results.nasty();
  const tab = await Tab.open(file);
  assert.equal(await tab.page.locator("h1").textContent(), "<img src=y onerror=alert(1)> & 'q'");
  assert.match(await tab.page.locator("#origin").textContent(), /<img src=x onerror=alert\(1\)> & 'q'\.toml/);
  assert.equal(await tab.page.locator("img[src='x'], img[src='y']").count(), 0);
  assert.ok((await tab.page.locator("main .banner").count()) > 0);
  assert.match(await tab.page.locator("main .banner").first().textContent(), /1 case/);
  await tab.key(".timeline-slider", "End");
  await tab.page.locator("#patches-view").scrollIntoViewIfNeeded();
  await tab.page.waitForFunction(() => /no contact|failed/i.test(document.querySelector("#patches-view").textContent));
  await tab.close();
});

test("a comparison of representations", async () => {
  const file = results.compare();
  const json = read("compare/compare.json");
  const tab = await Tab.open(file);
  const rows = await tab.page.locator("table.data").last().locator("tbody tr").count();
  assert.equal(rows, json.rows.length);
  await tab.page.locator("[data-view='contact'] [data-control='peak']").first().waitFor();
  await tab.key(".timeline-slider", "End");
  const truth = json.rows.find((row) => row.case === 3);
  await tab.waitForPeak("[data-view='contact']", "pressure", truth.pmax_MPa, 2e-4 * truth.pmax_MPa);
  assert.ok((await tab.page.locator("[data-view='chart'] path.line, [data-view='chart'] .mark").count()) > 0);
  await tab.close();
  await photograph(file, "compare", "[data-view='contact']");
  await readWhole(file, "compare", "all");
});

test("a benchmark", async () => {
  const file = results.bench();
  const json = read("bench/bench.json");
  const tab = await Tab.open(file);
  assert.ok((await tab.page.locator("table.data tbody tr").count()) >= json.rows.length);
  await tab.page.locator("[data-view='chart']").first().scrollIntoViewIfNeeded();
  await tab.page.waitForTimeout(300);
  await tab.close();
  await photograph(file, "bench");
  await readWhole(file, "bench");
});

test("the audit of an import", async () => {
  const file = results.import();
  const tab = await Tab.open(file);
  const pictures = await tab.page.locator("img.picture").evaluateAll((images) => images.map((image) => image.complete && image.naturalWidth > 0));
  assert.ok(pictures.length >= 3 && pictures.every(Boolean), "pictures of the audit");
  const cloud = tab.page.locator("[data-view='cloud']");
  await cloud.scrollIntoViewIfNeeded();
  await tab.page.locator("[data-view='cloud'][data-ready='true']").waitFor();
  const points = Number(await cloud.getAttribute("data-points"));
  assert.ok(points > 50000 && points <= 100000, `${points} points in space`);
  await cloud.locator("button[data-view='contact']").click();
  await cloud.locator("select[name='quantity']").selectOption("1");
  await cloud.locator("select[name='exaggeration']").selectOption("10");
  await tab.page.waitForTimeout(600);
  const box = await cloud.locator("canvas.scene-canvas").boundingBox();
  await tab.page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await tab.page.waitForFunction(() => /deviation from the surface/.test(document.querySelector("[data-view='cloud'] output")?.textContent ?? ""));
  await cloud.locator("input[name='others']").uncheck();
  await tab.page.waitForFunction((before) => Number(document.querySelector("[data-view='cloud']").dataset.points) < before, points);
  await tab.page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  const colours = await tab.page.locator("[data-view='cloud'] .scene-print").evaluate((picture) => {
    const { data } = picture.getContext("2d").getImageData(0, 0, picture.width, picture.height);
    return new Set(new Uint32Array(data.buffer)).size;
  });
  await tab.page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
  assert.ok(colours > 50, "points on paper");
  await tab.page.locator("[data-view='map']").first().scrollIntoViewIfNeeded();
  await tab.page.locator("[data-view='map'] svg").first().waitFor();
  await tab.close();
  await photograph(file, "import", "[data-view='map']");
  await readWhole(file, "import");
});

test("a simulation in time", async () => {
  const file = results.simulation();
  const tab = await Tab.open(file);
  await tab.page.locator("#forces").scrollIntoViewIfNeeded();
  await tab.page.waitForSelector("#forces path.line", { state: "attached" });
  const csv = readFileSync(join(folder, "simulation", "history.csv"), "utf8").trim().split("\n");
  const column = csv[0].split(",").indexOf("Q_N");
  const largest = Math.max(...csv.slice(1).map((line) => Number(line.split(",")[column])));
  const summary = await tab.page.locator("#table-summary tbody tr").evaluateAll((rows) => {
    const row = rows.find((one) => one.cells[0].textContent === "q_max");
    return Number([...row.cells].find((cell) => cell.dataset.value).dataset.value);
  });
  near(summary, largest / 1000, 1e-12 * largest, "largest force [kN]");
  // ParaView has contact, wheel and rail at the seconds that the history has for the pitch of the snapshots.
  const times = (name) => [...readFileSync(join(folder, "simulation", "vtk", name), "utf8").matchAll(/timestep="([^"]*)".*file="([^"]*)"/g)];
  const last = Number(csv.at(-1).split(",")[csv[0].split(",").indexOf("t_s")]);
  const seconds = [...new Set(times("bodies.pvd").map(([, time]) => Number(time)))];
  assert.equal(seconds.length, 4);
  assert.ok(seconds.every((time, k) => time >= 0 && time <= last && (k === 0 || time > seconds[k - 1])), String(seconds));
  for (const [, time, name] of [...times("bodies.pvd"), ...times("snapshots.pvd")]) {
    assert.ok(seconds.includes(Number(time)), name);
    assert.ok(statSync(join(folder, "simulation", "vtk", name)).size > 1000, name);
  }
  assert.equal(await tab.page.locator(".timeline-slider").getAttribute("max"), String(csv.length - 2));
  await tab.key(".timeline-slider", "End");
  await tab.close();
  await photograph(file, "simulation", "#forces");
  await readWhole(file, "simulation", "all");
});

test("a study", async () => {
  const file = results.sweep();
  const tab = await Tab.open(file);
  assert.equal(await tab.page.locator("h1").textContent(), "Loads and depths");
  assert.equal(await tab.page.locator("#table-runs tbody tr").count(), 6);
  await tab.page.locator("#summary-1").scrollIntoViewIfNeeded();
  await tab.page.waitForSelector("#summary-1 path.line", { state: "attached" });
  await tab.page.locator("#table-runs tr[data-step='4'] td").first().click();
  await tab.waitForStep(4);
  await tab.close();
  await photograph(file, "sweep", "#summaries");
  await readWhole(file, "sweep");
});

test("evolutions follow the slider over their generations", async () => {
  const [flat, tread] = results.evolutions();
  for (const [file, folderName, figures] of [
    [flat, "worn-flat", ["over-generations", "wheel-section", "wheel-along", "wheel-depth", "wheel-pressure", "wheel-strain"]],
    [tread, "worn-tread", ["over-generations", "wheel-section"]],
  ]) {
    assert.ok(statSync(join(folder, file)).size < 8e6);
    const json = read(`${folderName}/evolution.json`);
    const last = json.generations.length - 1;
    const tab = await Tab.open(file);
    const { page } = tab;
    assert.equal(await tab.step(), last);
    const ids = await page.locator("[id]").evaluateAll((all) => all.map((one) => one.id));
    assert.deepEqual(ids.filter((id, k) => ids.indexOf(id) !== k), [], "ids that are there twice");
    for (const name of ["pmax_MPa", "wheel_volume_mm3", ...(file === tread ? ["wheel_conicity_3mm"] : ["wheel_raised_mm", "wheel_strain"])])
      for (let k = 0; k <= last; ++k)
        near(await tab.cell("generations", k, name), json.generations[k][name], 1e-9 * Math.abs(json.generations[k][name]), `${name} of generation ${k}`);
    for (const id of figures) {
      await page.locator(`#${id}`).scrollIntoViewIfNeeded();
      await page.waitForSelector(`#${id} svg`, { state: "attached" });
    }
    if (file === flat) {
      // The map is another picture at another generation, and its file has the depths of that one.
      await page.locator("#wheel-depth").scrollIntoViewIfNeeded();
      const picture = () => page.locator("#wheel-depth svg image").first().getAttribute("href");
      const largest = async () => {
        const [csv] = await Promise.all([page.waitForEvent("download"), page.locator("#wheel-depth .downloads button", { hasText: "CSV" }).first().click()]);
        return Math.max(...readFileSync(await csv.path(), "utf8").trim().split("\n").slice(1).map((line) => Number(line.split(",")[2])));
      };
      await page.waitForSelector("#wheel-depth svg image", { state: "attached" });
      const worn = await picture();
      near(await largest(), json.generations[last].wheel_depth_mm, 0.01 * json.generations[last].wheel_depth_mm, "depth of the last generation");
      await tab.key(".timeline-slider", "Home");
      await tab.waitForStep(0);
      await page.waitForFunction((before) => document.querySelector("#wheel-depth svg image").getAttribute("href") !== before, worn);
      near(await largest(), 0, 1e-12, "depth of the first generation");
    }
    await tab.close();
  }
  await photograph(flat, "evolution", "#wheel-depth");
  await readWhole(flat, "evolution", "1-2");
});

test("two runs laid over each other", async () => {
  const other = "less-of-a-flat-and-more-friction";
  const file = results.overlay();
  assert.ok(statSync(join(folder, file)).size < 8e6);
  const [before, after] = ["run", other].map((name) => read(`${name}/result.json`));
  const most = (json, k) => Math.max(...json.cases[k].patches.map((one) => one.pmax_MPa));
  const tab = await Tab.open(file);
  const { page } = tab;
  const differences = before.cases.map((_, k) => most(after, k) - most(before, k));
  for (let k = 0; k < 26; ++k) {
    near(await tab.cell("cases", k, "largest pressure, run"), most(before, k), 1e-6, `pressure of case ${k + 1}`);
    near(await tab.cell("cases", k, `largest pressure, ${other}`), most(after, k), 1e-6, `other pressure of case ${k + 1}`);
    near(await tab.cell("cases", k, "largest pressure, difference"), differences[k], 1e-6, `difference of case ${k + 1}`);
    near(await tab.cell("cases", k, "largest pressure, change"), (100 * differences[k]) / most(before, k), 1e-6, `change of case ${k + 1}`);
  }
  // The case with the greatest difference comes first, the settings that differ are named.
  const sizes = differences.map(Math.abs);
  assert.equal(await tab.step(), sizes.indexOf(Math.max(...sizes)));
  const said = await page.locator("#table-differs tbody tr").allTextContents();
  assert.ok(said.some((row) => /friction: coefficient.*0\.3.*0\.4/.test(row)), said.join("; "));
  // Both curves in every panel, in two colours and dashes.
  await page.locator("#forces").scrollIntoViewIfNeeded();
  const looks = await page.locator("#forces .sample path.line, #forces svg path.line").evaluateAll((paths) => paths.map((path) => `${path.style.stroke} ${path.getAttribute("stroke-dasharray")}`));
  assert.equal(new Set(looks).size, 2, [...new Set(looks)].join("; "));
  // Patches side by side; the picked element and the sections through it have both.
  const view = page.locator("#patches-view");
  await view.scrollIntoViewIfNeeded();
  await view.locator("[data-control='peak']").first().click();
  const step = await tab.step();
  const patch = (json) => json.cases[step].patches.reduce((a, b) => (a.fn_N > b.fn_N ? a : b));
  const numbers = view.locator(".contact-side tr", { hasText: /^largest pressure p/ }).first();
  for (const json of [before, after]) assert.ok((await numbers.textContent()).includes(String(Number(patch(json).pmax_MPa.toPrecision(4)))), await numbers.textContent());
  const curves = await view.locator(".contact-sections svg g[clip-path]").evaluateAll((groups) => groups.map((group) => [...group.querySelectorAll("path")].map((path) => [path.getAttribute("d").length > 20, path.getAttribute("stroke-dasharray")].join())));
  assert.equal(curves.length, 2);
  for (const pair of curves) {
    assert.equal(new Set(pair).size, 2, pair.join("; "));
    assert.ok(pair.every((one) => one.startsWith("true")), pair.join("; "));
  }
  await view.locator("[data-control='difference']").check();
  await view.locator(`text[data-full*="${other} – difference"]`).waitFor();
  // The other wheel lies dashed in the section.
  await page.locator("#section").scrollIntoViewIfNeeded();
  assert.equal(await page.locator("#section .section-other").count(), 2);
  const [csv] = await Promise.all([page.waitForEvent("download"), page.locator("#section .downloads button", { hasText: "CSV" }).click()]);
  assert.ok(readFileSync(await csv.path(), "utf8").includes(`"wheel, ${other}"`));
  await tab.close();
  await photograph(file, "overlay", "#contact");
  await readWhole(file, "overlay", "1, 13-14");
});

test("26 cases under 400 steps", async () => {
  const file = results.overlayLong();
  const tab = await Tab.open(file);
  const { page } = tab;
  assert.match((await page.locator(".banner").allTextContents()).join("\n"), /run has not got 375 cases: 27 to 401\. There is nothing/);
  assert.equal(await page.locator("#table-cases tbody tr").count(), 401);
  await tab.key(".timeline-slider", "End");
  await tab.waitForStep(400);
  await page.locator("#patches-view").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelector("#patches-view .contact-status").textContent.includes("run: failed – There is none of that number in this result."));
  await tab.close();
});

test("two simulations laid over each other", async () => {
  const file = results.overlaySimulations();
  const tab = await Tab.open(file);
  const { page } = tab;
  const history = (name) => {
    const [head, ...rows] = readFileSync(join(folder, name, "history.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
    const column = (wanted) => rows.map((row) => Number(row[head.indexOf(wanted)]));
    return { t: column("t_s"), q: column("Q_N") };
  };
  const mean = ({ t, q }) => q.slice(1).reduce((sum, b, i) => sum + (0.5 * (q[i] + b) * (t[i + 1] - t[i])) / t.at(-1), 0) / 1e3;
  const rows = await page.locator("#table-columns tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.dataset.value ?? cell.textContent)));
  const row = (measure) => rows.find(([name]) => name === `Q, ${measure}`).map(Number);
  const [a, b] = ["simulation", "faster"].map(history);
  near(row("largest")[3], Math.max(...a.q) / 1e3, 1e-6, "largest force");
  near(row("largest")[5], (Math.max(...b.q) - Math.max(...a.q)) / 1e3, 1e-6, "difference of the largest forces");
  near(row("mean")[4], mean(b), 1e-6, "mean force");
  near(row("mean")[5], mean(b) - mean(a), 1e-6, "difference of the mean forces");
  for (const id of ["#over-distance", "#over-time"]) {
    await page.locator(id).scrollIntoViewIfNeeded();
    const looks = await page.locator(`${id} svg path.line`).evaluateAll((paths) => paths.map((path) => `${path.style.stroke} ${path.getAttribute("stroke-dasharray")}`));
    assert.equal(new Set(looks).size, 2, [...new Set(looks)].join("; "));
  }
  // Patches at the snapshots of both: one of the round wheel, three at the flat.
  const view = page.locator("#patches-view");
  await view.scrollIntoViewIfNeeded();
  await tab.key(".timeline-slider", "End");
  await tab.waitForStep(3);
  near(await tab.cell("snapshots", 3, "pitch angle, faster"), -4, 0.3, "pitch of the last snapshot");
  await view.locator("[data-control='peak']").first().click();
  const pressures = (await view.locator(".contact-side tr", { hasText: /^largest pressure p/ }).first().locator("td").allTextContents()).map(Number);
  assert.ok(pressures.length === 2 && pressures.every((one) => one > 500 && one < 5000), pressures.join("; "));
  assert.match((await page.locator("#table-differs").textContent()), /set: simulation\.speed_m_s.*45/);
  await tab.close();
  await photograph(file, "overlay-simulations", "#histories");
  await readWhole(file, "overlay-simulations");
});

test("keys are heard from the start; tables are sorted, curves hidden, charts zoomed, themes and sections chosen", async () => {
  const tab = await Tab.open("run.html");
  const { page } = tab;
  for (const [key, step] of [["Home", 0], ["ArrowRight", 1], ["ArrowLeft", 0], ["End", 25]]) {
    await page.keyboard.press(key);
    await tab.waitForStep(step);
  }
  assert.equal(await page.locator("#table-cases tr.current").getAttribute("data-step"), "25");
  const heading = page.locator("#table-cases th", { hasText: "p_max" });
  const column = await heading.evaluate((cell) => cell.cellIndex);
  const pressures = () => page.locator("#table-cases tbody tr").evaluateAll((rows, k) => rows.map((row) => Number(row.cells[k].dataset.value)), column);
  const written = await pressures();
  const rising = [...written].sort((a, b) => a - b);
  for (const order of [rising, [...rising].reverse(), written]) {
    await heading.locator("button").click();
    assert.deepEqual(await pressures(), order);
  }
  await page.locator("#forces").scrollIntoViewIfNeeded();
  await page.waitForSelector("#forces path.line", { state: "attached" });
  const lines = await page.locator("#forces svg path.line").count();
  await page.locator("#forces .legend button[aria-pressed]").first().click();
  await page.waitForFunction((n) => document.querySelectorAll("#forces svg path.line").length < n, lines);
  await page.locator("#forces .chart-buttons button[aria-label^='Zoom in']").click();
  await page.waitForSelector("#forces .chart-buttons button[aria-label^='Show all']:not([hidden])");
  for (const theme of ["light", "dark"]) {
    await page.locator("button.theme").click();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), theme);
  }
  await page.locator(".print-menu summary").click();
  await page.locator(".print-menu fieldset label", { hasText: "Cases" }).click();
  await page.emulateMedia({ media: "print" });
  assert.deepEqual([await page.locator("#cases").isVisible(), await page.locator("#inputs").isVisible()], [false, true]);
  await tab.close();
});

test("fixed pictures need no scripts", async () => {
  results.treadmark(["report", results.path("run"), "--static", "-o", results.path("static.html")]);
  const tab = await Tab.open("static.html", { scripts: false });
  assert.match(await tab.page.locator(".banner").first().textContent(), /Static pictures/);
  assert.equal(await tab.page.locator("script").count(), 0);
  assert.ok((await tab.page.locator("figure.view img.picture").count()) >= 3);
  assert.equal(await tab.page.locator("#table-cases tbody tr").count(), 26);
  await tab.close();
});

test("geometry, measures, checks and assessments are read whole by everybody", async () => {
  for (const name of results.small()) {
    await photograph(`${name}.html`, name);
    await readWhole(`${name}.html`, name);
  }
});

test("a report is printed into any folder", () => {
  const strange = join(folder, "50 % of #1");
  mkdirSync(strange);
  results.treadmark(["geometry", join(results.examples, "wheel-flat.toml"), "--report", join(strange, "wheelset.pdf")]);
  const print = readFileSync(join(strange, "wheelset.pdf"), "latin1");
  assert.ok(print.startsWith("%PDF"));
  const pages = print.match(/\/Type\s*\/Page\b/g)?.length ?? 0;
  assert.ok(pages >= 1 && pages <= 8, `${pages} pages`);
  assert.deepEqual(readdirSync(strange), ["wheelset.pdf"]);
});

test("every page stays below 8 MB", () => {
  const files = [...readdirSync(folder).filter((name) => name.endsWith(".html")), join("import", "report.html")];
  assert.ok(files.length >= 9, files.join(", "));
  for (const file of files) assert.ok(statSync(join(folder, file)).size < 8e6, file);
});
