# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Pictures by matplotlib, meshes: what they hold, and what is said where the package is missing."""
import os
import sys

import numpy as np
import pytest

import treadmark as tm


@pytest.fixture
def drawn():
    if os.environ.get("CI") != "true":
        pytest.importorskip("matplotlib", reason="needs the Debian package python3-matplotlib")
    from matplotlib import pyplot

    yield lambda ax: ax.get_lines()[0].get_xydata()
    pyplot.close("all")


def test_results_draw(drawn, pair, examples):
    pytest.importorskip("pandas"), pytest.importorskip("xarray")
    solutions = pair.solve(y=[0.0, 2e-3, 3e-3])
    ax = solutions.plot("pmax")
    assert drawn(ax) == pytest.approx(np.array([[y, s.patches[0].pmax] for y, s in zip((0.0, 2e-3, 3e-3), solutions)]))
    assert ax.get_xlabel() == "wheelset.y" and solutions.plot("z", ax=ax) is ax and len(ax.get_lines()) == 2
    patch = solutions[0].patches[0]
    assert patch.plot().collections[0].get_array().max() == patch.pmax
    found = tm.geometry("S1002", "60E1", gauge=1.435, cant="1:40")
    assert drawn(found.plot()) == pytest.approx(np.stack([found.functions["y"], found.functions["delta_r"]], axis=1))
    assert len(found.plot(["angle_left", "angle_right"]).get_lines()) == 2
    for call in (lambda: solutions.plot("pmaxx"), lambda: solutions.plot(x="wheelset.s"), lambda: patch.plot("presure")):
        with pytest.raises(KeyError, match="pmaxx|wheelset.s|presure"):
            call()
    if tm.parts()["vehicle"]:
        run = tm.simulate(examples / "flat-at-speed.toml", set={"simulation.distance_m": 0.02, "simulation.wheels": []})
        assert len(drawn(run.plot())) == len(run.values)
        track = tm.track(examples / "tracks" / "zhai-equivalent.toml", count=20)
        assert drawn(track.plot(x=track.to_pandas().columns[0]))[:, 0] == pytest.approx(track.frequencies)


def test_meshes(pair):
    patch = pair.solve(y=2e-3).patches[0]
    mesh = patch.to_mesh()
    corners = mesh["points"][mesh["faces"]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
    assert np.linalg.norm(normal, axis=1) == pytest.approx(patch.grid.dx * patch.grid.dy)
    force = (mesh["cell_data"]["pressure"][:, None] * normal).sum(axis=0)
    assert np.linalg.norm(force) == pytest.approx(patch.fn, rel=1e-9) and corners.mean(axis=(0, 1))[1] == pytest.approx(patch.y_tr, abs=5e-3)
    surface = pair.rail.with_defects(squats=[{"length_mm": 40.0, "width_mm": 30.0, "depth_mm": 0.5}])
    assert all((surface.to_mesh(5e-3)[name] == part).all() for name, part in zip(("points", "faces"), surface.triangles(5e-3)))


def test_what_is_missing_is_named(monkeypatch, pair):
    solutions = pair.solve(y=[0.0, 2e-3])
    for package, call in (("matplotlib", solutions.plot), ("pandas", solutions.to_pandas), ("xarray", solutions.to_xarray),
                          ("matplotlib", solutions[0].patches[0].plot)):
        for name in [name for name in sys.modules if name.partition(".")[0] == package] or [package]:
            monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(ImportError, match=f"needs {package}, which is not installed .*python3-{package}") as caught:
            call()
        assert caught.value.name == package
