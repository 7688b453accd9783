// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Weights of the search: a page whose title has the words comes before pages with a section of that name, and these before pages
// that only mention them; documents for users before those about the sources.
const named = (title) => new URLSearchParams(window.location.search).get("q").toLowerCase().split(/\s+/)
  .every((word) => new RegExp(`(^|[^\\p{L}])${word.replace(/[^\p{L}\p{N}]/gu, ".")}([^\\p{L}]|$)`, "u").test(title.toLowerCase()));
var Scorer = {
  score: ([page, title, , , score]) => score + (page.startsWith("docs/") ? 20 : 0) + (named(title.split(" > ")[0]) ? 200 : named(title) ? 50 : 0),
  objNameMatch: 11, objPartialMatch: 6, objPrio: { 0: 15, 1: 5, 2: -5 }, objPrioDefault: 0,
  title: 15, partialTitle: 7, term: 5, partialTerm: 2,
};
