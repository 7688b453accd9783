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

/** Runs in a page whose views are drawn: charts without anything in them, words that lie on each other, columns that texts are squeezed into. */
export function flaws(desktop) {
  const MOST_COLUMNS = 18;  // more do not fit a window, and scroll beside the first one
  const found = [];
  const shown = (element) => element.checkVisibility({ checkVisibilityCSS: true });
  const place = (element) => element.closest("[id]")?.id ?? element.tagName;
  for (const chart of document.querySelectorAll("svg.chart"))
    if (shown(chart) && !chart.querySelector(".line, .marks, .level")) found.push(`nothing in a chart of ${place(chart)}`);
  for (const svg of document.querySelectorAll("figure.view svg")) {
    if (!shown(svg)) continue;
    const words = [...svg.querySelectorAll("text")]
      .filter((text) => text.textContent.trim() && shown(text) && !/rotate/.test(text.getAttribute("transform") ?? ""))
      .map((text) => ({ text: text.textContent, box: text.getBoundingClientRect() }));
    words.forEach(({ text, box: a }, k) => {
      for (const { text: other, box: b } of words.slice(k + 1)) {
        const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        // Boxes are higher than letters.
        if (wide > 2 && high > 0.35 * Math.min(a.height, b.height)) found.push(`"${text}" on "${other}" in ${place(svg)}`);
      }
    });
  }
  for (const table of document.querySelectorAll("table.data")) {
    if (!shown(table)) continue;
    const frame = table.closest(".table-frame");
    if (desktop && frame && table.rows[0].cells.length <= MOST_COLUMNS && frame.scrollWidth > frame.clientWidth + 1) found.push(`${table.id} is ${frame.scrollWidth} wide in ${frame.clientWidth}`);
    for (const cell of table.querySelectorAll("tbody td")) {
      const lines = cell.clientHeight / parseFloat(getComputedStyle(cell).lineHeight);
      if (cell.textContent.length > 24 && lines > 5 && cell.clientWidth < 170) found.push(`"${cell.textContent.slice(0, 30)}" in a column of ${cell.clientWidth} px in ${table.id}`);
    }
  }
  return found;
}
