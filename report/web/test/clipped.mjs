// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
/* global NodeFilter */

/**
 * Runs in a page: texts of which a part cannot be seen, by the boxes that the browser gives its letters. What a reader can scroll to
 * counts as seen, but not on paper. Titles may end with an ellipsis as long as no digit is lost with what it stands for.
 */
export function clipped(paper) {
  const SLACK = 1.5;  // boxes of letters are higher and a little wider than what is drawn
  const found = [];
  const page = { left: 0, right: document.documentElement.clientWidth, top: -Infinity, bottom: Infinity };
  /** What is seen of an element's content. */
  const windowOf = (element) => {
    const seen = { ...page };
    for (let one = element; one && one !== document.body; one = one.parentElement) {
      const style = getComputedStyle(one);
      if (style.position === "fixed" || one.classList.contains("visually-hidden")) return null;
      const drawing = one.tagName.toLowerCase() === "svg";
      const cuts = (value) => ["hidden", "clip"].includes(value) || (paper && ["auto", "scroll"].includes(value));
      if (!paper && [style.overflowX, style.overflowY].some((value) => value === "auto" || value === "scroll")) return null;
      const box = one.getBoundingClientRect();
      if (cuts(style.overflowX) || drawing) Object.assign(seen, { left: Math.max(seen.left, box.left), right: Math.min(seen.right, box.right) });
      if (cuts(style.overflowY) || drawing) Object.assign(seen, { top: Math.max(seen.top, box.top), bottom: Math.min(seen.bottom, box.bottom) });
    }
    return seen;
  };
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const text = node.textContent.trim();
    const parent = node.parentElement;
    if (!text || /^(script|style|option|noscript|title)$/i.test(parent.tagName) || !parent.checkVisibility({ checkVisibilityCSS: true })) continue;
    const seen = windowOf(parent);
    if (!seen) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const box of range.getClientRects()) {
      const over = Math.max(seen.left - box.left, box.right - seen.right, box.bottom - seen.bottom - 0.25 * box.height, seen.top - box.top - 0.25 * box.height);
      if (box.width > 0 && over > SLACK) {
        found.push(`"${text.slice(0, 40)}" by ${over.toFixed(1)} px in ${parent.closest("[id]")?.id ?? parent.tagName}`);
        break;
      }
    }
    if (parent.dataset.full && text.endsWith("…") && /\d/.test(parent.dataset.full.slice(text.length - 1))) found.push(`"${parent.dataset.full}" shortened`);
  }
  return found;
}
