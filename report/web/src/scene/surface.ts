// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Vec3 } from "./vec";

/** A rectangle of a grid with its faces: small enough that what is out of sight need not be drawn. */
export interface Block {
  index: Uint32Array;
  /** First and last ones, both included. */
  stations: [number, number];
  points: [number, number];
  centre: Vec3;
  radius: number;
}

/** A grid of points as triangles that face out of the body. Vertices are relative to `centre`, which keeps them exact as floats. */
export interface SurfaceMesh {
  /** Stations; of a closed grid the first one is repeated at the end, so that the numbers of stations grow across the seam. */
  nu: number;
  nv: number;
  centre: Vec3;
  positions: Float32Array;
  normals: Float32Array;
  deviation: Float32Array | null;
  blocks: Block[];
  triangles: number;
  /** 1 where there is a point. */
  there: Uint8Array;
  /** Whether faces go round the other way than stations and points do. */
  turned: boolean;
}

export interface SurfaceGrid {
  body: "wheel" | "rail";
  nu: number;
  nv: number;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  z: ArrayLike<number>;
  deviation: ArrayLike<number> | null;
  closed: boolean;
}

const cellsAlong = 24;
const cellsAcross = 32;

function middle(values: ArrayLike<number>): number {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < values.length; ++i) {
    const value = values[i]!;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return high >= low ? 0.5 * (low + high) : 0;
}

/** Faces of the quads between two stations: two triangles, one where a corner is missing, none where more are. */
function stripFaces(out: number[], station: number, [first, last]: [number, number], nv: number, there: Uint8Array): void {
  for (let j = first; j < last; ++j) {
    const corners = [station * nv + j, (station + 1) * nv + j, (station + 1) * nv + j + 1, station * nv + j + 1];
    const present = corners.filter((corner) => there[corner]);
    if (present.length === 4) out.push(corners[0]!, corners[1]!, corners[2]!, corners[0]!, corners[2]!, corners[3]!);
    else if (present.length === 3) out.push(present[0]!, present[1]!, present[2]!);
  }
}

/** Normals at the vertices, the mean of the faces around by area; those of the seam of a closed grid agree. */
export function vertexNormals(positions: Float32Array, blocks: Block[], nv: number, closed: boolean): Float32Array {
  const normals = new Float32Array(positions.length);
  for (const { index } of blocks) {
    for (let f = 0; f < index.length; f += 3) {
      const a = 3 * index[f]!;
      const b = 3 * index[f + 1]!;
      const c = 3 * index[f + 2]!;
      const ux = positions[b]! - positions[a]!;
      const uy = positions[b + 1]! - positions[a + 1]!;
      const uz = positions[b + 2]! - positions[a + 2]!;
      const vx = positions[c]! - positions[a]!;
      const vy = positions[c + 1]! - positions[a + 1]!;
      const vz = positions[c + 2]! - positions[a + 2]!;
      const nx = uy * vz - uz * vy;
      const ny = uz * vx - ux * vz;
      const nz = ux * vy - uy * vx;
      for (const k of [a, b, c]) {
        normals[k]! += nx;
        normals[k + 1]! += ny;
        normals[k + 2]! += nz;
      }
    }
  }
  if (closed) {
    const last = normals.length - 3 * nv;
    for (let k = 0; k < 3 * nv; ++k) normals[k] = normals[last + k] = normals[k]! + normals[last + k]!;
  }
  for (let k = 0; k < normals.length; k += 3) {
    const size = Math.hypot(normals[k]!, normals[k + 1]!, normals[k + 2]!) || 1;
    normals[k]! /= size;
    normals[k + 1]! /= size;
    normals[k + 2]! /= size;
  }
  return normals;
}

/** Whether the faces point into the body: a wheel's material is nearer to its axle (y through the origin), a rail's lies below (z down). */
function pointsInwards(grid: SurfaceGrid, mesh: SurfaceMesh): boolean {
  const round = grid.body === "wheel" || grid.closed;
  const axle = grid.body === "wheel" ? [0, 0] : [mesh.centre[0], mesh.centre[2]];
  let outwards = 0;
  for (let k = 0; k < mesh.normals.length; k += 3) {
    if (!round) outwards -= mesh.normals[k + 2]!;
    else {
      const x = mesh.positions[k]! + mesh.centre[0] - axle[0]!;
      const z = mesh.positions[k + 2]! + mesh.centre[2] - axle[1]!;
      outwards += (mesh.normals[k]! * x + mesh.normals[k + 2]! * z) / (Math.hypot(x, z) || 1);
    }
  }
  return outwards < 0;
}

