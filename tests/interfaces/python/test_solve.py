# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Single instants: pairs, states, patches, arrays of problems, threads, misuse."""
import copy
import gc
import pickle
import resource
import threading

import numpy as np
import pytest

import treadmark as tm
from conftest import CASE


def test_a_pair_solves_as_a_file_does(pair):
    solution = pair.solve(y=3e-3)
    told = tm.run({**CASE, "wheelset.y_mm": 3.0}).cases[0]
    assert solution.ok and solution.force == pytest.approx(told.force, rel=1e-12) and solution.z == told.z
    for mine, theirs in zip(solution.patches, told.patches, strict=True):
        assert mine.numbers == {n: v for n, v in theirs.numbers.items() if not n.endswith("_refinement")}
        assert all((mine.fields[name] == theirs.fields[name]).all() for name in ("pressure", "traction_x", "state"))


def test_names_of_settings():
    problem = tm.Problem(y=3e-3, speed=20.0, friction=0.25, dx=5e-4, track__cant=0.025, law="coulomb", set={"wheelset.yaw_deg": 1.0})
    assert (problem["y"], problem["wheelset.velocity"], problem["friction.coefficient"], problem["dx"]) == (3e-3, 20.0, 0.25, 5e-4)
    assert problem["track__cant"] == 0.025 and problem["yaw"] == pytest.approx(np.pi / 180)
    other = problem.replace(y=0.0)
    assert (problem["y"], other["y"], other["speed"]) == (3e-3, 0.0, 20.0)
    with pytest.raises(tm.InputError, match="vertical_force"):
        tm.Problem(vertical_forc=1e3)
    with pytest.raises(TypeError):
        tm.Problem(y="far")
    with pytest.raises(tm.InputError):
        tm.Problem(law="cubic")
    with pytest.raises(tm.InputError):
        tm.Problem(friction=-1.0)
    assert len(tm.settings()) > 100 and all(len(row) == 3 for row in tm.settings())
    assert tm.Problem(CASE)["vertical_force"] == 80e3
    with pytest.raises(tm.InputError, match="no case of this number"):
        tm.Problem(CASE, case=2)


