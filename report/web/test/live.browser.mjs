// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Uses the page of treadmark live as a reader would, and runs what it saves.
// usage: node --test test/live.browser.mjs, with TREADMARK (program), TREADMARK_WEB (folder of the program for browsers), OUT (folder) and CHROMIUM in the environment
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import test, { after, before } from "node:test";
import { pathToFileURL } from "node:url";

import { chromium } from "playwright-core";

const folder = resolve(process.env.OUT ?? "dist/live");
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const program = process.env.TREADMARK ?? "treadmark";
const file = (name) => join(folder, name);

function treadmark(...args) {
  const done = spawnSync(program, ["--quiet", ...args], { encoding: "utf8", cwd: folder, env: { ...process.env, TREADMARK_MODULES: process.env.TREADMARK_WEB }, maxBuffer: 1 << 26 });
  assert.ok([0, 1].includes(done.status), `treadmark ${args.join(" ")}: ${done.stderr}`);
  return done.stdout;
}

const runs = (name) => JSON.parse(treadmark("run", file(name), "--json", "-")).cases[0];
const near = (value, wanted, share, what) => assert.ok(Math.abs(value - wanted) <= share * Math.abs(wanted), `${what}: ${value}, not ${wanted}`);

let browser;
before(async () => {
  treadmark("live", "--no-open", "-o", file("live.html"));
  treadmark("convert", "S1002", file("own.csv"));
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader"] });
});
after(() => browser?.close());

