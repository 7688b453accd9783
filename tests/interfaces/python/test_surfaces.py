# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Wheels and rails from files, arrays and functions."""
import numpy as np
import pytest

import treadmark as tm


def crown(y, radius=0.3):
    return radius - np.sqrt(radius**2 - np.asarray(y) ** 2)


def test_a_profile_of_ones_own():
    y = np.linspace(-0.03, 0.03, 241)
    rail = tm.Surface.profile(y, crown(y), "rail")
    assert (rail.body, rail.constant_profile, rail.nominal_radius) == ("rail", True, 0.0)
    x = np.zeros((3, 1)) + [0.1, -0.02]
    z = rail.heights(x, np.array([[0.0], [5e-3], [-1e-2]]))
    assert z.shape == (3, 2) and z[:, 0] == pytest.approx(crown([0.0, 5e-3, -1e-2]), abs=1e-9) and np.isnan(rail.heights(0.0, 0.2))
    found = rail.locate([0.0, 0.0], [4e-3, 0.2])
    assert list(found.found) == [True, False] and found.position[0] == pytest.approx([0, 4e-3, crown(4e-3)], abs=1e-9)
    assert found.curvature_1[0] == pytest.approx(1 / 0.3, rel=1e-3) and np.linalg.norm(found.normal[0]) == pytest.approx(1.0)
    z, dzdx, dzdy = rail.heights(0.0, 4e-3, slopes=True)
    assert dzdx == 0.0 and dzdy == pytest.approx(4e-3 / np.sqrt(0.3**2 - 4e-3**2), rel=1e-5)


def test_parameters_and_lines():
    y = np.linspace(-0.03, 0.03, 241)
    rail = tm.Surface.profile(y, crown(y), "rail")
    found = rail.locate([0.2, 0.2], [4e-3, -7e-3])
    at = rail.evaluate(found.u, found.v)
    assert at.exact and at.position == pytest.approx(found.position, abs=1e-12) and at.normal == pytest.approx(found.normal, abs=1e-9)
    assert at.by_u == pytest.approx(np.array([[1.0, 0, 0]] * 2)) and np.linalg.norm(at.by_v, axis=1) == pytest.approx(1.0, abs=1e-3)
    assert np.abs(at.direction_2[:, 0]) == pytest.approx(1.0)
    line = rail.section_line(0.2, step=2e-3, y=(-0.01, 0.01))
    assert line.s[-1] == pytest.approx(2 * 0.3 * np.arcsin(0.01 / 0.3), abs=1e-7) and line.curvature_along == pytest.approx(1 / 0.3, rel=2e-2)
    along = rail.line_along(5e-3, (0.0, 0.1), step=0.03)
    assert along.s == pytest.approx([0, 0.03, 0.06, 0.09, 0.1]) and along.position[:, 0] == pytest.approx(along.s)
    with pytest.raises(tm.InputError, match="no surface"):
        rail.section_line(0.0, y=(-0.01, 0.2))


def test_a_turned_plane():
    y = np.linspace(-0.03, 0.03, 241)
    rail = tm.Surface.profile(y, crown(y), "rail")
    roll = 0.02
    turned = np.array([[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]])
    height = rail.heights(0.0, 3e-3, origin=[0, 1e-3, 2e-3], rotation=turned)
    point = np.array([0, 1e-3, 2e-3]) + turned @ [0, 3e-3, height]
    assert point[2] == pytest.approx(crown(point[1]), abs=1e-9)
    with pytest.raises(tm.InputError, match="rotation"):
        rail.heights(0.0, 0.0, rotation=2 * np.eye(3))
    with pytest.raises(tm.InputError, match=r"\(3, 3\)"):
        rail.heights(0.0, 0.0, rotation=np.eye(2))


