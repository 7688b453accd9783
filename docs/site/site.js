// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Debian's theme has colours for "dark", not for "auto" on a dark system.
const dark = window.matchMedia("(prefers-color-scheme: dark)");
function follow() {
  if ((localStorage.getItem("theme") || "auto") === "auto") document.body.dataset.theme = dark.matches ? "dark" : "auto";
}
dark.addEventListener("change", follow);
follow();
