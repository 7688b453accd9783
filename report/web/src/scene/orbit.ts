// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { add, cross, type Vec3 } from "./vec";

/** A camera that looks at `target`: from behind (azimuth 0, looking forward), turned to the right, raised. Angles in degrees, lengths in mm. */
export interface Orbit {
  target: Vec3;
  distance: number;
  azimuth: number;
  elevation: number;
}

export const fieldOfView = 20;
const steepest = 89.5;
const nearest = 2;
const farthest = 30000;
const radians = Math.PI / 180;

/** From the target to the camera, a unit vector; x forward, y right, z down. */
export function outlook({ azimuth, elevation }: Orbit): Vec3 {
  const level = Math.cos(elevation * radians);
  return [-Math.cos(azimuth * radians) * level, -Math.sin(azimuth * radians) * level, -Math.sin(elevation * radians)];
}

export function eye(orbit: Orbit): Vec3 {
  return add(orbit.target, outlook(orbit), orbit.distance);
}

/** To the right and up in the picture, unit vectors. */
export function pictureAxes(orbit: Orbit): { right: Vec3; up: Vec3 } {
  const right: Vec3 = [-Math.sin(orbit.azimuth * radians), Math.cos(orbit.azimuth * radians), 0];
  return { right, up: cross(outlook(orbit), right) };
}

/** Millimetres at the target that a pixel covers. */
export function millimetresPerPixel(orbit: Orbit, height: number): number {
  return (2 * orbit.distance * Math.tan(0.5 * fieldOfView * radians)) / Math.max(1, height);
}

export function turned(orbit: Orbit, azimuth: number, elevation: number): Orbit {
  const raised = Math.min(steepest, Math.max(-steepest, orbit.elevation + elevation));
  return { ...orbit, azimuth: (((orbit.azimuth + azimuth) % 360) + 360) % 360, elevation: raised };
}

export function zoomed(orbit: Orbit, factor: number): Orbit {
  return { ...orbit, distance: Math.min(farthest, Math.max(nearest, orbit.distance * factor)) };
}

/** Moves what is seen by pixels to the right and down. */
export function panned(orbit: Orbit, right: number, down: number, height: number): Orbit {
  const scale = millimetresPerPixel(orbit, height);
  const axes = pictureAxes(orbit);
  return { ...orbit, target: add(add(orbit.target, axes.right, -right * scale), axes.up, down * scale) };
}

/** Distance at which a width and a height [mm] fill the picture, with a little room. */
export function distanceFor(width: number, height: number, aspect: number): number {
  return (0.56 * Math.max(height, width / Math.max(0.2, aspect))) / Math.tan(0.5 * fieldOfView * radians);
}

export type ViewName = "contact" | "along" | "above" | "below" | "whole";
/** cut: solid, but only beyond the contact as the camera sees it; glass: see-through. */
export type BodyStyle = "solid" | "cut" | "glass" | "hidden";

export interface ViewPreset {
  name: ViewName;
  label: string;
  title: string;
  azimuth: number;
  elevation: number;
  wheel: BodyStyle;
  rail: BodyStyle;
}

export const presets: readonly ViewPreset[] = [
  { name: "contact", label: "Contact", title: "The patch on the rail, the wheel cut away in front", azimuth: 32, elevation: 34, wheel: "cut", rail: "solid" },
  { name: "along", label: "Along track", title: "Forward along the track", azimuth: 0, elevation: 7, wheel: "cut", rail: "solid" },
  { name: "above", label: "From above", title: "Straight down, forward is upwards", azimuth: 0, elevation: steepest, wheel: "glass", rail: "solid" },
  { name: "below", label: "From below", title: "The patch on the wheel, the rail cut away in front", azimuth: 32, elevation: -40, wheel: "solid", rail: "cut" },
  { name: "whole", label: "Whole wheel", title: "The wheel on the rail", azimuth: 58, elevation: 14, wheel: "solid", rail: "solid" },
];

/** A sphere, or the patch, that a preset shows; lengths in mm. */
export interface Subject {
  contact: Vec3;
  /** Greatest extent of the contact. */
  size: number;
  /** Width of the rail's section. */
  railWidth: number;
  wheelCentre: Vec3;
  wheelRadius: number;
}

export function orbitOf(preset: ViewPreset, subject: Subject, aspect: number): Orbit {
  const { azimuth, elevation, name } = preset;
  const size = Math.max(8, subject.size);
  switch (name) {
    case "contact":
    case "below":
      return { azimuth, elevation, target: subject.contact, distance: distanceFor(3 * size, 2.1 * size, aspect) };
    case "above":
      return { azimuth, elevation, target: subject.contact, distance: distanceFor(1.9 * size, 1.5 * size, aspect) };
    case "along": {
      const target: Vec3 = [subject.contact[0], subject.contact[1], subject.contact[2]];
      return { azimuth, elevation, target, distance: distanceFor(1.7 * subject.railWidth, 1.1 * subject.railWidth, aspect) };
    }
    case "whole": {
      const across = 2.05 * subject.wheelRadius;
      return { azimuth, elevation, target: subject.wheelCentre, distance: distanceFor(across, across, aspect) };
    }
  }
}
