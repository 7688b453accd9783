# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Random cases have the same numbers to all digits from the program, on 1 to 7 threads, from C and from Python; and to 1e-5 from their twin in
CONTACT's format. TREADMARK_RANDOM_CASES=COUNT[:SEED] takes more of them, or others."""
import ctypes
import json
import os
import pathlib
import random
import subprocess

import pytest

import treadmark as tm
from test_run import without_times

PROGRAM = os.environ["TREADMARK_PROGRAM"]
LAST_BIT = 1e-5  # numbers in other units may differ in their last bit, and iterations end a step apart


@pytest.fixture(scope="module")
def library():
    made = ctypes.CDLL(str(pathlib.Path(os.environ["TREADMARK_BUILD"]) / "interfaces/c/libtreadmark.so"))
    made.tm_message.restype = ctypes.c_char_p
    return made


def by_c(library, file):
    text = ctypes.c_char_p()
    status = library.tm_run(os.fsencode(file), None, ctypes.c_size_t(0), ctypes.byref(text))
    assert text.value is not None, (status, library.tm_message())
    document = json.loads(text.value)
    library.tm_text_free(text)
    return document


def by_program(file, *options):
    done = subprocess.run([PROGRAM, *options, "run", str(file), "--json", "-", "--quiet"], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr  # 1: with a warning
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("cases")
    for name, file in (("60E1", "rail.prr"), ("S1002", "wheel.prw")):
        subprocess.run([PROGRAM, "convert", name, str(made / file), "--quiet"], check=True)
    return made


def case_text(draw):
    radius, speed = draw.choice([0.42, 0.46]), 10.0
    rolling = -speed / radius * (1.0 + draw.uniform(-1.0, 1.0) * 10.0 ** draw.uniform(-5.0, -2.0))
    regime, model = draw.choice([("none", "full"), ("steady", "full"), ("steady", "fastsim")])
    return f"""rail.shape.file = "rail.prr"
wheel.shape.file = "wheel.prw"
[case]
regime = "{regime}"
[solver]
tangential_model = "{model}"
[track]
gauge_mm = 1435
gauge_height_mm = 14
cant_rad = {draw.choice([0.0, 0.025, 0.05])}
[friction]
coefficient = {draw.uniform(0.05, 0.6):.6g}
[wheelset]
nominal_radius_mm = {1e3 * radius}
flange_back_distance_mm = 1360
y_mm = {draw.uniform(-5.0, 5.0):.6g}
yaw_rad = {draw.uniform(-8e-3, 8e-3):.6g}
vertical_force_N = {10.0 ** draw.uniform(3.0, 5.1):.6g}
velocity_m_s = {speed}
vpitch_rad_s = {rolling:.9g}
[discretisation]
dx_mm = {draw.uniform(0.8, 1.5):.6g}
ds_mm = {draw.uniform(0.8, 1.5):.6g}
"""


def rounded_numbers(document):
    """Forces over the greatest, and pressures."""
    for case in document["cases"]:
        force = [case["force_on_rail"][f"f{axis}_tr_N"] for axis in "xyz"] if case["patches"] else []
        yield [f / max(map(abs, force)) for f in force] + [patch["pmax_MPa"] / 1e3 for patch in case["patches"]]


def test_random_cases_are_the_same_from_everywhere(folder, library):
    count, _, seed = os.environ.get("TREADMARK_RANDOM_CASES", "6").partition(":")
    first = int(seed or 1)
    twins = 0
    for number in range(first, first + int(count)):
        text = case_text(random.Random(number))
        file, twin = folder / f"{number}.toml", folder / f"{number}.inp"
        file.write_text(text)
        told = without_times(by_program(file))
        assert without_times(by_program(file, "--threads", str(1 + number % 7))) == told, text
        assert without_times(by_c(library, file)) == told, text
        assert without_times(json.loads(tm.run(file).to_json())) == told, text
        if subprocess.run([PROGRAM, "convert", str(file), str(twin), "--quiet"], capture_output=True).returncode != 0:
            continue  # cannot be said there
        twins += 1
        for ours, theirs in zip(rounded_numbers(told), rounded_numbers(by_program(twin)), strict=True):
            assert theirs == pytest.approx(ours, rel=LAST_BIT, abs=LAST_BIT), text
    assert 2 * twins > int(count)
