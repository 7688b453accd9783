# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What people do wrong in Python: errors of the right class, in the words and units of the package."""
import dataclasses
import inspect
import os
import pickle
import re

import numpy as np
import pytest

import treadmark as tm
from conftest import CASE


def test_files_that_are_not_there(tmp_path):
    (tmp_path / "my.toml").write_text("[wheel]\n")
    (tmp_path / "wheel.csv").write_text("0 0\n")
    calls = [(lambda: tm.run(tmp_path / "MY.toml"), "my.toml"), (lambda: tm.Problem(tmp_path / "MY.toml"), "my.toml"),
             (lambda: tm.check(tmp_path / "MY.toml"), "my.toml"), (lambda: tm.check(tmp_path / "Wheel.csv"), "wheel.csv"), (lambda: tm.Surface.read(tmp_path / "Wheel.csv", "wheel"), "wheel.csv"),
             (lambda: tm.Surface.read(str(tmp_path / "Wheel.csv"), "rail"), "wheel.csv"),
             (lambda: tm.measure("wheel", tmp_path / "Wheel.csv"), "wheel.csv"),
             (lambda: tm.run({"rail.shape.standard": "60E1", "wheel.shape.file": str(tmp_path / "Wheel.csv"), "wheelset.vertical_force_N": 1e5}),
              "wheel.csv")]
    for call, near in calls:
        with pytest.raises(FileNotFoundError, match=f"did you mean {re.escape(str(tmp_path / near))}") as caught:
            call()
        error = caught.value
        assert isinstance(error, tm.InputError) and isinstance(error, tm.MissingFileError) and isinstance(error, ValueError)
        again = pickle.loads(pickle.dumps(error))
        assert str(again) == str(error) and type(again) is type(error)
    calls = [(tm.Surface.read, "wheel"), (tm.measure_files,), (tm.read_result,), (tm.read_comparison,), (tm.read_bench,)]
    if tm.parts()["scans"] and tm.parts()["vehicle"] and tm.parts()["hdf5"] and tm.parts()["report"]:
        calls += [(tm.read_import,), (tm.read_simulation,), (tm.read_sweep,), (tm.track,), (tm.stability,), (tm.response,), (tm.assess,), (tm.simulate,), (tm.evolve, tmp_path / "out"),
                  (tm.sweep, tmp_path / "out"), (tm.report, tmp_path / "out.html")]
    for function, *more in calls:
        for ending in ("toml", "csv"):
            with pytest.raises(FileNotFoundError, match="nosuch"):
                function("rail", "@nosuch") if function is tm.measure_files else function(str(tmp_path / f"nosuch.{ending}"), *more)


def test_places_of_texts_and_dictionaries():
    with pytest.raises(tm.InputError) as caught:
        tm.run({**CASE, "wheelset.y_m": 1.0})
    assert "did you mean 'wheelset.y_mm'" in str(caught.value) and "dictionary:" not in str(caught.value) and "text:" not in str(caught.value)
    with pytest.raises(tm.InputError) as caught:
        tm.Problem({**CASE, "wheelset.y_m": 1.0})
    assert "text:" not in str(caught.value)
    for call in (tm.run, tm.Problem):
        with pytest.raises(tm.InputError, match=r"^line 2, column 8 of the text: .*write file = \"w\.csv\""):
            call("[wheel]\nfile = w.csv\n")


def test_words_of_the_package():
    for call in (lambda: tm.Surface.standard("S1003"), lambda: tm.Surface.read("S1002", "wheel"),
                 lambda: tm.run({**CASE, "wheel.shape.standard": "X9"})):
        with pytest.raises(tm.InputError) as caught:
            call()
        assert "treadmark list" not in str(caught.value) and " --" not in str(caught.value), str(caught.value)


def test_units(pair):
    with pytest.raises(tm.InputError, match=r"wheelset\.y = 2 m: .*in m"):
        pair.solve(y=2)
    with pytest.raises(tm.InputError, match=r"nominal_radius = 460 m"):
        tm.Problem(nominal_radius=460)
    for radius in (460, 0.00046, -0.46):
        with pytest.raises(tm.InputError, match="nominal_radius of .* m .*0.46 for 460 mm"):
            tm.Surface.standard("S1002", nominal_radius=radius)
    y = np.linspace(0.06, -0.06, 50)
    with pytest.raises(tm.InputError, match="nominal_radius"):
        tm.Surface.profile(y, 0 * y, "wheel", nominal_radius=460)
    doubted = pair.solve(y=0.0, vertical_force=100.0)
    assert [r.name for r in doubted.remarks if r.grave] == ["unusual_value"]
    assert not [r for r in pair.solve(y=0.0, vertical_force=100e3).remarks if r.grave]


def test_types(pair):
    for value in ("2 mm", b"2", object(), 1j):
        with pytest.raises(TypeError, match="y must be a number in m, not "):
            pair.solve(y=value)
    assert pair.solve(y=np.float32(0.0)).ok and pair.solve(y=np.array(0.0)).ok


def functions():
    for name in tm.__all__:
        thing = getattr(tm, name)
        if inspect.isfunction(thing):
            yield name, thing
        for member in dir(thing) if inspect.isclass(thing) and not issubclass(thing, Exception) else ():
            if not member.startswith("_") or member == "__init__" and not dataclasses.is_dataclass(thing) and "held" not in str(inspect.signature(thing)):
                if inspect.isfunction(getattr(thing, member)) or inspect.ismethod(getattr(thing, member)):
                    yield f"{name}.{member}", getattr(thing, member)


@pytest.mark.parametrize("function", [pytest.param(function, id=name) for name, function in functions()])
def test_every_argument_is_checked(function):
    """Also those of functions that are yet to come: the error says which argument is wrong."""
    for parameter in inspect.signature(function).parameters.values():
        if parameter.annotation not in (parameter.empty, "Any") and parameter.kind is not parameter.VAR_POSITIONAL and parameter.kind is not parameter.VAR_KEYWORD:
            with pytest.raises(TypeError, match=f"^{parameter.name} must be "):
                function(**{parameter.name: object()})


def test_bytes_that_are_no_text(tmp_path):
    """Of a file in another encoding, and of its name: the error is that of the package, and results keep the rest of the text."""
    broken = tmp_path / "latin.inp"
    broken.write_bytes("3 MODULE\n % mm\u00e9\n".encode("latin-1") + b"0.\xe9\xe9 x\n")
    with pytest.raises(tm.InputError) as caught:
        tm.run(broken)
    assert "latin.inp" in str(caught.value)
    named = tmp_path / os.fsdecode(b"\xe9.toml")
    with pytest.raises(tm.TreadmarkError):
        tm.run(named)
    named.write_text("wheell = 3\n")
    with pytest.raises(tm.InputError, match="wheell"):
        tm.run(named)
    named.write_text("[rail]\nshape.standard = '60E1'\n[wheel]\nshape.standard = 'S1002'\n[track]\ncant = '1:40'\n"
                     "[wheelset]\nvertical_force_N = 80e3\n[discretisation]\ndx_mm = 1\nds_mm = 1\n")
    result = tm.run(named)
    assert "\ufffd.toml" in result.input_file and result.cases[0].status == "ok"
    result.write(tmp_path / "fields.h5")
    assert "\ufffd.toml" in tm.read_result(tmp_path / "fields.h5").input_file
