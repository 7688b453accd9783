#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What scripts/mutate.sh runs, which says how: draws mutants, compiles each source by itself with its target's options, and links it
ahead of the libraries with the tests of its folder. What other sources of its unity inlined stays as it was. Indexes of containers are
checked in the mutated source, so that reading past an end is noticed, too.

  mutants.py --self-test
"""
import argparse
import datetime
import functools
import json
import pathlib
import random
import re
import shlex
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict, dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
REASONS = ROOT / "tests" / "mutants.txt"
FAR_TOO_LONG = 10.0  # times the tests' own time, and some seconds


@dataclass(frozen=True)
class Mutant:
    file: str
    line: int  # from 1
    kind: str
    before: str
    after: str


# Operators stand between blanks, by .clang-format, and brackets of templates do not.
SWAPS = [("boundary", " < ", " <= "), ("boundary", " <= ", " < "), ("boundary", " > ", " >= "), ("boundary", " >= ", " > "),
         ("relation", " < ", " >= "), ("relation", " > ", " <= "), ("relation", " == ", " != "), ("relation", " != ", " == "),
         ("arithmetic", " + ", " - "), ("arithmetic", " - ", " + "), ("arithmetic", " * ", " / "), ("arithmetic", " / ", " * "),
         ("arithmetic", " += ", " -= "), ("arithmetic", " -= ", " += "), ("condition", " && ", " || "), ("condition", " || ", " && "),
         ("function", "std::min(", "std::max("), ("function", "std::max(", "std::min("), ("function", "std::sin(", "std::cos("),
         ("function", "std::cos(", "std::sin(")]
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+|\d+)(?![\w.])")
STATEMENT = re.compile(r"^\s*(?!return|throw|break|continue|using|case|else|for|if|while|do|default|static|const|auto|delete)"
                       r"[\w:.>\[\]()*+-]+(?:\s*[-+*/]?= .*|\(.*\))?;$")
CONDITION = re.compile(r"^(\s*(?:} else )?(?:if|while) \()([^;]*)(\)(?: \{|(?: \S.*;)?))$")


def masked(text):
    """The same length, with blanks for comments, texts, characters, and what the preprocessor reads."""
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', blank, text, flags=re.DOTALL)
    return re.sub(r"^#[^\n]*", blank, text, flags=re.MULTILINE)


def balanced(text):
    depth = 0
    for c in text:
        depth += {"(": 1, ")": -1}.get(c, 0)
        if depth < 0:
            return False
    return depth == 0


def mutants_of(file, text):
    """All of a source."""
    out = []
    depth_of_message = 0  # within throw Error(...) and the like nothing is drawn: texts are not numbers
    for number, (line, code) in enumerate(zip(text.splitlines(), masked(text).splitlines()), 1):
        add = lambda kind, after: out.append(Mutant(file, number, kind, line, after))
        if depth_of_message > 0 or re.search(r"\bthrow\b|\brefuse\(|static_assert|fmt::format", code):
            depth_of_message = max(0, depth_of_message + code.count("(") - code.count(")"))
            continue
        for kind, old, new in SWAPS:
            for at in re.finditer(re.escape(old), code):
                add(kind, line[: at.start()] + new + line[at.end():])
        for at in NUMBER.finditer(code):
            value = at[1]
            changed = f"{1.05 * float(value):.12g}" if re.search(r"[.e]", value) else str(int(value) + 1)
            if float(value) == 0.0 and "." in value:
                changed = "1e-3"
            add("constant", line[: at.start()] + changed + line[at.end():])
        if (found := CONDITION.match(code)) and balanced(found[2]):
            add("negated", line[: found.start(2)] + "!(" + line[found.start(2): found.end(2)] + ")" + line[found.end(2):])
        if STATEMENT.match(code) and balanced(code):
            add("deleted", re.match(r"\s*", line)[0] + ";")
    return out


def sources(folders):
    for folder in folders:
        yield from sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / folder).rglob("*.cpp")
                          if not p.relative_to(ROOT).parts[0] in ("tests", "bench", "build"))


def drawn(folders, count, seed):
    all_mutants = [m for file in sources(folders) for m in mutants_of(file, (ROOT / file).read_text())]
    random.Random(seed).shuffle(all_mutants)
    seen, out = set(), []
    for m in all_mutants:  # a line at most once
        if (m.file, m.line) not in seen and len(out) < count:
            seen.add((m.file, m.line))
            out.append(m)
    return out


@functools.cache
def commands(build):
    """Of the build: what compiles and links."""
    return subprocess.run(["ninja", "-C", str(build), "-t", "commands"], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()


@functools.cache
def programs(build, folder):
    """Test programs of the folder, or of the nearest one above that has some: path in the build and link command."""
    links = {}
    for command in commands(build):
        if at := re.search(r"-o (tests/(\S*)/\w+_tests)\b", command):
            links.setdefault(at[2], []).append((at[1], command))
    at = pathlib.PurePosixPath(folder)
    for place in (at, *at.parents):
        if found := links.get(place.as_posix()):
            return found
    return []


@functools.cache
def compile_command(build, file):
    """That of the unity which includes the source, or of itself."""
    source = str(ROOT / file)
    for command in commands(build):
        at = re.search(r" -o (\S+\.o) -c (\S+)$", command)
        if not at or "/tests/" in at[1]:
            continue
        unity = pathlib.Path(at[2])
        if at[2] == source or (unity.name.startswith("unity_") and unity.exists() and f'"{source}"' in unity.read_text()):
            return command
    return None


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **more)


class Bench:
    """Tries mutants in one build."""

    def __init__(self, build):
        self.build, self.own_time = build, {}
        self.folder = tempfile.TemporaryDirectory()
        self.work = pathlib.Path(self.folder.name)

    def tested(self, program, limit):
        """"" where it passes, else how it failed."""
        try:
            found = run([str(program), "--gtest_brief=1", "--gtest_fail_fast"], timeout=limit, cwd=self.work)
        except subprocess.TimeoutExpired:
            return "time"
        if found.returncode == 0:
            return ""
        name = re.search(r"\[  FAILED  \] (\S+)", found.stdout)
        return name[1] if name else f"status {found.returncode}"

    def own(self, path):
        if path not in self.own_time:
            start = time.time()
            if wrong := self.tested(self.build / path, 3600):
                sys.exit(f"{path} fails as it is: {wrong}")
            self.own_time[path] = time.time() - start
        return self.own_time[path]

    def outcome(self, mutant):
        """"killed by ...", "survived", "does not compile"."""
        command = compile_command(self.build, mutant.file)
        if command is None:
            return "is not built"
        lines = (ROOT / mutant.file).read_text().splitlines()
        lines[mutant.line - 1] = mutant.after
        source, made = self.work / pathlib.Path(mutant.file).name, self.work / "mutant.o"
        source.write_text("\n".join(lines) + "\n")
        words = [w for w in shlex.split(command) if w not in ("-Werror", "-Winvalid-pch", "-MD") and not w.endswith("ccache")]
        for flag in ("-MT", "-MF", "-o", "-c"):
            at = words.index(flag) if flag in words else None
            if at is not None:
                del words[at: at + 2]
        words += ["-w", "-O1", "-D_GLIBCXX_ASSERTIONS", "-I", str((ROOT / mutant.file).parent), "-c", str(source), "-o", str(made)]
        if run(words, cwd=self.build).returncode:
            return "does not compile"
        for path, link in programs(self.build, str(pathlib.PurePosixPath(mutant.file).parent)):
            program = self.work / "tests"
            link = link.removeprefix(": && ").split(" && ")[0].replace(f"-o {path}", f"-Wl,--allow-multiple-definition {made} -o {program}")
            linked = run(link, shell=True, cwd=self.build)
            if linked.returncode:
                return "does not link"
            if wrong := self.tested(program, FAR_TOO_LONG * self.own(path) + 20.0):
                return f"killed by {wrong}"
        return "survived"


def reasons():
    """By file and change: why no test can notice it."""
    out = {}
    if REASONS.exists():
        for line in REASONS.read_text().splitlines():
            if line and not line.startswith("#"):
                file, before, after, reason = [part.strip() for part in line.split("|")]
                out[file, before, after] = reason
    return out


def write(out, results, seed, folders):
    out.mkdir(parents=True, exist_ok=True)
    (out / "results.json").write_text(json.dumps([{**asdict(m), "outcome": outcome, "reason": reason} for m, outcome, reason in results],
                                                 indent=1) + "\n")
    table = {}
    for m, outcome, reason in results:
        row = table.setdefault(str(pathlib.PurePosixPath(m.file).parent), [0, 0, 0])
        if outcome.startswith("killed"):
            row[0] += 1
        elif outcome == "survived":
            row[2 if reason else 1] += 1
    lines = [f"# Mutants of {', '.join(folders)}, seed {seed}", "", "| folder | noticed | survived | cannot be noticed | score |", "|---|--:|--:|--:|--:|"]
    rows = sorted(table.items()) + [("all", [sum(row[k] for row in table.values()) for k in range(3)])]
    for folder, (killed, alive, equal) in rows:
        lines.append(f"| {folder} | {killed} | {alive} | {equal} | {f'{100 * killed / (killed + alive):.0f} %' if killed + alive else '-'} |")
    lines += ["", "| survivor | kind | before | after | reason |", "|---|---|---|---|---|"]
    cell = lambda text: text.strip().replace("|", "\\|")
    for m, outcome, reason in results:
        if outcome == "survived":
            lines.append(f"| {m.file}:{m.line} | {m.kind} | `{cell(m.before)}` | `{cell(m.after)}` | {reason or 'no test notices it'} |")
    (out / "survivors.md").write_text("\n".join(lines) + "\n")
    return rows[-1][1]


def self_test():
    text = """int f(int a, double b) {  // a < b
  if (a < 3 && b > 0.5) return 1;
  total += b;
  const auto s = "x < y";
  throw Error("b < 1", 4 +
              5);
  return std::min(a, 2) - g<int>(7);
}
"""
    found = {(m.line, m.kind, m.after.strip()) for m in mutants_of("f.cpp", text)}
    expected = {(2, "boundary", "if (a <= 3 && b > 0.5) return 1;"), (2, "boundary", "if (a < 3 && b >= 0.5) return 1;"),
                (2, "relation", "if (a >= 3 && b > 0.5) return 1;"), (2, "relation", "if (a < 3 && b <= 0.5) return 1;"),
                (2, "condition", "if (a < 3 || b > 0.5) return 1;"), (2, "constant", "if (a < 4 && b > 0.5) return 1;"),
                (2, "constant", "if (a < 3 && b > 0.525) return 1;"), (2, "constant", "if (a < 3 && b > 0.5) return 2;"),
                (2, "negated", "if (!(a < 3 && b > 0.5)) return 1;"), (3, "arithmetic", "total -= b;"), (3, "deleted", ";"),
                (7, "function", "return std::max(a, 2) - g<int>(7);"), (7, "arithmetic", "return std::min(a, 2) + g<int>(7);"),
                (7, "constant", "return std::min(a, 3) - g<int>(7);"), (7, "constant", "return std::min(a, 2) - g<int>(8);")}
    assert found == expected, f"{found - expected}\n{expected - found}"
    some = drawn(["analysis/geometry"], 5, 1)
    assert len(some) == 5 and some == drawn(["analysis/geometry"], 5, 1) != drawn(["analysis/geometry"], 5, 2)
    for m in drawn(["analysis/geometry", "analysis/damage"], 200, 1):
        assert (ROOT / m.file).read_text().splitlines()[m.line - 1] == m.before != m.after
    for file, before, after in reasons():
        lines = [line.strip() for line in (ROOT / file).read_text().splitlines()]
        assert before in lines, f"{REASONS.name}: {file} no longer has the line {before}"
    print("self-test passed")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", default=datetime.date.today().isoformat())
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "mutants")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--targets", action="store_true", help="only prints the test programs that will be needed")
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("folders", nargs="*")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    build = options.build.resolve()
    if not options.folders:
        parser.error("name folders of sources")
    mutants = drawn([folder.rstrip("/") for folder in options.folders], options.count, options.seed)
    if options.targets:
        paths = {path for m in mutants for path, _ in programs(build, str(pathlib.PurePosixPath(m.file).parent))}
        print("\n".join(sorted(pathlib.PurePosixPath(path).name for path in paths)))
        return 0
    known, bench, results = reasons(), Bench(build), []
    for number, m in enumerate(mutants, 1):
        outcome = bench.outcome(m)
        results.append((m, outcome, known.get((m.file, m.before.strip(), m.after.strip()), "")))
        print(f"{number}/{len(mutants)} {m.file}:{m.line} {m.kind}: {outcome}", file=sys.stderr)
        killed, alive, _ = write(options.out, results, options.seed, options.folders)
    print(f"{killed} noticed, {alive} survived: {options.out / 'survivors.md'}")
    return 1 if alive else 0


if __name__ == "__main__":
    sys.exit(main())
