// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { Group } from "three";

import type { FieldInfo, Frame, FrameSet, Placed, SceneView } from "../data";
import type { Store, Theme } from "../store";
import { formatNumber } from "../numbers";
import { decode } from "../packed";
import { Body } from "./body";
import { addControls, type ControlTarget } from "./controls";
import { placeOf } from "./drape";
import type { Layers } from "./layers";
import { patchMaterial, rgbVector, sharedUniforms } from "./materials";
import { eye, millimetresPerPixel, orbitOf, outlook, presets, type Orbit, type ViewName } from "./orbit";
import { drawCaption, drawColourBar, drawDeviationBar, drawMarker, showAxes } from "./overlay";
import { paletteOf, type Palette } from "./palette";
import { makePanel, type Options, type Panel } from "./panel";
import { elementCorners } from "./patch";
import { PatchLayer } from "./patches";
import { pickElement } from "./picking";
import { colourRange, rangeOf, rangeOfSet, union, type Range } from "./ranges";
import type { Stage } from "./stage";
import { contactPoint, reachAlong, subjectOf, type PlacedMesh } from "./subject";
import { add, dot, length, sub, toOuter, turn, type Place, type Vec3 } from "./vec";

const here: Place = { origin: [0, 0, 0], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
const patchBias = 0.6;
/** Cells of the surfaces smaller than this are joined [pixels]. */
const restCell = 2.5;
const movingCell = 14;

/** Wheel, rail and patches of the current step, with the camera and what the reader chose to see. */
export class Viewer implements ControlTarget {
  orbit: Orbit = { target: [0, 0, 0], distance: 300, azimuth: 30, elevation: 35 };
  readonly panel: Panel;
  readonly options: Options;
  private readonly set: FrameSet | undefined;
  private readonly fields: FieldInfo[];
  private readonly bodies = new Map<number, Body>();
  private readonly shared = sharedUniforms();
  private readonly world = new Group();
  private readonly patches: PatchLayer;
  private readonly ranges = new Map<string, Range | null>();
  private greatestTraction = 0;
  private renewals = 0;
  private palette: Palette;
  private wheel: Body | null = null;
  private rail: Body | null = null;
  private frame: Frame | null = null;
  private frameIndex = -1;
  /** The world's origin in track axes: goes along the track with the contact. */
  private anchor: Vec3 = [0, 0, 0];
  private contact: Vec3 | null = null;
  private range: Range = { low: 0, high: 1 };
  private view: ViewName | null = "contact";
  private ordered = "";
  private exaggeration = 1;
  /** How far the patches go along the track from the contact point [mm]. */
  private cutReach = 0;

  constructor(
    private readonly figure: HTMLElement,
    private readonly stage: Stage,
    private readonly layers: Layers,
    private readonly output: HTMLOutputElement,
    private readonly sceneView: SceneView,
    private readonly store: Store,
    fullScreen: () => void,
  ) {
    const { data } = store;
    this.set = data.sets[sceneView.set];
    this.palette = paletteOf(store.theme);
    this.patches = new PatchLayer(data.blobs, patchMaterial(this.shared.mesh, patchBias, false), patchMaterial({ value: 0 }, 1.3 * patchBias, true));
    const frames = this.set?.frames ?? [];
    const present = (name: string): boolean => frames.some((frame) => frame.patches.some((patch) => patch.values[name]));
    this.fields = data.fields.filter((field) => present(field.name));
    const placed = (body: "wheel" | "rail"): boolean =>
      frames.some((frame) => frame[body]) || (frames.length === 0 && data.surfaces.some((surface) => surface.body === body));
    const offered = {
      fields: this.fields,
      wheel: placed("wheel"),
      rail: placed("rail"),
      arrows: present("traction_x") && present("traction_s"),
      deviation: data.surfaces.some((surface) => surface.deviation),
    };
    const contact = this.fields.length > 0;
    this.options = {
      field: this.fields.find((field) => field.name === "pressure")?.name ?? this.fields[0]?.name ?? "",
      sameScale: true,
      wheel: contact && offered.rail ? "cut" : "solid",
      rail: "solid",
      arrows: offered.arrows,
      mesh: false,
      section: contact,
      deviation: offered.deviation && !contact,
      exaggeration: 1,
    };
    this.greatestTraction = this.measuredTraction();
    this.panel = makePanel(this.options, offered, () => this.optionsChanged(), (name) => this.preset(name), fullScreen);
    this.world.matrixAutoUpdate = false;
    this.world.add(this.patches.group);
    this.stage.scene.add(this.world);
    this.stage.before = (moving) => this.prepare(moving);
    this.stage.after = () => this.finish();
    addControls(stage.canvas, this);
    this.setTheme(store.theme);
    this.setStep();
  }

  get height(): number {
    return this.stage.height;
  }

  moved(): void {
    this.stage.invalidate();
  }

  /** The range of a field over all steps, measured once. */
  private rangeOf(name: string): Range | null {
    const known = this.ranges.get(name);
    if (known !== undefined || !this.set) return known ?? null;
    const { blobs } = this.store.data;
    const all = (count: number): number[] => Array.from({ length: count }, (_, k) => k);
    const range = rangeOfSet(this.set, name, (packed) => rangeOf(decode(packed, blobs), all(packed.count)));
    this.ranges.set(name, range);
    return range;
  }

  private measuredTraction(): number {
    const traction = this.rangeOf("traction");
    const [tx, ts] = [this.rangeOf("traction_x"), this.rangeOf("traction_s")];
    const size = (range: Range | null): number => (range ? Math.max(Math.abs(range.low), Math.abs(range.high)) : 0);
    return traction ? traction.high : Math.hypot(size(tx), size(ts));
  }

  /** The data are others: what was made of those before goes. */
  renew(): void {
    for (const [key, body] of this.bodies) {
      if (this.store.data.surfaces[key] === body.data) continue;
      this.world.remove(body.group);
      body.dispose();
      this.bodies.delete(key);
    }
    this.ranges.clear();
    this.greatestTraction = this.measuredTraction();
    ++this.renewals;
    this.ordered = "";  // a new body has no style yet
    this.frameIndex = -2;
    this.setStep();
  }

  private get field(): FieldInfo | undefined {
    return this.fields.find((field) => field.name === this.options.field);
  }

  setTheme(theme: Theme): void {
    this.palette = paletteOf(theme);
    this.stage.setBackground(this.palette.background);
    this.shared.line.value.copy(rgbVector(this.palette.line));
    for (const body of this.bodies.values()) body.setColour(this.palette[body.data.body]);
    this.stage.invalidate();
  }

  private body(index: number): Body | null {
    const data = this.store.data.surfaces[index];
    if (!data) return null;
    let body = this.bodies.get(index);
    if (!body) {
      body = new Body(data, this.store.data.blobs, this.shared);
      body.setColour(this.palette[data.body]);
      if (this.exaggeration !== 1) body.exaggerate(this.exaggeration);
      this.bodies.set(index, body);
      this.world.add(body.group);
      const spans = [...this.bodies.values()].map((b) => b.deviationSize);
      this.shared.span.value = Math.max(...spans) || 1;
    }
    return body;
  }

  /** Bodies and patches of the store's step. The first time the camera takes the first view. */
  setStep(): void {
    const first = this.frameIndex === -1;
    const index = this.store.data.timeline ? this.store.frame() : 0;
    const frame = index === null ? null : (this.set?.frames[index] ?? null);
    if (!first && index === this.frameIndex) return;
    this.frameIndex = index ?? -2;
    const seen = this.contact !== null && this.inSight(this.contact);
    this.frame = frame;
    const shownBodies = frame ?? (first ? this.firstPlaced() : null);
    if (shownBodies) {
      this.wheel = this.placedBody(shownBodies.wheel);
      this.rail = this.placedBody(shownBodies.rail);
      const contact = contactPoint(shownBodies.patches);
      this.follow(contact ?? shownBodies.wheel?.origin_mm ?? null, first);
      if (contact) this.contact = contact;
      for (const [key, body] of this.bodies) {
        const placed = [shownBodies.wheel, shownBodies.rail].find((p) => p?.surface === key) ?? null;
        body.setPlace(placed ? { origin: placed.origin_mm, rotation: placed.rotation } : null, this.anchor);
      }
    }
    this.styleBodies();
    this.showPatches();
    if (first) this.preset(this.wheel || !this.rail || this.fields.length > 0 ? this.firstView() : "contact", false);
    else if (seen && this.contact && !this.inSight(this.contact)) this.orbit = { ...this.orbit, target: sub(this.contact, this.anchor) };
    this.stage.invalidate();
  }

  private firstView(): ViewName {
    return this.fields.length > 0 ? "contact" : "whole";
  }

  /** Where the current step has no frame: the first one that has bodies; without frames all bodies where their own axes are. */
  private firstPlaced(): Frame | null {
    const frames = this.set?.frames ?? [];
    const found = frames.find((frame) => frame.wheel ?? frame.rail) ?? null;
    if (found || frames.length > 0) return found;
    const place = (body: "wheel" | "rail"): Placed | null => {
      const surface = this.store.data.surfaces.findIndex((data) => data.body === body);
      return surface < 0 ? null : { surface, origin_mm: [0, 0, 0], rotation: [...here.rotation] };
    };
    return { name: "", status: "ok", message: "", patches: [], wheel: place("wheel"), rail: place("rail") };
  }

  private placedBody(placed: Placed | null): Body | null {
    return placed ? this.body(placed.surface) : null;
  }

  /** Along the track the world goes with the contact; across it and in height it stays. */
  private follow(point: Vec3 | null, first: boolean): void {
    if (!point) return;
    this.anchor = first ? [...point] : [point[0], this.anchor[1], this.anchor[2]];
  }

  private inSight(point: Vec3): boolean {
    const at = this.stage.project(sub(point, this.anchor));
    if (!at) return false;
    const { width, height } = this.stage;
    return Math.abs(at[0] / width - 0.5) < 0.42 && Math.abs(at[1] / height - 0.5) < 0.42;
  }

  private showPatches(): void {
    const { field, options, frame } = this;
    const shape = `${this.frameIndex} ${this.renewals} ${this.exaggeration}`;
    const info = field ?? { name: "", label: "", unit: "", kind: "sequential" as const };
    let range = options.sameScale ? this.rangeOf(info.name) : null;
    if (!options.sameScale && frame) {
      for (const patch of frame.patches) {
        const values = this.patches.values(patch, info.name);
        const inside = this.patches.values(patch, "pressure");
        if (!values) continue;
        const elements = Array.from({ length: values.length }, (_, k) => k).filter((k) => !inside || inside[k]! > 0);
        range = union(range, rangeOf(values, elements));
      }
    }
    this.range = colourRange(range, info.kind);
    const key = `${info.name} ${this.range.low} ${this.range.high}`;
    const ground = () => this.rail?.ground() ?? this.wheel?.ground() ?? null;
    const greatest = options.arrows ? this.greatestTraction : 0;
    this.patches.show(frame, shape, ground, { field: info, range: this.range, key }, greatest, this.anchor);
    const contact = frame ? contactPoint(frame.patches) : null;
    if (contact) this.shared.sectionAt.value.set(...sub(contact, this.anchor));
    this.cutReach = contact && frame ? reachAlong(frame.patches, contact[0]) : 0;
    this.tellPoint();
  }

  private optionsChanged(): void {
    const { options } = this;
    this.shared.mesh.value = options.mesh ? 1 : 0;
    this.shared.coloured.value = options.deviation ? 1 : 0;
    this.shared.section.value = options.section ? 1 : 0;
    if (options.exaggeration !== this.exaggeration) {
      this.exaggeration = options.exaggeration;
      for (const body of this.bodies.values()) body.exaggerate(this.exaggeration);
    }
    this.styleBodies();
    this.showPatches();
    this.panel.refresh(this.view);
    this.stage.invalidate();
  }

  /** The camera and the bodies as a view has them. */
  preset(name: ViewName, restyle = true): void {
    const preset = presets.find((p) => p.name === name);
    if (!preset) return;
    this.view = name;
    const placed = (body: Body | null): PlacedMesh | null => (body?.place ? { mesh: body.mesh, place: body.place } : null);
    const subject = subjectOf(this.frame?.patches ?? [], placed(this.wheel), placed(this.rail));
    const orbit = orbitOf(preset, subject, this.stage.width / Math.max(1, this.stage.height));
    this.orbit = { ...orbit, target: sub(orbit.target, this.anchor) };
    if (restyle) {
      if (this.options.wheel !== "hidden") this.options.wheel = preset.wheel;
      if (this.options.rail !== "hidden") this.options.rail = preset.rail;
    }
    this.optionsChanged();
  }

  /** See-through bodies are drawn from the far one to the near one. */
  private styleBodies(): void {
    const main = this.frame?.patches[0];
    const normal: Vec3 = main ? turn(main.rotation, [0, 0, 1]) : [0, 0, 1];
    const above = dot(outlook(this.orbit), normal) < 0;
    const ordered = `${above} ${this.options.wheel} ${this.options.rail} ${this.bodies.size}`;
    if (ordered === this.ordered) return;
    this.ordered = ordered;
    for (const body of this.bodies.values()) {
      const isWheel = body.data.body === "wheel";
      body.setStyle(isWheel ? this.options.wheel : this.options.rail, isWheel === above ? 5 : 4);
    }
  }

  private prepare(moving: boolean): void {
    this.styleBodies();
    this.shared.quick.value = moving && this.stage.software && !this.options.mesh ? 1 : 0;
    const forward = outlook(this.orbit)[0] <= 0 ? 1 : -1;
    const cutAt = 1.04 * this.cutReach;
    this.shared.cut.value.set(forward, 0, 0, -cutAt);
    const { x } = this.shared.sectionAt.value;
    const beyond = (p: Vec3): number => forward * (p[0] - x) - cutAt;
    let reach = 100;
    for (const body of this.bodies.values()) {
      if (!body.place) continue;
      const centre = sub(toOuter(body.place, body.mesh.centre), this.anchor);
      reach = Math.max(reach, length(sub(centre, this.orbit.target)) + body.radius);
    }
    this.stage.aim(this.orbit, reach);
    const pixels = 1 / millimetresPerPixel({ ...this.orbit, distance: 1 }, this.stage.height);
    const limit = moving && this.stage.software ? movingCell * this.stage.coarseness : restCell;
    for (const body of this.bodies.values()) body.setDetail(eye(this.orbit), pixels, limit, 0.5 * this.orbit.distance, beyond);
  }

  private finish(): void {
    this.drawLayers();
    const { dataset } = this.figure;
    let triangles = this.patches.triangles;
    for (const body of this.bodies.values()) if (body.place && body.style !== "hidden") triangles += body.mesh.triangles;
    dataset["ready"] = "true";
    dataset["triangles"] = String(triangles);
    dataset["drawn"] = String(this.stage.renderer.info.render.triangles);
    dataset["pictures"] = String(this.stage.pictures);
    dataset["frame"] = String(this.frameIndex);
  }

  /** Text and signs over the picture, in pixels of the page. */
  private drawLayers(): void {
    const { layers, palette, stage, field, options } = this;
    const { width, height } = stage;
    const style = `${this.store.theme} ${palette.text}`;
    this.drawPoint();

    const caption = this.caption();
    const captionBox = { x: 4, y: 4, width: Math.min(0.62 * width + 16, width - 8), height: 8 + 20 * Math.max(1, caption.length) };
    layers.show("caption", caption.length > 0 ? captionBox : null, `${style} ${caption.join("\n")}`, (pen) =>
      drawCaption(pen, palette, caption, 14, 18, 0.6 * width),
    );

    const barHeight = Math.min(200, 0.42 * height);
    const bar = field && this.patches.shown.length > 0 ? { x: width - 190, y: 4, width: 186, height: barHeight + 56 } : null;
    layers.show("bar", bar, `${style} ${field?.name} ${this.range.low} ${this.range.high}`, (pen) => {
      if (field) drawColourBar(pen, palette, field, this.range, width - 12, 14, barHeight);
    });

    const deviates = options.deviation && [...this.bodies.values()].some((body) => body.place && body.deviationSize > 0);
    const span = this.shared.span.value;
    layers.show("deviation", deviates ? { x: width - 270, y: height - 64, width: 266, height: 62 } : null, `${style} ${span}`, (pen) => {
      const title = width > 620 ? "deviation from mean section [mm]" : "deviation [mm]";
      drawDeviationBar(pen, palette, span, title, width - 12, height - 10, Math.min(210, 0.42 * width));
    });

    showAxes(layers, palette, this.orbit, style, width, height, true);
  }

  private caption(): string[] {
    const { frame } = this;
    const lines: string[] = [];
    if (frame?.name) lines.push(frame.name);
    if (frame?.message) lines.push(frame.message);
    if (frame?.trimmed) lines.push(frame.trimmed);
    if (!frame && (this.set?.frames.length ?? 0) > 0) lines.push("No contact fields are kept of this step");
    if (this.exaggeration !== 1) lines.push(`Deviation shown ${this.exaggeration} times as large`);
    return lines;
  }

  /** The picked element if it is in this step. */
  private picked(): { corners: Vec3[]; place: Place; value: number; text: string } | null {
    const { point } = this.store;
    if (!point || point.set !== this.sceneView.set) return null;
    const shown = this.patches.shown[point.patch];
    if (!shown || point.ix >= shown.patch.nx || point.iy >= shown.patch.ny) return null;
    const { patch, heights } = shown;
    const value = this.field ? (this.patches.values(patch, this.field.name)?.[point.ix + patch.nx * point.iy] ?? NaN) : NaN;
    const text = Number.isFinite(value) && this.field?.kind !== "state" ? `${formatNumber(value)} ${this.field?.unit ?? ""}`.trim() : "";
    return { corners: elementCorners(patch, heights, point.ix, point.iy), place: placeOf(patch), value, text };
  }

  private drawPoint(): void {
    const { layers, palette, stage } = this;
    const { width, height } = stage;
    const picked = this.picked();
    const corners = picked?.corners.map((corner) => stage.project(sub(toOuter(picked.place, corner), this.anchor))) ?? [];
    const seen = corners.filter((corner): corner is [number, number] => corner !== null);
    const key = `${this.store.theme} ${picked?.text} ${seen.flat().join(" ")}`;
    layers.show("point", seen.length === 4 ? { x: 0, y: 0, width, height } : null, key, (pen) =>
      drawMarker(pen, palette, seen, picked?.text ?? "", width),
    );
  }

  /** Says the value of the picked element below the picture. */
  private tellPoint(): void {
    const picked = this.picked();
    this.figure.dataset["picked"] = picked ? String(picked.value) : "";
    const { point } = this.store;
    const patch = point && this.frame?.patches[point.patch];
    if (!picked || !point || !patch || !this.field) {
      this.output.textContent = "";
      return;
    }
    const at = (first: number, step: number, k: number): string => formatNumber(Number((first + k * step).toFixed(3)));
    const where = `x ${at(patch.x0_mm, patch.dx_mm, point.ix)} mm, s ${at(patch.s0_mm, patch.ds_mm, point.iy)} mm`;
    const state = this.field.kind === "state" ? `state ${picked.value}` : picked.text;
    this.output.textContent = `${patch.name ? `${patch.name}, ` : ""}${where}: ${this.field.label} ${state}`;
  }

  pointChanged(): void {
    this.tellPoint();
    this.stage.invalidate();
  }

  pick(x: number, y: number): void {
    const { origin, direction } = this.stage.ray(x, y);
    const solids = [this.wheel, this.rail].filter((body): body is Body => body?.style === "solid");
    const picked = pickElement(this.patches.shown, solids, add(origin, this.anchor), direction);
    this.store.setPoint(picked ? { set: this.sceneView.set, ...picked } : null);
  }
}
