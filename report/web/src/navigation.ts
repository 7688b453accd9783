// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

/** Marks the section that is being read in the navigation. */
export function mountNavigation(): void {
  const links = [...document.querySelectorAll<HTMLAnchorElement>("nav.sections a[href^='#']")];
  const sections = links.map((link) => document.getElementById(decodeURIComponent(link.hash.slice(1))));
  const bar = links[0]?.parentElement;
  if (!bar) return;
  let current = -1;
  const update = (): void => {
    const line = bar.getBoundingClientRect().bottom + 0.25 * window.innerHeight;
    let at = -1;
    sections.forEach((section, k) => {
      if (section && section.getBoundingClientRect().top <= line) at = k;
    });
    const atEnd = window.scrollY > 0 && window.innerHeight + window.scrollY >= document.documentElement.scrollHeight - 2;
    if (atEnd) at = sections.length - 1;
    if (at === current) return;
    current = at;
    links.forEach((link, k) => {
      if (k === at) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    });
    const link = links[at];
    // In a bar that is too narrow for all names the current one comes into sight.
    if (link && bar.scrollWidth > bar.clientWidth) bar.scrollLeft = link.offsetLeft - (bar.clientWidth - link.offsetWidth) / 2;
  };
  let pending = false;
  const later = (): void => {
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      update();
    });
  };
  window.addEventListener("scroll", later, { passive: true });
  window.addEventListener("resize", later);
  update();
}
