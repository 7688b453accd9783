// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

/** A rectangle of the picture, in pixels of the page from its top left. */
export interface Rectangle {
  x: number;
  y: number;
  width: number;
  height: number;
}

interface Layer {
  canvas: HTMLCanvasElement;
  pen: CanvasRenderingContext2D;
  at: Rectangle;
  key: string;
}

/**
 * Small canvases over the picture with text and signs. A browser that draws with the processor pays for every pixel that lies over the
 * moving picture, so there are only those that are needed, and each is drawn again only when what it shows has changed.
 */
export class Layers {
  private readonly layers = new Map<string, Layer>();

  constructor(private readonly box: HTMLElement) {}

  private layer(name: string): Layer | null {
    const known = this.layers.get(name);
    if (known) return known;
    const canvas = document.createElement("canvas");
    const pen = canvas.getContext("2d", { willReadFrequently: true });
    if (!pen) return null;
    canvas.className = "scene-layer";
    canvas.setAttribute("aria-hidden", "true");
    this.box.append(canvas);
    const layer: Layer = { canvas, pen, at: { x: 0, y: 0, width: 0, height: 0 }, key: "" };
    this.layers.set(name, layer);
    return layer;
  }

  /** Shows what `draw` draws, in the picture's coordinates, as long as `key` is the same; null hides the layer. */
  show(name: string, at: Rectangle | null, key: string, draw: (pen: CanvasRenderingContext2D) => void): void {
    if (!at && !this.layers.has(name)) return;
    const layer = this.layer(name);
    if (!layer) return;
    layer.canvas.hidden = !at;
    if (!at) return;
    const scale = Math.min(2, Math.max(1, window.devicePixelRatio));
    const fullKey = [key, at.x, at.y, at.width, at.height, scale].join(" ");
    if (layer.key === fullKey) return;
    layer.key = fullKey;
    layer.at = at;
    const { canvas, pen } = layer;
    const [wide, high] = [Math.ceil(at.width * scale), Math.ceil(at.height * scale)];
    if (canvas.width !== wide) canvas.width = wide;
    if (canvas.height !== high) canvas.height = high;
    canvas.style.left = `${at.x}px`;
    canvas.style.top = `${at.y}px`;
    canvas.style.width = `${wide / scale}px`;
    canvas.style.height = `${high / scale}px`;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, wide, high);
    pen.setTransform(scale, 0, 0, scale, -at.x * scale, -at.y * scale);
    draw(pen);
  }

  /** Copies the layers to a larger canvas, `scale` pixels a pixel of the page. */
  copyTo(pen: CanvasRenderingContext2D, scale: number): void {
    for (const { canvas, at } of this.layers.values())
      if (!canvas.hidden) pen.drawImage(canvas, at.x * scale, at.y * scale, at.width * scale, at.height * scale);
  }
}
