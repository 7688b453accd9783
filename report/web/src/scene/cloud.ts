// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { BufferAttribute, BufferGeometry, Color, Matrix4, Points, PointsMaterial, SRGBColorSpace } from "three";

import { css, lut } from "../colours";
import type { CloudView } from "../data";
import { formatNumber } from "../numbers";
import { decode, type Decoded } from "../packed";
import type { Store, Theme } from "../store";
import { addControls, type ControlTarget } from "./controls";
import type { Layers } from "./layers";
import { distanceFor, type Orbit, type ViewName } from "./orbit";
import { drawCaption, drawDeviationBar, drawKey, drawMarker, showAxes } from "./overlay";
import { paletteOf, type Palette } from "./palette";
import { startPanel, type Panel, type ViewButton } from "./panel";
import type { Stage } from "./stage";
import type { Vec3 } from "./vec";

const pointSize = 2.5;
const removedSize = 3.5;
/** How far from a point it is still meant [pixels]. */
const reach = 8;

interface Look extends ViewButton {
  azimuth: number;
  elevation: number;
}

/** Ways to look at a cloud; the damage lies where the band has its zero. */
function looksOf(body: CloudView["body"]): Look[] {
  const wheel = body === "wheel";
  return [
    {
      name: "contact",
      label: "Zero",
      title: wheel ? "The tread at the angle 0, from below" : "The rail at x = 0",
      azimuth: 32,
      elevation: wheel ? -34 : 34,
    },
    { name: "along", label: "Along track", title: "Forward along the track", azimuth: 0, elevation: 7 },
    { name: "above", label: "From above", title: "Straight down, forward is upwards", azimuth: 0, elevation: 89.5 },
    { name: "below", label: "From below", title: "Straight up", azimuth: 0, elevation: -89.5 },
    { name: "whole", label: "All points", title: "All points", azimuth: wheel ? 58 : 32, elevation: wheel ? 14 : 34 },
  ];
}

/** The outward normal at a point. */
export function normalAt(body: CloudView["body"], p: Vec3, tilt: number): Vec3 {
  const [across, out] = [Math.sin(tilt), Math.cos(tilt)];
  if (body === "rail") return [0, across, -out];
  const radius = Math.hypot(p[0], p[2]) || 1;
  return [(out * p[0]) / radius, across, (out * p[2]) / radius];
}

/** Of points in the picture ([x, y, how far off]) the front one within reach of a place; -1: none. */
export function pointAt(seen: (k: number) => readonly [number, number, number] | null, count: number, x: number, y: number): number {
  let found = -1;
  let nearest = Infinity;
  for (let k = 0; k < count; ++k) {
    const at = seen(k);
    if (!at || at[2] >= nearest) continue;
    if (Math.hypot(at[0] - x, at[1] - y) > reach) continue;
    found = k;
    nearest = at[2];
  }
  return found;
}

/** A cloud of points, coloured by how far they lie from a surface. */
export class CloudViewer implements ControlTarget {
  orbit: Orbit = { target: [0, 0, 0], distance: 300, azimuth: 30, elevation: 35 };
  readonly panel: Panel;
  private readonly looks: Look[];
  private readonly x: Decoded;
  private readonly y: Decoded;
  private readonly z: Decoded;
  private readonly tilt: Decoded;
  /** Points with values, then the others: their numbers in the data. */
  private readonly valued: number[] = [];
  private readonly others: number[] = [];
  private readonly low: Vec3 = [Infinity, Infinity, Infinity];
  private readonly high: Vec3 = [-Infinity, -Infinity, -Infinity];
  private readonly geometry = new BufferGeometry();
  private readonly otherPoints: Points<BufferGeometry, PointsMaterial>;
  private readonly options = { quantity: 0, exaggeration: 1, others: true };
  private shown = { quantity: -1, exaggeration: 1 };
  private palette: Palette;
  private view: ViewName | null = "whole";
  private picked = -1;

