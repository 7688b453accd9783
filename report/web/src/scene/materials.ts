// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import {
  ClampToEdgeWrapping,
  DataTexture,
  DoubleSide,
  KeepStencilOp,
  LinearFilter,
  NotEqualStencilFunc,
  AlwaysStencilFunc,
  ReplaceStencilOp,
  ShaderMaterial,
  Vector2,
  Vector3,
  Vector4,
} from "three";

import { lut, type Rgb } from "../colours";

// Depth of a point as if it lay nearer to the camera. The undeformed bodies overlap in the contact: so neither covers the patch, and a
// body that is cut away does not sink into the other one.
const nearerDepth = `
float nearerDepth(vec3 eye, float bias) {
  vec4 nearer = projectionMatrix * vec4(eye * (1.0 - min(0.3, bias / length(eye))), 1.0);
  return nearer.z / nearer.w;
}`;
const cutBias = 0.4;

// Lit from above the camera's left shoulder and from the camera itself; both sides of the surface are lit, the inner one darker.
// Shade and gloss.
const lighting = `
vec2 light(vec3 normal, vec3 eye, out float inside, out float straight) {
  vec3 n = normalize(normal);
  vec3 v = normalize(-eye);
  float side = dot(n, v);
  inside = step(side, 0.0);
  n *= 1.0 - 2.0 * inside;
  straight = abs(side);
  vec3 lamp = normalize(vec3(-0.45, 0.5, 0.75));
  float gloss = max(dot(reflect(-lamp, n), v), 0.0);
  gloss *= gloss;
  gloss *= gloss;
  gloss *= 0.10 * gloss * gloss * gloss;
  return vec2(0.44 + 0.42 * max(dot(n, lamp), 0.0) + 0.18 * straight - 0.10 * inside, gloss);
}`;

const bodyVertex = `${nearerDepth}
uniform int columns;
uniform float bias;
attribute float deviation;
varying vec3 atEye;
varying vec3 facing;
varying vec3 place;
varying vec2 cell;
varying float excess;
varying vec2 lit;
${lighting}
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vec4 eye = viewMatrix * world;
  gl_Position = projectionMatrix * eye;
  if (bias > 0.0) gl_Position.z = nearerDepth(eye.xyz, bias) * gl_Position.w;
  atEye = eye.xyz;
  facing = normalMatrix * normal;
  place = world.xyz;
  cell = vec2(float(gl_VertexID / columns), float(gl_VertexID % columns));
  excess = deviation;
  float inside;
  float straight;
  lit = light(facing, atEye, inside, straight);
}`;

// quick: while a processor draws moving pictures, light of the vertices and no lines but the section.
const bodyFragment = `${lighting}
uniform float quick;
uniform vec3 base;
uniform vec3 line;
uniform float opacity;
uniform float mesh;
uniform vec2 lastCell;
uniform float openEnds;
uniform sampler2D colours;
uniform float coloured;
uniform float span;
uniform vec3 sectionAt;
uniform vec3 sectionNormal;
uniform float section;
uniform vec4 cut;
varying vec3 atEye;
varying vec3 facing;
varying vec3 place;
varying vec2 cell;
varying float excess;
varying vec2 lit;
float thin(float distance, float width) { return 1.0 - smoothstep(width, width + 1.0, distance); }
void main() {
#ifdef CUT
  float beyond = dot(vec4(place - sectionAt, 1.0), cut);
  if (beyond < 0.0) discard;
#endif
  vec3 colour = base;
  float t = 0.5;
  if (coloured > 0.0) t = clamp(0.5 + 0.5 * excess / span, 0.0, 1.0);
  if (coloured > 0.0) colour = texture2D(colours, vec2(t, 0.5)).rgb;
#ifndef GLASS
  if (quick > 0.0) {
    float off = section > 0.0 ? abs(dot(place - sectionAt, sectionNormal)) : 1.0;
    gl_FragColor = vec4(off < 0.15 ? line : colour * lit.x + lit.y, opacity);
    return;
  }
#endif
  float inside;
  float straight;
  vec2 lamps = light(facing, atEye, inside, straight);
  colour = colour * lamps.x + lamps.y;
  float alpha = opacity;
#ifdef GLASS
  alpha = mix(opacity, 0.82, pow(1.0 - straight, 2.2)) + coloured * 0.5 * abs(2.0 * t - 1.0);
#endif
  vec2 width = max(fwidth(cell), vec2(1e-6));
  float lines = 0.0;
  if (mesh > 0.0) {
    vec2 near = abs(fract(cell - 0.5) - 0.5) / width;
    vec2 drawn = vec2(thin(near.x, 0.1), thin(near.y, 0.1)) * (1.0 - smoothstep(0.22, 0.45, width));
    lines = 0.38 * max(drawn.x, drawn.y);
  }
  vec2 margin = min(cell, lastCell - cell) / width;
  lines = max(lines, 0.6 * max(thin(margin.y, 0.6), openEnds * thin(margin.x, 0.6)));
  if (section > 0.0) {
    float across = dot(place - sectionAt, sectionNormal);
    float nearby = 1.0 - smoothstep(140.0, 200.0, length(place - sectionAt));
    lines = max(lines, 0.85 * nearby * thin(abs(across) / max(fwidth(across), 1e-6), 0.7));
  }
#ifdef CUT
  lines = max(lines, 0.9 * thin(beyond / max(fwidth(beyond), 1e-6), 1.4));
#endif
  colour = mix(colour, line, lines);
  gl_FragColor = vec4(colour, min(1.0, max(alpha, lines)));
}`;

