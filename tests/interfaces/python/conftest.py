# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What several test files use. TREADMARK_SOURCE: the sources; TREADMARK_PROGRAM: the program to compare with."""
import os
import pathlib
import subprocess

import pytest

import treadmark as tm

SOURCE = pathlib.Path(os.environ["TREADMARK_SOURCE"])
COARSE = {"discretisation.dx_mm": 1.0, "discretisation.ds_mm": 1.0}
CASE = {"rail.shape.standard": "60E1", "wheel.shape.standard": "S1002", "track.cant": "1:40",
        "wheelset": {"vertical_force_N": 80e3, "velocity_m_s": 20.0, "vpitch_rad_s": -43.4}, **COARSE}


@pytest.fixture
def examples():
    return SOURCE / "examples"


@pytest.fixture(scope="session")
def program():
    def call(*arguments):
        done = subprocess.run([os.environ["TREADMARK_PROGRAM"], *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return call


@pytest.fixture(scope="session")
def rail():
    return tm.Surface.standard("60E1")


@pytest.fixture(scope="session")
def wheel():
    return tm.Surface.standard("S1002", nominal_radius=0.46)


@pytest.fixture
def pair(rail, wheel):
    return tm.Pair(rail, wheel, tm.Problem(vertical_force=80e3, speed=20.0, pitch_rate=-43.4, dx=1e-3, ds=1e-3, cant="1:40"))
