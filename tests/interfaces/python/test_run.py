# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Whole files: the same numbers as the program writes, fields, files, errors, progress."""
import copy
import gc
import json
import pickle
import weakref

import numpy as np
import pytest

import treadmark as tm
from conftest import CASE, COARSE


def without_times(document):
    """result.json without what differs from run to run."""
    document = dict(document, treadmark=None, surfaces=None, settings=None)
    for case in document["cases"]:
        case.pop("seconds"), case.pop("timing", None)
    return document


def test_numbers_are_those_of_the_program_to_all_digits(program, examples):
    changes = {**COARSE, "wheelset.pitch_deg": -6}
    arguments = [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
    told = json.loads(program("run", examples / "wheel-flat.toml", "--json", "-", "--quiet", *arguments))
    result = tm.run(examples / "wheel-flat.toml", set=changes)
    assert without_times(json.loads(result.to_json())) == without_times(told)
    # and the case that they hold, from which pages solve again
    again = tm.run(told["input"]["toml"], folder=examples).cases[0].patches[0]
    assert again.pmax == pytest.approx(result.cases[0].patches[0].pmax, rel=1e-9)
    # and so do the attributes, in SI
    patch, written = result.cases[0].patches[0], told["cases"][0]["patches"][0]
    assert f"{patch.pmax / 1e6:.11g}" == f"{written['pmax_MPa']:.11g}"
    assert f"{1e3 * patch.x_tr:.9g}" == f"{written['reference']['x_tr_mm']:.9g}"
    assert patch.ncon == written["elements"]["ncon"]
    assert result.settings == ["discretisation.dx_mm=1.0", "discretisation.ds_mm=1.0", "wheelset.pitch_deg=-6"]


def test_paths_text_and_dictionaries_are_the_same_case(tmp_path):
    text = 'rail.shape.standard = "60E1"\nwheel.shape.standard = "S1002"\ntrack.cant = "1:40"\n[wheelset]\nvertical_force_N = 80e3\nvelocity_m_s = 20\nvpitch_rad_s = -43.4\n[discretisation]\ndx_mm = 1\nds_mm = 1\n'
    (tmp_path / "case.toml").write_text(text)
    forms = [tm.run(given).cases[0].numbers for given in (CASE, text, tmp_path / "case.toml", str(tmp_path / "case.toml"))]
    known = [{name: value for name, value in numbers.items() if not name.startswith("timing")} for numbers in forms]
    assert all(numbers == known[0] for numbers in known) and known[0]["force_on_rail.fz_tr"] == pytest.approx(80e3, rel=1e-4)


def test_a_list_of_cases_in_a_dictionary():
    result = tm.run({**CASE, "cases": [{"wheelset.y_mm": [0.0, 2.0]}, {"wheelset": {"y_mm": 4.0}}]})
    assert [round(1e3 * case.y, 9) for case in result.cases] == [0.0, 2.0, 4.0] and result.complete and len(result) == result.cases_total == 3


def test_fields_are_views_that_keep_their_owner():
    result = tm.run(CASE)
    patch = result.cases[0].patches[0]
    field = patch.pressure
    assert field.shape == (patch.grid.ny, patch.grid.nx) and field.dtype == np.float64 and not field.flags.writeable
    assert not field.flags.owndata and np.asarray(field) is field
    assert np.shares_memory(result._held.cases()[0]["patches"][0]["fields"]["pressure"], field)  # no copies
    assert field.max() == patch.pmax and field.sum() * patch.grid.dx * patch.grid.dy == pytest.approx(patch.fn, rel=1e-9)
    kept, gone = field.copy(), weakref.ref(result)
    del result, patch
    gc.collect()
    assert gone() is None and (field == kept).all()
    with pytest.raises(ValueError):
        field[0, 0] = 1.0


def test_every_row_of_the_tables_is_an_attribute():
    patch = tm.run(CASE).cases[0].patches[0]
    for name in tm.PATCH_QUANTITIES:
        value = getattr(patch, name.rpartition(".")[2])
        assert isinstance(value, float)
    assert set(patch.fields) <= set(tm.FIELDS) and {"pressure", "traction_x", "traction_s", "slip_x", "gap", "state"} <= set(patch.fields)
    assert np.isnan(patch.max_temperature_1)  # was not asked for
    with pytest.raises(AttributeError, match="was not computed"):
        patch.temperature_1
    with pytest.raises(AttributeError, match="no 'presure'"):
        patch.presure
    assert "pmax" in dir(patch) and "pressure" in dir(patch)


def test_files_are_read_back(tmp_path, program):
    result = tm.run({**CASE, "cases": [{"wheelset.y_mm": [0.0, 3.0]}]})
    result.write(tmp_path / "run.json"), result.write(tmp_path / "run.h5"), result.write(tmp_path / "folder")
    assert (tmp_path / "folder" / "pressure.svg").exists() and (tmp_path / "folder" / "vtk").is_dir()
    for name in ("run.json", "run.h5", "folder"):
        again = tm.read_result(tmp_path / name)
        assert len(again.cases) == 2 and again.version == tm.__version__
        for a, b in zip(result.cases, again.cases):
            assert [p.fn for p in a.patches] == pytest.approx([p.fn for p in b.patches], rel=1e-11)
            assert b.force == pytest.approx(a.force, rel=1e-10, abs=1e-6) and b.y == pytest.approx(a.y, abs=1e-15)
        if name != "run.json":
            assert (again.cases[1].patches[0].pressure == result.cases[1].patches[0].pressure).all()
    (tmp_path / "bad.json").write_text("{}")
    with pytest.raises(tm.InputError, match="is no result"):
        tm.read_result(tmp_path / "bad.json")
    with pytest.raises(tm.InputError):
        tm.read_result(tmp_path / "missing.json")
    with pytest.raises(tm.InputError):
        tm.read_result(tmp_path / "run.json.h5")
    with pytest.raises(ValueError, match="use .json"):
        result.write(tmp_path / "run.xlsx")


def test_a_shift_is_read_back_in_si(tmp_path):
    case = {"case.regime": "shift", "patch": {"normal_force_N": 1000.0, "shift_x_mm": 0.001, "mx": 12, "my": 12, "hertz": {
        "given": "semi_axes", "semi_axis_x_mm": 1.0, "semi_axis_y_mm": 1.0}}}
    result = tm.run(case)
    result.write(tmp_path / "shift.json")
    again = tm.read_result(tmp_path / "shift.json").cases[0].patches[0]
    patch = result.cases[0].patches[0]
    assert patch.shift and again.shift and patch.xi == 1e-6
    for name, value in patch.numbers.items():
        assert again.numbers[name] == pytest.approx(value, rel=1e-10, abs=1e-30), name


def test_reports_and_pictures(tmp_path):
    result = tm.run(CASE)
    result.report(tmp_path / "report.html")
    assert "<html" in (tmp_path / "report.html").read_text()[:400]
    assert result._repr_svg_().startswith("<svg") and "<svg" in result._repr_html_() and "<td>" in result._repr_html_()
    assert result.cases[0]._repr_svg_().startswith("<svg")
    assert "pmax" in repr(result.cases[0].patches[0]) and "1 patch" in repr(result.cases[0]) and "1 of 1" in repr(result)
    assert "case 1" in result.summary().lower()


def test_xarray():
    pytest.importorskip("xarray")
    result = tm.run({**CASE, "cases": [{"wheelset.y_mm": [0.0, 3.0]}]})
    fields = result.to_xarray(case=2)
    assert fields["pressure"].dims == ("s", "x") and fields["pressure"].attrs["units"] == "Pa"
    assert float(fields["pressure"].integrate("x").integrate("s")) == pytest.approx(result.cases[1].patches[0].fn, rel=1e-6)
    with pytest.raises(IndexError):
        result.to_xarray(case=3)


def test_tables_say_what_was_varied(tmp_path, pair):
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    result = tm.run({**CASE, "cases": [{"wheelset.y_mm": [0.0, 3.0]}, {"wheelset": {"vertical_force_N": 90e3}, "case.side": "left"}]})
    assert result.varied == {"wheelset.y": [0.0, 3e-3, 0.0], "wheelset.vertical_force": [80e3, 80e3, 90e3], "case.side": ["right", "right", "left"]}
    table = result.to_pandas()
    assert len(table) == sum(len(c.patches) for c in result) and table["pmax"][0] == result[0].patches[0].pmax
    for name, values in result.varied.items():
        assert list(table[name]) == [values[number - 1] for number in table["case"]] and list(result.to_pandas("case")[name]) == values
    fields = xarray.concat([result.to_xarray(case)["pressure"] for case in (1, 3)], "wheelset.vertical_force")
    assert list(fields["wheelset.vertical_force"]) == [80e3, 90e3] and list(fields["case.side"]) == ["right", "left"]
    result.write(tmp_path / "run.h5"), result.write(tmp_path / "run.json")
    for name in ("run.h5", "run.json"):  # which know where the wheelset was
        assert tm.read_result(tmp_path / name).varied == {"wheelset.y": [0.0, pytest.approx(3e-3), 0.0]}
    assert tm.run(CASE).varied == {}
    solutions = pair.solve(y=[0.0, 2e-3], friction=[[0.2], [0.3]])
    assert solutions.varied == {"wheelset.y": [0.0, 2e-3] * 2, "friction.coefficient": [0.2, 0.2, 0.3, 0.3]} and isinstance(table, pandas.DataFrame)
    assert list(solutions.to_pandas("case")["friction.coefficient"]) == [0.2, 0.2, 0.3, 0.3] and float(solutions.to_xarray(4)["wheelset.y"]) == 2e-3


def test_errors_have_place_and_advice(tmp_path):
    (tmp_path / "case.toml").write_text('[wheel]\nshape.standard = "S1002"\n[wheelset]\n  y_mmm = 3\n')
    with pytest.raises(tm.InputError) as caught:
        tm.run(tmp_path / "case.toml")
    error = caught.value
    assert (error.file, error.line, error.column) == (str(tmp_path / "case.toml"), 4, 3) and "y_mmm" in error.message and "y_mm" in error.advice
    assert isinstance(error, tm.TreadmarkError) and isinstance(error, ValueError) and str(error).startswith(f"{tmp_path}")
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
    for given, what in (({"wheelset.y_mm": "far"}, "wheelset.y_mm"), ({"rail.shape.file": "nowhere.prr"}, "nowhere.prr"), ("nowhere.toml", "nowhere.toml")):
        with pytest.raises(tm.InputError, match=what):
            tm.run(given if isinstance(given, str) else {**CASE, **given} if "rail.shape.file" not in given else
                   {**{k: v for k, v in CASE.items() if k != "rail.shape.standard"}, **given})
    with pytest.raises(TypeError, match="set must be a dictionary or a list of texts"):
        tm.run(CASE, set="wheelset.y_mm=3")
    with pytest.raises(TypeError):
        tm.run({**CASE, "title": object()})
    with pytest.raises(tm.InputError):
        tm.run({**CASE, "bad key": 1})


def test_other_kinds_of_files_are_refused(examples):
    with pytest.raises(tm.InputError, match="treadmark.simulate"):
        tm.run(examples / "flat-at-speed.toml")
    with pytest.raises(tm.InputError, match="treadmark.sweep"):
        tm.run(examples / "figure5.toml")


def test_progress_ends_and_raises():
    cases = {**CASE, "cases": [{"wheelset.y_mm": [0.1 * k for k in range(6)]}]}
    told = []
    result = tm.run(cases, progress=lambda finished, total, what: told.append((finished, total)), threads=1)
    assert [finished for finished, _ in told] == list(range(1, 7)) and {total for _, total in told} == {6}
    some = tm.run(cases, progress=lambda finished, *rest: finished < 2, threads=1)
    assert not some.complete and 2 <= len(some.cases) < 6 and some.cases[0].force == pytest.approx(result.cases[0].force)

    def fails(*what):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tm.run(cases, progress=fails)
    with pytest.raises(TypeError):
        tm.run(cases, progress=lambda: None)


def test_results_can_be_copied_and_pickled(tmp_path):
    result = tm.run(CASE)
    again = pickle.loads(pickle.dumps(result))
    assert again.cases[0].numbers == result.cases[0].numbers and (again.cases[0].patches[0].pressure == result.cases[0].patches[0].pressure).all()
    assert again.to_json() == result.to_json() and pickle.loads(pickle.dumps(again)).cases[0].summary() == result.cases[0].summary()
    with pytest.raises(ValueError, match="pickled"):
        again.write("x.json")
    for copied in (copy.copy(result), copy.deepcopy(result)):
        copied.write(tmp_path / "copied.json")
        assert copied.cases[0].numbers == result.cases[0].numbers
    assert copied.cases[0] is not result.cases[0] and copied.cases[0].patches[0].pressure is not result.cases[0].patches[0].pressure


def test_check_reads_without_solving(examples):
    found = tm.check(examples / "wheel-flat.toml")
    assert (found.kind, found.count, len(found.positions)) == ("cases", 13, 13)
    assert found.positions[0].rail.shape[1] == 2 and found.positions[0].svg().startswith("<svg") and "no errors" in repr(found)
    assert tm.check(examples / "flat-at-speed.toml").kind == "simulation"
    assert tm.check(examples / "figure5.toml").kind == "study"
    with pytest.raises(tm.InputError):
        tm.check({**CASE, "wheelset.vertical_force_N": -1.0})


def test_subsurface_blocks():
    case = tm.run({**CASE, "subsurface.blocks": [{"z_mm": [1.0, 3.0], "x_mm": [-1.0, 0.0, 1.0], "y_mm": [0.0]}]}).cases[0]
    block = case.patches[0].subsurface[0]
    assert block["point"].shape == (2, 1, 3, 3) and block["stress"].shape == (2, 1, 3, 3, 3)
    assert list(1e3 * block["point"][:, 0, 0, 2]) == pytest.approx([1.0, 3.0]) and list(1e3 * block["point"][0, 0, :, 0]) == pytest.approx([-1, 0, 1])
    stress = block["stress"][0, 0, 1]
    assert (stress == stress.T).all() and np.linalg.eigvalsh(stress)[::-1] == pytest.approx(block["principal"][0, 0, 1], rel=1e-6)