def test_standards_and_defects(rail, wheel):
    assert wheel.nominal_radius == 0.46 and wheel.heights(0.0, 0.0) == pytest.approx(0.46, abs=1e-4) and wheel.body == "wheel"
    flat = wheel.with_flat(length=60e-3, depth=1e-3)
    assert not flat.constant_profile and wheel.heights(0.0, 0.0) - flat.heights(0.0, 0.0) == pytest.approx(1e-3, abs=1e-9)
    assert flat.heights(0.0, 0.0) == tm.Surface.of_case(
        {"wheel.shape.standard": "S1002", "wheel.flats": [{"length_mm": 60.0, "depth_mm": 1.0}], "rail.shape.standard": "60E1",
         "wheelset.vertical_force_N": 1.0}, "wheel").heights(0.0, 0.0)
    squat = rail.with_defects(squats=[{"length_mm": 40.0, "width_mm": 30.0, "depth_mm": 0.5}])
    assert squat.heights(0.0, 0.0) - rail.heights(0.0, 0.0) == pytest.approx(0.5e-3, abs=1e-9)
    with pytest.raises(tm.InputError, match="depth_cm"):
        wheel.with_defects(flats=[{"depth_cm": 1.0}])
    with pytest.raises(tm.InputError):
        wheel.with_defects(squats=[{"length_mm": 40.0, "width_mm": 30.0, "depth_mm": 0.5}])
    with pytest.raises(tm.InputError, match="profile of a wheel"):
        tm.Surface.standard("S1002", body="rail")


def test_triangles_and_files(tmp_path, rail, wheel):
    short = wheel.with_flat(length=30e-3, depth=5e-4)
    short.save(tmp_path / "wheel.slcw", 2e-3)
    again = tm.Surface.read(tmp_path / "wheel.slcw", "wheel", 0.46)
    x = np.linspace(-0.01, 0.01, 21)
    assert again.heights(x, 0.0) == pytest.approx(short.heights(x, 0.0), abs=2e-6)
    squat = rail.with_defects(squats=[{"length_mm": 40.0, "width_mm": 30.0, "depth_mm": 0.5}])
    vertices, faces = squat.triangles(3e-3)
    assert vertices.shape[1:] == faces.shape[1:] == (3,) and faces.max() == len(vertices) - 1
    mesh = tm.Surface.mesh(vertices, faces, "rail")
    assert mesh.backend == "mesh" and mesh.heights(0.0, 0.0) == pytest.approx(squat.heights(0.0, 0.0), abs=5e-6)
    assert rail.represent("mesh", 5e-3).backend == "mesh"
    with pytest.raises(tm.InputError, match="use .ply"):
        squat.save(tmp_path / "rail.txt")
    with pytest.raises(tm.InputError, match="spline"):
        rail.represent("splines")
    assert "rail by" in repr(rail) and rail._repr_svg_().startswith("<svg") and wheel._repr_svg_().startswith("<svg")


def test_a_function_of_ones_own():
    class Wavy:
        def heights(self, u, y):
            return crown(y) + 2e-5 * np.cos(2 * np.pi * u / 0.05)

    rail = tm.Surface.function(Wavy(), "rail", u=(-0.1, 0.1), y=(-0.03, 0.03), n_u=161, n_y=121)
    x, y = np.meshgrid(np.linspace(-0.08, 0.08, 33), np.linspace(-0.02, 0.02, 9))
    assert rail.heights(x, y) == pytest.approx(Wavy().heights(x, y), abs=2e-8) and not rail.constant_profile
    wheel = tm.Surface.function(lambda u, y: 1e-4 * np.cos(8 * u) + y / 20, "wheel", (-0.2, 0.2), (-0.03, 0.03), 81, 61, nominal_radius=0.46)
    angle = 0.05
    radius = 0.46 + 1e-4 * np.cos(8 * angle)
    assert wheel.heights(radius * np.sin(angle), 0.0) == pytest.approx(radius * np.cos(angle), abs=1e-7)


@pytest.mark.parametrize("heights, what", [
    (lambda u, y: 0.0, "must be \\(161, 121\\)"),
    (lambda u, y: np.full(u.shape, np.nan), "not finite"),
    (lambda u, y: "high", "must be numbers"),
])
def test_functions_that_are_wrong(heights, what):
    with pytest.raises(tm.InputError, match=what):
        tm.Surface.function(heights, "rail", (-0.1, 0.1), (-0.03, 0.03), 161, 121)


def test_a_function_that_raises():
    def fails(u, y):
        raise ZeroDivisionError("mine")

    with pytest.raises(ZeroDivisionError, match="mine"):
        tm.Surface.function(fails, "rail", (-0.1, 0.1), (-0.03, 0.03))
    with pytest.raises(tm.InputError, match="empty"):
        tm.Surface.function(fails, "rail", (0.1, -0.1), (-0.03, 0.03))
    with pytest.raises(TypeError):
        tm.Surface.function(3, "rail", (-0.1, 0.1), (-0.03, 0.03))


