// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { PictureView } from "./data";
import { addDownloads } from "./download";
import { svgToPng } from "./svg";

/** The SVG texts of a figure's pictures: elements of the page, or images with their SVG inside. */
function textsOf(figure: HTMLElement): string[] {
  const inline = [...figure.querySelectorAll<SVGSVGElement>(".plot > svg")].map((svg) => new XMLSerializer().serializeToString(svg));
  const images = [...figure.querySelectorAll<HTMLImageElement>("img.picture")].flatMap((image) => {
    const match = /^data:image\/svg\+xml;base64,(.*)$/s.exec(image.src);
    if (!match) return [];
    const bytes = Uint8Array.from(atob(match[1]!), (c) => c.charCodeAt(0));
    return [new TextDecoder().decode(bytes)];
  });
  return [...inline, ...images];
}

/** A picture is drawn by the program; it gets its downloads, a row for each where there are several. */
export function mountPicture(figure: HTMLElement, view: PictureView): void {
  const texts = textsOf(figure);
  texts.forEach((text, k) => {
    addDownloads(figure, { svg: () => text, png: () => svgToPng(text) }, texts.length === 1 ? view.id : `${view.id}-${k + 1}`);
  });
}
