// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
import { unzlibSync } from "fflate";

import type { LiveData } from "../data";
import { fromBase64 } from "../packed";
import workerText from "live-worker";
import type { Answer, Task } from "./worker";

/** Whoever has not answered by then never will [ms]. */
const PATIENCE = 60_000;

function textOf(id: string): string {
  const text = document.getElementById(id)?.textContent;
  if (!text) throw new Error("the page has no program to solve with");
  return text;
}

/** The program in its worker; one that does not answer or has no memory left is replaced. */
export class Engine {
  private worker: Worker | null = null;
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private readonly files = new Map<string, Uint8Array>();
  private count = 0;
  private readonly wasm: Uint8Array;
  private starting: Promise<Answer> | null = null;

  constructor(private readonly live: LiveData) {
    this.wasm = unzlibSync(fromBase64(textOf("treadmark-module")));
    for (const [name, text] of Object.entries(live.files)) this.files.set(name, fromBase64(text));
  }

  private start(): Promise<Answer> {
    let worker: Worker;
    let url: string;
    try {
      url = URL.createObjectURL(new Blob([textOf("treadmark-loader"), "\n", workerText], { type: "text/javascript" }));
      worker = new Worker(url);
    } catch (error) {  // some browsers let no page from a disk start one
      return Promise.resolve({ trouble: `the page cannot solve: ${error instanceof Error ? error.message : String(error)}` });
    }
    worker.addEventListener("message", (event: MessageEvent<{ id: number; answer: Answer }>) => {
      this.waiting.get(event.data.id)?.(event.data.answer);
    });
    worker.addEventListener("error", (event) => {
      event.preventDefault();
      this.stop(event.message || "the worker could not be started");
    });
    this.worker = worker;
    const started = this.send({ kind: "start", wasm: this.wasm, live: this.live });
    void started.then(() => URL.revokeObjectURL(url));
    for (const [name, bytes] of this.files) void started.then(() => this.send({ kind: "file", name, bytes }));
    return started;
  }

  private stop(trouble: string): void {
    this.worker?.terminate();
    this.worker = null;
    this.starting = null;
    const all = [...this.waiting.values()];
    this.waiting.clear();
    for (const answer of all) answer({ trouble });
  }

  private send(task: Task): Promise<Answer> {
    const id = ++this.count;
    return new Promise((resolve) => {
      const late = setTimeout(() => this.stop("it took more than a minute and was ended"), PATIENCE);
      this.waiting.set(id, (answer) => {
        clearTimeout(late);
        this.waiting.delete(id);
        resolve(answer);
      });
      this.worker?.postMessage({ id, task });
    });
  }

  /** Never fails: an answer may be trouble. */
  async ask(task: Task): Promise<Answer> {
    this.starting ??= this.start();
    const started = await this.starting;
    if (started.trouble !== undefined) return started;
    if (!this.worker) return this.ask(task);
    const answer = await this.send(task);
    if (answer.trouble !== undefined && /memory|unreachable|out of bounds|Aborted/i.test(answer.trouble)) this.stop(answer.trouble);
    return answer;
  }

  /** Keeps a file for the program; its name there, another one where a file of other content has it. */
  async addFile(name: string, bytes: Uint8Array): Promise<string> {
    const fits = (old: Uint8Array | undefined): boolean => !old || (old.length === bytes.length && old.every((byte, k) => byte === bytes[k]));
    let free = name;
    for (let k = 2; !fits(this.files.get(free)); ++k) free = name.replace(/(\.[^.]*)?$/, `-${k}$1`);
    this.files.set(free, bytes);
    await this.ask({ kind: "file", name: free, bytes });
    return free;
  }
}
