// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Writes DIR/demo.html (26 cases) and DIR/demo-simulation.html (20 000 instants) with DIR/report.js in them.
// usage: node test/make-demo.mjs --out DIR [--style FILE]
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs } from "node:util";

import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({ options: { out: { type: "string", default: "dist" }, style: { type: "string" } } });
const out = resolve(values.out);
mkdirSync(out, { recursive: true });
const bundled = join(out, "demo.mjs");
await build({ absWorkingDir: here, entryPoints: ["demo.ts"], outfile: bundled, bundle: true, platform: "node", format: "esm", target: "node18" });
const { demoPage } = await import(pathToFileURL(bundled).href);
const styleFile = values.style ?? join(here, "..", "..", "style.css");
const style = existsSync(styleFile) ? readFileSync(styleFile, "utf8") : "";
const script = readFileSync(join(out, "report.js"), "utf8");
for (const [name, kind] of [["demo", "run"], ["demo-simulation", "simulation"]]) {
  const page = demoPage(kind, style, script);
  writeFileSync(join(out, `${name}.html`), page);
  console.log(`${name}.html: ${(page.length / 1e6).toFixed(2)} MB`);
}