/** The page, which complains about errors and requests when it is closed. */
class Tab {
  static async open(address = "", size = { width: 1280, height: 900 }) {
    const tab = new Tab();
    tab.context = await browser.newContext({ viewport: size, acceptDownloads: true });
    tab.page = await tab.context.newPage();
    [tab.wrong, tab.requests] = [[], []];
    tab.page.on("pageerror", (error) => tab.wrong.push(String(error)));
    tab.page.on("console", (message) => ["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && tab.wrong.push(message.text()));
    tab.page.on("request", (request) => tab.requests.push(request.url()));
    const begin = Date.now();
    await tab.page.goto(pathToFileURL(file("live.html")).href + address);
    await tab.solved();
    tab.opened = Date.now() - begin;
    return tab;
  }

  async close() {
    assert.deepEqual(this.wrong, [], "errors of the page");
    assert.deepEqual(this.requests.filter((url) => !/^(data:|blob:)/.test(url)).slice(1), [], "requests besides the page itself");
    await this.context.close();
  }

  /** Waits for an answer, "fine" or "trouble"; the number of the largest pressure [MPa]. */
  async solved(how = "fine") {
    await this.page.waitForFunction((wanted) => document.body.dataset.live === wanted, how, { polling: 20, timeout: 120_000 });
    return Number(await this.page.evaluate(() => document.body.dataset.pressure));
  }

  /** Types a value into a field, or lets do something else, and waits. */
  async after(act, how = "fine") {
    await this.page.evaluate(() => delete document.body.dataset.live);
    await act();
    return this.solved(how);
  }

  type(key, value) {
    return this.page.locator(`input[data-control="${key}"]`).fill(value);
  }

  async saved(name) {
    const [download] = await Promise.all([this.page.waitForEvent("download"), this.page.locator("[data-control='save']").click()]);
    await download.saveAs(file(name));
    return runs(name);
  }
}

test("the page is small, opens at once and holds the answer", async () => {
  assert.ok(statSync(file("live.html")).size < 6e6);
  const tab = await Tab.open();
  console.log(`live.html: ${statSync(file("live.html")).size} bytes, solved ${tab.opened} ms after it was asked for`);
  assert.match(await tab.page.locator(".cards").first().textContent(), /Largest pressure/);
  assert.ok((await tab.page.locator("#patches-view svg .cells").count()) > 0);
  assert.match(await tab.page.locator("#section svg").first().getAttribute("aria-label"), /Section of wheel and rail/);
  await tab.close();
});

test("a reader types, drags, takes back, shares, saves, and the program solves the same", async () => {
  const tab = await Tab.open();
  const { page } = tab;
  const first = await tab.solved();
  const typed = await tab.after(() => tab.type("wheelset.y_mm", "4"));
  assert.notEqual(typed, first);
  assert.match(page.url(), /wheelset\.y_mm=4/);
  const slider = page.locator("[data-slider='wheelset.vertical_force_N']");
  const loaded = await tab.after(() => slider.evaluate((one) => ((one.value = "120"), one.dispatchEvent(new Event("input", { bubbles: true })))));
  assert.ok(loaded > typed);
  await tab.after(() => page.locator("[data-control='rolling']").selectOption("creepage"));
  const braked = await tab.after(() => tab.type("creepage", "-0.3"));
  const run = await tab.saved("saved.toml");
  near(braked, run.patches.reduce((most, { pmax_MPa: p }) => Math.max(most, p), 0), 1e-9, "pressure of the saved case");
  // the link shows the same elsewhere
  const other = await Tab.open(new URL(page.url()).hash);
  near(await other.solved(), braked, 1e-12, "pressure behind the link");
  await other.close();
  const before = await tab.after(() => page.locator("[data-control='undo']").click());
  assert.notEqual(before, braked);
  near(await tab.after(() => page.keyboard.press("Control+Shift+Z")), braked, 1e-12, "pressure after redo");
  near(await tab.after(() => page.locator("[data-control='reset']").click()), first, 1e-12, "pressure at the start");
  await tab.close();
});

test("a stranger drops a file with two columns and reads the pressure within 30 s", async () => {
  const begin = Date.now();
  const tab = await Tab.open();
  const dropped = await tab.after(() => tab.page.locator("[data-control='wheel-file']").setInputFiles(file("own.csv")));
  assert.ok(Date.now() - begin < 30_000);
  assert.match(await tab.page.locator(".live-evidence").first().textContent(), /own\.csv, as it is read[^]*flange/);
  const run = await tab.saved("dropped.toml");
  near(dropped, run.patches[0].pmax_MPa, 1e-9, "pressure of the dropped profile");
  await tab.close();
});

test("a case that is opened is solved as the program does, and the rail of the library changes it", async () => {
  writeFileSync(file("opened.toml"), readFileSync(file("saved.toml"), "utf8"));
  const tab = await Tab.open();
  const opened = await tab.after(() => tab.page.locator("[data-control='open']").setInputFiles(file("opened.toml")));
  near(opened, Math.max(...runs("opened.toml").patches.map(({ pmax_MPa: p }) => p)), 1e-9, "pressure of the opened case");
  assert.notEqual(await tab.after(() => tab.page.locator("select[data-control='rail']").selectOption("54E1")), opened);
  await tab.close();
});

test("the page of a run leads to the page that solves, with the case that is shown, and so does its result file", async () => {
  writeFileSync(file("both.toml"), 'rail.shape.standard = "60E1"\nwheel.shape.standard = "S1002"\ntrack.cant = "1:40"\nwheelset = { vertical_force_N = 100e3, velocity_km_h = 100, rolling = "nominal" }\n[[cases]]\nwheelset.y_mm = 0\n[[cases]]\nwheelset.y_mm = 4\n');
  treadmark("run", "both.toml", "-o", "both", "--report", "both.html");
  const { cases } = JSON.parse(readFileSync(file("both/result.json"), "utf8"));
  const largest = ({ patches }) => Math.max(...patches.map(({ pmax_MPa: p }) => p));
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(pathToFileURL(file("both.html")).href);
  const link = page.getByRole("link", { name: "Change and solve again" });
  const worst = cases.findIndex((one) => largest(one) === Math.max(...cases.map(largest)));  // is shown first
  const tab = await Tab.open(new URL(await link.getAttribute("href"), page.url()).hash);
  near(await tab.solved(), largest(cases[worst]), 1e-9, "pressure of the case that was shown");
  const softer = await tab.after(() => tab.type("wheelset.vertical_force_N", "50"));
  assert.equal(await tab.page.locator("input[data-control='wheelset.y_mm']").inputValue(), String([0, 4][worst]));  // it is still that case
  assert.ok(softer < largest(cases[worst]));
  await context.close();
  const opened = await tab.after(() => tab.page.locator("[data-control='open']").setInputFiles(file("both/result.json")));
  near(opened, largest(cases[0]), 1e-9, "pressure of the first case of a result file");
  writeFileSync(file("other.json"), "{}");
  await tab.after(() => tab.page.locator("[data-control='open']").setInputFiles(file("other.json")), "trouble");
  assert.match(await tab.page.locator(".live-messages").textContent(), /holds no case/);
  await tab.close();
});

test("two profiles and two representations stand side by side, with their difference", async () => {
  const tab = await Tab.open();
  const { page } = tab;
  const beside = (wanted) => page.waitForFunction((one) => (one ? Number(document.body.dataset.beside) > 0 : document.body.dataset.beside === ""), wanted, { polling: 20, timeout: 120_000 });
  const figures = page.locator("#beside > figure:visible");
  const here = await tab.solved();
  assert.equal(await figures.count(), 0);
  await tab.after(() => page.locator("[data-control='beside.wheel-file']").setInputFiles(file("own.csv")));
  await beside(true);
  assert.equal(await figures.count(), 2);
  near(Number(await page.evaluate(() => document.body.dataset.beside)), here, 1e-3, "pressure of the same profile read from a file");
  assert.match(await page.locator("#beside .live-evidence:visible").textContent(), /own\.csv, as it is read/);
  await tab.after(() => page.locator("[data-control='beside.wheel']").selectOption("EPS"));
  await page.waitForFunction((one) => Math.abs(document.body.dataset.beside / one - 1) > 0.05, here);
  assert.match(await page.locator(".cards").first().textContent(), /beside [^]*Equivalent conicity[^]*beside/);
  await page.locator("#beside-patches").scrollIntoViewIfNeeded();
  await page.locator("#beside-patches").getByLabel(/^Difference/).check();
  await page.waitForFunction(() => /difference/.test(document.querySelector("#beside-patches svg").textContent));
  // both move, and the link holds both
  await tab.after(() => tab.type("wheelset.y_mm", "2"));
  await page.waitForFunction(() => /y_mm=2.*beside\.wheel\.shape\.standard=EPS|beside\.wheel\.shape\.standard=EPS.*y_mm=2/.test(document.location.hash), undefined, { timeout: 120_000 });
  await tab.after(() => page.locator("[data-control='beside.wheel']").selectOption(""));
  await beside(false);
  assert.equal(await figures.count(), 0);
  await page.locator("[data-control='beside.wheel.backend']").selectOption("spline");
  await beside(true);
  near(Number(await page.evaluate(() => document.body.dataset.beside)), await tab.solved(), 1e-3, "pressure in another representation");
  await tab.close();
});

test("hostile input is a sentence, and the last good state stays", async () => {
  writeFileSync(file("hostile.csv"), "<img src=x onerror=alert(1)>,".repeat(500));
  writeFileSync(file("hostile.toml"), "[[");
  writeFileSync(file("large.csv"), Buffer.alloc(21e6, "1,2\n"));
  const tab = await Tab.open();
  const { page } = tab;
  const good = await tab.after(() => tab.type("wheelset.y_mm", "2"));
  const says = async (act, words) => {
    await tab.after(act, "trouble");
    assert.match(await page.locator(".live-messages").textContent(), words);
  };
  await says(() => page.locator("[data-control='wheel-file']").setInputFiles(file("hostile.csv")), /hostile\.csv was not taken/);
  await says(() => page.locator("[data-control='rail-file']").setInputFiles(file("large.csv")), /21 MB/);
  await says(() => page.locator("[data-control='open']").setInputFiles(file("hostile.toml")), /hostile\.toml was not opened/);
  await says(() => tab.type("wheelset.y_mm", ""), /number/);
  await says(() => tab.type("friction.coefficient", "-1"), /friction/);
  const run = await tab.saved("kept.toml");
  near(good, Math.max(...run.patches.map(({ pmax_MPa: p }) => p)), 1e-9, "pressure of the state that stays");
  await tab.after(() => tab.type("wheelset.y_mm", "300"));
  assert.match(await page.locator(".live-messages").textContent(), /nowhere face each other/);
  await tab.close();
});

test("a move is answered at once", async () => {
  const base = `rail.shape.standard = "60E1"
wheel.shape.standard = "S1002"
track = { gauge_mm = 1435, cant = "1:40" }
wheelset = { nominal_radius_mm = 460, vertical_force_N = 80e3, velocity_m_s = 20, vpitch_rad_s = -43.5, flange_back_distance_mm = 1360, flange_back_position_mm = -70, pitch_deg = 2 }
friction.coefficient = 0.3
`;
  const cases = {
    "exact theory, 1 mm": "discretisation = { dx_mm = 1, ds_mm = 1 }",
    "KPEC and FASTSIM, 1 mm": 'discretisation = { dx_mm = 1, ds_mm = 1 }\nsolver = { normal_model = "kpec", tangential_model = "fastsim" }',
    "flat, 0.5 mm": "discretisation = { dx_mm = 0.5, ds_mm = 0.5 }\nwheel.flats = [{ length_mm = 40, depth_mm = 0.5 }]",
  };
  for (const [name, rest] of Object.entries(cases)) {
    const tab = await Tab.open(`#case=${encodeURIComponent(base + rest)}`);
    // from the event of the field to the numbers of the first answer on the page and to the frame after it is drawn, and what solving took of it
    const moves = await tab.page.evaluate(async () => {
      const field = document.querySelector("input[data-control='wheelset.y_mm']");
      const { dataset } = document.body;
      const frame = () => new Promise((then) => requestAnimationFrame(then));
      const all = [];
      let told = 0;
      new MutationObserver(() => {
        if (dataset.live !== undefined) told ||= performance.now();
      }).observe(document.body, { attributes: true });
      for (let k = 0; k < 41; ++k) {
        delete dataset.live;
        await Promise.resolve();
        told = 0;
        field.value = String(0.1 * (k % 20));
        const begin = performance.now();
        field.dispatchEvent(new Event("input", { bubbles: true }));
        while (dataset.live === undefined) await frame();
        await frame();
        const drawn = performance.now();
        const solved = Number(/([0-9.]+) ms/.exec([...document.querySelectorAll(".card-value")].at(-1).textContent)[1]);
        all.push([told - begin, drawn - begin, solved]);
        while (dataset.live !== "fine") await frame();
        await new Promise((then) => setTimeout(then, 100));
      }
      return all;
    });
    const at = (column, share) => moves.map((row) => row[column]).sort((a, b) => a - b)[Math.round(share * (moves.length - 1))].toFixed(1);
    const words = ["from a move to the first answer", "to its picture", "of it solving"].map((what, k) => `${what}: median ${at(k, 0.5)} ms, 95 % ${at(k, 0.95)} ms`);
    console.log(`${name}: ${words.join("; ")}`);
    assert.ok(Number(at(0, 0.5)) < 2000);
    await tab.close();
  }
});

test("nothing stands in the way of readers with helpers, nor on a phone", async () => {
  const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
  for (const size of [{ width: 1280, height: 900 }, { width: 390, height: 844 }]) {
    const tab = await Tab.open("", size);
    await tab.page.evaluate(axe);
    const { violations } = await tab.page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    assert.deepEqual(violations.filter(({ impact }) => ["serious", "critical"].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes[0].target}`), []);
    const [wide, window_] = await tab.page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
    assert.ok(wide <= window_, `the page is ${wide} wide in a window of ${window_}`);
    await tab.close();
  }
});

test("a page that cannot be told leaves an error", () => {
  const done = spawnSync("sh", ["-c", '"$0" --quiet live --no-open -o told.html > /dev/full', program], { cwd: folder, encoding: "utf8", env: { ...process.env, TREADMARK_MODULES: process.env.TREADMARK_WEB } });
  assert.ok(done.status > 0);
  assert.match(done.stderr, /could not be written to standard output/);
});
