// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Bundles the scripts of the report into one file, which the page holds inline, and those that pages which solve have beside it.
// usage: node build.mjs --out DIR      writes DIR/report.js and DIR/live.js
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

/** Resolves the import `name` to a value. */
function made(name, value) {
  return {
    name,
    setup(builder) {
      builder.onResolve({ filter: new RegExp(`^${name}$`) }, () => ({ path: name, namespace: name }));
      builder.onLoad({ filter: /.*/, namespace: name }, () => ({ contents: JSON.stringify(value), loader: "json" }));
    },
  };
}

function bundle(entry, plugins = []) {
  return build({
    absWorkingDir: here,
    entryPoints: [`src/${entry}.ts`],
    bundle: true,
    minify: true,
    format: "iife",
    charset: "ascii",
    target: "es2020",
    legalComments: "none",
    metafile: true,
    write: false,
    logLevel: "warning",
    plugins,
  });
}

function write(name, { outputFiles }, about) {
  const text = outputFiles[0].text.replace(/<\/(script)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
  if (/<\/script/i.test(text)) throw new Error("the bundle would end the page's script element");
  writeFileSync(join(out, name), text);
  console.log(`${name}: ${(text.length / 1024).toFixed(0)} KiB with ${about}`);
}

if (!existsSync(out)) mkdirSync(out, { recursive: true });
// Twice: the first bundle tells which packages the second one has to name.
const first = await bundle("main", [made("bundled-licences", [])]);
const list = licences(first.metafile.inputs);
write("report.js", await bundle("main", [made("bundled-licences", list)]), list.map((entry) => `${entry.name} ${entry.version}`).join(", ") || "no libraries");
const worker = (await bundle("live/worker")).outputFiles[0].text;
const live = await bundle("live/main", [made("live-worker", worker)]);
const alien = licences(live.metafile.inputs).filter(({ name }) => !list.some((entry) => entry.name === name));
if (alien.length > 0) throw new Error(`nothing names ${alien[0].name}`);
write("live.js", live, "the worker");
