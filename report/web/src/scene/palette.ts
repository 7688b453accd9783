// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Rgb } from "../colours";
import type { Theme } from "../store";

/** Colours of the scene in a theme. Wheel and rail differ in lightness too: the wheel warm and light, the rail cool and darker. */
export interface Palette {
  background: Rgb;
  /** Behind points in the colours of a map, whose middle is near white. */
  ground: Rgb;
  wheel: Rgb;
  rail: Rgb;
  /** Of mesh lines and the line of the section on the bodies. */
  line: Rgb;
  /** Points that were left out: no colour of the maps. */
  removed: Rgb;
  text: string;
  faint: string;
  /** Behind text that lies over the picture. */
  plate: string;
  mark: string;
  markRim: string;
  axes: readonly [string, string, string];
}

const palettes: Record<Theme, Palette> = {
  light: {
    background: [246, 247, 249],
    ground: [186, 192, 201],
    wheel: [206, 192, 172],
    rail: [128, 146, 168],
    line: [28, 34, 46],
    removed: [190, 20, 140],
    text: "#1a2230",
    faint: "#566174",
    plate: "rgba(246,247,249,0.86)",
    mark: "#ffffff",
    markRim: "#10151f",
    axes: ["#b3420a", "#1f6f54", "#2456a6"],
  },
  dark: {
    background: [20, 24, 31],
    ground: [20, 24, 31],
    wheel: [196, 180, 156],
    rail: [104, 124, 150],
    line: [8, 10, 14],
    removed: [255, 110, 215],
    text: "#e8ecf3",
    faint: "#a3aec0",
    plate: "rgba(20,24,31,0.84)",
    mark: "#ffffff",
    markRim: "#05070b",
    axes: ["#ff9a5c", "#63c9a2", "#82b1ff"],
  },
};

export function paletteOf(theme: Theme): Palette {
  return palettes[theme];
}