def test_arrays_make_independent_problems(pair):
    y = np.array([[0.0, 2e-3, 4e-3]])
    force = np.array([[60e3], [90e3]])
    solutions = pair.solve(y=y, vertical_force=force)
    assert len(solutions) == 6
    for k, solution in enumerate(solutions):
        alone = pair.solve(y=y[0, k % 3], vertical_force=force[k // 3, 0])
        assert (solution.force == alone.force).all() and solution.z == alone.z and solution.number == k + 1
    with pytest.raises(tm.InputError, match="fit each other"):
        pair.solve(y=[0.0, 1e-3], vertical_force=[1e3, 2e3, 3e3])
    with pytest.raises(tm.InputError):
        pair.solve(y=[0.0, float("nan")])


def test_many_rows_have_the_numbers_of_single_ones(pair):
    y, yaw = np.linspace(-3.0, 3.0, 30), 1e-3 * np.arange(2)[:, None]
    rows = pair.solve_many(y_mm=y, yaw=yaw, load=70e3, quantities=["z", "fz_tr", "npatch", "pmax", "patch_2.pmax"])
    assert list(rows) == ["y_mm", "yaw", "z", "fz_tr", "npatch", "pmax", "patch_2.pmax", "status", "message"]
    assert all(isinstance(column, np.ndarray) and column.shape == (60,) for column in rows.values())
    for k in (0, 17, 44, 59):
        alone = pair.solve(y=rows["y_mm"][k] * 1e-3, yaw=rows["yaw"][k], vertical_force=70e3)
        most = max(alone.patches, key=lambda patch: patch.fn)
        assert (rows["z"][k], rows["fz_tr"][k], rows["npatch"][k]) == (alone.z, alone.force[2], len(alone.patches))
        assert rows["pmax"][k] == most.pmax
        assert len(alone.patches) > 1 or np.isnan(rows["patch_2.pmax"][k])
    assert (pair.solve_many(y_mm=y, yaw=yaw, load=70e3, quantities=["pmax"], threads=1)["pmax"] == rows["pmax"]).all()
    assert "fn" in pair.solve_many(y=[0.0, 1e-3])


def test_rows_that_fail_do_not_stop_the_others(pair):
    before = pair.save().to_bytes()
    with pytest.warns(tm.ConvergenceWarning, match="1 of 3 rows"):
        rows = pair.solve_many(y=[0.0, float("nan"), 1e-3], quantities=["pmax"])
    assert rows["status"].tolist()[1] == "failed" and rows["message"][1] and rows["message"][0] == ""
    assert np.isnan(rows["pmax"]).tolist() == [False, True, False]
    assert pair.save().to_bytes() == before
    with pytest.warns(tm.ConvergenceWarning, match="1 of 2 rows"):  # not the radius of the wheel's surface: no number is known
        rows = pair.solve_many(nominal_radius=[pair.problem["nominal_radius"], 0.5], quantities=["z", "fz_tr", "npatch", "pmax"])
    assert rows["status"].tolist() == ["ok", "failed"]
    assert all(np.isnan(rows[name]).tolist() == [False, True] for name in ("z", "fz_tr", "npatch", "pmax"))
    told = []
    pair.solve_many(y=np.zeros(200), progress=lambda *what: told.append(what))
    assert told[-1] == (200, 200, "contacts")
    for wrong in ({"y": [0.0], "quantities": ["pmaximum"]}, {"y": 0.0}, {"y": [0.0, 1.0], "yaw": [0.0, 1.0, 2.0]}, {"y": ["far"]}, {"law": ["coulomb"]},
                  {"y": [0.0], "history": "continue"}, {"y": [0.0], "y_mm": [0.0]}):
        with pytest.raises(tm.InputError):
            pair.solve_many(**wrong)


def test_gradients(pair, rail):
    exact = {"solver.tolerance": 1e-9}
    before = pair.save().to_bytes()
    pressure = pair.gradient("pmax", ["load", "y_mm"], y=2e-3, set=exact)
    assert pair.save().to_bytes() == before and pressure.by_gap == []
    at = [pair.solve(y=2e-3, load=80e3 + step, set=exact).patches[0].pmax for step in (0.0, 20.0, -20.0)]
    assert pressure.value == at[0] and pressure.by[0] == pytest.approx((at[1] - at[2]) / 40.0, rel=1e-3)
    assert pressure.by[1] == pytest.approx(1e-3 * pair.gradient("pmax", ["y"], y=2e-3, set=exact).by[0])
    fields = pair.gradient("wheelset.z", y=2e-3, set=exact).by_gap
    patch = pair.solve(y=2e-3, set=exact).patches[0]
    assert fields[0].shape == patch.pressure.shape and fields[0].sum() == pytest.approx(1.0 / np.cos(patch.angle), rel=1e-6)
    assert ((fields[0] != 0.0) <= (patch.state > 0)).all() and not fields[0].flags.writeable
    points = np.linspace(-0.03, 0.03, 121)
    measured = tm.Surface.profile(points, rail.heights(0.0, points), "rail")
    assert rail.parameters[0] == ("segment_0_curvature", "1/m") and measured.parameters[60] == ("point_60", "m")
    worn = tm.Pair(measured, pair.wheel, pair.problem.replace(track__rail_y=0.7535, track__rail_z=0.0))
    by = worn.gradient("pmax", [f"rail.{name}" for name, unit in measured.parameters[20:100]], set=exact).by
    assert min(abs(by[0]), abs(by[-1])) < 1e-3 * abs(by).max()  # far from the contact
    whole = worn.shape_gradient("pmax", "rail", set=exact)  # of all points at once
    assert whole.exact and whole.by.shape == (121,) and whole.by[20:100] == pytest.approx(by, abs=1e-3 * abs(by).max())
    assert whole.places.shape == (121, 3) and whole.places[60, 1] == pytest.approx(points[60], abs=1e-9)
    assert whole.by_height[0].shape == worn.solve(set=exact).patches[0].pressure.shape
    with pytest.raises(tm.InputError, match="rail"):
        worn.shape_gradient("pmax", "sleeper")
    for wrong in ({"quantity": "elements.ncon", "by": ["y"]}, {"quantity": "pmaximum"}, {"quantity": "y_tr"}, {"quantity": "pmax", "by": ["law"]},
                  {"quantity": "pmax", "by": ["y"], "set": {"solver.tangential_model": "fastsim"}}):
        with pytest.raises(tm.InputError):
            pair.gradient(**wrong)
    with pytest.raises(tm.NumericalError, match="not ok"):
        pair.gradient("pmax", ["y"], set={"wheelset.z_mm": -5.0})


def test_sequences_in_time_and_states(pair):
    steps = [dict(pitch=-1e-3 * k / 0.46, s=1e-3 * k) for k in range(4)]
    going = pair.problem.replace(regime="transient", vertical_force=80e3)
    pair.solve(going, **steps[0])
    first = pair.step(going, **steps[1])
    state = pickle.loads(pickle.dumps(pair.save()))
    second = pair.step(going, **steps[2])
    assert (first.patches[0].traction_x != second.patches[0].traction_x).any()
    other = tm.Pair(pair.rail, pair.wheel, pair.problem)
    other.restore(state)
    again = other.step(going, **steps[2])
    assert (again.force == second.force).all() and (again.patches[0].traction_x == second.patches[0].traction_x).all()
    assert tm.State(state.to_bytes()).to_bytes() == state.to_bytes() == copy.deepcopy(state).to_bytes()
    pair.reset()
    fresh = pair.step(going, **steps[2])
    assert (fresh.patches[0].traction_x != second.patches[0].traction_x).any()
    for wrong in (b"", b"nonsense" * 9, state.to_bytes()[:-5]):
        with pytest.raises(tm.InputError):
            tm.State(wrong)
    foreign = tm.Pair(tm.Surface.standard("54E1"), pair.wheel, pair.problem)
    with pytest.raises(tm.InputError, match="other surfaces"):
        foreign.restore(state)


def test_statuses_warn(pair):
    apart = pair.solve(set={"wheelset.z_mm": -5.0})
    assert apart.status == "no_contact" and apart.patches == [] and (apart.force == 0).all()
    with pytest.warns(tm.ConvergenceWarning, match="not_converged"):
        doubtful = pair.solve(max_force_iterations=1, y=4e-3, vertical_force=300e3)
    assert doubtful.status == "not_converged" and doubtful.message


def test_misuse_is_refused(rail, wheel, pair):
    with pytest.raises(tm.InputError, match="rail and a wheel"):
        tm.Pair(wheel, rail)
    with pytest.raises(tm.InputError):
        pair.solve(y=float("nan"))
    with pytest.raises(tm.InputError):
        pair.solve(vertical_force=float("inf"))
    with pytest.raises(tm.InputError, match="radius"):
        pair.solve(nominal_radius=0.5)
    with pytest.raises(tm.InputError, match="does not belong|no setting"):
        pair.solve(patch__mx=3)
    with pytest.raises(tm.InputError, match="one of a patch"):
        pair.solve(tm.Problem(patch=True, normal_force=1e3))
    ok = pair.solve(y=0.0)
    with tm.Pair(rail, wheel, pair.problem) as closed:
        kept = closed.solve(y=0.0)
    for call in (closed.solve, closed.save, closed.reset):
        with pytest.raises(tm.InputError, match="closed"):
            call()
    assert (kept.patches[0].pressure == ok.patches[0].pressure).all()  # results stay


def test_fields_outlive_everything(rail, wheel):
    own = tm.Pair(rail, wheel, tm.Problem(vertical_force=80e3, dx=1e-3, ds=1e-3))
    field = own.solve().patches[0].pressure
    kept = field.copy()
    del own
    gc.collect()
    assert (field == kept).all() and not field.flags.writeable


def test_hertz():
    solution = tm.hertz(10e3, semi_axes=(4e-3, 2e-3))
    patch = solution.patches[0]
    assert patch.pmax == pytest.approx(1.5 * 10e3 / (np.pi * 4e-3 * 2e-3), rel=2e-3) and patch.fn == pytest.approx(10e3, rel=1e-5)
    assert solution.force[2] == patch.fn
    same = tm.PatchSolver().solve(normal_force=10e3, mx=40, my=40, set={
        "patch.hertz.given": "semi_axes", "patch.hertz.semi_axis_x_mm": 4.0, "patch.hertz.semi_axis_y_mm": 2.0})
    assert (same.patches[0].pressure == patch.pressure).all()
    for wrong in ({}, dict(semi_axes=(1e-3, 1e-3), curvatures=(1.0, 1.0)), dict(semi_axes=(-1e-3, 1e-3))):
        with pytest.raises(tm.InputError):
            tm.hertz(1e3, **wrong)


def test_patches_in_sequence():
    solver = tm.PatchSolver()
    shift = tm.Problem(patch=True, regime="shift", normal_force=1e3, shift_x=1e-6, mx=12, my=12, set={
        "patch.hertz.given": "semi_axes", "patch.hertz.semi_axis_x_mm": 1.0, "patch.hertz.semi_axis_y_mm": 1.0})
    first = solver.solve(shift).patches[0]
    second = solver.solve(shift, history="continue").patches[0]
    assert first.shift and abs(second.fx) > 1.2 * abs(first.fx)


def test_sensitivities(pair):
    patch = pair.solve(set={"case.sensitivities": True}).patches[0]
    assert patch.by_creepage.shape == (3, 2) and patch.by_approach.shape == (3,) and patch.by_approach[0] > 0
    assert pair.solve().patches[0].by_creepage is None


def test_threads_share_surfaces_and_pairs(rail, wheel, pair):
    """Pairs of their own side by side, and one pair for all."""
    expected = pair.solve(y=1e-3)
    found, alive = [], threading.Event()

    def work(own):
        for _ in range(3):
            found.append(own.solve(y=1e-3).force)

    def other():  # goes on while others solve: they do not hold the GIL
        alive.set()

    threads = [threading.Thread(target=work, args=(tm.Pair(rail, wheel, pair.problem),)) for _ in range(3)]
    threads += [threading.Thread(target=work, args=(pair,)) for _ in range(3)] + [threading.Thread(target=other)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert alive.is_set() and len(found) == 18 and all((force == expected.force).all() for force in found)


def test_the_gil_is_free_while_it_solves(pair):
    ticks, done = [], threading.Event()

    def count():
        while not done.wait(0.001):
            ticks.append(1)

    counter = threading.Thread(target=count)
    counter.start()
    pair.solve(dx=2e-4, ds=2e-4)  # some tenths of a second in one call
    done.set()
    counter.join()
    assert len(ticks) > 10


def test_many_calls_do_not_grow_memory(pair):
    problem = pair.problem.replace(dx=3e-3, ds=3e-3, y=0.0)

    def calls(count):
        for _ in range(count):
            pair.solve(problem, set=["wheelset.z_mm=-5"])  # without contact: what the interface itself keeps
            pair.solve(problem, regime="none")
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = calls(100)
    assert calls(300) - before < 1500  # KiB
