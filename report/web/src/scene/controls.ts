// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { panned, presets, turned, zoomed, type Orbit, type ViewName } from "./orbit";

export interface ControlTarget {
  orbit: Orbit;
  readonly height: number;
  moved(): void;
  preset(name: ViewName): void;
  /** A click or tap, in pixels from the top left of the canvas. */
  pick(x: number, y: number): void;
}

const degreesPerPixel = 0.4;
const clickReach = 5;

interface Finger {
  x: number;
  y: number;
}

/** Mouse and fingers: drag turns, Shift, right button or two fingers shift, wheel or pinch zooms. The wheel scrolls the page until the view is focused. */
function followPointers(canvas: HTMLCanvasElement, target: ControlTarget): void {
  const fingers = new Map<number, Finger>();
  let start: Finger | null = null;
  const local = (event: PointerEvent | WheelEvent): Finger => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    const at = local(event);
    fingers.set(event.pointerId, at);
    start = fingers.size === 1 && event.button === 0 ? at : null;
  });

  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const at = local(event);
    if (start && Math.hypot(at.x - start.x, at.y - start.y) < clickReach) return;
    start = null;
    const [dx, dy] = [at.x - before.x, at.y - before.y];
    const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const was = Math.hypot(before.x - other.x, before.y - other.y);
      const is = Math.hypot(at.x - other.x, at.y - other.y);
      target.orbit = panned(zoomed(target.orbit, Math.max(1, was) / Math.max(1, is)), 0.5 * dx, 0.5 * dy, target.height);
    } else if (event.shiftKey || (event.buttons & 6) !== 0) target.orbit = panned(target.orbit, dx, dy, target.height);
    else target.orbit = turned(target.orbit, dx * degreesPerPixel, dy * degreesPerPixel);
    fingers.set(event.pointerId, at);
    target.moved();
  });

  const lift = (event: PointerEvent): void => {
    fingers.delete(event.pointerId);
    if (event.type === "pointerup" && start) target.pick(start.x, start.y);
    start = null;
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());

  canvas.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
      const amount = Math.min(240, Math.max(-240, event.deltaY * lines));
      const at = local(event);
      const box = canvas.getBoundingClientRect();
      const [right, down] = [at.x - 0.5 * box.width, at.y - 0.5 * box.height];
      // The point under the mouse stays where it is.
      const closer = zoomed(panned(target.orbit, -right, -down, target.height), Math.exp(0.0016 * amount * (event.ctrlKey ? 4 : 1)));
      target.orbit = panned(closer, right, down, target.height);
      target.moved();
    },
    { passive: false },
  );
}

/** Arrows turn, with Shift they move; + and - zoom; 1, 2, ... choose a view, Home the first one. */
function followKeys(canvas: HTMLCanvasElement, target: ControlTarget): void {
  const ways: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const way = ways[event.key];
    const preset = presets[Number(event.key) - 1] ?? (event.key === "Home" ? presets[0] : undefined);
    if (way && event.shiftKey) target.orbit = panned(target.orbit, 24 * way[0], 24 * way[1], target.height);
    else if (way) target.orbit = turned(target.orbit, 5 * way[0], 5 * way[1]);
    else if (event.key === "+" || event.key === "=") target.orbit = zoomed(target.orbit, 1 / 1.15);
    else if (event.key === "-" || event.key === "_") target.orbit = zoomed(target.orbit, 1.15);
    else if (preset) target.preset(preset.name);
    else return;
    event.preventDefault();
    target.moved();
  });
}

export function addControls(canvas: HTMLCanvasElement, target: ControlTarget): void {
  followPointers(canvas, target);
  followKeys(canvas, target);
}