@pytest.mark.parametrize("make, what", [
    (lambda: tm.Surface.profile([0.0, 1.0], [0.0], "rail"), "must be \\(2\\)"),
    (lambda: tm.Surface.profile([[0.0, 1.0]], [[0.0, 0.0]], "rail"), "must be \\(n\\)"),
    (lambda: tm.Surface.profile([0.0, float("nan")], [0.0, 0.0], "rail"), "not finite"),
    (lambda: tm.Surface.profile([0.0, 0.01], [0.0, 0.0], "track"), "body must be"),
    (lambda: tm.Surface.profile([0.01, 0.0], [0.0, 0.0], "wheel"), "radius"),
    (lambda: tm.Surface.profile(["a", "b"], [0.0, 0.0], "rail"), "must be numbers"),
    (lambda: tm.Surface.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 3]], "rail"), "does not exist"),
    (lambda: tm.Surface.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0.0, 1.0, 2.0]], "rail"), "whole numbers"),
    (lambda: tm.Surface.slices([0.0, 1.0], [0.0, 0.01], [[0.0, 0.0]], "rail"), "must be \\(2, n\\)"),
    (lambda: tm.Surface.read("nowhere.prr", "rail"), "nowhere.prr"),
])
def test_arrays_that_are_wrong(make, what):
    with pytest.raises(tm.InputError, match=what):
        make()
    with pytest.raises(TypeError):
        tm.Surface()


def test_sections(rail, wheel):
    y = np.linspace(-0.02, 0.02, 5)
    assert rail.section(0.3, y) == pytest.approx(rail.heights(0.3, y), abs=1e-15)
    assert wheel.section(0.0, y) == pytest.approx(wheel.heights(0.0, y) - 0.46, abs=1e-12)
    flat = wheel.with_flat(length=60e-3, depth=1e-3, angle=0.5)
    assert wheel.section(0.5, [0.0])[0] - flat.section(0.5, [0.0])[0] == pytest.approx(1e-3, abs=1e-9)


class Linear:
    """Straight lines between samples."""

    def __init__(self, u, y, z, body):
        assert z.shape == (len(u), len(y)) and body in ("rail", "wheel")
        self.u, self.y, self.z = u, y, z

    def heights(self, u, y):
        k = np.clip(np.searchsorted(self.u, u[:, 0], side="right") - 1, 0, len(self.u) - 2)
        share = ((u[:, 0] - self.u[k]) / (self.u[k + 1] - self.u[k]))[:, None]
        rows = (1 - share) * self.z[k] + share * self.z[k + 1]
        return np.array([np.interp(at, self.y, row) for at, row in zip(y, rows)])


def test_a_backend_in_python(rail):
    tm.register_backend("linear-py", Linear)
    assert "linear-py" in tm.backends()
    squat = rail.with_defects(squats=[{"length_mm": 40.0, "width_mm": 30.0, "depth_mm": 0.5}])
    x, y = np.meshgrid(np.linspace(-0.015, 0.015, 41), np.linspace(-0.01, 0.01, 9))
    errors = [abs(squat.represent("linear-py", spacing).heights(x, y) - squat.heights(x, y)).max() for spacing in (4e-3, 2e-3)]
    assert squat.represent("linear-py", 2e-3).backend == "linear-py" and errors[1] < 0.4 * errors[0] < 2e-5
    case = {"rail.shape.standard": "60E1", "wheel.shape.standard": "S1002", "wheel.flats": [{"length_mm": 40.0, "depth_mm": 0.5}],
            "wheelset.vertical_force_N": 80e3, "discretisation": {"dx_mm": 1.0, "ds_mm": 1.0}}
    compared = tm.compare(case, backends=["spline", "linear-py"], resolutions=[4e-3])
    rows = {row["backend"]: row for row in compared.rows()}
    assert 60 > abs(rows["linear-py"]["pmax_error_percent"]) > abs(rows["spline"]["pmax_error_percent"])
    with pytest.raises(tm.InputError, match="linear-py"):
        tm.register_backend("linear-py", Linear)
    with pytest.raises(tm.InputError):
        tm.register_backend("Not a name", Linear)


def test_a_backend_that_raises(rail):
    class Fails(Linear):
        def heights(self, u, y):
            raise RuntimeError("not today")

    tm.register_backend("fails-py", Fails)
    with pytest.raises(tm.InputError, match="not today"):
        rail.represent("fails-py", 2e-3)
