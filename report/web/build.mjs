// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Bundles the scripts of the report into one file, which the page holds inline.
// usage: node build.mjs --out DIR      writes DIR/report.js
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({ options: { out: { type: "string", default: "dist" } } });
const out = resolve(values.out);

/** Name, version and licence text of every package of which the bundle holds code. */
function licences(inputs) {
  const folders = new Set();
  for (const input of Object.keys(inputs)) {
    const match = /^(?:.*\/)?node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (match) folders.add(match[1]);
  }
  return [...folders].sort().map((name) => {
    const folder = join(here, "node_modules", name);
    const about = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((entry) => /^licen[cs]e(\.|$)/i.test(entry));
    if (!file) throw new Error(`${name} has no file of its licence`);
    return { name, version: about.version, licence: about.license ?? "", text: readFileSync(join(folder, file), "utf8").trim() };
  });
}

/** Resolves the import "bundled-licences" to the given list. */
function licencesModule(list) {
  return {
    name: "licences",
    setup(builder) {
      builder.onResolve({ filter: /^bundled-licences$/ }, () => ({ path: "bundled-licences", namespace: "licences" }));
      builder.onLoad({ filter: /.*/, namespace: "licences" }, () => ({ contents: JSON.stringify(list), loader: "json" }));
    },
  };
}

function bundle(list) {
  return build({
    absWorkingDir: here,
    entryPoints: ["src/main.ts"],
    bundle: true,
    minify: true,
    format: "iife",
    charset: "ascii",
    target: "es2020",
    legalComments: "none",
    metafile: true,
    write: false,
    logLevel: "warning",
    plugins: [licencesModule(list)],
  });
}

// Twice: the first bundle tells which packages the second one has to name.
const first = await bundle([]);
const list = licences(first.metafile.inputs);
const text = (await bundle(list)).outputFiles[0].text.replace(/<\/(script)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
if (/<\/script/i.test(text)) throw new Error("the bundle would end the page's script element");
if (!existsSync(out)) mkdirSync(out, { recursive: true });
writeFileSync(join(out, "report.js"), text);
console.log(`report.js: ${(text.length / 1024).toFixed(0)} KiB with ${list.map((entry) => `${entry.name} ${entry.version}`).join(", ") || "no libraries"}`);
