// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Store, Theme } from "./store";

export type ThemeChoice = "auto" | Theme;

const choices: readonly ThemeChoice[] = ["auto", "light", "dark"];
const key = "treadmark-theme";

export function parseChoice(text: string | null): ThemeChoice {
  return choices.find((choice) => choice === text) ?? "auto";
}

export function nextChoice(choice: ThemeChoice): ThemeChoice {
  return choices[(choices.indexOf(choice) + 1) % choices.length]!;
}

// Browsers may keep storage from pages that lie in files; then the choice lasts as long as the page.
function remembered(): ThemeChoice {
  try {
    return parseChoice(localStorage.getItem(key));
  } catch {
    return "auto";
  }
}

function remember(choice: ThemeChoice): void {
  try {
    localStorage.setItem(key, choice);
  } catch {
    return;
  }
}

/** The button that goes through the system's colours, light and dark. */
export function mountTheme(toolbar: HTMLElement, store: Store): void {
  const root = document.documentElement;
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  let choice = remembered();
  const button = document.createElement("button");
  button.type = "button";
  button.className = "theme";
  const apply = (): void => {
    const theme: Theme = choice === "auto" ? (dark.matches ? "dark" : "light") : choice;
    if (choice === "auto") root.removeAttribute("data-theme");
    else root.setAttribute("data-theme", choice);
    button.textContent = `Theme: ${choice}`;
    button.title = "Colours: as the system has them, light, dark";
    store.setTheme(theme);
  };
  button.addEventListener("click", () => {
    choice = nextChoice(choice);
    remember(choice);
    apply();
  });
  dark.addEventListener("change", apply);
  toolbar.append(button);
  apply();
}
