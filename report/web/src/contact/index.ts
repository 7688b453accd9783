// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { ContactView } from "../data";
import type { Store } from "../store";
import { ContactFigure } from "./view";

/** Fills a figure with the pictures of contact patches. */
export function mountContact(figure: HTMLElement, view: ContactView, store: Store): void {
  new ContactFigure(figure, view, store);
}
