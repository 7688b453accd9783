// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { pointerAt } from "./svg";

/** What the reader does on the pictures. */
export interface Actions {
  hover(pixel: [number, number] | null): void;
  pick(pixel: [number, number]): void;
  /** Moves the picked element by columns and rows (s upwards). */
  move(dx: number, ds: number): void;
  peak(): void;
  clear(): void;
  step(by: number): void;
  /** Remembers the picked element, and takes it back. */
  remember(): void;
  recall(): void;
}

/** A quick sideways stroke of a finger is a step, not a choice of an element. */
const FLICK_MS = 260;
const FLICK_PIXELS = 60;

/** Mouse, pen, finger and keys on the pictures. A finger that moves up or down scrolls the page. */
export function listen(target: HTMLElement, drawing: SVGSVGElement, actions: Actions): void {
  let start: { x: number; y: number; at: number; id: number } | null = null;
  target.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !event.isPrimary) return;
    start = { x: event.clientX, y: event.clientY, at: event.timeStamp, id: event.pointerId };
    if (event.pointerType !== "mouse") target.setPointerCapture(event.pointerId);
    actions.remember();
    actions.pick(pointerAt(event, drawing));
  });
  target.addEventListener("pointermove", (event) => {
    const pixel = pointerAt(event, drawing);
    if (start?.id === event.pointerId) actions.pick(pixel);
    else if (event.pointerType === "mouse") actions.hover(pixel);
  });
  target.addEventListener("pointerup", (event) => {
    if (start?.id !== event.pointerId) return;
    const dx = event.clientX - start.x;
    const quick =
      event.timeStamp - start.at < FLICK_MS && Math.abs(dx) > FLICK_PIXELS && Math.abs(event.clientY - start.y) < 0.5 * Math.abs(dx);
    start = null;
    if (!quick || event.pointerType === "mouse") return;
    actions.recall();
    actions.step(dx < 0 ? 1 : -1);
  });
  target.addEventListener("pointercancel", () => {
    if (start) actions.recall();
    start = null;
  });
  target.addEventListener("pointerleave", () => actions.hover(null));
  target.addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const far = event.shiftKey ? 5 : 1;
    const keys: Record<string, () => void> = {
      ArrowLeft: () => actions.move(-far, 0),
      ArrowRight: () => actions.move(far, 0),
      ArrowUp: () => actions.move(0, far),
      ArrowDown: () => actions.move(0, -far),
      Home: () => actions.peak(),
      Escape: () => actions.clear(),
      PageUp: () => actions.step(-1),
      PageDown: () => actions.step(1),
    };
    const action = keys[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
