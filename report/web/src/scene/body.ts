// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { BufferAttribute, BufferGeometry, Group, Mesh, Sphere, Vector3, type Matrix4 } from "three";

import type { SurfaceData } from "../data";
import { decode } from "../packed";
import { bodyMaterials, rgbVector, type BodyMaterials, type SharedUniforms } from "./materials";
import type { Rgb } from "../colours";
import type { BodyStyle } from "./orbit";
import { coarseIndex, meanSpacing, strideFor } from "./detail";
import type { Ground } from "./drape";
import { boundBlock, exaggerated, meshOfGrid, type SurfaceMesh } from "./surface";
import { columnMajor, length, sub, toOuter, type Place, type Vec3 } from "./vec";

/** A wheel or rail in the picture: its geometry goes to the graphics card once, a step only changes its place. */
export class Body {
  readonly group = new Group();
  readonly mesh: SurfaceMesh;
  place: Place | null = null;
  style: BodyStyle = "solid";
  positions: Float32Array;
  /** Greatest size of the deviation [mm]; 0: none. */
  readonly deviationSize: number;
  private readonly materials: BodyMaterials;
  private readonly drawn: Mesh[] = [];
  private readonly depths: Mesh[] = [];
  private readonly spacing: readonly [number, number];
  /** Index of each block by its stride. */
  private readonly indices: Map<string, BufferAttribute>[] = [];
  private readonly position: BufferAttribute;
  private readonly normal: BufferAttribute;

  constructor(
    readonly data: SurfaceData,
    blobs: string[],
    shared: SharedUniforms,
  ) {
    const { body, nu, nv, closed } = data;
    const deviation = data.deviation ? decode(data.deviation, blobs) : null;
    const [x, y, z] = [decode(data.x, blobs), decode(data.y, blobs), decode(data.z, blobs)];
    this.mesh = meshOfGrid({ body, nu, nv, x, y, z, deviation, closed });
    this.positions = this.mesh.positions;
    let size = 0;
    for (const value of this.mesh.deviation ?? []) if (Math.abs(value) > size) size = Math.abs(value);
    this.deviationSize = size;
    this.materials = bodyMaterials({ nu: this.mesh.nu, nv, closed }, shared);
    this.position = new BufferAttribute(this.mesh.positions.slice(), 3);
    this.normal = new BufferAttribute(this.mesh.normals.slice(), 3);
    const excess = new BufferAttribute(this.mesh.deviation?.map((v) => (Number.isFinite(v) ? v : 0)) ?? new Float32Array(this.mesh.nu * nv), 1);
    this.spacing = meanSpacing(this.mesh);
    this.group.matrixAutoUpdate = false;
    for (const block of this.mesh.blocks) {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", this.position);
      geometry.setAttribute("normal", this.normal);
      geometry.setAttribute("deviation", excess);
      const index = new BufferAttribute(block.index, 1);
      geometry.setIndex(index);
      this.indices.push(new Map([["1 1", index]]));
      geometry.boundingSphere = new Sphere(new Vector3(...block.centre), block.radius);
      this.drawn.push(this.part(geometry, this.materials.solid));
      this.depths.push(this.part(geometry, this.materials.depth));
    }
  }

  private part(geometry: BufferGeometry, material: BodyMaterials["solid"]): Mesh {
    const part = new Mesh(geometry, material);
    part.matrixAutoUpdate = false;
    this.group.add(part);
    return part;
  }

  /** Gives back what the graphics card holds of it. */
  dispose(): void {
    for (const { geometry } of this.drawn) geometry.dispose();
  }

  setColour(colour: Rgb): void {
    this.materials.base.value.copy(rgbVector(colour));
  }

  /** `order`: of two see-through bodies the one with the lower number, the farther one, is drawn first. */
  setStyle(style: BodyStyle, order: number): void {
    this.style = style;
    for (const part of this.drawn) {
      part.visible = style !== "hidden";
      part.material = style === "hidden" ? this.materials.solid : this.materials[style];
      part.renderOrder = style === "glass" ? 2 * order + 1 : 0;
    }
    for (const part of this.depths) {
      part.visible = style === "glass";
      part.renderOrder = 2 * order;
    }
  }

  /** Shows the deviation larger; see exaggerated(). */
  exaggerate(factor: number): void {
    const { positions, normals } = exaggerated(this.mesh, factor, this.data.closed);
    if (positions === this.positions) return;
    this.positions = positions;
    this.position.array.set(positions);
    this.normal.array.set(normals);
    this.position.needsUpdate = this.normal.needsUpdate = true;
    this.mesh.blocks.forEach((block, k) => {
      boundBlock(block, positions);
      const sphere = this.drawn[k]?.geometry.boundingSphere;
      sphere?.center.set(...block.centre);
      if (sphere) sphere.radius = block.radius;
    });
  }

  /**
   * Joins cells that are small in the picture. `pixels`: of a millimetre at a distance of one; `limit`: of the joined cells [pixels];
   * `nearest`: nothing counts as nearer than this [mm]; `cut`: distance beyond the plane before which bodies are cut away [mm].
   */
  setDetail(eye: Vec3, pixels: number, limit: number, nearest: number, cut: (p: Vec3) => number): void {
    if (this.style === "hidden" || !this.place) return;
    this.mesh.blocks.forEach((block, k) => {
      const centre = this.inWorld(block.centre);
      const drawn = this.drawn[k]!;
      drawn.visible = this.style !== "cut" || cut(centre) > -block.radius;
      if (!drawn.visible) return;
      const away = length(sub(centre, eye)) - 0.6 * block.radius;
      const scale = pixels / Math.max(nearest, away);
      const stride = { stations: strideFor(this.spacing[0] * scale, limit), points: strideFor(this.spacing[1] * scale, 0.6 * limit) };
      const key = `${stride.stations} ${stride.points}`;
      const known = this.indices[k]!;
      let index = known.get(key);
      if (!index) known.set(key, (index = new BufferAttribute(coarseIndex(this.mesh, block, stride), 1)));
      const { geometry } = drawn;
      if (geometry.index !== index) geometry.setIndex(index);
    });
  }

  /** A point relative to the mesh's centre in the world. */
  private inWorld(p: Vec3): Vec3 {
    const v = new Vector3(...p).applyMatrix4(this.group.matrix);
    return [v.x, v.y, v.z];
  }

  /** Places the body in track axes, drawn relative to `anchor`. Null: not in this step. */
  setPlace(place: Place | null, anchor: Vec3): void {
    this.place = place;
    this.group.visible = place !== null;
    if (!place) return;
    const [x, y, z] = toOuter(place, this.mesh.centre);
    const matrix: Matrix4 = this.group.matrix;
    matrix.fromArray(columnMajor({ origin: [x - anchor[0], y - anchor[1], z - anchor[2]], rotation: place.rotation }));
    this.group.matrixWorldNeedsUpdate = true;
  }

  ground(): Ground | null {
    return this.place ? { place: this.place, centre: this.mesh.centre, positions: this.positions, blocks: this.mesh.blocks } : null;
  }

  /** Of the sphere about the mesh's centre that holds it [mm]. */
  get radius(): number {
    return Math.max(0, ...this.mesh.blocks.map(({ centre, radius }) => length(centre) + radius));
  }
}
