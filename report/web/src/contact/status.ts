// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { Frame } from "../data";
import type { PanelModel } from "./model";

const words: Record<Frame["status"], string> = { ok: "", no_contact: "no contact", not_converged: "not converged", failed: "failed" };

/** How frames ended, where there is something to say; with several sets each with its name. */
export function statusText(panels: readonly PanelModel[], many: boolean): { text: string; bad: boolean } {
  let bad = false;
  const parts: string[] = [];
  for (const { frame, name } of panels) {
    if (!frame) continue;
    bad ||= frame.status === "failed" || frame.status === "not_converged";
    const said = [words[frame.status], frame.message, frame.trimmed ?? ""].filter((text) => text !== "").join(" – ");
    if (said !== "") parts.push(many ? `${name}: ${said}` : said);
  }
  return { text: parts.join("; "), bad };
}