function turnOver(mesh: SurfaceMesh): void {
  mesh.turned = true;
  for (let k = 0; k < mesh.normals.length; ++k) mesh.normals[k] = -mesh.normals[k]!;
  for (const { index } of mesh.blocks)
    for (let f = 0; f < index.length; f += 3) [index[f + 1], index[f + 2]] = [index[f + 2]!, index[f + 1]!];
}

/** Sphere around the vertices of a block. */
export function boundBlock(block: Block, positions: Float32Array): void {
  const low: Vec3 = [Infinity, Infinity, Infinity];
  const high: Vec3 = [-Infinity, -Infinity, -Infinity];
  for (const vertex of block.index)
    for (let k = 0; k < 3; ++k) {
      const value = positions[3 * vertex + k]!;
      if (value < low[k]!) low[k] = value;
      if (value > high[k]!) high[k] = value;
    }
  block.centre = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])];
  block.radius = 0.5 * Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

/** The grid as triangles. Points that are NaN leave holes. */
export function meshOfGrid(grid: SurfaceGrid): SurfaceMesh {
  const { nv, closed } = grid;
  const given = grid.nu * nv;
  const nu = closed && grid.nu > 1 ? grid.nu + 1 : grid.nu;
  const centre: Vec3 = [middle(grid.x), middle(grid.y), middle(grid.z)];
  const positions = new Float32Array(3 * nu * nv);
  const deviation = grid.deviation ? new Float32Array(nu * nv) : null;
  const there = new Uint8Array(nu * nv);
  for (let k = 0; k < nu * nv; ++k) {
    const from = k % given;
    const x = grid.x[from]! - centre[0];
    const y = grid.y[from]! - centre[1];
    const z = grid.z[from]! - centre[2];
    if (deviation) deviation[k] = grid.deviation![from]!;
    if (!Number.isFinite(x + y + z)) continue;
    there[k] = 1;
    positions.set([x, y, z], 3 * k);
  }
  const mesh: SurfaceMesh = { nu, nv, centre, positions, normals: new Float32Array(0), deviation, blocks: [], triangles: 0, there, turned: false };
  for (let i0 = 0; i0 + 1 < nu; i0 += cellsAlong)
    for (let j0 = 0; j0 + 1 < nv; j0 += cellsAcross) {
      const stations: Block["stations"] = [i0, Math.min(nu - 1, i0 + cellsAlong)];
      const points: Block["points"] = [j0, Math.min(nv - 1, j0 + cellsAcross)];
      const faces: number[] = [];
      for (let i = i0; i < stations[1]; ++i) stripFaces(faces, i, points, nv, there);
      if (faces.length === 0) continue;
      const block: Block = { index: Uint32Array.from(faces), stations, points, centre: [0, 0, 0], radius: 0 };
      boundBlock(block, positions);
      mesh.blocks.push(block);
      mesh.triangles += faces.length / 3;
    }
  const closes = closed && nu > grid.nu;
  mesh.normals = vertexNormals(positions, mesh.blocks, nv, closes);
  if (pointsInwards(grid, mesh)) turnOver(mesh);
  return mesh;
}

/**
 * The surface with its deviation from the mean section shown `factor` times as large: each vertex moves along the outward normal of the
 * true surface by (factor - 1) times its deviation. Factor 1 gives the surface itself.
 */
export function exaggerated(mesh: SurfaceMesh, factor: number, closed: boolean): { positions: Float32Array; normals: Float32Array } {
  if (factor === 1 || !mesh.deviation) return { positions: mesh.positions, normals: mesh.normals };
  const positions = mesh.positions.slice();
  for (let k = 0; k < mesh.deviation.length; ++k) {
    const move = (factor - 1) * mesh.deviation[k]!;
    if (!Number.isFinite(move)) continue;
    for (let c = 3 * k; c < 3 * k + 3; ++c) positions[c]! += move * mesh.normals[c]!;
  }
  return { positions, normals: vertexNormals(positions, mesh.blocks, mesh.nv, closed) };
}
