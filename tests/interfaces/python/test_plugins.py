# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Plug-ins: the backend and the detector of tests/consumer, in a process of their own, for nothing takes them out again."""
import os
import pathlib
import subprocess
import sys

import pytest

import treadmark as tm

PLUGINS = pathlib.Path(os.environ["TREADMARK_BUILD"]) / "tests" / "app" / "plugins"
USED = """
import sys, treadmark as tm
assert tm.load_plugins(*sys.argv[1:]) == ["chebyshev"] and tm.load_plugins(*sys.argv[1:]) == [] and "chebyshev" in tm.backends()
case = {"rail.shape.standard": "60E1", "wheel.shape.standard": "S1002", "wheelset.vertical_force_N": 80e3, "track.cant": "1:40",
        "discretisation.dx_mm": 1.0, "discretisation.ds_mm": 1.0}
by_plugin = {**case, "rail.backend": "chebyshev", "discretisation.detector": "fine-grid"}
found, expected = (tm.run(one).cases[0].patches[0].pmax for one in (by_plugin, case))
assert abs(found / expected - 1) < 1e-3, (found, expected)
"""


@pytest.mark.parametrize("named", [True, False])
def test_a_plugin_is_a_choice_by_its_name(named):
    file = str(PLUGINS / "chebyshev.so")
    subprocess.run([sys.executable, "-c", USED, *[file] * named], check=True, env={**os.environ, "TREADMARK_PLUGINS": "" if named else file})


def test_what_is_no_plugin_is_refused(tmp_path):
    with pytest.raises(tm.MissingFileError, match="does not exist"):
        tm.load_plugins(tmp_path / "nothing.so")
    with pytest.raises(tm.InputError, match="another Treadmark"):
        tm.load_plugins(PLUGINS / "foreign.so")