const patchVertex = `${nearerDepth}
uniform float bias;
attribute vec4 paint;
varying vec4 colour;
varying vec2 corner;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * eye;
  gl_Position.z = nearerDepth(eye.xyz, bias) * gl_Position.w;
  colour = paint;
  int k = gl_VertexID % 4;
  corner = vec2(k == 1 || k == 2 ? 1.0 : 0.0, k >= 2 ? 1.0 : 0.0);
}`;

const patchFragment = `
uniform float mesh;
varying vec4 colour;
varying vec2 corner;
void main() {
  if (mesh == 0.0) {
    gl_FragColor = vec4(colour.rgb, 1.0);
    return;
  }
  vec2 width = max(fwidth(corner), vec2(1e-6));
  vec2 near = min(corner, 1.0 - corner) / width;
  vec2 drawn = (1.0 - smoothstep(0.0, 1.0, near)) * (1.0 - smoothstep(0.15, 0.35, width));
  gl_FragColor = vec4(mix(colour.rgb, vec3(0.05), 0.5 * mesh * max(drawn.x, drawn.y)), 1.0);
}`;

/** Numbers 0..1 of a colour, written to the picture as they are. */
export function rgbVector([r, g, b]: Rgb): Vector3 {
  return new Vector3(r / 255, g / 255, b / 255);
}

export function divergingTexture(): DataTexture {
  const texture = new DataTexture(Uint8Array.from(lut("diverging", 256)), 256, 1);
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** What all bodies have in common and one assignment changes for all. */
export interface SharedUniforms {
  /** 1: as quick as can be. */
  quick: { value: number };
  mesh: { value: number };
  line: { value: Vector3 };
  colours: { value: DataTexture };
  coloured: { value: number };
  span: { value: number };
  section: { value: number };
  sectionAt: { value: Vector3 };
  sectionNormal: { value: Vector3 };
  /** Cut bodies are drawn where this (normal, distance) times (place - sectionAt, 1) is positive. */
  cut: { value: Vector4 };
}

export function sharedUniforms(): SharedUniforms {
  return {
    quick: { value: 0 },
    mesh: { value: 0 },
    line: { value: new Vector3() },
    colours: { value: divergingTexture() },
    coloured: { value: 0 },
    span: { value: 1 },
    section: { value: 1 },
    sectionAt: { value: new Vector3() },
    sectionNormal: { value: new Vector3(1, 0, 0) },
    cut: { value: new Vector4(1, 0, 0, 0) },
  };
}

export interface GridShape {
  nu: number;
  nv: number;
  closed: boolean;
}

export interface BodyMaterials {
  base: { value: Vector3 };
  solid: ShaderMaterial;
  cut: ShaderMaterial;
  glass: ShaderMaterial;
  /** Only depth: of the see-through body just the nearest layer is drawn. */
  depth: ShaderMaterial;
}

/** The patch marks its pixels in the stencil; see-through bodies leave these alone, so that its colours stay those of the colour bar. */
export function bodyMaterials(shape: GridShape, shared: SharedUniforms): BodyMaterials {
  const base = { value: new Vector3() };
  const whole = { value: new Vector4(0, 0, 0, 1e6) };
  const uniforms = (opacity: number, cut = whole): ShaderMaterial["uniforms"] => ({
    cut,
    bias: { value: cut === whole ? 0 : cutBias },
    base,
    quick: shared.quick,
    mesh: shared.mesh,
    line: shared.line,
    colours: shared.colours,
    coloured: shared.coloured,
    span: shared.span,
    section: shared.section,
    sectionAt: shared.sectionAt,
    sectionNormal: shared.sectionNormal,
    opacity: { value: opacity },
    columns: { value: shape.nv },
    lastCell: { value: new Vector2(shape.nu - 1, shape.nv - 1) },
    openEnds: { value: shape.closed ? 0 : 1 },
  });
  const shader = { vertexShader: bodyVertex, fragmentShader: bodyFragment, side: DoubleSide };
  const spared = {
    stencilWrite: true,
    stencilRef: 1,
    stencilFunc: NotEqualStencilFunc,
    stencilFail: KeepStencilOp,
    stencilZFail: KeepStencilOp,
    stencilZPass: KeepStencilOp,
  };
  return {
    base,
    solid: new ShaderMaterial({ ...shader, uniforms: uniforms(1) }),
    cut: new ShaderMaterial({ ...shader, defines: { CUT: "" }, uniforms: uniforms(1, shared.cut) }),
    glass: new ShaderMaterial({ ...shader, ...spared, defines: { GLASS: "" }, uniforms: uniforms(0.14), transparent: true, depthWrite: false }),
    depth: new ShaderMaterial({ ...shader, ...spared, uniforms: uniforms(1), transparent: true, colorWrite: false }),
  };
}

/** `bias`: how much nearer to the camera than it is the patch counts as [mm]. `layered`: later triangles lie over earlier ones. */
export function patchMaterial(mesh: { value: number }, bias: number, layered: boolean): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: patchVertex,
    fragmentShader: patchFragment,
    uniforms: { mesh, bias: { value: bias } },
    side: DoubleSide,
    depthWrite: !layered,
    stencilWrite: true,
    stencilRef: 1,
    stencilFunc: AlwaysStencilFunc,
    stencilZPass: ReplaceStencilOp,
  });
}