  constructor(
    private readonly figure: HTMLElement,
    private readonly stage: Stage,
    private readonly layers: Layers,
    private readonly output: HTMLOutputElement,
    private readonly data: CloudView,
    private readonly store: Store,
    fullScreen: () => void,
  ) {
    const { blobs } = store.data;
    this.palette = paletteOf(store.theme);
    this.x = decode(data.x, blobs);
    this.y = decode(data.y, blobs);
    this.z = decode(data.z, blobs);
    this.tilt = decode(data.tilt, blobs);
    const first = this.valuesOf(0);
    for (let k = 0; k < this.x.length; ++k) (Number.isNaN(first[k] ?? NaN) ? this.others : this.valued).push(k);
    for (const k of this.valued.length > 0 ? this.valued : this.others) {
      const p = this.place(k);
      for (let i = 0; i < 3; ++i) {
        this.low[i] = Math.min(this.low[i]!, p[i]!);
        this.high[i] = Math.max(this.high[i]!, p[i]!);
      }
    }
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * this.valued.length), 3));
    this.geometry.setAttribute("color", new BufferAttribute(new Float32Array(3 * this.valued.length), 3));
    const points = new Points(this.geometry, new PointsMaterial({ size: pointSize, sizeAttenuation: false, vertexColors: true }));
    const otherGeometry = new BufferGeometry();
    otherGeometry.setAttribute("position", new BufferAttribute(Float32Array.from(this.others.flatMap((k) => this.place(k))), 3));
    this.otherPoints = new Points(otherGeometry, new PointsMaterial({ size: removedSize, sizeAttenuation: false }));
    points.frustumCulled = this.otherPoints.frustumCulled = false;
    stage.scene.add(points, this.otherPoints);

    this.looks = looksOf(data.body);
    const panel = startPanel(this.looks, () => this.optionsChanged(), (name) => this.preset(name), fullScreen);
    const { options } = this;
    panel.choice(
      "quantity",
      "Colour",
      data.quantities.map((quantity, k) => [String(k), quantity.label] as const),
      () => String(options.quantity),
      (value) => (options.quantity = Number(value)),
    );
    const factors = [1, 10, 50, 200].map((factor) => [String(factor), `× ${factor}`] as const);
    panel.choice("exaggeration", "Shown", factors, () => String(options.exaggeration), (value) => (options.exaggeration = Number(value)));
    if (this.others.length > 0)
      panel.tick("others", data.others, `Whether ${data.others} are drawn`, () => options.others, (value) => (options.others = value));
    this.panel = panel;
    stage.before = () => this.aim();
    stage.after = () => this.finish();
    addControls(stage.canvas, this);
    this.followPointer();
    this.setTheme(store.theme);
    this.preset("whole");
  }

  get height(): number {
    return this.stage.height;
  }

  moved(): void {
    this.stage.invalidate();
  }

  setTheme(theme: Theme): void {
    this.palette = paletteOf(theme);
    this.stage.setBackground(this.palette.ground);
    const [r, g, b] = this.palette.removed;
    this.otherPoints.material.color.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
    this.stage.invalidate();
  }

  /** The points are those of all steps. */
  setStep(): void {
    this.stage.invalidate();
  }

  preset(name: ViewName): void {
    const look = this.looks.find((one) => one.name === name);
    if (!look) return;
    const { low, high } = this;
    const middle = (i: 0 | 1 | 2): number => 0.5 * (low[i] + high[i]);
    const aspect = this.stage.width / Math.max(1, this.stage.height);
    const size = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) || 1;
    const near = Math.min(size, 2 * (high[1] - low[1]) || size);
    const at: Vec3 = [middle(0), middle(1), middle(2)];
    const zero: Vec3 = [Math.min(high[0], Math.max(low[0], 0)), middle(1), this.data.body === "wheel" ? high[2] : low[2]];
    const close = name === "contact";
    const extent = close ? near : name === "whole" ? size : Math.max(...[0, 1, 2].map((i) => high[i]! - low[i]!));
    this.view = name;
    this.orbit = {
      target: close ? zero : at,
      azimuth: look.azimuth,
      elevation: look.elevation,
      distance: distanceFor(extent, 0.9 * extent, aspect),
    };
    this.optionsChanged();
  }

  private optionsChanged(): void {
    this.panel.refresh(this.view);
    this.otherPoints.visible = this.options.others;
    this.colour();
    this.tellPoint();
    this.stage.invalidate();
  }

  private valuesOf(quantity: number): Decoded {
    const one = this.data.quantities[quantity];
    return one ? decode(one.values, this.store.data.blobs) : new Float32Array();
  }

  private place(k: number): Vec3 {
    return [this.x[k]!, this.y[k]!, this.z[k]!];
  }

  /** Colours and places of the points by the quantity and how much it is exaggerated. */
  private colour(): void {
    const { quantity, exaggeration } = this.options;
    const one = this.data.quantities[quantity];
    if (!one || (this.shown.quantity === quantity && this.shown.exaggeration === exaggeration)) return;
    this.shown = { quantity, exaggeration };
    const values = this.valuesOf(quantity);
    const table = lut("diverging");
    const colours = Array.from({ length: 256 }, (_, i) =>
      new Color().setRGB(table[4 * i]! / 255, table[4 * i + 1]! / 255, table[4 * i + 2]! / 255, SRGBColorSpace),
    );
    const position = this.geometry.getAttribute("position") as BufferAttribute;
    const colour = this.geometry.getAttribute("color") as BufferAttribute;
    this.valued.forEach((k, i) => {
      const value = values[k]!;
      const t = Math.min(1, Math.max(0, 0.5 + (0.5 * value) / one.span));
      const { r, g, b } = colours[Math.round(255 * t)]!;
      colour.setXYZ(i, r, g, b);
      const p = this.place(k);
      const off = ((exaggeration - 1) * value) / one.per_mm;
      const normal = off === 0 ? p : normalAt(this.data.body, p, this.tilt[k]!);
      position.setXYZ(i, p[0] + off * normal[0], p[1] + off * normal[1], p[2] + off * normal[2]);
    });
    position.needsUpdate = colour.needsUpdate = true;
  }

  private aim(): void {
    const { low, high } = this;
    const size = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    const { target } = this.orbit;
    const off = Math.hypot(...[0, 1, 2].map((i) => target[i]! - 0.5 * (low[i]! + high[i]!)));
    this.stage.aim(this.orbit, off + size + 400);
  }

  /** Where points are drawn, those with values first. */
  private drawn(index: number): Vec3 {
    const position = this.geometry.getAttribute("position");
    if (index < this.valued.length) return [position.getX(index), position.getY(index), position.getZ(index)];
    return this.place(this.others[index - this.valued.length]!);
  }

  pick(x: number, y: number): void {
    const { camera, width, height } = this.stage;
    const { elements: m } = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const seen = (k: number): [number, number, number] | null => {
      const [px, py, pz] = this.drawn(k);
      const w = m[3] * px + m[7] * py + m[11] * pz + m[15];
      if (!(w > camera.near)) return null;
      const u = (m[0] * px + m[4] * py + m[8] * pz + m[12]) / w;
      const v = (m[1] * px + m[5] * py + m[9] * pz + m[13]) / w;
      return [(0.5 + 0.5 * u) * width, (0.5 - 0.5 * v) * height, w];
    };
    const count = this.valued.length + (this.options.others ? this.others.length : 0);
    const found = pointAt(seen, count, x, y);
    if (found === this.picked) return;
    this.picked = found;
    this.tellPoint();
    this.drawPoint();
  }

  /** A mouse reads values without a click; once a picture. */
  private followPointer(): void {
    const { canvas } = this.stage;
    let asked = false;
    canvas.addEventListener("pointermove", (event) => {
      if (asked || event.buttons !== 0 || event.pointerType === "touch") return;
      asked = true;
      requestAnimationFrame(() => {
        asked = false;
        const box = canvas.getBoundingClientRect();
        this.pick(event.clientX - box.left, event.clientY - box.top);
      });
    });
  }

  private tellPoint(): void {
    const { picked, valued, others, data } = this;
    const k = picked < valued.length ? valued[picked] : others[picked - valued.length];
    this.figure.dataset["picked"] = k === undefined ? "" : String(k);
    if (k === undefined) {
      this.output.textContent = "";
      return;
    }
    const mm = (value: number): string => value.toFixed(2).replace("-", "\u2212");
    const where = `x ${mm(this.x[k]!)} mm, y ${mm(this.y[k]!)} mm, z ${mm(this.z[k]!)} mm`;
    const words =
      picked < valued.length
        ? data.quantities.map((quantity, q) => `${quantity.label} ${formatNumber(this.valuesOf(q)[k])} ${quantity.unit}`).join(", ")
        : `one of the ${data.others}`;
    this.output.textContent = `${where}: ${words}`;
  }

  private drawPoint(): void {
    const { layers, palette, stage, picked } = this;
    const { width, height } = stage;
    const at = picked < 0 ? null : stage.project(this.drawn(picked));
    layers.show("point", at ? { x: 0, y: 0, width, height } : null, `${this.store.theme} ${at?.join(" ")}`, (pen) => {
      if (at) drawMarker(pen, palette, [at], "", width);
    });
  }

  private finish(): void {
    this.drawLayers();
    const { dataset } = this.figure;
    dataset["ready"] = "true";
    dataset["points"] = String(this.valued.length + (this.options.others ? this.others.length : 0));
    dataset["pictures"] = String(this.stage.pictures);
  }

  /** Text and signs over the picture, in pixels of the page. */
  private drawLayers(): void {
    const { layers, palette, stage, options, data } = this;
    const { width, height } = stage;
    const style = `${this.store.theme} ${palette.text}`;
    this.drawPoint();
    const one = data.quantities[options.quantity];
    const caption = [...data.caption];
    if (options.exaggeration !== 1 && one) caption.push(`${one.label} shown ${options.exaggeration} times as large`);
    const captionBox = { x: 4, y: 4, width: width - 8, height: 8 + 20 * caption.length };
    layers.show("caption", captionBox, `${style} ${caption.join("\n")}`, (pen) => drawCaption(pen, palette, caption, 14, 18, width - 32));

    const barBox = { x: width - 270, y: height - 64, width: 266, height: 62 };
    layers.show("bar", one ? barBox : null, `${style} ${options.quantity}`, (pen) => {
      if (one) drawDeviationBar(pen, palette, one.span, `${one.label} [${one.unit}]`, width - 16, height - 10, Math.min(210, 0.42 * width));
    });
    const keyBox = { x: width - 184, y: height - 92, width: 180, height: 24 };
    layers.show("key", this.otherPoints.visible && this.others.length > 0 ? keyBox : null, style, (pen) =>
      drawKey(pen, palette, css(palette.removed), data.others, width - 16, height - 79),
    );

    // a narrow picture has the room of the scale for the bar
    showAxes(layers, palette, this.orbit, style, width, height, width > 480);
  }
}
