// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

/** What a chart does with the pointer; places are in pixels of the panel's picture. */
export interface PointerTarget {
  /** Whether a plain drag moves the cursor (else it marks a range to zoom to). */
  readonly stepsByDrag: boolean;
  readonly isZoomed: boolean;
  inPlot(panel: number, y: number): boolean;
  chooseStep(panel: number, x: number, y: number): void;
  click(panel: number, x: number, y: number): void;
  hover(panel: number, x: number, y: number): void;
  leave(): void;
  band(from: number, to: number): void;
  zoomTo(from: number, to: number): void;
  zoomAbout(x: number, factor: number): void;
  pan(pixels: number): void;
  reset(): void;
}

type Mode = "none" | "step" | "band" | "pan";

/**
 * Drag: the cursor where steps are linked, else a range to zoom to (with Shift always a range); below the plot: moves a zoomed window.
 * Wheel with Ctrl or a pinch: zoom; with Shift: move. Double click: all.
 */
export function attachPointer(svg: SVGSVGElement, panel: number, target: PointerTarget): void {
  let mode: Mode = "none";
  let startX = 0;
  let lastX = 0;
  const place = (event: MouseEvent): [number, number] => {
    const box = svg.getBoundingClientRect();
    const scale = svg.viewBox.baseVal.width / Math.max(1, box.width);
    return [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
  };

  svg.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    const [x, y] = place(event);
    startX = lastX = x;
    if (!target.inPlot(panel, y)) mode = target.isZoomed ? "pan" : "none";
    else mode = target.stepsByDrag && !event.shiftKey ? "step" : "band";
    if (mode === "none") return;
    svg.setPointerCapture(event.pointerId);
    if (mode === "step") target.chooseStep(panel, x, y);
  });
  svg.addEventListener("pointermove", (event) => {
    const [x, y] = place(event);
    if (mode === "step") target.chooseStep(panel, x, y);
    if (mode === "band" && Math.abs(x - startX) > 4) target.band(startX, x);
    if (mode === "pan") target.pan(lastX - x);
    lastX = x;
    if (target.inPlot(panel, y) && mode !== "band") target.hover(panel, x, y);
    else target.leave();
  });
  const finish = (event: PointerEvent, done: boolean): void => {
    const [x, y] = place(event);
    if (mode === "band") {
      target.band(0, 0);
      if (done && Math.abs(x - startX) > 8) target.zoomTo(startX, x);
      else if (done) target.click(panel, x, y);
    } else if (mode === "step" && done && Math.abs(x - startX) <= 4) target.click(panel, x, y);
    mode = "none";
  };
  svg.addEventListener("pointerup", (event) => finish(event, true));
  svg.addEventListener("pointercancel", (event) => finish(event, false));
  svg.addEventListener("pointerleave", () => target.leave());
  svg.addEventListener("dblclick", () => target.reset());
  svg.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey && !event.metaKey && !(event.shiftKey && target.isZoomed)) return;
      event.preventDefault();
      const [x] = place(event);
      if (event.shiftKey && !event.ctrlKey && !event.metaKey) target.pan(event.deltaY || event.deltaX);
      else target.zoomAbout(x, Math.min(2, Math.max(0.5, Math.exp(event.deltaY * (event.deltaMode === 1 ? 0.06 : 0.004)))));
    },
    { passive: false },
  );
}
