// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { save } from "./download";
import { toAddress, tomlOf } from "./live/state";
import type { Store } from "./store";

/** The page that solves, where treadmark live has written it into the same folder. */
const PAGE = "live.html";

/** On pages of runs: a link to the page that solves, with the case that is shown, and the case as a file. */
export function mountAgain(store: Store): void {
  const overview = document.getElementById("overview");
  const toml = store.data.kind === "run" ? tomlOf(store.data.document) : null;
  if (!overview || toml === null) return;
  const bar = document.createElement("div");
  bar.className = "controls again not-printed";
  const link = document.createElement("a");
  link.textContent = "Change and solve again";
  const follow = (): void => {
    const name = store.data.sets[0]?.frames[store.frame() ?? 0]?.name ?? "";
    const number = Number(/^case (\d+)/.exec(name)?.[1] ?? 1);
    link.href = `${PAGE}#${toAddress({ toml, ...(number > 1 ? { number } : {}), changes: new Map<string, string>() }, "")}`;
  };
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Save case.toml";
  button.addEventListener("click", () => save(new Blob([toml], { type: "text/plain" }), "case.toml"));
  const note = document.createElement("span");
  note.className = "view-note";
  note.textContent = `opens ${PAGE} beside this page, which treadmark live -o ${PAGE} writes; any such page opens case.toml, too`;
  bar.append(link, button, note);
  overview.append(bar);
  store.onStep(follow);
  follow();
}
