# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The package as such: stubs, docstrings and their examples, exports."""
import doctest
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import treadmark as tm
from treadmark import _requests, _verbs


def test_all_that_is_exported_says_what_it_is():
    for name in tm.__all__:
        thing = getattr(tm, name)
        if callable(thing) and not name.startswith("__"):
            assert inspect.getdoc(thing), name
            for member, value in vars(thing).items() if inspect.isclass(thing) else ():
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, (property, classmethod))):
                    assert inspect.getdoc(value), f"{name}.{member}"


@pytest.mark.parametrize("module", [_requests, _verbs])
def test_examples_in_docstrings(module):
    runner = doctest.DocTestRunner()
    for name, thing in vars(module).items():
        if inspect.isfunction(thing) and thing.__module__ == module.__name__:
            for example in doctest.DocTestFinder().find(inspect.unwrap(thing), name, globs={**vars(module), name: thing}):
                runner.run(example)
    assert runner.tries > 0 == runner.failures


@pytest.mark.parametrize("page", ["docs/python.md", "docs/tutorials.md"])
def test_the_handbook_runs(page):
    text = (pathlib.Path(os.environ["TREADMARK_SOURCE"]) / page).read_text()
    blocks = text.split("```python\n")[1:]
    names = {}
    for block in blocks:
        exec(compile(block.split("```")[0], page, "exec"), names)
    assert blocks


def test_stubs_and_types_say_what_there_is(tmp_path):
    pytest.importorskip("mypy")
    folder = pathlib.Path(tm.__file__).parent.parent
    environment = {**os.environ, "MYPYPATH": str(folder), "MYPY_CACHE_DIR": str(folder / ".mypy_cache")}
    stubs = subprocess.run([sys.executable, "-m", "mypy.stubtest", "treadmark._treadmark", "--allowlist",
                            str(pathlib.Path(__file__).parent / "stub_allowances.txt"), "--ignore-unused-allowlist"], capture_output=True, text=True,
                           env=environment, cwd=tmp_path)
    assert stubs.returncode == 0, stubs.stdout + stubs.stderr
    types = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", str(folder / "treadmark")], capture_output=True, text=True,
                           env=environment, cwd=tmp_path)
    assert types.returncode == 0, types.stdout + types.stderr
