// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Opens the demo pages in a browser and uses them. Wants `npm run demo` before; the browser is $CHROMIUM or /usr/bin/chromium.
// usage: node test/demo.browser.mjs [DIR]      DIR: where the demo pages lie; default dist
import assert from "node:assert/strict";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

import { chromium } from "playwright-core";

const folder = resolve(process.argv[2] ?? "dist");
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });

async function open(name, viewport) {
  const page = await browser.newPage({ viewport });
  const wrong = [];
  const requests = [];
  page.on("pageerror", (error) => wrong.push(String(error)));
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && !/GPU stall|WebGL/.test(message.text()) && wrong.push(message.text()));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(pathToFileURL(resolve(folder, name)).href);
  await page.waitForTimeout(300);
  return { page, wrong, requests };
}

function check(wrong, requests) {
  assert.deepEqual(wrong, [], "errors of the page");
  assert.deepEqual(requests.filter((url) => !/^(data:|blob:)/.test(url)).slice(1), [], "requests besides the page itself");
}

const name = (page) => page.locator(".timeline-name .name").textContent();

async function useTheRun() {
  const { page, wrong, requests } = await open("demo.html", { width: 1280, height: 900 });
  // The slider and the buttons.
  assert.equal(await name(page), "case 1: y = -2.5 mm");
  await page.locator(".timeline-slider").focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.querySelector(".timeline-name .name").textContent.startsWith("case 2:"));
  await page.keyboard.press("End");
  await page.waitForFunction(() => document.querySelector(".timeline-name .name").textContent.startsWith("case 26:"));
  assert.equal(await page.locator("tr.current").getAttribute("data-step"), "25");
  await page.locator("tr[data-step='3'] td").first().click();
  await page.waitForFunction(() => document.querySelector(".timeline-name .name").textContent.startsWith("case 4:"));

  // A table: rising, falling, as written; the empty cells last.
  const heading = page.locator("#table-cases th", { hasText: "Flange force" });
  const steps = () => page.locator("#table-cases tbody tr").evaluateAll((rows) => rows.map((row) => Number(row.dataset.step)));
  await heading.locator("button").click();
  assert.equal(await heading.getAttribute("aria-sort"), "ascending");
  assert.equal((await steps())[0], 18);
  await heading.locator("button").click();
  assert.equal((await steps())[0], 25);
  assert.equal((await steps())[25], 17);
  await heading.locator("button").click();
  assert.deepEqual(await steps(), Array.from({ length: 26 }, (_, k) => k));
  const [csv] = await Promise.all([page.waitForEvent("download"), page.locator(".table-actions button", { hasText: "CSV" }).first().click()]);
  assert.equal(csv.suggestedFilename(), "cases.csv");

  // A linked chart: a click chooses the step, keys move it, a hidden series goes.
  const chart = page.locator("#forces svg.chart").first();
  await chart.scrollIntoViewIfNeeded();
  await page.waitForSelector("#forces path.line", { state: "attached" });
  const box = await chart.boundingBox();
  await page.mouse.click(box.x + box.width - 30, box.y + 60);
  await page.waitForFunction(() => Number(document.querySelector("tr.current").dataset.step) >= 24);
  assert.ok(await page.locator("#forces .readout").isVisible());
  await page.locator("#forces .chart-frame").focus();
  await page.keyboard.press("Home");
  await page.waitForFunction(() => document.querySelector("tr.current").dataset.step === "0");
  const lines = await page.locator("#forces path.line").count();
  await page.locator("#forces .legend button[aria-pressed]").first().click();
  await page.waitForFunction((n) => document.querySelectorAll("#forces path.line").length < n, lines);
  await page.locator("#forces .chart-buttons button[aria-label^='Zoom in']").click();
  await page.waitForSelector("#forces .chart-buttons button[aria-label^='Show all']:not([hidden])");
  const [svg] = await Promise.all([page.waitForEvent("download"), page.locator("#forces .downloads button", { hasText: "SVG" }).click()]);
  assert.equal(svg.suggestedFilename(), "forces.svg");
  const [png] = await Promise.all([page.waitForEvent("download"), page.locator("#deviation .downloads button", { hasText: "PNG" }).click()]);
  assert.equal(png.suggestedFilename(), "deviation.png");

  // The theme: auto, light, dark.
  const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
  assert.equal(await theme(), undefined);
  await page.locator("button.theme").click();
  assert.equal(await theme(), "light");
  await page.locator("button.theme").click();
  assert.equal(await theme(), "dark");
  assert.ok((await page.locator(".licences h3").count()) > 0);
  check(wrong, requests);
  await page.close();
}

async function useTheHistory() {
  const { page, wrong, requests } = await open("demo-simulation.html", { width: 1280, height: 900 });
  await page.locator("#forces").scrollIntoViewIfNeeded();
  await page.waitForSelector("#forces path.line", { state: "attached" });
  assert.match(await name(page), /^t = 0\.00000 s$/);
  // Peaks of one instant are on the picture: the line reaches what the axis needs for them.
  const length = await page.locator("#forces path.line").first().evaluate((path) => path.getAttribute("d").length);
  assert.ok(length < 100000, `a line of ${length} characters`);
  await page.locator("button[aria-label='Play']").click();
  await page.waitForFunction(() => document.querySelector(".timeline-slider").valueAsNumber > 200);
  await page.locator("button[aria-label='Pause']").click();
  check(wrong, requests);
  await page.close();
}

async function onAPhone() {
  const { page, wrong, requests } = await open("demo.html", { width: 390, height: 844 });
  for (const id of ["overview", "cases", "checks", "input"]) {
    await page.evaluate((section) => document.getElementById(section).scrollIntoView(), id);
    await page.waitForTimeout(150);
    const [wide, window] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
    assert.ok(wide <= window, `the page is ${wide} wide in a window of ${window}`);
  }
  check(wrong, requests);
  await page.close();
}

try {
  await useTheRun();
  await useTheHistory();
  await onAPhone();
  console.log("The demo pages work.");
} finally {
  await browser.close();
}
