// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { SceneView } from "../data";
import { addDownloads } from "../download";
import { onPaper } from "../print";
import type { Store } from "../store";
import { Layers } from "./layers";
import { Stage, graphics } from "./stage";
import { Viewer } from "./viewer";

const help =
  "Drag turns, Shift and drag or two fingers move, the mouse wheel zooms once the view is clicked (or with Ctrl). " +
  "Keys: arrows turn, Shift and arrows move, + and \u2212 zoom, 1 to 5 choose a view. A click on the patch reads its value.";

function make<K extends keyof HTMLElementTagNameMap>(tag: K, className: string): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  element.className = className;
  return element;
}

/** The picture and the layers over it in one. */
function composed(stage: Stage, layers: Layers): HTMLCanvasElement {
  stage.drawNow();
  const both = document.createElement("canvas");
  both.width = stage.canvas.width;
  both.height = stage.canvas.height;
  const pen = both.getContext("2d");
  if (!pen) throw new Error("the browser gives no canvas to draw on");
  pen.drawImage(stage.canvas, 0, 0);
  layers.copyTo(pen, both.width / stage.width);
  return both;
}

function toBlob(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the browser could not write the picture"))), "image/png"),
  );
}

interface Live {
  stage: Stage;
  /** The picture of the store's step, in light colours. */
  printed: () => HTMLCanvasElement;
  /** Shows the store's step again. */
  restore: () => void;
}

/** Fills the frame with the live scene. */
function start(figure: HTMLElement, frame: HTMLElement, view: SceneView, store: Store, software: boolean): Live {
  const box = make("div", "scene-stage");
  const canvas = make("canvas", "scene-canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  const caption = figure.querySelector("figcaption")?.textContent ?? "";
  canvas.setAttribute("aria-label", `${caption ? `${caption}. ` : ""}Three-dimensional view of wheel, rail and contact. ${help}`);
  const output = make("output", "scene-value");
  const hint = make("p", "scene-hint");
  hint.textContent = help;
  box.append(canvas);

  const stage = new Stage(canvas, software);
  const layers = new Layers(box);
  const measure = (): void => {
    const { width, height } = box.getBoundingClientRect();
    if (width < 2 || height < 2) return;
    stage.resize(Math.round(width), Math.round(height));
  };
  const fullScreen = (): void => {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void frame.requestFullscreen();
  };
  frame.append(box);
  measure();
  const viewer = new Viewer(figure, stage, layers, output, view, store, fullScreen);
  frame.replaceChildren(viewer.panel.element, box, output, hint);
  measure();
  new ResizeObserver(() => {
    measure();
    stage.invalidate();
  }).observe(box);

  store.onStep(() => viewer.setStep());
  store.onPoint(() => viewer.pointChanged());
  store.onTheme((theme) => viewer.setTheme(theme));
  addDownloads(figure, { png: () => toBlob(composed(stage, layers)) }, view.id);
  const printed = (): HTMLCanvasElement => {
    viewer.setTheme("light");
    viewer.setStep();
    const picture = composed(stage, layers);
    picture.className = "scene-print";
    viewer.setTheme(store.theme);
    return picture;
  };
  return { stage, printed, restore: () => viewer.setStep() };
}

/** Wheel, rail and contact in space. What needs the graphics is made when the figure first comes in sight. */
export function mountScene(figure: HTMLElement, view: SceneView, store: Store): void {
  const plot = figure.querySelector<HTMLElement>(".plot") ?? figure.appendChild(make("div", "plot"));
  const kind = graphics();
  if (kind === "none") {
    const note = make("p", "scene-missing");
    note.textContent = "This browser offers no WebGL, which the view in space needs. The other views show the same results.";
    plot.append(note);
    figure.dataset["ready"] = "false";
    return;
  }
  const frame = make("div", "scene");
  plot.replaceChildren(frame);
  let live: Live | null = null;
  const started = (): Live => (live ??= start(figure, frame, view, store, kind === "software"));
  // Paper shows it whether it was ever in sight or not.
  window.addEventListener("beforeprint", () => frame.append(started().printed()));
  onPaper(figure, store, () => [started().printed()]);
  window.addEventListener("afterprint", () => {
    frame.querySelector(".scene-print")?.remove();
    live?.restore();
  });
  const watch = new IntersectionObserver(
    (entries) => {
      const visible = entries[entries.length - 1]?.isIntersecting ?? false;
      if (visible) started();
      live?.stage.setVisible(visible);
    },
    { rootMargin: "160px" },
  );
  watch.observe(figure);
}
