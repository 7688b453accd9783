#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Whether error bars hold: virtual scans of shapes that are known, imported and run, and how often the truth lies within what results say.

usage: error-bars.py PROGRAM [--scans N] [--shapes NAME,...] [--points N] [--noise-mm S] [--passes N] [--registration-mm S]
                     [--cut F] [--seed K] [--jobs N] [--json FILE] [--check]

Shapes: new (wheel), flat, hollow, rail (worn), squat. Each scan has noise, an unknown frame, passes that are off, and a part that is
cut away (--cut: share of the length, at the ends of a rail and beside the middle of a wheel), all by its seed. Prints a Markdown table:
of each shape and quantity how many of the scans have the truth within one and two standard deviations, the root mean square of
difference over deviation (1: they are as large as they say), and the source that is named most. --check: exit status 1 unless 60 to 76 %
of all lie within one and at least 92 % within two.
"""
import argparse
import collections
import concurrent.futures
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

CASE = """[wheel]
{wheel}
[rail]
{rail}
[case]
error_bars = "{bars}"
[track]
cant = "1:40"
gauge_mm = 1435
[wheelset]
nominal_radius_mm = {radius}
{height}
y_mm = {y}
velocity_m_s = 20
rolling = "nominal"
[discretisation]
dx_mm = 1
ds_mm = 1
"""
LOAD_N = 80e3
LOAD = f"vertical_force_N = {LOAD_N}"
RADIUS = 460
WHEEL, RAIL = 'shape.standard = "S1002"', 'shape.standard = "60E1"'
FLAT = '[[wheel.flats]]\nshape = "rounded"\nlength_mm = 60\ndepth_mm = 0.9\ny_center_mm = 0\nwidth_mm = 40\n'
SQUAT = "[[rail.squats]]\nlength_mm = 40\nwidth_mm = 30\ndepth_mm = 0.4\n"
MEASURED = 'shape.file = "{file}"\nshape.smoothing = "none"\nshape.placement = "as_in_file"'
SHAPES = {  # body, its keys, lateral position [mm]
    "new": ("wheel", WHEEL, 1.0),
    "flat": ("wheel", WHEEL + "\n" + FLAT, 0.0),
    "hollow": ("wheel", MEASURED.format(file="hollow.csv"), 1.0),
    "rail": ("rail", MEASURED.format(file="worn.csv").replace('\nshape.placement = "as_in_file"', ""), 1.0),
    "squat": ("rail", RAIL + "\n" + SQUAT, 0.0),
}
WITHIN_ONE, WITHIN_TWO = (0.60, 0.76), 0.92


class Trials:
    def __init__(self, program, folder, options):
        self.program, self.folder, self.options = program, folder, options

    def call(self, *words, folder=None):
        done = subprocess.run([self.program, *map(str, words)], cwd=folder or self.folder, capture_output=True, text=True)
        if done.returncode not in (0, 1):  # 1: warnings that numbers may be wrong, which error bars are about
            raise RuntimeError(f"treadmark {' '.join(map(str, words))}: {done.stderr.strip()}")
        return done.stdout

    def points_of(self, name, body):
        self.call("convert", name, f"{name}.csv", "--body", body)
        rows = []
        for line in (self.folder / f"{name}.csv").read_text().splitlines():
            numbers = re.split(r"[,;\s]+", line.strip())
            try:
                rows.append((float(numbers[0]), float(numbers[1])))
            except (ValueError, IndexError):
                continue
        return rows

    def write_worn(self):
        """A wheel that is hollow by 2 mm over 50 mm, and a rail worn by 1 mm on its crown and 2 mm at its gauge side."""
        hollow = [(y, z - (2.0 * math.cos(math.pi * y / 50) ** 4 if abs(y) < 25 else 0.0)) for y, z in self.points_of("S1002", "wheel")]
        worn = [(y, z + 1.0 * math.exp(-((y / 15) ** 2)) + 2.0 * math.exp(-(((y + 28) / 8) ** 2))) for y, z in self.points_of("60E1", "rail")]
        for name, rows in (("hollow.csv", hollow), ("worn.csv", worn)):
            (self.folder / name).write_text("".join(f"{y:.9f},{z:.9f}\n" for y, z in rows))

    def case(self, shape, keys=None, height=LOAD, bars="never"):
        body, own, y = SHAPES[shape]
        keys = keys or own
        return CASE.format(wheel=keys if body == "wheel" else WHEEL, rail=keys if body == "rail" else RAIL, bars=bars, radius=RADIUS,
                           height=height, y=y)

    def solved(self, file, folder=None):
        return json.loads(self.call("run", file, "--json", "-", "--quiet", folder=folder))["cases"][0]

    def conicity(self, file, folder=None):
        g = json.loads(self.call("geometry", file, "--json", "-", folder=folder))["geometry"]
        return g["conicity_3mm"], g.get("conicity_3mm_noise")

    def depth(self, file, folder=None):
        m = json.loads(self.call("measure", "wheel", file, "--nominal-radius", RADIUS, "--nominal", "S1002", "--json", "-", folder=folder))["wheel"]
        return m["flat_depth_mm"], m["uncertainty"].get("flat_depth_mm")

    def truth(self, shape):
        """Under the load, and the force at the height where that was."""
        (self.folder / f"{shape}.toml").write_text(self.case(shape))
        case = self.solved(f"{shape}.toml")
        best = max(case["patches"], key=lambda patch: patch["fn_N"])
        known = {"pmax": best["pmax_MPa"], "area": best["elements"]["ncon"], "force": LOAD_N, "z": case["wheelset"]["z_mm"], "patches": len(case["patches"])}
        if shape not in ("flat", "squat"):  # whose sections vary
            known["conicity"] = self.conicity(f"{shape}.toml")[0]
        if shape == "flat":
            known["depth"] = self.depth(f"{shape}.toml")[0]
        return known

    def cloud(self, shape, folder, seed):
        body = SHAPES[shape][0]
        o = self.options
        dice = random.Random(seed)
        words = ["scan", self.folder / f"{shape}.toml", "--body", body, "-o", "scan.ply", "--points", o.points, "--noise-mm", o.noise_mm,
                 "--outliers", 0.005, "--holes", 0.01, "--frame", "random", "--seed", seed]
        if o.passes > 1:
            words += ["--passes", o.passes, "--registration-mm", o.registration_mm]
        if body == "rail":
            half = 300 * (1 - o.cut * dice.random())
            words += [f"--range-mm={-half:.1f},{half:.1f}"]
        elif o.cut > 0:
            half = 180 * (1 - o.cut * dice.random())
            words += [f"--range-deg={-half:.1f},{half:.1f}"]
        self.call(*words, folder=folder)

    def trial(self, shape, truth, seed):
        """(quantity, difference over deviation, what it comes from most) of one scan."""
        body = SHAPES[shape][0]
        file = "found.slcw" if body == "wheel" else "found.slcs"
        rows = []
        with tempfile.TemporaryDirectory(dir=self.folder) as name:
            folder = pathlib.Path(name)
            self.cloud(shape, folder, seed)
            # a defect lies at 0; which way along a rail that is its own mirror image is all the same
            radius = ["--nominal-radius", RADIUS] if body == "wheel" else []
            self.call("import", "scan.ply", "--body", body, "-o", file, *radius, "--quiet", folder=folder)

            def run(height, quantities):
                (folder / "found.toml").write_text(self.case(shape, f'shape.file = "{file}"', height, "always"))
                case = self.solved("found.toml", folder)
                known = case.get("uncertainty") or {"message": "none", "numbers": []}
                if known["message"] or len(case["patches"]) != truth["patches"]:
                    rows.extend((quantity, None, known["message"] or "other patches") for quantity, _ in quantities)
                    return
                best = max(range(len(case["patches"])), key=lambda k: case["patches"][k]["fn_N"]) + 1
                numbers = {number["name"]: number for number in known["numbers"]}
                for quantity, key in quantities:
                    number = numbers.get(key.format(patch=best))
                    if not number or not number["sigma"]:
                        rows.append((quantity, None, "not known"))
                        continue
                    shares = [share if share is not None else 0.0 for share in number["shares"]]
                    most = max(range(len(shares)), key=shares.__getitem__) if shares and max(shares) > 0 else None
                    rows.append((quantity, (number["value"] - truth[quantity]) / number["sigma"],
                                 known["sources"][most]["name"] if most is not None else ""))

            run(LOAD, [("pmax", "patch_{patch}.pmax_MPa"), ("area", "patch_{patch}.elements.ncon")])
            run(f"z_mm = {truth['z']:.9f}", [("force", "force_on_rail.fz_tr_N")])
            if "conicity" in truth:
                value, sigma = self.conicity("found.toml", folder)
                rows.append(("conicity", (value - truth["conicity"]) / sigma if value is not None and sigma else None, ""))
            if "depth" in truth:
                value, width = self.depth(file, folder)
                rows.append(("depth", 1.96 * (value - truth["depth"]) / width if value is not None and width else None, ""))
        return rows


def table(found):
    print("| shape | quantity | scans | within 1 σ | within 2 σ | rms of difference/σ | named most | not known |")
    print("|---|---|---|---|---|---|---|---|")
    out = []
    for (shape, quantity), rows in sorted(found.items()):
        known = [off for off, _ in rows if off is not None]
        one = sum(abs(off) <= 1 for off in known)
        two = sum(abs(off) <= 2 for off in known)
        rms = math.sqrt(sum(off * off for off in known) / len(known)) if known else math.nan
        names = collections.Counter(name for off, name in rows if off is not None and name).most_common(1)
        named = f"{names[0][0]} ({100 * names[0][1] // len(known)} %)" if names else ""
        part = (lambda count: f"{100 * count / len(known):.0f} %") if known else (lambda count: "-")
        print(f"| {shape} | {quantity} | {len(rows)} | {part(one)} | {part(two)} | {rms:.2f} | {named} | {len(rows) - len(known)} |")
        out.append({"shape": shape, "quantity": quantity, "scans": len(rows), "known": len(known), "within_1": one, "within_2": two, "rms": rms})
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--scans", type=int, default=200, help="of each shape")
    parser.add_argument("--shapes", default=",".join(SHAPES))
    parser.add_argument("--points", type=int, default=400_000)
    parser.add_argument("--noise-mm", type=float, default=0.03)
    parser.add_argument("--passes", type=int, default=1)
    parser.add_argument("--registration-mm", type=float, default=0.1)
    parser.add_argument("--cut", type=float, default=0.3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--json")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    shapes = options.shapes.split(",")
    for shape in shapes:
        if shape not in SHAPES:
            parser.error(f"no shape {shape}: {', '.join(SHAPES)}")
    found = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        trials = Trials(str(pathlib.Path(options.program).resolve()), pathlib.Path(folder), options)
        trials.write_worn()
        truths = {shape: trials.truth(shape) for shape in shapes}
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            waiting = {pool.submit(trials.trial, shape, truths[shape], options.seed + k): shape for shape in shapes for k in range(options.scans)}
            for done in concurrent.futures.as_completed(waiting):
                shape = waiting[done]
                try:
                    rows = done.result()
                except RuntimeError as error:
                    print(f"{shape}: {error}", file=sys.stderr)
                    rows = [(quantity, None, "failed") for quantity in truths[shape] if quantity not in ("z", "patches")]
                for quantity, off, name in rows:
                    found[shape, quantity].append((off, name))
    rows = table(found)
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(rows, indent=1) + "\n")
    known = sum(row["known"] for row in rows)
    one, two = (sum(row[key] for row in rows) / max(known, 1) for key in ("within_1", "within_2"))
    print(f"\nall: {100 * one:.0f} % within 1 σ, {100 * two:.0f} % within 2 σ of {known}")
    if options.check and not (WITHIN_ONE[0] <= one <= WITHIN_ONE[1] and two >= WITHIN_TWO):
        sys.exit(1)


if __name__ == "__main__":
    main()
