// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { BufferAttribute, BufferGeometry, Group, Mesh, type ShaderMaterial } from "three";

import { STATE_COLOURS, lut } from "../colours";
import type { FieldInfo, Frame, Patch } from "../data";
import { decode } from "../packed";
import { arrowsOfPatch } from "./arrows";
import { drape, type Ground } from "./drape";
import { meshOfPatch, quadColours, shownElements, type PatchMesh } from "./patch";
import type { Range } from "./ranges";
import { columnMajor, type Vec3 } from "./vec";

/** A patch of a frame as it is drawn. */
export interface ShownPatch {
  patch: Patch;
  heights: Float32Array;
  mesh: PatchMesh;
  surface: Mesh;
  arrows: Mesh | null;
}

/** How patches are coloured; `key` tells two ways apart. */
export interface Painting {
  field: FieldInfo;
  range: Range;
  key: string;
}

interface Entry {
  patches: ShownPatch[];
  painted: string;
  arrowsFor: number;
}

const kept = 48;
const missing = [150, 150, 150, 255];

function painter(values: ArrayLike<number> | null, { field, range }: Painting): (element: number, out: Uint8Array, at: number) => void {
  if (!values) return (_, out, at) => out.set(missing, at);
  if (field.kind === "state") {
    return (element, out, at) => {
      const state = STATE_COLOURS[Math.round(values[element]!)];
      out.set(state && state.alpha > 0 ? [...state.rgb, 255] : missing, at);
    };
  }
  const table = lut(field.kind, 256);
  const scale = 255 / (range.high - range.low);
  return (element, out, at) => {
    const value = values[element]!;
    if (!Number.isFinite(value)) return out.set(missing, at);
    const k = 4 * Math.min(255, Math.max(0, Math.round((value - range.low) * scale)));
    for (let c = 0; c < 4; ++c) out[at + c] = table[k + c]!;
  };
}

/** The patches of the frames: geometry is made when a frame is first shown, and the last ones are kept. */
export class PatchLayer {
  readonly group = new Group();
  shown: ShownPatch[] = [];
  private readonly entries = new Map<string, Entry>();

  constructor(
    private readonly blobs: string[],
    private readonly material: ShaderMaterial,
    private readonly arrowMaterial: ShaderMaterial,
  ) {}

  values(patch: Patch, field: string): ArrayLike<number> | null {
    const packed = patch.values[field];
    return packed ? decode(packed, this.blobs) : null;
  }

  /**
   * Shows a frame's patches on the ground. `key`: of frame and shape of the ground. `greatest`: traction of the longest arrow [MPa]; 0
   * for no arrows.
   */
  show(frame: Frame | null, key: string, ground: () => Ground | null, painting: Painting, greatest: number, anchor: Vec3): void {
    this.group.clear();
    this.shown = [];
    if (!frame || frame.patches.length === 0) return;
    let entry = this.entries.get(key);
    this.entries.delete(key);
    if (!entry) {
      const under = ground();
      entry = { patches: frame.patches.map((patch) => this.make(patch, under)), painted: "", arrowsFor: -1 };
    }
    this.entries.set(key, entry);
    this.forgetOldest();
    if (entry.painted !== painting.key) for (const shown of entry.patches) this.paint(shown, painting);
    entry.painted = painting.key;
    if (greatest > 0 && entry.arrowsFor !== greatest) {
      for (const shown of entry.patches) this.addArrows(shown, greatest);
      entry.arrowsFor = greatest;
    }
    this.shown = entry.patches;
    for (const { patch, surface, arrows } of entry.patches) {
      const o = patch.origin_mm;
      const place = { origin: [o[0] - anchor[0], o[1] - anchor[1], o[2] - anchor[2]] as Vec3, rotation: patch.rotation };
      for (const part of [surface, arrows]) {
        if (!part) continue;
        part.matrix.fromArray(columnMajor(place));
        part.matrixWorldNeedsUpdate = true;
        part.visible = part === surface || greatest > 0;
        this.group.add(part);
      }
    }
  }

  private make(patch: Patch, ground: Ground | null): ShownPatch {
    const elements = shownElements(patch, this.values(patch, "state"), this.values(patch, "pressure"));
    const heights = drape(patch, ground);
    const mesh = meshOfPatch(patch, elements, heights);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3));
    geometry.setIndex(new BufferAttribute(mesh.index, 1));
    return { patch, heights, mesh, surface: this.part(geometry, this.material, 1), arrows: null };
  }

  private part(geometry: BufferGeometry, material: ShaderMaterial, order: number): Mesh {
    const part = new Mesh(geometry, material);
    part.matrixAutoUpdate = false;
    part.renderOrder = order;
    return part;
  }

  private paint({ patch, mesh, surface }: ShownPatch, painting: Painting): void {
    const colours = quadColours(mesh.elements, painter(this.values(patch, painting.field.name), painting));
    surface.geometry.setAttribute("paint", new BufferAttribute(colours, 4, true));
  }

  private addArrows(shown: ShownPatch, greatest: number): void {
    shown.arrows?.geometry.dispose();
    shown.arrows = null;
    const [tx, ts] = [this.values(shown.patch, "traction_x"), this.values(shown.patch, "traction_s")];
    if (!tx || !ts || shown.mesh.elements.length === 0) return;
    const arrows = arrowsOfPatch(shown.patch, shown.mesh.elements, tx, ts, shown.heights, greatest);
    if (arrows.count === 0) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(arrows.positions, 3));
    geometry.setAttribute("paint", new BufferAttribute(arrows.colours, 4, true));
    geometry.setIndex(new BufferAttribute(arrows.index, 1));
    shown.arrows = this.part(geometry, this.arrowMaterial, 2);
  }

  private forgetOldest(): void {
    for (const [key, entry] of this.entries) {
      if (this.entries.size <= kept) return;
      for (const { surface, arrows } of entry.patches) {
        surface.geometry.dispose();
        arrows?.geometry.dispose();
      }
      this.entries.delete(key);
    }
  }

  get triangles(): number {
    return this.shown.reduce((sum, { mesh }) => sum + mesh.index.length / 3, 0);
  }
}
