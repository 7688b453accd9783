# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Makes wheels for pip (PEP 517): CMake builds and installs, setuptools packs. config_settings: "build-dir", a folder of CMake."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import build_meta

ROOT = pathlib.Path(__file__).resolve().parents[2]
SETUP = "from setuptools import setup\nsetup(packages=['treadmark'], package_data={'treadmark': ['*', '*/*']}, has_ext_modules=lambda: True)\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = pathlib.Path((config_settings or {}).get("build-dir", ROOT / "build" / "wheel")).resolve()

    def cmake(*arguments):
        subprocess.run(["cmake", *map(str, arguments)], check=True)

    if not (build / "CMakeCache.txt").exists():
        cmake("-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DTREADMARK_BUILD_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}")
    cmake("--build", build, "--target", "treadmark_python")
    with tempfile.TemporaryDirectory() as folder:  # of what setuptools reads, so that it leaves nothing in the sources
        stage = pathlib.Path(folder)
        for name in ("pyproject.toml", "README.md", "LICENSE", "NOTICE"):
            shutil.copy(ROOT / name, stage)
        (stage / "VERSION").write_text(re.search(r"^project\(Treadmark VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1])
        (stage / "setup.py").write_text(SETUP)
        cmake("--install", build, "--component", "python", "--prefix", stage / "installed")
        shutil.copytree(next((stage / "installed").rglob("_treadmark*.so")).parent, stage / "treadmark")
        for program in (build / "lib" / "treadmark").glob("treadmark-*"):  # is looked for in this folder beside the module that starts it
            if program.suffix == "":
                (stage / "treadmark" / "treadmark").mkdir(exist_ok=True)
                shutil.copy(program, stage / "treadmark" / "treadmark")
        os.chdir(stage)
        try:
            return build_meta.build_wheel(wheel_directory)
        finally:
            os.chdir(ROOT)
