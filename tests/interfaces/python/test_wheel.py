# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""A wheel is made of the checkout, offline, and does its work in a fresh environment."""
import importlib.util
import os
import subprocess
import sys

import pytest

import treadmark as tm
from conftest import SOURCE

if os.environ.get("CI") != "true":
    for module, package in (("pip", "python3-pip"), ("ensurepip", "python3-venv"), ("setuptools", "python3-setuptools"), ("wheel", "python3-wheel")):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"needs the Debian package {package}", allow_module_level=True)

WORK = """
import importlib.metadata, os, treadmark as tm
rail = tm.Surface.standard("60E1")
print(importlib.metadata.version("treadmark"), tm.__version__, tm.__file__)
print(tm.Pair(rail, tm.Surface.standard("S1002"), tm.Problem(vertical_force=80e3, dx=2e-3, ds=2e-3)).solve().status)
print(rail.represent("offset").backend)
if tm.parts()["openvdb"]:  # a program of its own, which the wheel holds; it would be found in the build, too
    assert os.access(os.path.join(os.path.dirname(tm.__file__), "treadmark", "treadmark-openvdb"), os.X_OK)
    rail.with_defects(squats=[{"length_mm": 40.0, "width_mm": 30.0, "depth_mm": 0.5}]).save("squat.vdb", 2e-3)
"""


def told(folder, *command):
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, env=environment, cwd=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_wheel_in_a_fresh_environment(tmp_path):
    before = sorted(path.name for path in SOURCE.iterdir())
    told(tmp_path, sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "--wheel-dir", tmp_path,
         "--config-settings", f"build-dir={os.environ['TREADMARK_BUILD']}", SOURCE)
    wheel, = tmp_path.glob("*.whl")
    assert f"-{tm.__version__}-cp3{sys.version_info.minor}-" in wheel.name and "linux" in wheel.name
    assert sorted(path.name for path in SOURCE.iterdir()) == before
    told(tmp_path, sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "fresh")  # for NumPy
    python = tmp_path / "fresh" / "bin" / "python"
    told(tmp_path, python, "-m", "pip", "install", "--no-index", wheel)
    versions, status, *backend = told(tmp_path, python, "-c", WORK).splitlines()
    assert versions.startswith(f"{tm.__version__} {tm.__version__} {tmp_path}") and status == "ok" and backend == ["offset"]
