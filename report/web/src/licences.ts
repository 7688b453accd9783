// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import bundled from "bundled-licences";

/** The licences of the libraries in the page's script, as these ask for. */
export function mountLicences(footer: HTMLElement): void {
  if (bundled.length === 0) return;
  const details = document.createElement("details");
  details.className = "licences";
  const summary = document.createElement("summary");
  summary.textContent = "Licences of the libraries in this page";
  details.append(summary);
  for (const library of bundled) {
    const heading = document.createElement("h3");
    heading.textContent = `${library.name} ${library.version}${library.licence ? ` (${library.licence})` : ""}`;
    const text = document.createElement("pre");
    text.textContent = library.text;
    details.append(heading, text);
  }
  footer.append(details);
}
