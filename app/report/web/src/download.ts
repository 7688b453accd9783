// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

export interface DownloadSources {
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

/** A small row of download buttons below a figure; files are named after the page, the figure and what it shows just now. */
export function addDownloads(figure: HTMLElement, sources: DownloadSources, name: string, shown: () => string = () => ""): void {
  const row = document.createElement("div");
  row.className = "downloads";
  const add = (label: string, make: () => Promise<Blob> | Blob): void => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = label;
    button.title = `Download ${label}`;
    button.setAttribute("aria-label", `Download ${name} as ${label}`);
    button.addEventListener("click", () => {
      button.disabled = true;
      Promise.resolve()
        .then(make)
        .then((blob) => save(blob, fileName(named(name, shown()), label.toLowerCase())))
        .catch((error: unknown) => {
          button.title = `Failed: ${String(error)}`;
          button.classList.add("failed");
        })
        .finally(() => (button.disabled = false));
    });
    row.append(button);
  };
  const { svg, png, csv } = sources;
  if (svg) add("SVG", () => new Blob([svg()], { type: "image/svg+xml" }));
  if (png) add("PNG", png);
  if (csv) add("CSV", () => new Blob([csv()], { type: "text/csv" }));
  figure.append(row);
}
