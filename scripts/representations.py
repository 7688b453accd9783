#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Compares all representations on four shapes and writes tables and pictures into docs/representations.md, between its markers.

usage: representations.py [PROGRAM] [--keep FOLDER]     default build/release/app/treadmark

Compares on one thread, where times of building and searching are processor time, so that other work on the machine hardly counts. Nothing is
written when a comparison is not complete. --keep FOLDER: comparisons that the folder has already are used, the others are left there.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/representations.md"
SHAPES = [("wheel-flat", "wheel flat", "wheel"), ("squat", "squat", "rail"), ("corrugation", "corrugation", "rail"), ("crossing", "crossing", "rail")]
RESOLUTIONS_MM = "1,0.5,0.25"
# Head, and the value that a row of a case or its body has.
COLUMNS = [
    ("height max [µm]", lambda row, body: body["height_max_um"]),
    ("rms [µm]", lambda row, body: body["height_rms_um"]),
    ("slope max [mrad]", lambda row, body: body["slope_max_mrad"]),
    ("rms [mrad]", lambda row, body: body["slope_rms_mrad"]),
    ("curvature max [1/m]", lambda row, body: body["curvature_max_per_m"]),
    ("rms [1/m]", lambda row, body: body["curvature_rms_per_m"]),
    ("pmax [%]", lambda row, body: row["pmax_error_percent"]),
    ("force [%]", lambda row, body: row["force_error_percent"]),
    ("position [µm]", lambda row, body: 1e3 * row["position_error_mm"]),
    ("memory [MB]", lambda row, body: body["memory_bytes"] / 1e6),
    ("build [s]", lambda row, body: body["build_s"]),
    ("search [ms]", lambda row, body: 1e3 * row["search_s"]),
]


def compare(program, shape, folder):
    """compare.json of one shape, and the processor time it took [s]; what the folder has is not computed again."""
    told = folder / "seconds.txt"
    if not told.exists():
        shutil.rmtree(folder, ignore_errors=True)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([program, "compare", ROOT / "examples" / f"{shape}.toml", "--resolutions", RESOLUTIONS_MM, "--threads", "1", "-o", folder,
                               "--quiet"], stdout=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode not in (0, 4):  # 4: a case of a coarse surface did not converge, which the row tells
            sys.exit(f"compare of {shape} failed, status {done.returncode}")
        told.write_text(f"{after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime:.1f}\n")
    result = json.loads((folder / "compare.json").read_text())
    if not result["complete"]:
        sys.exit(f"compare of {shape} is not complete")
    return result, float(told.read_text())


def digits(value):
    """Two significant digits, without an exponent."""
    if value is None:
        return "–"
    if abs(value) < 5e-6:
        return "0"
    if abs(value) >= 10:
        return f"{value:.0f}"
    return f"{float(f'{value:.2g}'):.10f}".rstrip("0").rstrip(".")


def table(result, body):
    """One line a candidate, but the truth; errors are the largest over the cases, the search is their mean."""
    lines = ["| representation | mm | " + " | ".join(name for name, _ in COLUMNS) + " |", "|" + "---|" * (len(COLUMNS) + 2)]
    remarks = []
    truth, *candidates = result["candidates"]
    times = [row["search_s"] for row in result["rows"] if row["backend"] == truth["backend"] and row["resolution_mm"] is None]
    for candidate in candidates:
        name, resolution = candidate["backend"], candidate["resolution_mm"]
        if "failure" in candidate:
            remarks.append(f"`{name}` {resolution:g} mm: {candidate['failure']}.")
            continue
        rows = [row for row in result["rows"] if (row["backend"], row["resolution_mm"]) == (name, resolution)]
        bad = [row["case"] for row in rows if row["status"] not in ("ok", "no_contact")]
        if bad:
            remarks.append(f"`{name}` {resolution:g} mm: not converged in case {', '.join(map(str, bad))}.")
        cells = []
        for head, value in COLUMNS:
            values = [v for v in (value(row, candidate[body]) for row in rows if head == "search [ms]" or "pmax_error_percent" in row) if v is not None]
            mean = head == "search [ms]"
            cells.append(digits((sum(values) / len(values) if mean else max(values, key=abs)) if values else None).lstrip("-"))
        lines.append(f"| {name} | {'–' if resolution is None else f'{resolution:g}'} | " + " | ".join(cells) + " |")
    search = 1e3 * sum(times) / len(times)
    lines.append(f"| as given | – |{' |' * (len(COLUMNS) - 1)} {digits(search)} |")
    return lines, remarks


def machine():
    name = platform.processor() or platform.machine()
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            name = line.split(":", 1)[1].strip()
            break
    return f"{name}, {os.cpu_count()} cores"


def replaced(text, name, content):
    begin, end = f"<!-- begin: {name} -->", f"<!-- end: {name} -->"
    out, count = re.subn(re.escape(begin) + ".*?" + re.escape(end), lambda _: f"{begin}\n{content}\n{end}", text, flags=re.S)
    if count != 1:
        sys.exit(f"{PAGE} has no place for '{name}'")
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=str(ROOT / "build/release/app/treadmark"))
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    folder = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="representations-"))
    folder.mkdir(parents=True, exist_ok=True)
    try:
        parts, pictures, total = [], [], 0.0
        for shape, title, body in SHAPES:
            result, seconds = compare(options.program, shape, folder / shape)
            total += seconds
            lines, remarks = table(result, body)
            picture = f"representations-{shape}.svg"
            pictures.append((folder / shape / "errors.svg", ROOT / "docs" / picture))
            parts.append("\n".join([f"### {title.capitalize()}", "", f"`treadmark compare examples/{shape}.toml`, the {body} in all representations:", "",
                                    *lines, "", *remarks, *([""] if remarks else []), f"![Errors over resolution, {title}]({picture})"]))
        date = datetime.date.today().isoformat()
        head = (f"Made by `scripts/representations.py` on {date} ({machine()}). Times are processor time on one thread; the four comparisons took {total:.0f} s of\n"
                "it together.")
        text = PAGE.read_text()
        text = replaced(text, "representations on four shapes", head + "\n\n" + "\n\n".join(parts))
        PAGE.write_text(text)
        for source, target in pictures:
            shutil.copy(source, target)
    finally:
        if options.keep is None:
            shutil.rmtree(folder, ignore_errors=True)
    print(f"written: {PAGE.relative_to(ROOT)}, " + ", ".join(str(target.relative_to(ROOT)) for _, target in pictures), file=sys.stderr)


if __name__ == "__main__":
    main()
