// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { CloudView, SceneView } from "../data";
import { addDownloads } from "../download";
import { onPaper } from "../print";
import type { Store, Theme } from "../store";
import { CloudViewer } from "./cloud";
import { Layers } from "./layers";
import type { Panel } from "./panel";
import { Stage, graphics } from "./stage";
import { Viewer } from "./viewer";

const help =
  "Drag turns, Shift and drag or two fingers move, the mouse wheel zooms once the view is clicked (or with Ctrl). " +
  "Keys: arrows turn, Shift and arrows move, + and \u2212 zoom, 1 to 5 choose a view.";

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

/** What a frame in space shows. */
interface Subject {
  panel: Panel;
  setTheme(theme: Theme): void;
  /** Shows the store's step. */
  setStep(): void;
}

interface Kind {
  /** What is seen, for those who do not. */
  seen: string;
  /** How a value is read. */
  reading: string;
  /** Where the same is to be seen without WebGL. */
  instead: string;
  make(stage: Stage, layers: Layers, output: HTMLOutputElement, fullScreen: () => void): Subject;
}

/** Fills the frame with the live scene. */
function start(figure: HTMLElement, frame: HTMLElement, id: string, kind: Kind, store: Store, software: boolean): Live {
  const words = `${help} ${kind.reading}`;
  const box = make("div", "scene-stage");
  const canvas = make("canvas", "scene-canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  const caption = figure.querySelector("figcaption")?.textContent ?? "";
  canvas.setAttribute("aria-label", `${caption ? `${caption}. ` : ""}${kind.seen} ${words}`);
  const output = make("output", "scene-value");
  const hint = make("p", "scene-hint");
  hint.textContent = words;
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
  const viewer = kind.make(stage, layers, output, fullScreen);
  frame.replaceChildren(viewer.panel.element, box, output, hint);
  measure();
  new ResizeObserver(() => {
    measure();
    stage.invalidate();
  }).observe(box);

  store.onStep(() => viewer.setStep());
  store.onTheme((theme) => viewer.setTheme(theme));
  addDownloads(figure, { png: () => toBlob(composed(stage, layers)) }, id);
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

/** What needs the graphics is made when the figure first comes in sight. */
function mount(figure: HTMLElement, id: string, what: Kind, store: Store): void {
  const plot = figure.querySelector<HTMLElement>(".plot") ?? figure.appendChild(make("div", "plot"));
  const kind = graphics();
  if (kind === "none") {
    const note = make("p", "scene-missing");
    note.textContent = `This browser offers no WebGL, which the view in space needs. ${what.instead}`;
    plot.append(note);
    figure.dataset["ready"] = "false";
    return;
  }
  const frame = make("div", "scene");
  plot.replaceChildren(frame);
  let live: Live | null = null;
  const started = (): Live => (live ??= start(figure, frame, id, what, store, kind === "software"));
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

/** Wheel, rail and contact in space. */
export function mountScene(figure: HTMLElement, view: SceneView, store: Store): void {
  const kind: Kind = {
    seen: "Three-dimensional view of wheel, rail and contact.",
    reading: "A click on the patch reads its value.",
    instead: "The other views show the same results.",
    make: (stage, layers, output, fullScreen) => {
      const viewer = new Viewer(figure, stage, layers, output, view, store, fullScreen);
      store.onPoint(() => viewer.pointChanged());
      store.onRenewal(() => viewer.renew());
      return viewer;
    },
  };
  mount(figure, view.id, kind, store);
}

/** Points in space. */
export function mountCloud(figure: HTMLElement, view: CloudView, store: Store): void {
  const kind: Kind = {
    seen: "Three-dimensional view of points.",
    reading: "Pointing at a point, or a tap on it, reads its value.",
    instead: "The maps below show the same unrolled.",
    make: (stage, layers, output, fullScreen) => new CloudViewer(figure, stage, layers, output, view, store, fullScreen),
  };
  mount(figure, view.id, kind, store);
}
