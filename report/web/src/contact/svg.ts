// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Elements of SVG drawings whose colours are variables of the style sheet, and those drawings as files of their own.

const NS = "http://www.w3.org/2000/svg";

type Attributes = Record<string, string | number>;

export function svg<K extends keyof SVGElementTagNameMap>(name: K, attributes: Attributes = {}, parent?: Element): SVGElementTagNameMap[K] {
  const element = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  parent?.append(element);
  return element;
}

/** Sets an attribute if it differs: unchanged ones cost no redraw. */
export function put(element: Element, name: string, value: string): void {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

/** Sets the text if it differs. */
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

export function show(element: SVGElement, visible: boolean): void {
  put(element, "display", visible ? "inline" : "none");
}

let context: CanvasRenderingContext2D | null | undefined;

/** Width of a text of the drawings [px]. */
export function textWidth(text: string, font = "12px system-ui, sans-serif"): number {
  if (context === undefined) context = document.createElement("canvas").getContext("2d");
  if (!context) return 6.6 * text.length;
  context.font = font;
  return context.measureText(text).width;
}

/** The text, cut with an ellipsis to fit a width [px]. */
export function fitted(text: string, width: number): string {
  if (textWidth(text, "600 12px system-ui, sans-serif") <= width) return text;
  let n = text.length;
  while (n > 1 && textWidth(`${text.slice(0, n)}…`, "600 12px system-ui, sans-serif") > width) --n;
  return `${text.slice(0, n).trimEnd()}…`;
}

/** Runs something while the page has its light colours: files are for white paper. */
function inLight<T>(task: () => T): T {
  const root = document.documentElement;
  const before = root.getAttribute("data-theme");
  root.setAttribute("data-theme", "light");
  try {
    return task();
  } finally {
    if (before === null) root.removeAttribute("data-theme");
    else root.setAttribute("data-theme", before);
  }
}

/** A drawing as text of an SVG file: light colours in place of variables, on white. `prepare` may change the copy. */
export function standalone(drawing: SVGSVGElement, prepare: (copy: SVGSVGElement) => void = () => undefined): string {
  const copy = drawing.cloneNode(true) as SVGSVGElement;
  const width = drawing.getAttribute("width") ?? "0";
  const height = drawing.getAttribute("height") ?? "0";
  for (const name of ["style", "class", "tabindex", "role", "aria-label"]) copy.removeAttribute(name);
  for (const element of copy.querySelectorAll('[display="none"], .live')) element.remove();
  copy.setAttribute("viewBox", `0 0 ${width} ${height}`);
  prepare(copy);
  const paper = svg("rect", { width, height, fill: "#ffffff" });
  copy.insertBefore(paper, copy.firstChild);
  const text = new XMLSerializer().serializeToString(copy);
  return inLight(() => {
    const style = getComputedStyle(document.documentElement);
    return text.replace(/var\((--[\w-]+)\)/g, (_, name: string) => style.getPropertyValue(name).trim().replace(/"/g, "'") || "#000000");
  });
}

/** An SVG file as PNG, `factor` times as large. */
export async function pngOf(text: string, width: number, height: number, factor = 3): Promise<Blob> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * factor);
  canvas.height = Math.round(height * factor);
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the browser gave no picture"))), "image/png"),
  );
}

/** Place of a pointer in the pixels of a drawing. */
export function pointerAt(event: PointerEvent, drawing: SVGSVGElement): [number, number] {
  const box = drawing.getBoundingClientRect();
  const width = Number(drawing.getAttribute("width"));
  const factor = box.width > 0 ? width / box.width : 1;
  return [(event.clientX - box.left) * factor, (event.clientY - box.top) * factor];
}
