#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Every command `treadmark ...` in the documents is one that the program takes: its verb, its options, and values of options that have a list.

usage: commands_test.py ROOT PROGRAM
Commands in blocks of code and within lines count; what they would do is not done here: run_documents.py runs those in blocks.
"""
import pathlib
import re
import subprocess
import sys

from documented_commands import commands_of, pages_of

OPTION = re.compile(r"(?<![\w-])(-[a-zA-Z]|--[a-z][a-z0-9-]*)")


class Program:
    def __init__(self, path):
        self.path, self.help = path, {}
        self.common = self.options("--help")
        self.verbs = self.call("list", "verbs").split("\n")
        self.verbs = {line.split()[0] for line in self.verbs if line.strip()}

    def call(self, *arguments):
        return subprocess.run([self.path, *arguments], capture_output=True, text=True).stdout

    def options(self, *arguments):
        """What --help lists: option to the words that it may have."""
        out = {}
        for line in self.call(*arguments).split("\n"):
            if re.match(r"\s+-", line):
                words = re.search(r"\{([^}]*)\}", line)
                for option in OPTION.findall(line.split("  ")[1] if line.startswith("  ") else line):
                    out[option] = set(words.group(1).split(",")) if words else None
        return out

    def wrong(self, words):
        """What is wrong with a command; empty: nothing."""
        if words[1].startswith("-"):
            known = {**self.common, "--json": None, "--spdx": None}
            return [f"no option {word}" for word in words[1:] if word.startswith("-") and word.split("=")[0] not in known]
        verb = words[1].rstrip(".,:")
        if verb not in self.verbs:
            return [f"no verb {verb}"]
        if verb not in self.help:
            self.help[verb] = {**self.common, **self.options(verb, "--help")}
        found = []
        for i, word in enumerate(words[2:], 2):
            name, sign, value = word.partition("=")
            if not re.fullmatch(r"-[a-zA-Z]|--[a-z][a-z0-9-]*", name):
                continue
            if name not in self.help[verb]:
                found.append(f"{verb} has no option {name}")
                continue
            allowed = self.help[verb][name]
            value = value if sign else words[i + 1] if i + 1 < len(words) else ""
            if allowed and not value.isupper() and not set(value.split(",")) <= allowed:
                found.append(f"{verb} {name} takes {', '.join(sorted(allowed))}, not {value}")
        return found


root, program = pathlib.Path(sys.argv[1]), Program(sys.argv[2])
planted = {"treadmark dance x": 1, "treadmark run x --repot y": 1, "treadmark convert x y --body bogie": 1, "treadmark run x -o y --report z": 0,
           "treadmark --version --json": 0, "treadmark --verison": 1}
for command, count in planted.items():
    assert len(program.wrong(command.split())) == count, command
violations, seen = [], 0
for page in pages_of(root):
    for line, words, _ in commands_of(page.read_text(encoding="utf-8")):
        seen += 1
        violations += [f"{page.relative_to(root)}:{line}: {text}: {' '.join(words)}" for text in program.wrong(words)]
assert seen > 80, seen
for verb in sorted(program.verbs):
    examples = re.findall(r"^  treadmark (.+)", program.call(verb, "--help").partition("Examples:")[2].partition("Exit status")[0], re.M)
    violations += [f"{verb} --help: {text}" for example in examples for text in program.wrong(["treadmark", *example.split()])]
    assert examples, verb
print("\n".join(violations) or f"{seen} commands")
sys.exit(1 if violations else 0)
