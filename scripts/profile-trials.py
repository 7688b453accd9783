#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Does a measured profile mean the same however it is written? Wheels and rails of known shape go through every reader and verb in many disguises.

usage: profile-trials.py [--program PROGRAM] [--count N] [--seed S] [--jobs J] [--keep FOLDER] [--results FILE] [--only CHOICES] [--classes N]

Each trial draws a base (new, hollow, side-worn ... , a formula of this script), a verb, a reader and disguises: unit, order, mirror, header, encoding,
spacing, frame, tilt, cut ends, noise, rounding, spikes, marks of nothing. First every pair of choices, then random ones. The answer must be that of the
base, which is given to the program in a file that says its axes and its unit, within 5 % (noise of 30 um: 15 %); or be doubted; or be refused. What is none of
these is a wrong number that nobody is told of: its disguises are taken off one by one as long as it stays wrong, its files lie in FOLDER/wrong. `noted`:
wrong, exit status 0, but a note names the doubt. `cautious`: right, and doubted.
Prints a table by kind for docs/verification.md, then all choices, classes of wrong answers and what refusals said; exit status 1 where anything was wrong
in silence. --only "verb=run,base=new;60E1": trials with these choices alone. --results: goes on where the same call stopped.
"""
import argparse
import bisect
import collections
import concurrent.futures
import contextlib
import hashlib
import itertools
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
FINE = 0.02  # mm between the points of an outline

# ---------------------------------------------------------------------------------------------------------------- shapes [mm], y to the right, z down


def arc(y, z, radius, begin, end):
    """Points of a circle between two angles [deg]; 0 is along +y, 90 along +z."""
    count = max(2, int(abs(end - begin) * math.pi / 180 * radius / FINE))
    angles = (math.radians(begin + (end - begin) * k / count) for k in range(count + 1))
    return [(y + radius * math.cos(a), z + radius * math.sin(a)) for a in angles]


def line(a, b):
    count = max(1, int(math.dist(a, b) / FINE))
    return [(a[0] + (b[0] - a[0]) * k / count, a[1] + (b[1] - a[1]) * k / count) for k in range(count + 1)]


def joined(*parts):
    out = []
    for part in parts:
        for point in part:
            if not out or math.dist(point, out[-1]) > 1e-3:
                out.append(point)
    return out


def angle_to(center, point):
    return math.degrees(math.atan2(point[1] - center[1], point[0] - center[0]))


def s1002():
    """EN 13715, flange 28 mm high and 32.5 mm thick, from the flange back to the field side."""
    tread = ([0.0, -3.358537058e-2, 1.565681624e-3, -2.810427944e-5, 5.844240864e-8, -1.562379023e-8, 5.309217349e-15, -5.957839843e-12, 2.646656573e-13])
    throat = [-4.320221063e3, -1.038384026e3, -1.065501873e2, -6.051367875, -2.054332446e-1, -4.169739389e-3, -4.687195829e-5, -2.252755540e-7]

    def height(y):
        if y > 32.15796:
            return 1.364323640 - 0.066666667 * y
        return sum(c * y**k for k, c in enumerate(tread if y > -26 else throat))

    back, tip, face, root = (-49.5, 9.519259302), (-55.0, 16.0), (-58.558326413, 8.834924130), (-26.210665, 16.446)
    h, g, f, e, d = (-62.764705882, 25.149), (-49.662510381, 26.748), (-39.764473993, 15.675), (-38.426669071, 12.0), (-35.0, 6.867)
    wide = [(y, height(y)) for y in (-35 + 95 * k / 4750 for k in range(4751))]
    return joined(arc(*back, 20.5, 180, angle_to(back, h)), arc(*tip, 12, angle_to(tip, h), angle_to(tip, g)),
                  arc(*face, 20, angle_to(face, g), angle_to(face, f)), line(f, e),
                  arc(*root, 13, angle_to(root, e) % 360, angle_to(root, d) % 360), wide)


def rail_60e1(depth=37.8):
    """EN 13674-1: circles of 300, 80 and 13 mm, sides 1:20, down to this depth; from the gauge side to the field side."""
    crown, shoulder, corner = (0.0, 300.0), (7.500533, 80.127896), (23.016030, 14.949147)
    right = joined(arc(*crown, 300, -90, angle_to(crown, (10.228, 0.174404))),
                   arc(*shoulder, 80, angle_to(shoulder, (10.228, 0.174404)), angle_to(shoulder, (26.0265, 2.302524))),
                   arc(*corner, 13, angle_to(corner, (26.0265, 2.302524)), angle_to(corner, (35.999811, 14.299958))),
                   line((35.999811, 14.299958), (35.999811 + (depth - 14.299958) / 20, depth)))
    return [(-y, z) for y, z in reversed(right)][:-1] + right


def smooth(t):
    t = min(1.0, max(0.0, t))
    return t * t * (3 - 2 * t)


def lifted(points, by):
    return [(y, z + by(y)) for y, z in points]


def hollow(depth, middle=10.0, half=35.0):
    return lambda y: -depth * 0.5 * (1 + math.cos(math.pi * (y - middle) / half)) if abs(y - middle) < half else 0.0


def side_worn(wear):
    return [(y + wear * smooth((z - 1.0) / 11.0) if y < 0 else y, z) for y, z in rail_60e1()]


def soft_max(z, level, soft):
    return 0.5 * (z + level + math.hypot(z - level, 2 * soft))


def grooved(below=7.0, outside=False):
    """A head with a groove of 50 mm, 45 mm deep, and a keeper beside its gauge side or the other one, so far below its top."""
    head = rail_60e1(40.0)
    bottom, wall = 45.0, head[0][0] - 50.0
    middle = below + 4.0
    keeper = joined(line((wall - 22, middle + 3.0), (wall - 22, middle)), arc(wall - 18, middle, 4.0, 180, 270), line((wall - 18, below), (wall - 4, below)),
                    arc(wall - 4, middle, 4.0, -90, 0), line((wall, middle), (wall, bottom)), line((wall, bottom), (head[0][0], bottom)),
                    line((head[0][0], bottom), head[0]))
    points = joined(keeper, head)
    return [(-y, z) for y, z in reversed(points)] if outside else points


def whole_outline(start=0.0):
    """Head, web and foot of 60E1 in straight lines, closed; from the gauge side, or from this share of its points on."""
    head = rail_60e1()
    y, z = head[-1]
    half = [(y, z), (y - 1.5, z + 2.0), (9.0, 52.0), (8.25, 80.0), (8.25, 112.0), (12.0, 140.0), (72.0, 160.5), (75.0, 164.0), (75.0, 172.0)]
    right = joined(*(line(a, b) for a, b in zip(half, half[1:])))
    base = line((75.0, 172.0), (-75.0, 172.0))
    points = joined(head, right, base, [(-y, z) for y, z in reversed(right)][:-1])
    first = int(start * len(points))
    return points[first:] + points[:first]


def double_flange():
    side = joined(line((0, 0), (42.0, 0.0)), arc(42.0, 4.0, 4.0, -90, -15), line((45.8637, 2.9647), (49.3, 15.8)), arc(53.2, 14.8, 4.04, 165.5, 97),
                  line((52.7, 18.81), (60.0, 19.7)))
    return [(-y, z) for y, z in reversed(side)][:-1] + side


def with_faces(back, field):
    """S1002 whose back, and outer face behind a chamfer, were measured as far up as this z."""
    points = joined(line((-70.0, back), (-70.0, 9.4)), s1002())
    return joined(points, line(points[-1], (65.0, 2.0)), line((65.0, 2.0), (65.0, field))) if field else points


def thin_flange(by):
    return [(y - by * smooth((y + 57) / 10) * smooth((-14 - y) / 18), z) if y > -57 else (y, z) for y, z in s1002()]


WHEELS = {
    "new": s1002,
    "hollow 0.5": lambda: lifted(s1002(), hollow(0.5)),
    "hollow 1": lambda: lifted(s1002(), hollow(1.0)),
    "hollow 2": lambda: lifted(s1002(), hollow(2.0)),
    "hollow 3": lambda: lifted(s1002(), hollow(3.0)),
    "hollow 4": lambda: lifted(s1002(), hollow(4.0)),
    "hollow 6": lambda: lifted(s1002(), hollow(6.0)),
    "thin flange": lambda: thin_flange(5.0),
    "false flange": lambda: lifted(s1002(), lambda y: hollow(2.5, 3.0, 32.0)(y) + 1.5 * math.exp(-((y - 44) / 7)**2)),
    "rising tread": lambda: lifted(s1002(), lambda y: 4.5 * smooth((y + 5) / 65)),
    "double flange": double_flange,
    "long back": lambda: with_faces(-25.0, None),
    "both faces": lambda: with_faces(-30.0, -28.0),
}
RAILS = {
    "60E1": rail_60e1,
    "grooved": grooved,
    "high keeper": lambda: grooved(0.0),
    "outer keeper": lambda: grooved(0.0, True),
    "side worn 2": lambda: side_worn(2.0),
    "side worn 4": lambda: side_worn(4.0),
    "side worn 6": lambda: side_worn(6.0),
    "flat head": lambda: [(y, soft_max(z, 1.0, 0.6)) for y, z in rail_60e1()],
    "top 20": lambda: [p for p in rail_60e1() if abs(p[0]) <= 20],
    "cut 5": lambda: [p for p in rail_60e1() if p[1] <= 5],
    "cut 8": lambda: [p for p in rail_60e1() if p[1] <= 8],
    "cut 10": lambda: [p for p in rail_60e1() if p[1] <= 10],
    "lip": lambda: [(y - 1.2 * math.exp(-((z - 9) / 3)**2) if y < 0 else y, z) for y, z in side_worn(3.0)],
    "gauge half": lambda: [p for p in rail_60e1() if p[0] <= 14],
    "whole outline": whole_outline,
    "outline from foot": lambda: whole_outline(0.5),
}
GROOVED = ("grooved", "high keeper", "outer keeper")
# What a base is where all of it would have been measured, and nothing that the head does not touch.
TRUE_SHAPE = {**dict.fromkeys(GROOVED, "60E1"), "gauge half": "60E1", "top 20": "60E1", "cut 5": "60E1", "cut 8": "60E1", "cut 10": "60E1", "whole outline": "60E1", "outline from foot": "60E1",
              "long back": "new", "both faces": "new"}
_outlines = {}


def outline(base):
    if base not in _outlines:
        _outlines[base] = (WHEELS.get(base) or RAILS[base])()
    return _outlines[base]


def is_wheel(base):
    return base in WHEELS


# ---------------------------------------------------------------------------------------------------------------------------------------- choices

# The first one of each is the plain one.
CHOICES = {
    "base": [*WHEELS, *RAILS],
    "verb": ["run", "check", "geometry", "measure", "convert", "simulate"],
    "reader": ["columns", "miniprof", "simpack", "gensys", "slices"],
    "unit": ["mm", "m", "um", "in", "cm"],
    "said": ["no", "names", "comment", "row"],
    "order": ["along", "back", "shuffled", "doubled"],
    "mirror": ["no", "y"],
    "z": ["down", "up"],
    "header": ["none", "names", "title", "remark", "x and z", "lateral", "German", "unknown words"],
    "count": ["none", "number", "two numbers", "words"],
    "extra": ["none", "index", "label", "time", "quality"],
    "delimiter": [" ", ",", ";", "\t", " , ", "|"],
    "decimal": [".", ","],
    "encoding": ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1"],
    "minus": ["-", "\u2212", "()", "\u2013"],
    "lines": ["\n", "\r\n", "\r"],
    "step": [0.2, 0.05, 0.1, 0.3, 0.5, 1.0],
    "sampled": ["by length", "by y"],
    "gap": ["none", "3 mm", "12 mm"],
    "frame": ["tape", "back", "axle", "anywhere", "4 mm off"],
    "height": ["nominal", "anywhere", "axle", "radius", "diameter"],
    "tilt": [0, 1, -1, 2, -2, 4, -4, 6, -6, 8, -8, 10, -10],
    "cut": ["none", "back", "field", "both", "flange"],
    "noise": [0.0, 0.001, 0.003, 0.01, 0.03],
    "rounded": [0.0001, 0.001, 0.01, 0.05],
    "spike": ["none", "2 mm", "0.5 mm", "three points", "at the end"],
    "nothing": ["none", "-9999", "NaN", "empty", "N/A", "--", "1.#QNAN", "-99.999", "-524288", "0 0", "NaN at the ends", "empty at the ends"],
    "style": ["fixed", "quotes", "exponent", "plus", "delimiter at the end", "remark behind"],
    "tail": ["none", "END", "sum", "blank line inside"],
    "layout": ["rows", "two long rows"],
    "keys": ["none", "right"],
    "side": ["right", "left"],
    "place": ["gauge", "rail_y"],
    "y": [0, -2, 2, 4],
}
PLAIN = {name: values[0] for name, values in CHOICES.items()}
TEXT_OF_COLUMNS = ("header", "count", "extra", "delimiter", "decimal", "minus", "nothing", "style", "tail", "layout")


def makes_sense(c):
    """Whether the choices belong together; those that a reader has no use for have to be plain."""
    wheel, reader = is_wheel(c["base"]), c["reader"]
    plain = lambda *names: all(c[n] == PLAIN[n] for n in names)
    if reader != "columns" and not plain(*TEXT_OF_COLUMNS, "said" if reader != "simpack" else "count"):
        return False
    if reader == "gensys" and not (wheel and plain("frame")):
        return False
    if reader == "simpack" and (c["said"] not in ("no", "names") or not plain("lines")):
        return False
    if c["unit"] == "mm" and c["said"] not in ("no", "names"):
        return False
    if c["said"] == "row" and c["header"] in ("none", "title", "remark"):
        return False
    if c["said"] == "names" and reader == "columns" and c["header"] in ("none", "title", "unknown words"):
        return False
    if c["decimal"] == "," and c["delimiter"] in (",", " , "):
        return False
    if c["header"] == "x and z" and c["delimiter"] == "|":
        return False
    if not wheel and (c["height"] in ("radius", "diameter") or c["cut"] in ("back", "flange", "both")):
        return False
    if c["cut"] != "none" and c["base"] in ("top 20", "whole outline", "outline from foot", "double flange", "long back", "both faces"):
        return False
    if c["height"] in ("radius", "diameter") and (c["z"] == "up" or c["header"] in ("title", "remark", "unknown words", "lateral", "German") or reader != "columns"
                                                  or c["tilt"]):
        return False
    if c["place"] == "rail_y" and (wheel or c["verb"] not in ("run",) or not plain("frame", "height", "mirror")):
        return False
    if c["order"] == "shuffled" and c["base"] in ("whole outline", "outline from foot", "long back", "both faces", *GROOVED):
        return False
    if c["verb"] != "run" and not plain("y", "keys", "side"):
        return False
    if c["sampled"] == "by y" and c["base"] in ("whole outline", "outline from foot", "long back", "both faces", "lip", *GROOVED):
        return False
    if c["verb"] == "geometry" and c["base"] == "double flange":
        return False  # it has no flange back to be placed by
    if c["verb"] in ("simulate", "measure") and c["base"] in ("double flange", *GROOVED):
        return False
    if c["verb"] == "simulate" and (c["noise"] > 0.003 or reader == "slices"):
        return False
    if c["verb"] == "check" and reader == "slices":
        return False
    if c["encoding"] != "utf-8" and reader == "slices":
        return False
    if c["layout"] != "rows" and not plain("extra", "header", "count", "nothing", "tail", "said", "lines"):
        return False
    if c["style"] == "quotes" and c["minus"] == "()":
        return False
    if c["encoding"] == "latin-1" and c["minus"] in ("\u2212", "\u2013"):
        return False
    return True


def trials(count, seed, only):
    """Pairs of choices with all else plain, then random ones."""
    rng = random.Random(seed)
    fits = lambda c: makes_sense(c) and all(str(c[n]) in v for n, v in only.items())
    seen = set()

    def fresh(c):
        key = tuple(c.values())
        if key in seen or not fits(c):
            return False
        seen.add(key)
        return True

    out = []
    start = dict(PLAIN)
    for n, v in only.items():
        start[n] = next(x for x in CHOICES[n] if str(x) in v)
    pairs = [(a, x, b, y) for a, b in itertools.combinations(CHOICES, 2) for x in CHOICES[a] for y in CHOICES[b]]
    rng.shuffle(pairs)
    for a, x, b, y in pairs:
        c = dict(start)
        if "base" not in only and not {"base"} & {a, b}:
            c["base"] = rng.choice(CHOICES["base"])
        if "verb" not in only and not {"verb"} & {a, b} and rng.random() < 0.5:
            c["verb"] = rng.choice(CHOICES["verb"][:5])
        c[a], c[b] = x, y
        if fresh(c):
            out.append(c)
        if len(out) >= count * 0.6:
            break
    weights = {"verb": [10, 4, 4, 4, 4, 1], "reader": [10, 3, 3, 1, 1]}
    tries = 0
    while len(out) < count and tries < 400 * count:
        tries += 1
        c = dict(start)
        for n in ("base", "verb", "reader", "y", "step"):
            if n not in only:
                c[n] = rng.choices(CHOICES[n], weights.get(n))[0]
        free = [n for n in CHOICES if n not in ("base", "verb", "reader", "y", "step") and n not in only]
        for n in rng.sample(free, rng.choice([1, 2, 3, 3, 4, 5, 6])):
            c[n] = rng.choice(CHOICES[n])
        if fresh(c):
            out.append(c)
    return out


# ---------------------------------------------------------------------------------------------------------------------------------------- disguises


def resampled(points, step):
    """Points of the polyline every step [mm] of its length."""
    lengths = [0.0]
    for a, b in zip(points, points[1:]):
        lengths.append(lengths[-1] + math.dist(a, b))
    count = max(2, round(lengths[-1] / step))
    out = []
    for k in range(count + 1):
        s = lengths[-1] * k / count
        i = min(max(bisect.bisect_right(lengths, s) - 1, 0), len(points) - 2)
        t = (s - lengths[i]) / (lengths[i + 1] - lengths[i])
        out.append((points[i][0] + t * (points[i + 1][0] - points[i][0]), points[i][1] + t * (points[i + 1][1] - points[i][1])))
    return out


def by_y(points, step):
    """Points where a polyline passes every step of y, as a camera sees them."""
    out, at = [points[0]], points[0][0] + step
    for a, b in zip(points, points[1:]):
        while a[0] < b[0] and at <= b[0]:
            t = (at - a[0]) / (b[0] - a[0])
            if t >= 0:
                out.append((at, a[1] + t * (b[1] - a[1])))
            at += step
    return out


def turned(points, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [(c * y - s * z, s * y + c * z) for y, z in points]


def cut(points, how):
    low = {"back": -62.0, "both": -62.0, "flange": -46.0}.get(how, -1e9)
    high = {"field": 28.0, "both": 40.0}.get(how, 1e9)
    return [p for p in points if low <= p[0] <= high]


TO_FILE = {"mm": 1.0, "m": 1e-3, "um": 1e3, "in": 1 / 25.4, "cm": 0.1}
RADIUS = 460.0  # mm, of all wheels here


def measured(c, rng):
    """Points as an instrument would have them, in the unit of the file: [(y, z or None or text)]."""
    wheel = is_wheel(c["base"])
    points = cut(outline(c["base"]), c["cut"])
    points = resampled(points, c["step"]) if c["sampled"] == "by length" else by_y(points, c["step"])
    if c["gap"] != "none":
        half = float(c["gap"].split()[0]) / 2
        points = [p for p in points if abs(p[0] - 3.0) > half or p[1] > 15]
    if c["noise"]:
        points = [(y + rng.gauss(0, 0.2 * c["noise"]), z + rng.gauss(0, c["noise"])) for y, z in points]
    inside = [k for k, (y, z) in enumerate(points) if abs(y) < 18 and abs(z) < 12] or [len(points) // 2]
    at = rng.choice(inside)
    bumps = {"2 mm": {at: -2.0}, "0.5 mm": {at: 0.5}, "three points": {at - 1: 0.25, at: 0.4, at + 1: 0.25}, "at the end": {0: 3.0, 1: 1.5}}
    for k, by in bumps.get(c["spike"], {}).items():
        if 0 <= k < len(points):
            points[k] = (points[k][0], points[k][1] + (by if wheel else -by))
    points = turned(points, c["tilt"])
    dy = {"tape": 0.0, "back": 70.0 if wheel else 36.0, "axle": 750.0, "anywhere": round(rng.uniform(-200, 200), 2), "4 mm off": 4.0}[c["frame"]]
    dz = {"nominal": 0.0, "anywhere": round(rng.uniform(-40, 40), 2), "axle": RADIUS if wheel else -172.0, "radius": RADIUS, "diameter": RADIUS}[c["height"]]
    points = [(y + dy, z + dz) for y, z in points]
    if c["height"] == "diameter":
        points = [(y, 2 * z) for y, z in points]
    if c["mirror"] == "y":
        points = [(-y, z) for y, z in points]
    if c["z"] == "up":
        points = [(y, -z) for y, z in points]
    if c["reader"] == "gensys":
        points = [(-y, z) for y, z in points]
    q = c["rounded"]
    points = [(round(y / q) * q, round(z / q) * q) for y, z in points]
    factor = TO_FILE[c["unit"]]
    points = [(y * factor, z * factor) for y, z in points]
    if c["order"] == "back":
        points.reverse()
    elif c["order"] == "shuffled":
        rng.shuffle(points)
    elif c["order"] == "doubled":
        points = [p for p in points for _ in range(2)]
    return points


class Texts:
    """Numbers and lines of a file in the style of the choices."""

    def __init__(self, c):
        self.c = c
        self.digits = {"mm": 5, "m": 8, "um": 2, "in": 6, "cm": 6}[c["unit"]]
        if c["rounded"] >= 0.001:
            self.digits -= {0.001: 1, 0.01: 2, 0.05: 2}[c["rounded"]] if c["unit"] != "in" else 0

    def number(self, value):
        text = f"{value:.{self.digits + 4}e}" if self.c["style"] == "exponent" else f"{value:.{max(self.digits, 0)}f}"
        if self.c["style"] == "plus" and value >= 0:
            text = "+" + text
        if self.c["decimal"] == ",":
            text = text.replace(".", ",")
        if text.startswith("-"):
            minus = self.c["minus"]
            text = f"({text[1:]})" if minus == "()" else minus + text[1:]
        return f'"{text}"' if self.c["style"] == "quotes" else text


UNIT_NAMES = {"mm": "mm", "m": "m", "um": "\u00b5m", "in": "inch", "cm": "cm"}


def column_lines(c, points, rng):
    texts, d = Texts(c), c["delimiter"]
    rows = []
    for k, (y, z) in enumerate(points):
        row = [texts.number(y), texts.number(z)]
        if c["extra"] == "index":
            row.insert(0, str(k + 1))
        elif c["extra"] == "label":
            row.insert(0, f"P{k + 1}")
        elif c["extra"] == "time":
            row.insert(0, f"2024-03-05T12:00:{k % 60:02}")
        elif c["extra"] == "quality":
            row.append("1")
        rows.append(row)
    first = 1 if c["extra"] in ("index", "label", "time") else 0
    mark = c["nothing"]
    if mark != "none":
        ends = mark.endswith("at the ends")
        where = [*range(4), *range(len(rows) - 4, len(rows))] if ends else rng.sample(range(len(rows)), min(4, len(rows) // 3))
        for k in where:
            text = {"empty": "", "0 0": "0", "NaN at the ends": "NaN", "empty at the ends": ""}.get(mark, mark)
            if c["decimal"] == ",":
                text = text.replace("-99.999", "-99,999")
            rows[k][first + 1] = text
            if mark in ("0 0", "-9999"):
                rows[k][first] = text
    unit = UNIT_NAMES[c["unit"]]
    if c["encoding"] == "utf-8" and c["unit"] == "um":
        unit = "um"
    y_name, z_name = {"x and z": ("x", "z"), "lateral": ("lateral", "vertical"), "German": ("Y-Wert", "Z-Wert"), "unknown words": ("col a", "col b")}.get(
        c["header"], ("y", "z"))
    if c["height"] in ("radius", "diameter"):
        z_name = rng.choice(["r", "radius"]) if c["height"] == "radius" else rng.choice(["d", "diameter"])
    if c["said"] == "names":
        y_name, z_name = (f"{name} [{unit}]" for name in (y_name, z_name))
    names = [y_name, z_name]
    if c["extra"] in ("index", "label", "time"):
        names.insert(0, {"index": "n", "label": "name", "time": "time"}[c["extra"]])
    if c["extra"] == "quality":
        names.append("quality")
    glue = d if d not in (" ",) else " "
    lines = []
    if c["said"] == "comment":
        lines.append(f"# unit: {unit}")
    if c["header"] == "title":
        lines.append("Profile of wheel 3, left" if is_wheel(c["base"]) else "Rail at kilometre 12")
    elif c["header"] == "remark":
        lines.append("# " + glue.join(names))
    elif c["header"] != "none":
        lines.append(glue.join(names))
    if c["height"] in ("radius", "diameter") and c["header"] == "none":
        lines.append(glue.join(names))
    if c["said"] == "row":
        lines.append(glue.join([f"{unit}"] * len(names)))
    if c["count"] != "none":
        lines.append({"number": f"{len(rows)}", "two numbers": f"{len(rows)} 2", "words": f"points: {len(rows)}"}[c["count"]])
    if c["layout"] != "rows":
        return lines + [d.join(row[k] for row in rows) for k in (0, 1)]
    end = {"delimiter at the end": d, "remark behind": " # measured"}.get(c["style"], "")
    table = [d.join(row) + end for row in rows]
    if c["tail"] == "blank line inside":
        table.insert(len(table) // 2, "")
    elif c["tail"] != "none":
        table.append({"END": "END", "sum": f"points{glue}{len(rows)}"}[c["tail"]])
    return lines + table


def file_lines(c, points, rng):
    """Lines of the file and the ending of its name."""
    wheel, texts = is_wheel(c["base"]), Texts(c)
    pairs = [f"{texts.number(y)} {texts.number(z)}" for y, z in points]
    if c["reader"] == "miniprof":
        styles = [[f"#MINI{'WHEEL' if wheel else 'RAIL'}PROF", "trial", "MINIPROF 2020", "Stock.......:", "Axle Number.:", ""],
                  ["ProgramName=MiniProf", "Date=05/03/2024", "ColumnDef=X,Y", f"XYPoints={len(pairs)}", ""]]
        return rng.choice(styles) + pairs, ".whl" if wheel else ".ban"
    if c["reader"] == "simpack":
        per_metre = {"mm": 1000, "m": 1, "um": 1e6, "in": 1 / 0.0254, "cm": 100}[c["unit"]] if c["said"] == "names" else 1000
        flags = [f"  units.len.f = {per_metre:.10g}", f"  mirror.y = {int(c['mirror'] == 'y')}", f"  mirror.z = {int(c['z'] == 'up')}"]
        head = ["header.begin", "  version = 1", f"  type = {int(wheel)}", "header.end", "spline.begin"]
        return head + flags + ["point.begin", *pairs, "point.end", "spline.end"], ".prw" if wheel else ".prr"
    if c["reader"] == "gensys":
        return pairs, ".wheel"
    return column_lines(c, points, rng), rng.choice([".csv", ".txt", ".dat"])


def written(c, folder, rng):
    """Writes what the choices say; the name of the file that a verb is given."""
    lines, ending = file_lines(c, measured(c, rng), rng)
    text = c["lines"].join(lines) + c["lines"]
    file = folder / f"profile{ending}"
    file.write_bytes(text.encode(c["encoding"], errors="replace"))
    if c["reader"] != "slices":
        return file.name
    wheel = is_wheel(c["base"])
    places = [-3.14159, -1.5, 0.0, 1.5, 3.14159] if wheel else [-500, -100, 0, 100, 500]
    index = ["0.0 1.0", f"{len(places)}", "0 0 0", "1", *(f"{u} '{file.name}'" for u in places)]
    name = "profile.slcw" if wheel else "profile.slcs"
    (folder / name).write_text("\n".join(index) + "\n")
    return name


# ------------------------------------------------------------------------------------------------------------------------------------------- verbs

CASE = """wheel.{wheel}
rail.{rail}
[track]
cant = "1:40"
{place}
[wheelset]
nominal_radius_mm = 460
vertical_force_N = 100e3
velocity_m_s = 20
rolling = "free"
{more}[case]
side = "{side}"
[discretisation]
dx_mm = {element}
ds_mm = {element}
[[cases]]
wheelset.y_mm = {y}
"""
SIMULATION = """[simulation]
vehicle = "{vehicle}"
speed_m_s = 20.0
distance_m = 0.05
[track]
cant_rad = 0.025
[wheel]
{wheel}
[rail]
{rail}
"""


def call(program, folder, *arguments, limit=900):
    done = subprocess.run([str(program), *map(str, arguments)], cwd=folder, capture_output=True, timeout=limit)
    return done.returncode, done.stdout.decode("utf-8", "replace"), done.stderr.decode("utf-8", "replace")


def shape(name, keys=""):
    return f'shape.file = "{name}"{keys}' if "." in name else f'shape.standard = "{name}"'


def said_keys(c):
    """What a user who knows her file says of it: (keys of the shape, keys of the wheelset)."""
    if c["keys"] == "none":
        return {}, {}
    shape_keys = {"mirror_z": '"yes"' if c["z"] == "up" else '"no"'}
    if c["mirror"] == "y":
        shape_keys["mirror_y"] = "true"
    if c["unit"] != "mm" and c["said"] == "no":
        shape_keys["scale_to_mm"] = f"{1 / TO_FILE[c['unit']]:.10g}"
    if c["reader"] == "simpack":  # says its axes itself
        shape_keys = {k: v for k, v in shape_keys.items() if not k.startswith("mirror")}
    return shape_keys, {"flange_back_position_mm": 0} if c["frame"] == "back" and is_wheel(c["base"]) else {}


def case_text(base, name, y, place, keys=({}, {}), side="right", element=0.5):
    wheel = is_wheel(base)
    own = f'shape = {{ file = "{name}"' + "".join(f", {k} = {v}" for k, v in keys[0].items()) + " }"
    return CASE.format(wheel=own if wheel else 'shape.standard = "S1002"', rail='shape.standard = "60E1"' if wheel else own,
                       place="gauge_mm = 1435" if place == "gauge" else "rail_y_mm = 753.5", y=-y if side == "left" else y, element=element,
                       more="".join(f"{k} = {v}\n" for k, v in keys[1].items()), side=side)


def run_answers(text):
    answers = []
    for case in json.loads(text)["cases"]:
        patches = case.get("patches") or []
        if not patches:
            answers.append({"status": case["status"]})
            continue
        best = max(patches, key=lambda p: p["fn_N"] or 0)
        answers.append({"status": case["status"], "remarks": [r["name"] for r in case.get("remarks", []) if r.get("grave")],
                        "all_remarks": [r["name"] for r in case.get("remarks", [])], "pmax": max(p["pmax_MPa"] for p in patches),
                        "place": best["reference"]["y_tr_mm"], "angle": best["reference"]["angle_rad"],
                        "noise": (best.get("noise") or {}).get("pmax_MPa") or 0.0})
    return answers


GEOMETRY = ["--cant", "1:40", "--gauge-mm", "1435", "--threads", "1", "--json", "-"]


def geometry_answer(text):
    g = json.loads(text)["geometry"]
    f = g["functions"]
    k = min(range(len(f["y_mm"])), key=lambda i: abs(f["y_mm"][i]))
    return {"conicity": g["conicity_3mm"], "wheel_y": f["wheel_y_right_mm"][k], "angle": f["angle_right_rad"][k],
            "thickness": g["wheelset"]["flange_thickness_right_mm"]}


WHEEL_NUMBERS = ("flange_height_mm", "flange_thickness_mm", "flange_gradient_mm", "flange_angle_deg", "hollow_mm", "tread_wear_mm", "flange_wear_mm")
RAIL_NUMBERS = ("w1_mm", "w2_mm", "w3_mm", "head_width_mm", "face_angle_deg")


def measure_answer(text, wheel):
    m = json.loads(text)
    numbers = m["wheel" if wheel else "rail"]
    sure = numbers.get("uncertainty") or {}
    return {n: (numbers[n], sure.get(n) or 0.0) for n in (WHEEL_NUMBERS if wheel else RAIL_NUMBERS) if numbers.get(n) is not None}


MEASURE = {"wheel": ["measure", "--json", "-", "--threads", "1", "--nominal", "S1002", "wheel"],
           "rail": ["measure", "--json", "-", "--threads", "1", "--nominal", "60E1", "--alignment", "top", "rail"]}
SIDE = {"wheel": ["--rail", "60E1"], "rail": ["--wheel", "S1002"]}


def plain_file(folder, base, tilt):
    """The shape in a format that says all of its axes and units."""
    plain = dict(PLAIN, base=base, tilt=tilt, step=0.1, reader="simpack", said="names", rounded=1e-5)
    lines, ending = file_lines(plain, measured(plain, random.Random(0)), random.Random(0))
    name = f"true{ending}"
    (folder / name).write_text("\n".join(lines) + "\n")
    return name


NEAR = [0.0, -0.12, -0.06, 0.06, 0.12]  # mm that a true answer may be beside, where contact jumps


def truth(program, store, base, tilt, verb, place, y):
    """What the program answers for the shape itself; of run near a position y. Kept in store, since many trials ask for the same."""
    base = TRUE_SHAPE.get(base, base)
    kept = store / (hashlib.sha1(f"{base} {tilt} {verb} {place} {y}".encode()).hexdigest() + ".json")
    if kept.exists():
        return json.loads(kept.read_text())
    wheel = is_wheel(base)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        name = plain_file(folder, base, tilt)
        body = "wheel" if wheel else "rail"
        if verb == "run":
            (folder / "case.toml").write_text(case_text(base, name, [round(y + near, 3) for near in NEAR], place))
            status, out, err = call(program, folder, "run", "case.toml", "--json", "-", "--threads", "1", "--quiet")
            answer = run_answers(out) if out else []
        elif verb == "geometry":
            status, out, err = call(program, folder, "geometry", f"--{body}", name, *SIDE[body], *GEOMETRY)
            answer = geometry_answer(out) if status == 0 else None
        elif verb == "measure":
            status, out, err = call(program, folder, *MEASURE[body], name)
            answer = measure_answer(out, wheel) if status == 0 and out else None
        elif verb == "simulate":
            status, out, err = simulate(program, folder, base, name)
            answer = simulate_answer(out) if status == 0 else None
        else:
            answer = None
    part = kept.with_suffix(f".{os.getpid()}")
    part.write_text(json.dumps(answer))
    part.rename(kept)
    return answer


def simulate(program, folder, base, name):
    own, wheel = f'shape.file = "{name}"', is_wheel(base)
    (folder / "simulation.toml").write_text(SIMULATION.format(vehicle=ROOT / "examples/vehicles/single-wheelset.toml",
                                                              wheel=own if wheel else 'shape.standard = "S1002"',
                                                              rail='shape.standard = "60E1"' if wheel else own))
    return call(program, folder, "simulate", "simulation.toml", "--json", "-", "--threads", "1", "--quiet")


def simulate_answer(text):
    summary = json.loads(text)
    static = summary["static"]
    return {"Y_N": static["ws1_right.Y_N"], "y_mm": 1e3 * static["ws1_right.y_cp_m"], "doubtful": summary.get("doubtful_steps", 0)}


# ---------------------------------------------------------------------------------------------------------------------------------------- verdicts

DOUBT = re.compile(r"(?<!minor )\bwarning\b|: [a-z]+_[a-z_]+: |: (gap|unit|exchanged|noise): ")


def near(a, b, absolute, relative=0.0):
    return a is not None and b is not None and abs(a - b) <= absolute + relative * abs(b)


def allowance(c):
    """Relative tolerance of pressure, of places [mm], angles [rad], measures [mm]."""
    rough = c["noise"] > 0.01 or c["rounded"] > 0.01
    some = c["noise"] > 0.001 or c["rounded"] > 0.001 or c["step"] > 0.5 or c["spike"] != "none" or c["gap"] != "none" or c["sampled"] != "by length"
    return (0.15 if rough else 0.08 if c["step"] > 0.5 else 0.05, 2.0 if rough else 1.0 if some else 0.5, 0.02 if rough else 0.01 if some else 0.005, 0.15 if rough else 0.08 if some else 0.03)


def run_right(c, answer, true):
    pressure, place, angle, _ = allowance(c)
    for t in true:
        if t and "pmax" in t and near(answer["pmax"], t["pmax"], 2 * answer["noise"], pressure) and near(answer["place"], t["place"], place) and near(
                answer["angle"], t["angle"], angle):
            return True
    return False


def outline_distance(points, base):
    """Largest distance of points from an outline [mm] after the shift that fits best."""
    true = outline(base)
    cells = collections.defaultdict(list)
    for k, (y, z) in enumerate(true[::4]):
        cells[(round(y), round(z))].append(k * 4)
    sample = points[::max(1, len(points) // 120)]

    def nearest(p):
        at = (round(p[0]), round(p[1]))
        found = [k for i in (-1, 0, 1) for j in (-1, 0, 1) for k in cells.get((at[0] + i, at[1] + j), ())]
        if not found:
            return None
        k = min(found, key=lambda k: math.dist(true[k], p))
        return min((true[i] for i in range(max(0, k - 4), min(len(true), k + 5))), key=lambda q: math.dist(q, p))

    far = [nearest(p) for p in sample]
    distances = [math.dist(p, q) if q else 2.0 for p, q in zip(sample, far)]
    return sorted(distances)[int(0.97 * len(distances))]


def best_shift(points, base):
    """Moves points by whole frames that files may have, then by means, onto the outline."""
    true = outline(base)
    choices = []
    top_true = max(true, key=lambda p: p[1]) if is_wheel(base) else min(true, key=lambda p: p[1])
    top = max(points, key=lambda p: p[1]) if is_wheel(base) else min(points, key=lambda p: p[1])
    choices.append((top_true[0] - top[0], top_true[1] - top[1]))
    choices.append((min(p[0] for p in true) - min(p[0] for p in points), choices[0][1]))
    choices.append((max(p[0] for p in true) - max(p[0] for p in points), choices[0][1]))
    choices.append((0.0, 0.0))
    best = 1e9
    for dy, dz in choices:
        for fine in (0.0, -0.3, 0.3):
            moved = [(y + dy + fine, z + dz) for y, z in points]
            best = min(best, outline_distance(moved, base))
    return best


def converted_right(c, folder):
    rows = []
    for line_ in (folder / "out.csv").read_text().splitlines():
        parts = re.split(r"[,; \t]+", line_.strip())
        try:
            rows.append((float(parts[0]), float(parts[1])))
        except (ValueError, IndexError):
            continue
    if len(rows) < 4:
        return False, "no points"
    if c["tilt"] and abs(c["tilt"]) <= 3:
        rows = min((turned(rows, -c["tilt"]), rows), key=lambda r: best_shift(r, c["base"]))
    distance = best_shift(rows, c["base"])
    limit = 0.35 + 4 * c["noise"] + c["rounded"] + (0.6 if c["spike"] != "none" else 0.0) + 0.5 * (c["step"] if c["step"] > 0.5 else 0)
    return distance <= limit, f"{distance:.2f} mm from the outline"


def checked_right(c, out):
    """Size and sides that check tells."""
    numbers = {}
    for axis in "yz":
        found = re.search(rf"^  {axis} +(-?[0-9.]+) to (-?[0-9.]+) mm", out, re.M)
        if not found:
            return False, f"no line {axis}"
        numbers[axis] = (float(found[1]), float(found[2]))
    points = cut(outline(c["base"]), c["cut"])
    ways = [turned(points, t) for t in ({0, c["tilt"]} if abs(c["tilt"]) <= 3 else {0})]
    slack = 0.4 + 6 * c["noise"] + c["rounded"] + (3.2 if c["spike"] != "none" else 0.0) + (4.0 if "ends" in c["nothing"] else 0)
    for way in ways:
        wide = max(p[0] for p in way) - min(p[0] for p in way)
        high = max(p[1] for p in way) - min(p[1] for p in way)
        got = [numbers[a][1] - numbers[a][0] for a in "yz"]
        if "outline" in c["base"] and got[1] < 60:
            return near(got[0], 74, 4), f"{got[0]:.1f} x {got[1]:.1f} mm"
        if near(got[0], wide, slack) and near(got[1], high, slack):
            break
    else:
        return False, f"{got[0]:.1f} x {got[1]:.1f} mm for {wide:.1f} x {high:.1f} mm"
    if is_wheel(c["base"]) and c["cut"] != "flange":
        tip = re.search(r"tip at y = (-?[0-9.]+) mm, z = (-?[0-9.]+) mm", out)
        if not tip:
            return False, "no flange"
        if c["base"] != "double flange" and float(tip[1]) > 0.5 * sum(numbers["y"]):
            return False, "flange on the side of great y"
        if abs(float(tip[2]) - numbers["z"][1]) > 0.1:
            return False, "flange up"
    return True, ""


def verdict(program, store, c, folder, index, seed):
    """('right', 'noted', 'doubted', 'refused' or 'wrong', words)"""
    rng = random.Random(f"{seed} {index}")
    wheel, verb = is_wheel(c["base"]), c["verb"]
    body = "wheel" if wheel else "rail"
    name = written(c, folder, rng)
    tilts = [0, c["tilt"]] if 0 < abs(c["tilt"]) <= 3 else [0]
    truths = [truth(program, store, c["base"], t, verb, c["place"], c["y"]) for t in tilts]
    if verb == "run":
        (folder / "case.toml").write_text(case_text(c["base"], name, c["y"], c["place"], said_keys(c), c["side"]))
        status, out, err = call(program, folder, "run", "case.toml", "--json", "-", "--threads", "1")
    elif verb == "check":
        status, out, err = call(program, folder, "check", name, "--body", body)
    elif verb == "geometry":
        status, out, err = call(program, folder, "geometry", f"--{body}", name, *SIDE[body], *GEOMETRY)
    elif verb == "measure":
        status, out, err = call(program, folder, *MEASURE[body], name)
    elif verb == "convert":
        status, out, err = call(program, folder, "convert", name, "out.csv", "--body", body)
    else:
        status, out, err = simulate(program, folder, c["base"], name)
    if status < 0:
        return "wrong", f"killed by signal {-status}"
    told = (err.strip().splitlines() or [""])[-1][:200]
    if status >= 2 or (status == 1 and not out):
        return "refused", told
    noted = DOUBT.search(err) or (verb == "check" and DOUBT.search(out))
    words = ""
    if verb == "run":
        answer = run_answers(out)[0]
        if c["side"] == "left" and "pmax" in answer:
            answer.update(place=-answer["place"], angle=-answer["angle"])
        if answer["status"] not in ("ok", "doubtful") or "pmax" not in answer:
            return "refused", f"{answer['status']} {told}"
        right = any(run_right(c, answer, t) for t in truths)
        t = (truths[-1] or [{}])[0]
        words = (f"{answer['pmax']:.0f} MPa at {answer['place']:.2f}, {answer['angle']:.4f} rad for {t.get('pmax', math.nan):.0f} at {t.get('place', math.nan):.2f}, "
                 f"{t.get('angle', math.nan):.4f}; {answer['all_remarks']}")
        doubts = json.loads(out)["input"].get("doubts", [])
        noted = noted or any(DOUBT.search(d) for d in doubts)
        if answer["remarks"] or answer["status"] == "doubtful":
            status = 1
    elif verb == "check":
        right, words = checked_right(c, out)
    elif verb == "convert":
        right, words = converted_right(c, folder)
    elif verb == "geometry":
        answer, (_, place, angle, size) = geometry_answer(out), allowance(c)
        noted = noted or any(DOUBT.search(n) for n in json.loads(out)["notes"])
        right = any(t and ((t["conicity"] is None and answer["conicity"] is None) or near(answer["conicity"], t["conicity"], 0.012 + (0.03 if size > 0.1 else 0), 0.06))
                    and (near(answer["wheel_y"], t["wheel_y"], place + 0.5) or near(answer["angle"], t["angle"], angle)) for t in truths)
        if c["tilt"] == 0 and truths[0] and truths[0]["thickness"] and answer["thickness"]:
            right = right and near(answer["thickness"], truths[0]["thickness"], 2 * size)
        words = f"{answer} for {truths}"
        if answer["conicity"] is None and truths[0] and truths[0]["conicity"] is not None:
            return "refused", "no conicity"
    elif verb == "measure":
        answer, (_, _, _, size) = measure_answer(out, wheel), allowance(c)
        m = json.loads(out)
        notes = m.get("notes") or []
        noted = noted or any(DOUBT.search(n) for n in notes)
        right, off = False, []
        for t in truths:
            off = [f"{n} {value:.3f} for {t[n][0]:.3f}" for n, (value, sure) in answer.items()
                   if t and n in t and not near(value, t[n][0], max((size + abs(c["tilt"]) * (0.6 if c["base"] in TRUE_SHAPE else 0.1)) * (1 if not n.endswith("deg") else 50 if c["sampled"] == "by y" or c["reader"] == "slices" else 10), 2 * sure))]
            right = right or not off
        words = ", ".join(off)
        if not answer:
            return "refused", "nothing measured"
    else:
        answer, (_, place, angle, _) = simulate_answer(out), allowance(c)
        right = truths[0] is None or any(t and near(answer["y_mm"], t["y_mm"], place) and near(answer["Y_N"], t["Y_N"], 54.5e3 * angle) for t in truths)
        words = f"{answer} for {truths}"
        if answer["doubtful"]:
            status = 1
    if status:
        doubts = re.findall(r"(?:: |warning +)([a-z_]+: [^\n]{0,160})", out + err)
        return ("cautious" if right else "doubted"), "; ".join(dict.fromkeys(doubts)) or words
    if right:
        return "right", words
    return ("noted" if noted else "wrong"), words


def tried(program, store, c, index, seed):
    with tempfile.TemporaryDirectory() as folder:
        try:
            return verdict(program, store, c, pathlib.Path(folder), index, seed)
        except subprocess.TimeoutExpired:
            return "wrong", "no answer within 900 s"
        except Exception as error:  # of this script, or an answer that cannot be read
            return "wrong", f"{type(error).__name__}: {error}"


def trial(job):
    """One trial; a wrong one with as few disguises as keep it wrong."""
    program, store, c, index, seed, keep = job
    kind, words = tried(program, store, c, index, seed)
    least = dict(c)
    if kind in ("wrong", "noted"):
        for n in CHOICES:
            if n in ("verb",) or least[n] == PLAIN[n]:
                continue
            for value in ([PLAIN[n]] if n != "base" else ["new", "60E1"] if not is_wheel(least["base"]) else ["new"]):
                if n == "base" and is_wheel(value) != is_wheel(least["base"]):
                    continue
                simpler = dict(least, **{n: value})
                if not makes_sense(simpler):
                    continue
                again, other = tried(program, store, simpler, index, seed)
                if again == kind:
                    least, words = simpler, other
                    break
        if keep:
            folder = keep / kind / f"{index:05}"
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            name = written(least, folder, random.Random(f"{seed} {index}"))
            if least["verb"] == "run":
                (folder / "case.toml").write_text(case_text(least["base"], name, least["y"], least["place"], said_keys(least), least["side"]))
            told = {n: v for n, v in least.items() if v != PLAIN[n] or n in ("base", "verb")}
            (folder / "trial.json").write_text(json.dumps({"kind": kind, "words": words, "least": told, "whole": c}, indent=1))
    return index, kind, words, least


# ------------------------------------------------------------------------------------------------------------------------------------------ tables

KINDS = ("right", "cautious", "doubted", "refused", "noted", "wrong")


IN_WORDS = [("worn or cut shapes", ("base",)), ("MiniProf, Simpack, GENSYS, slices", ("reader",)), ("unit", ("unit",)), ("order, doubled points", ("order",)),
            ("mirrored, upside down", ("mirror", "z")), ("headers, counts, further columns, last lines", ("header", "count", "extra", "tail", "said")),
            ("separators, decimal commas, minus signs, styles", ("delimiter", "decimal", "minus", "style", "layout")), ("encoding, ends of lines", ("encoding", "lines")),
            ("spacing, gaps", ("step", "sampled", "gap")), ("frame", ("frame", "height")), ("tilt of 1 to 10 degrees", ("tilt",)), ("cut ends", ("cut",)),
            ("noise of 1 to 30 um", ("noise",)), ("rounded to 1 to 50 um", ("rounded",)), ("dirt, spikes", ("spike",)), ("marks of nothing", ("nothing",))]


def named(choice, value):
    return f"tilt {'+' if value > 0 else '-'}" if choice == "tilt" else f"{choice}={value}"


def table(title, rows):
    print(f"\n| {title} | trials | " + " | ".join(KINDS) + " |\n|---|" + "---|" * (len(KINDS) + 1))
    for name, counts in rows:
        print(f"| {name} | {sum(counts.values())} | " + " | ".join(str(counts[k]) for k in KINDS) + " |")


def print_messages(which, results, chosen, most):
    """What was said, with the disguise that most of its trials share."""
    usual = collections.Counter(named(n, v) for c in chosen for n, v in c.items() if v != PLAIN[n])
    groups = collections.defaultdict(list)
    for index, kind, words, _ in results:
        if kind == which:
            groups[re.sub(r"[-+]?[0-9]+([.,][0-9]+)*|profile\.[a-z]+|'.*'|wheel|rail", "#", words)[:70]].append((index, words))
    print(f"\n{which}: {len(groups)} messages")
    for members in sorted(groups.values(), key=len, reverse=True)[:most]:
        shared = collections.Counter(named(n, v) for index, _ in members for n, v in chosen[index].items() if v != PLAIN[n])
        likely = max(shared, key=lambda w: shared[w] / len(members) * math.log(1 + len(chosen) / usual[w]), default="plain")
        print(f"- {len(members)} x {likely} ({shared[likely]}): trial {members[0][0]}: {members[0][1][:300]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/app/treadmark")
    parser.add_argument("--count", type=int, default=20000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the files of what was wrong in silence")
    parser.add_argument("--results", type=pathlib.Path, help="a line of JSON a trial; what is there already of the same program and call is not run again")
    parser.add_argument("--only", default="", help="choices, for example verb=run,base=new;hollow 2")
    parser.add_argument("--classes", type=int, default=60, help="how many classes of wrong answers are listed")
    arguments = parser.parse_args()
    only = {}
    for part in filter(None, arguments.only.split(",")):
        n, v = part.split("=", 1)
        only[n] = v.split(";")
    chosen = trials(arguments.count, arguments.seed, only)
    keep = arguments.keep.resolve() if arguments.keep else None
    call = {"program": hashlib.sha256(arguments.program.read_bytes()).hexdigest(), "count": arguments.count, "seed": arguments.seed, "only": only}
    results = []
    with contextlib.ExitStack() as open_until_here:
        lines = open_until_here.enter_context(arguments.results.open("a+")) if arguments.results else open_until_here.enter_context(tempfile.TemporaryFile("w+"))
        lines.seek(0)
        before = lines.read().splitlines()
        if before and json.loads(before[0]) != call:
            parser.error(f"{arguments.results} is of another program or call")
        if not before:
            print(json.dumps(call), file=lines, flush=True)
        for line in before[1:]:
            try:
                results.append(tuple(json.loads(line)))
            except ValueError:  # cut off when it was written
                print(file=lines, flush=True)
        known = {index for index, *_ in results}
        store = pathlib.Path(open_until_here.enter_context(tempfile.TemporaryDirectory()))
        jobs = [(arguments.program.resolve(), store, c, k, arguments.seed, keep) for k, c in enumerate(chosen) if k not in known]
        pool = open_until_here.enter_context(concurrent.futures.ProcessPoolExecutor(arguments.jobs))
        start = time.monotonic()
        for done in pool.map(trial, jobs, chunksize=4):
            results.append(done)
            print(json.dumps(done), file=lines, flush=True)
            if len(results) % 100 == 0:
                seconds = (time.monotonic() - start) / (len(results) - len(known)) * (len(chosen) - len(results))
                print(f"{len(results)} of {len(chosen)}, {seconds / 60:.0f} min left", file=sys.stderr)
    results.sort(key=lambda result: result[0])
    all_kinds = collections.Counter(kind for _, kind, _, _ in results)
    rows = [("all", all_kinds)]
    for words, choices in IN_WORDS:
        rows.append((words, collections.Counter(kind for index, kind, _, _ in results if any(chosen[index][n] not in (PLAIN[n], "60E1") for n in choices))))
    for verb in CHOICES["verb"]:
        rows.append((f"`{verb}`", collections.Counter(kind for index, kind, _, _ in results if chosen[index]["verb"] == verb)))
    table("disguise", rows)
    for name in CHOICES:
        counts = {value: collections.Counter() for value in CHOICES[name]}
        for index, kind, _, _ in results:
            if name in ("base", "verb", "reader") or chosen[index][name] != PLAIN[name]:
                counts[chosen[index][name]][kind] += 1
        table(name, [(repr(v) if isinstance(v, str) and not v.strip(" \t\r\n,;|.-()").isalnum() else v, n) for v, n in counts.items() if n])
    for kind in ("wrong", "noted"):
        classes = collections.defaultdict(list)
        for index, k, words, least in results:
            if k == kind:
                classes[tuple(named(n, v) for n, v in least.items() if v != PLAIN[n] and n not in ("step", "y") or n in ("verb", "base"))].append((index, words))
        print(f"\n{kind}: {len(classes)} classes")
        for key, members in sorted(classes.items(), key=lambda item: -len(item[1]))[:arguments.classes]:
            print(f"- {len(members)} x {', '.join(key)}: trial {members[0][0]}: {members[0][1][:260]}")
    print_messages("refused", results, chosen, arguments.classes)
    print_messages("cautious", results, chosen, arguments.classes)
    sys.exit(1 if all_kinds["wrong"] else 0)


if __name__ == "__main__":
    main()
