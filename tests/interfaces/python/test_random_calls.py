# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Functions of the module in C++ in any order, with arguments of any kind: each gives a result or one of the errors that are documented, and the
interpreter lives on. TREADMARK_RANDOM_CALLS=COUNT[:SEED] takes more of them, or others."""
import os
import pathlib
import random
import warnings

import numpy as np
import pytest

import treadmark as tm
from treadmark import _treadmark as native

PATCH = ("[patch]\nnormal_force_N = 1000.0\nmx = 9\nmy = 9\nx0_mm = -1.6\ny0_mm = -1.6\ndx_mm = 0.4\ndy_mm = 0.4\n"
         "[patch.gap]\nkind = \"quadratic\"\ncoefficients_si = [10.0, 0.0, 10.0, 0.0, 0.0, 0.0]\n")
PAIR = ("rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\n[track]\ngauge_mm = 1435.0\ncant = \"1:40\"\n"
        "[wheelset]\nnominal_radius_mm = 460\nvertical_force_N = 80e3\nvelocity_m_s = 20\nvpitch_rad_s = -43.5\n"
        "[friction]\ncoefficient = 0.3\n[discretisation]\ndx_mm = 3\nds_mm = 3\nmax_elements = 2000\n")
ASSIGNMENTS = ["wheelset.y_mm=5", "wheelset.z_mm=0.2", "case.regime=transient", "case.regime=none", "case.regime=shift", "case.history=continue",
               "case.side=left", "rail.backend=spline", "wheel.flats=[{length_mm=60, depth_mm=0.9}]", "friction.coefficient=1e-3", "nonsense", "", "=", "\0"]
TEXTS = ["rail", "wheel", "spline", "chebyshev", "pmax", "force_on_rail.fz_tr", "pressure", "", "a\0b", "\ud800", "é" * 100]
ASKED = ["wheel=S1002", "wheel=cone 1:20", "wheel=60E1", "rail=60E1", "rail=circle R300", "gauge_mm=1435", "gauge_mm=nan", "gauge_mm=1e300", "cant=1:40",
         "cant=0", "rail_origins_mm=1500", "amplitudes_mm=[1, 3]", "amplitudes_mm=3", "amplitudes_mm=1:9:1e-9", "gauges_mm=1434,1436", "roll=free",
         "step_mm=0.5", "step_mm=1e-9", "yaw_mrad=10", "nominal=S1002", "nominal=60E1", "nominal_radius_mm=460", "alignment=top", "stations=3", "line_mm=5",
         "wheelset.y_mm=5", "case=nowhere.toml", "nonsense=1", "nonsense", "", "=", "\0", "wheel=\"a\\u0000b\""]
MEANT = (tm.TreadmarkError, TypeError, ValueError, AttributeError, OverflowError, IndexError, KeyError, NotImplementedError)


class Calls:
    def __init__(self, seed, folder):
        self.random = random.Random(seed)
        self.folder = folder
        self.kept = [native.Case.parse(PAIR, "", 1), native.Case.parse(PATCH, "", 1), native.PatchSolver()]
        self.solved, self.most_solved = 0, 300

    def number(self):
        pick = self.random.random()
        if pick < 0.1:
            return self.random.choice([float("nan"), float("inf"), -1e308, 1e308, 0, -1, 2**31, 2**63, 10**30, True, None, "1", 1j, b"2"])
        return self.random.choice([1e-3, 0.46, 5e-3, 80e3, 1, 2, 3, 0.0]) * self.random.choice([1, 1, 1, -1])

    def array(self):
        n = self.random.choice([0, 1, 2, 7, 30])
        y = np.linspace(-0.03, 0.03, n)
        kind = self.random.randrange(10)
        made = [y, 2.0 * y * y, np.stack([y, y * y]), np.zeros((3, n)), y[::-1], np.zeros((n, 2 * n))[:, ::2], np.eye(3), y.astype(np.float32),
                np.arange(3 * n, dtype=np.int32).reshape(n, 3), np.array(["a", None], dtype=object)][kind]
        if made.dtype == np.float64 and made.size and self.random.random() < 0.1:
            made = made.copy()
            made.flat[self.random.randrange(made.size)] = self.random.choice([np.nan, np.inf, 1e300, -1.0])
        return made

    def anything(self):
        pick = self.random.random()
        if pick < 0.3:
            return self.random.choice(self.kept)
        if pick < 0.5:
            return self.number()
        if pick < 0.7:
            return self.array()
        if pick < 0.8:
            return self.random.choice(TEXTS)
        return self.random.choice([None, [], [1.0], (), {}, b"", b"\x01" * 40, lambda *a: None, object(), self.folder / "file", self.random.choice(ASSIGNMENTS)])

    def of(self, kind):
        mine = [k for k in self.kept if isinstance(k, kind)]
        return self.random.choice(mine) if mine and self.random.random() < 0.95 else self.anything()

    def body(self):
        return self.random.choice(["rail", "wheel", "rail", "wheel", "engine"])

    def meant(self):
        """A call with arguments that are mostly of the right kinds."""
        r, n = self.random, native
        y = np.linspace(-0.03, 0.03, r.choice([2, 7, 30, 61]))
        z = 2.0 * y * y
        if r.random() < 0.1:
            z[r.randrange(len(z))] = r.choice([np.nan, 1e300, -1.0])
        case, surface, pair = self.of(n.Case), self.of(n.Surface), self.of(n.Pair)
        return r.choice([
            lambda: n.Case.create(r.random() < 0.5),
            lambda: n.Case.parse(r.choice([PAIR, PATCH])[: r.choice([None, None, 40, 200])], "", r.choice([1, 1, 0, 2])),
            lambda: n.Case.copy(case),
            lambda: n.Case.set(case, r.choice(ASSIGNMENTS)),
            lambda: n.Case.set_number(case, r.randrange(-2, 400), self.number()),
            lambda: n.Case.get_number(case, r.choice(TEXTS)),
            lambda: n.Surface.of_case(case, self.body()),
            lambda: n.Surface.profile(self.body(), y, z, r.choice([0.46, 0.0, self.number()]), 0.0),
            lambda: n.Surface.slices(self.body(), np.array([0.0, 0.1, r.choice([0.2, 0.05]), 0.3]), np.stack([y] * 4), np.stack([z] * 4), 0.46),
            lambda: n.Surface.heights(surface, self.array(), self.array(), r.choice([None, self.array()]), r.choice([None, np.eye(3), self.array()]), True),
            lambda: n.Surface.section(surface, self.number(), self.array()),
            lambda: n.Surface.locate(surface, self.array(), self.array()),
            lambda: n.Surface.bounds(surface),
            lambda: n.Surface.with_defects(surface, [r.choice(["wheel.flats=[{length_mm=60, depth_mm=0.9}]", "nonsense", "rail.squats=[{}]"])]),
            lambda: n.Pair(surface, self.of(n.Surface)),
            lambda: self.solve(lambda: n.Pair.solve(pair, case)),
            lambda: self.solve(lambda: n.Pair.solve_all(pair, [case] * r.randrange(3))),
            lambda: self.solve(lambda: n.Pair.solve_many(pair, case, [(r.randrange(400), np.zeros(r.randrange(4)))], [r.choice(["fn", "wheelset.z", ""])], 3, None, 0)),
            lambda: n.Pair.reset(pair),
            lambda: n.Pair.save(pair),
            lambda: n.Pair.restore(pair, self.of(n.State)),
            lambda: n.State.from_bytes(self.damaged(self.of(n.State))),
            lambda: self.solve(lambda: n.PatchSolver.solve(self.of(n.PatchSolver), case)),
            lambda: n.geometry(r.sample(ASKED[:9], 4) + r.sample(ASKED, 3), None, 0),
            lambda: n.measure(self.body(), r.choice(["S1002", "60E1", "EPS", "", "a\0b", "nowhere"]), r.sample(ASKED, 2), None, 0),
            lambda: n.measure_files(self.body(), ["S1002", "60E1", "@nowhere", "."][: r.randrange(5)], r.sample(ASKED, 1), None, 0),
        ])

    def solve(self, call):
        """Most of the time goes here, so no more than a number of them."""
        if self.solved >= self.most_solved:
            return
        call()
        self.solved += 1

    def damaged(self, state):
        if not isinstance(state, native.State):
            return state
        data = bytearray(state.to_bytes())
        for _ in range(self.random.randrange(3)):
            data[self.random.randrange(len(data))] = self.random.randrange(256)
        return bytes(data[: len(data) - self.random.choice([0, 0, 1, 20])])

    def nonsense(self):
        """Any function or method with anything."""
        name = self.random.choice(["Case", "Surface", "Pair", "PatchSolver", "State", "Run", "Comparison", "Bench", "Source", "position_svg", "tables", "Geometry", "Measured",
                                   "geometry", "measure", "measure_files", "profile_body", "request_tables"])
        called = getattr(native, name)
        if isinstance(called, type):
            methods = [m for m in dir(called) if not m.startswith("_") and callable(getattr(called, m)) and not m.startswith(("write", "save"))]
            if methods and self.random.random() < 0.9:
                called = getattr(called, self.random.choice(methods))
        arguments = [self.anything() for _ in range(self.random.randrange(7))]
        return lambda: called(*arguments)

    def one(self):
        call = self.meant() if self.random.random() < 0.7 else self.nonsense()
        try:
            made = call()
        except MEANT as error:
            assert str(error) or not isinstance(error, tm.TreadmarkError), "an error says why"
            return
        if isinstance(made, (native.Case, native.Surface, native.Pair, native.State)):
            self.kept.append(made)
            if len(self.kept) > 40:
                del self.kept[self.random.randrange(3, len(self.kept))]


def test_random_calls_end_in_documented_errors(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    count, _, seed = os.environ.get("TREADMARK_RANDOM_CALLS", "4000").partition(":")
    calls = Calls(int(seed or 20260523), pathlib.Path(tmp_path))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for _ in range(int(count)):
            calls.one()
    assert calls.solved > 20
    # the library still does what it did
    pair = tm.Pair(tm.Surface.standard("60E1"), tm.Surface.standard("S1002", nominal_radius=0.46), tm.Problem(vertical_force=80e3, dx=1e-3, ds=1e-3))
    assert pair.solve().force[2] == pytest.approx(80e3, rel=1e-5)
