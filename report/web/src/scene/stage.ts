// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { Color, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";

import type { Rgb } from "../colours";
import { eye, fieldOfView, type Orbit } from "./orbit";
import type { Vec3 } from "./vec";

/** How the browser draws WebGL: not at all, with the processor, or with a graphics card. */
export type Graphics = "none" | "software" | "hardware";

export function graphics(): Graphics {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return "none";
  const about = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(about ? about.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name) ? "software" : "hardware";
}

const restAfter = 250;
const slowFrame = 30;
const longestBreak = 250;
const coarsest = 6;
const leastRatio = 0.5;

/**
 * Draws the scene when something changed and it is in sight. While pictures follow each other the resolution falls as far as they
 * need to keep coming; at rest one more picture has it in full.
 */
export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(fieldOfView, 2, 1, 10000);
  readonly renderer: WebGLRenderer;
  width = 0;
  height = 0;
  visible = false;
  pictures = 0;
  lost = false;
  /** How much larger than usual the cells of surfaces may be while pictures follow each other. */
  coarseness = 1;
  /** Called before and after each picture; moving: more pictures may follow soon. */
  before: (moving: boolean) => void = () => undefined;
  after: () => void = () => undefined;
  private background = new Color();
  private asked = false;
  /** From drawing a moving picture until the browser is ready for the next one [ms]. */
  private cost = 0;
  private rest: ReturnType<typeof setTimeout> | undefined;
  private ratio = 0;
  private movingRatio: number;
  private slow = 0;

  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly software: boolean,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !software, stencil: true, powerPreference: "high-performance" });
    this.camera.up.set(0, 0, -1);
    this.movingRatio = software ? 1 : this.fullRatio();
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.lost = true;
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.lost = false;
      this.renderer.setClearColor(this.background, 1);
      this.invalidate();
    });
  }

  /** Pixels of the picture a pixel of the page, at rest; the processor smooths edges by more of them. */
  private fullRatio(): number {
    return Math.min(2, this.software ? Math.max(1.5, window.devicePixelRatio) : window.devicePixelRatio);
  }

  setBackground([r, g, b]: Rgb): void {
    this.background = new Color(`rgb(${r},${g},${b})`);
    this.renderer.setClearColor(this.background, 1);
  }

  resize(width: number, height: number): void {
    if (width === this.width && height === this.height) return;
    this.width = width;
    this.height = height;
    this.ratio = 0;
    this.invalidate();
  }

  setVisible(visible: boolean): void {
    this.visible = visible;
    if (visible) this.invalidate();
  }

  /**
   * Asks for a picture, quick first; once nothing was asked for some time one more follows in full resolution. A picture that a
   * processor draws slowly is followed by a longer break: the other views of the page keep up with the slider.
   */
  invalidate(): void {
    clearTimeout(this.rest);
    if (this.asked || !this.visible) return;
    this.asked = true;
    const next = (): number => requestAnimationFrame(() => this.drawMoving());
    if (this.software && this.cost > slowFrame) setTimeout(next, Math.min(longestBreak, 1.5 * this.cost));
    else next();
  }

  private drawMoving(): void {
    this.asked = false;
    this.adapt(this.cost);
    this.draw(true);
    const from = performance.now();
    requestAnimationFrame(() => (this.cost = performance.now() - from));
    clearTimeout(this.rest);
    this.rest = setTimeout(() => {
      this.cost = 0;
      if (this.visible) this.draw(false);
    }, restAfter);
  }

  /** Pictures that follow each other too slowly get fewer pixels. */
  private adapt(passed: number): void {
    this.slow = passed > slowFrame ? this.slow + 1 : Math.max(0, this.slow - 0.25);
    if (this.slow < 3) return;
    this.slow = 0;
    const much = passed > 2 * slowFrame;
    if (this.coarseness < coarsest) this.coarseness = Math.min(coarsest, this.coarseness * (much ? 2 : 1.42));
    this.movingRatio = Math.max(leastRatio, this.movingRatio * (much ? 0.7 : 0.85));
  }

  /** At full resolution, at once; the caller reads the canvas in the same task. */
  drawNow(): void {
    this.draw(false);
  }

  private draw(moving: boolean): void {
    if (this.width < 2 || this.height < 2 || this.lost) return;
    const ratio = moving ? this.movingRatio : this.fullRatio();
    if (ratio !== this.ratio) {
      this.ratio = ratio;
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(this.width, this.height, false);
    }
    this.before(moving);
    this.renderer.render(this.scene, this.camera);
    this.pictures += 1;
    this.after();
  }

  /** Aims the camera; `reach`: radius about the target beyond which there is nothing [mm]. */
  aim(orbit: Orbit, reach: number): void {
    const at = eye(orbit);
    this.camera.position.set(...at);
    this.camera.lookAt(...orbit.target);
    this.camera.aspect = this.width / Math.max(1, this.height);
    this.camera.near = Math.max(0.2, 0.02 * orbit.distance);
    this.camera.far = orbit.distance + reach;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  /** Where a point of the world is in the picture, in pixels of the page from the top left; null behind the camera. */
  project(point: Vec3): [number, number] | null {
    const v = new Vector3(...point).applyMatrix4(this.camera.matrixWorldInverse);
    if (v.z > -this.camera.near) return null;
    v.applyMatrix4(this.camera.projectionMatrix);
    return [(0.5 + 0.5 * v.x) * this.width, (0.5 - 0.5 * v.y) * this.height];
  }

  /** The ray under a pixel of the page: its start and unit direction. */
  ray(x: number, y: number): { origin: Vec3; direction: Vec3 } {
    const { position } = this.camera;
    const v = new Vector3((2 * x) / this.width - 1, 1 - (2 * y) / this.height, 0.5).unproject(this.camera).sub(position).normalize();
    return { origin: [position.x, position.y, position.z], direction: [v.x, v.y, v.z] };
  }
}
