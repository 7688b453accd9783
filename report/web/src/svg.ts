// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

const namespace = "http://www.w3.org/2000/svg";

export type Attributes = Record<string, string | number>;

/** An SVG element with attributes and children; texts become text nodes. */
export function el<K extends keyof SVGElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(namespace, name);
  for (const [key, value] of Object.entries(attributes))
    if (key === "style") element.style.cssText = String(value); // as an attribute it would be against the policy of the page
    else element.setAttribute(key, String(value));
  element.append(...children);
  return element;
}

const inlined = [
  "fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray", "stroke-linejoin", "stroke-linecap",
  "opacity", "font-family", "font-size", "font-weight", "font-style", "font-variant-numeric", "text-anchor", "dominant-baseline",
  "paint-order", "shape-rendering", "image-rendering", "visibility",
];

function inlineStyles(from: Element, to: ElementCSSInlineStyle & Element): void {
  const computed = getComputedStyle(from);
  const style = inlined
    .map((property) => [property, computed.getPropertyValue(property)] as const)
    .filter(([, value]) => value !== "")
    .map(([property, value]) => `${property}:${value}`)
    .join(";");
  to.style.cssText = style;
  to.removeAttribute("class");
}

/** Runs something while the page has its light colours, as pictures for documents have; nothing of it is painted. */
export function inLightColours<T>(make: () => T): T {
  const root = document.documentElement;
  const before = root.getAttribute("data-theme");
  root.setAttribute("data-theme", "light");
  try {
    return make();
  } finally {
    if (before === null) root.removeAttribute("data-theme");
    else root.setAttribute("data-theme", before);
  }
}

/**
 * Text of an SVG element that needs no style sheet: styles are written into a copy, in light colours on white. The element must be
 * in the document. Elements of class "hover" and "cursor-layer" are left out.
 */
export function standaloneSvg(svg: SVGSVGElement): string {
  return inLightColours(() => {
    const copy = svg.cloneNode(true) as SVGSVGElement;
    const from = [...svg.querySelectorAll("*")];
    const to = [...copy.querySelectorAll<SVGElement>("*")];
    inlineStyles(svg, copy);
    from.forEach((element, i) => {
      const twin = to[i];
      if (twin) inlineStyles(element, twin);
    });
    from.forEach((element, i) => {
      if (element.classList.contains("hover") || element.classList.contains("cursor-layer")) to[i]?.remove();
    });
    const { width, height } = sizeOf(svg);
    copy.setAttribute("xmlns", namespace);
    copy.setAttribute("width", String(width));
    copy.setAttribute("height", String(height));
    copy.prepend(el("rect", { x: 0, y: 0, width, height, fill: "#ffffff" }));
    return new XMLSerializer().serializeToString(copy);
  });
}

function sizeOf(svg: SVGSVGElement): { width: number; height: number } {
  const box = svg.viewBox.baseVal;
  if (box.width > 0) return { width: box.width, height: box.height };
  const { width, height } = svg.getBoundingClientRect();
  return { width, height };
}

/** A PNG of the text of an SVG picture, `scale` pixels to its unit. */
export async function svgToPng(text: string, scale = 2): Promise<Blob> {
  const url = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(1, Math.round(image.naturalWidth * scale));
    canvas.height = Math.max(1, Math.round(image.naturalHeight * scale));
    const context = canvas.getContext("2d");
    if (!context) throw new Error("no canvas");
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await canvasToPng(canvas);
  } finally {
    URL.revokeObjectURL(url);
  }
}

export function canvasToPng(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture could not be made"))), "image/png");
  });
}

/** Width of a text of the charts in pixels, near enough for margins. */
export function textWidth(text: string, size = 11.5): number {
  return [...text].length * size * 0.57;
}
