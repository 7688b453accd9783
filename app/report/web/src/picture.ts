// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { PictureView } from "./data";
import { addDownloads } from "./download";

/** A picture is drawn by C++; it only gets its downloads. */
export function mountPicture(figure: HTMLElement, view: PictureView): void {
  const svg = figure.querySelector("svg");
  if (!svg) return;
  addDownloads(figure, { svg: () => new XMLSerializer().serializeToString(svg) }, view.id);
}
