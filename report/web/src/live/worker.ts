// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import type { LiveData } from "../data";
import { Library, type Module } from "./library";
import { Solver, type Given, type Solved } from "./solve";

// The worker in which a page solves. Its text follows that of the module's own script, which makes createTreadmark.

export type Task =
  | { kind: "start"; wasm: Uint8Array; live: LiveData }
  | { kind: "file"; name: string; bytes: Uint8Array }
  | { kind: "solve"; given: Given; element: number | null; name: string; names: string[]; beside: boolean }
  | { kind: "text"; given: Given }
  | { kind: "geometry"; given: Given }
  | { kind: "check"; name: string; body: string };

export type Answer = { solved?: Solved; text?: string; json?: unknown; trouble?: string };

declare function createTreadmark(how: { wasmBinary: Uint8Array }): Promise<Module>;

/** What the reader is at, and what is solved beside it: each keeps its surfaces. */
let solvers: [Solver, Solver] | null = null;

async function done(task: Task): Promise<Answer> {
  if (task.kind === "start") {
    const library = new Library(await createTreadmark({ wasmBinary: task.wasm }));
    solvers = [new Solver(library, task.live), new Solver(library, task.live)];
    return {};
  }
  if (!solvers) return { trouble: "the program has not started" };
  const [solver, other] = solvers;
  switch (task.kind) {
    case "file":
      for (const one of solvers) one.addFile(task.name, task.bytes);
      return {};
    case "solve":
      return { solved: (task.beside ? other : solver).solve(task.given, task.element, task.name, task.names) };
    case "text":
      return { text: solver.text(task.given) };
    case "geometry":
      return { json: solver.geometry(task.given) };
    case "check":
      return { json: solver.check(task.name, task.body) };
  }
}

self.addEventListener("message", (event: MessageEvent<{ id: number; task: Task }>) => {
  const { id, task } = event.data;
  void done(task)
    .catch((error: unknown): Answer => ({ trouble: error instanceof Error ? error.message : String(error) }))
    .then((answer) => self.postMessage({ id, answer }));
});
