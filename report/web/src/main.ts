// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { mountAgain } from "./again";
import { mountChart } from "./chart/index";
import { mountContact } from "./contact/index";
import type { ReportData, View } from "./data";
import { mountLicences } from "./licences";
import { mountMap } from "./map";
import { mountNavigation } from "./navigation";
import { mountPaperTables } from "./paper-tables";
import { mountPicture } from "./picture";
import { mountPrint } from "./print";
import { mountCloud, mountScene } from "./scene/index";
import { mountSection } from "./section";
import { Store } from "./store";
import { mountTables } from "./tables";
import { mountTheme } from "./theme";
import { mountTimeline } from "./timeline";
import { mountTrack } from "./track";

function mountView(figure: HTMLElement, view: View, store: Store): void {
  switch (view.type) {
    case "chart":
      return mountChart(figure, view, store);
    case "contact":
      return mountContact(figure, view, store);
    case "scene":
      return mountScene(figure, view, store);
    case "section":
      return mountSection(figure, view, store);
    case "track":
      return mountTrack(figure, view, store);
    case "map":
      return mountMap(figure, view, store);
    case "cloud":
      return mountCloud(figure, view, store);
    case "picture":
      return mountPicture(figure, view);
  }
}

/** A view that fails says so in its own figure; the others go on. */
function mountAll(store: Store): void {
  for (const view of store.data.views) {
    const figure = document.getElementById(view.id);
    if (!figure) continue;
    try {
      mountView(figure, view, store);
    } catch (error) {
      const note = document.createElement("p");
      note.className = "view-note failed";
      note.textContent = `This view could not be drawn: ${error instanceof Error ? error.message : String(error)}`;
      figure.append(note);
    }
  }
}

function start(): void {
  const element = document.getElementById("treadmark-data");
  if (!element?.textContent) return;
  const data = JSON.parse(element.textContent) as ReportData;
  const store = new Store(data);
  const toolbar = document.getElementById("toolbar");
  if (toolbar) {
    mountTheme(toolbar, store);
    mountPrint(toolbar, store);
  }
  const bar = document.getElementById("timeline");
  if (bar) mountTimeline(bar, store);
  mountTables(store);
  mountPaperTables();
  mountAll(store);
  mountAgain(store);
  mountNavigation();
  const footer = document.querySelector<HTMLElement>("body > footer");
  if (footer) mountLicences(footer);
  window.dispatchEvent(new CustomEvent("treadmark-report", { detail: store }));  // to the script of pages that solve
}

start();
