// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { zipSync } from "fflate";

import { allSteps } from "./print";
import type { Store } from "./store";
import { svgToPng } from "./svg";

/** A figure at other steps than the one shown: for films. */
export interface PictureSeries {
  store: Store;
  /** Draws it at the step of the store; its SVG. */
  draw: () => string;
}

export interface DownloadSources {
  series?: PictureSeries;
  svg?: () => string;
  png?: () => Promise<Blob> | Blob;
  csv?: () => string;
}

/** A name that every file system takes. */
export function fileName(name: string, suffix: string): string {
  const plain = name
    .normalize("NFKD")
    .replace(/[^A-Za-z0-9._-]+/g, "-")
    .replace(/^[-.]+|[-.]+$/g, "")
    .slice(0, 80);
  return `${plain || "treadmark"}.${suffix}`;
}

/** The page's title, what a file holds of it, and of which step. */
export function named(name: string, shown = ""): string {
  return [document.title.slice(0, 40).trim(), shown.slice(0, 20).trim(), name].filter((part) => part !== "").join(" ");
}

/** Offers a blob to the reader as a file. */
export function save(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** A picture a step, 0001.png and so on, in one file. */
async function zipOf({ store, draw }: PictureSeries, steps: readonly number[]): Promise<Blob> {
  const drawings = steps.map((step) => new DOMParser().parseFromString(store.at(step, draw), "image/svg+xml").documentElement);
  draw();
  // Films want pictures of one size.
  const [width, height] = ["width", "height"].map((name) => Math.max(...drawings.map((drawing) => Number(drawing.getAttribute(name))))) as [number, number];
  const files: Record<string, Uint8Array> = {};
  for (const [k, drawing] of drawings.entries()) {
    for (const [name, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}` })) drawing.setAttribute(name, String(value));
    const png = await svgToPng(new XMLSerializer().serializeToString(drawing));
    files[`${String(k + 1).padStart(4, "0")}.png`] = new Uint8Array(await png.arrayBuffer());
  }
  return new Blob([zipSync(files, { level: 0 })], { type: "application/zip" });
}

/** A small row of download buttons below a figure; files are named after the page, the figure and what it shows just now. */
export function addDownloads(figure: HTMLElement, sources: DownloadSources, name: string, shown: () => string = () => ""): void {
  const row = document.createElement("div");
  row.className = "downloads";
  const add = (label: string, make: () => Promise<Blob> | Blob, suffix = label.toLowerCase(), what = shown): void => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = label;
    button.title = `Download ${label}`;
    button.setAttribute("aria-label", `Download ${name} as ${label}`);
    button.addEventListener("click", () => {
      button.disabled = true;
      Promise.resolve()
        .then(make)
        .then((blob) => save(blob, fileName(named(name, what()), suffix)))
        .catch((error: unknown) => {
          button.title = `Failed: ${String(error)}`;
          button.classList.add("failed");
        })
        .finally(() => (button.disabled = false));
    });
    row.append(button);
  };
  const { svg, png, csv, series } = sources;
  if (svg) add("SVG", () => new Blob([svg()], { type: "image/svg+xml" }));
  if (png) add("PNG", png);
  const { timeline, blobs } = series?.store.data ?? {};
  const steps = timeline && blobs ? allSteps(timeline, blobs) : [];
  if (series && steps.length > 1) add("PNG of every " + timeline!.label, () => zipOf(series, steps), "zip", () => "");
  if (csv) add("CSV", () => new Blob([csv()], { type: "text/csv" }));
  figure.append(row);
}
