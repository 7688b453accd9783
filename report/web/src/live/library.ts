// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// The functions of treadmark.h in a module of WebAssembly (interfaces/web).

/** What the module's own script makes. */
export interface Module {
  HEAPU8: Uint8Array;
  HEAP32: Int32Array;
  HEAPF64: Float64Array;
  FS: { writeFile(path: string, data: Uint8Array): void; mkdirTree(path: string): void; chdir(path: string): void };
  UTF8ToString(pointer: number): string;
  stringToUTF8(text: string, pointer: number, room: number): void;
  lengthBytesUTF8(text: string): number;
  _malloc(size: number): number;
  _free(pointer: number): void;
}

/** Of tm_status: a call that ends with more has done nothing. */
export const FAILED = 3;
const OUT_OF_MEMORY = 15;
/** Of tm_body. */
export const RAIL = 0;
export const WHEEL = 1;

/** What a call of treadmark.h that did nothing says. */
export class CallError extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

type Argument = number | string;

/** Calls by name: texts are lent for the call, outputs lie in places of `out`. */
export class Library {
  /** Places of eight bytes each for what calls give. */
  private readonly places: number;

  constructor(readonly module: Module) {
    this.places = this.room(8 * 32);
  }

  /** Memory for a call, which the caller gives back. Errors: CallError. */
  room(size: number): number {
    const at = this.module._malloc(size);
    if (at === 0) throw new CallError(OUT_OF_MEMORY, "there is not enough memory");
    return at;
  }

  /** The same with a text in it. */
  private written(text: string): number {
    const size = this.module.lengthBytesUTF8(text) + 1;
    const at = this.room(size);
    this.module.stringToUTF8(text, at, size);
    return at;
  }

  /** Address of the k-th place for an output. */
  out(k: number): number {
    return this.places + 8 * k;
  }

  pointer(k: number): number {
    return this.module.HEAP32[this.out(k) >> 2]!;
  }

  double(k: number): number {
    return this.module.HEAPF64[this.out(k) >> 3]!;
  }

  doubles(pointer: number, count: number): Float64Array {
    return this.module.HEAPF64.slice(pointer >> 3, (pointer >> 3) + count);
  }

  text(pointer: number): string {
    return pointer === 0 ? "" : this.module.UTF8ToString(pointer);
  }

  /** What the function returns: a status, a size or an address. */
  ask(name: string, ...given: Argument[]): number {
    const { module } = this;
    const lent: number[] = [];
    try {
      const values = given.map((one) => {
        if (typeof one === "number") return one;
        const at = this.written(one);
        lent.push(at);
        return at;
      });
      return (module as unknown as Record<string, (...values: number[]) => number>)[`_tm_${name}`]!(...values);
    } finally {
      lent.forEach((at) => module._free(at));
    }
  }

  /** The same of a function with a status: how a computation ended. Errors: CallError for what did nothing. */
  call(name: string, ...given: Argument[]): number {
    const status = this.ask(name, ...given);
    if (status > FAILED) throw new CallError(status, this.text(this.ask("message")));
    return status;
  }

  /** An object that a call makes at its last argument. */
  make(name: string, ...given: Argument[]): number {
    this.call(name, ...given, this.out(0));
    return this.pointer(0);
  }

  /** A text that a call makes at its last argument. */
  textOf(name: string, ...given: Argument[]): string {
    const at = this.make(name, ...given);
    const text = this.text(at);
    this.ask("text_free", at);
    return text;
  }

  /** The same of a function of a list of settings. */
  textBySettings(name: string, settings: readonly string[], ...before: Argument[]): string {
    const { module } = this;
    const texts = settings.map((text) => this.written(text));
    const list = this.room(4 * Math.max(1, texts.length));
    texts.forEach((at, k) => (module.HEAP32[(list >> 2) + k] = at));
    try {
      return this.textOf(name, ...before, list, texts.length);
    } finally {
      [...texts, list].forEach((at) => module._free(at));
    }
  }

  /** A number by name of what a function knows; NaN where it does not. */
  number(name: string, ...given: Argument[]): number {
    return this.ask(name, ...given, this.out(0)) > FAILED ? NaN : this.double(0);
  }
}
