// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Mounts the view in space alone and lets a browser test steer it.
import type { ReportData, SceneView } from "../src/data";
import { mountScene } from "../src/scene/index";
import { Store } from "../src/store";

const data = JSON.parse(document.getElementById("treadmark-data")?.textContent ?? "") as ReportData;
const store = new Store(data);
store.setTheme(document.documentElement.dataset["theme"] === "dark" ? "dark" : "light");
const figure = document.getElementById("scene");
if (figure) mountScene(figure, data.views[0] as SceneView, store);
Object.assign(window, { store });
