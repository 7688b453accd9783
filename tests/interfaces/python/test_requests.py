# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Geometry of a wheelset on its track and measures, against the program, closed forms and printed numbers."""
import copy
import csv
import json
import math
import os
import pathlib
import pickle
import signal
import tempfile
import threading
import time

import numpy as np
import pytest

import treadmark as tm
from treadmark import _treadmark as native

PAIR = {"wheel": "S1002", "rail": "60E1", "gauge": 1.435, "cant": "1:40"}
CONE = {"wheel": "cone 1:20", "rail": "circle R300", "rail_origins": 1.5, "wheel_origins": 1.5, "amplitudes": [1e-3, 3e-3, 5e-3]}
needs_report = pytest.mark.skipif(not tm.parts()["report"], reason="this build leaves out reports")


@pytest.fixture(scope="module")
def pair():
    return tm.geometry(**PAIR, gauges=[1.434, 1.4355], axle_load=160e3)


@pytest.fixture
def milled(tmp_path):
    """A 60E1 whose crown was cut off 3 mm below its top."""
    y = np.arange(-34e-3, 34.01e-3, 0.1e-3)
    z = np.maximum(tm.Surface.standard("60E1").section(0.0, y), 3e-3)
    file = tmp_path / "milled.csv"
    np.savetxt(file, 1e3 * np.stack([y, z], axis=1), fmt="%.6f", delimiter=";", header="y_mm;z_mm", comments="")
    return file


def test_geometry_is_that_of_the_program(program, pair):
    told = json.loads(program("geometry", "--wheel", "S1002", "--rail", "60E1", "--gauge-mm", 1435, "--cant", "1:40", "--gauges-mm", "1434,1435.5",
                              "--axle-load-kN", 160, "--json", "-", "--quiet"))
    assert pair.document == told


def test_its_numbers_are_in_si(pair):
    g = pair.document["geometry"]
    for key, factor in (("y_mm", 1e-3), ("delta_r_mm", 1e-3), ("angle_right_rad", 1.0), ("rail_curvature_left_per_m", 1.0), ("pressure_right_MPa", 1e6),
                        ("normal_force_left_N", 1.0), ("delta_tan_gamma", 1.0)):
        name = key
        for unit in ("_mm", "_rad", "_per_m", "_MPa", "_N"):
            name = name.removesuffix(unit)
        values = pair.functions[name]
        assert values == pytest.approx([math.nan if v is None else factor * v for v in g["functions"][key]], rel=1e-12, nan_ok=True), name
        assert not values.flags.writeable and len(values) == len(pair.functions["y"])
    assert (pair.units["y"], pair.units["pressure_right"], pair.units["wheel_curvature_left"]) == ("m", "Pa", "1/m")
    rounding = 2e-12  # three numbers of twelve digits, up to 460 mm
    assert pair.functions["delta_r"] == pytest.approx(pair.functions["radius_right"] - pair.functions["radius_left"], rel=0, abs=rounding)
    assert pair.gauge == pair.numbers["track.gauge"] == pytest.approx(1.435, abs=1e-12)
    assert pair.nonlinearity == pytest.approx(1e3 * g["nonlinearity_per_mm"], rel=1e-12)
    assert pair.numbers["gravitational_stiffness_per_weight"] == g["gravitational_stiffness_per_weight_per_m"]
    # the largest difference of radii before a flange of 30 degrees touches, of both sides the less, makes the wheels roll in a circle
    y, dr = pair.functions["y"], pair.functions["delta_r"]
    right = np.cumprod(pair.functions["angle_right"][y >= -1e-9] < math.radians(30)).astype(bool)
    left = np.cumprod(pair.functions["angle_left"][y <= 1e-9][::-1] < math.radians(30)).astype(bool)
    least = min(dr[y >= -1e-9][right].max(), (-dr[y <= 1e-9][::-1][left]).max())
    assert least > 1e-3 and pair.numbers["steering.delta_r_max"] == pytest.approx(least, rel=1e-9)
    radius = 0.25 * (pair.numbers["wheelset.diameter_right"] + pair.numbers["wheelset.diameter_left"])
    assert pair.smallest_steered_radius == pytest.approx(pair.numbers["wheelset.wheel_origins"] * radius / least, rel=1e-9)
    assert pair.numbers["load.right.pressure"] == pytest.approx(1e6 * g["load"]["right"]["pressure_MPa"], rel=1e-12)
    assert pair.axle_load == pytest.approx(160e3)
    assert pair.conicity.amplitude[:2] == pytest.approx([1e-3, 1.1e-3]) and pair.conicity.tan_gamma_e.tolist() == g["conicity"]["tan_gamma_e"]
    assert pair.conicity.wavelength == pytest.approx(1e-3 * np.array(g["conicity"]["wavelength_mm"])) and set(pair.conicity.reasons) == {""}
    assert [jump.y for jump in pair.jumps] == pytest.approx([1e-3 * jump["y_mm"] for jump in g["jumps"]], abs=1e-15) and len(pair.jumps) > 0
    assert pair.second_contacts[0].gap == pytest.approx(1e-3 * g["second_contacts"][0]["gap_mm"])
    assert pair.limits["right"].y == pytest.approx(1e-3 * g["limits"]["right"]["y_mm"]) and pair.limits["right"].y == -pair.limits["left"].y
    assert pair.gauges.gauge == pytest.approx([1.434, 1.4355]) and pair.gauges.tan_gamma_e.shape == (2, len(pair.conicity.amplitude))
    assert pair.gauges.tan_gamma_e.tolist() == g["gauge_sweep"]["tan_gamma_e"]
    with pytest.raises(AttributeError, match="numbers"):
        pair.pressure  # of which side?
    with pytest.raises(AttributeError, match="colour"):
        pair.colour
    assert "clearance" in dir(pair)


def test_cones_are_cones():
    """A cone of 1:20 has that conicity at any amplitude, and the wavelength of Klingel (1883)."""
    found = tm.geometry(**CONE, diameter=0.92)
    assert found.conicity.tan_gamma_e == pytest.approx(0.05, abs=1e-9)
    assert found.conicity.wavelength == pytest.approx(2 * math.pi * math.sqrt(1.5 * 0.46 / (2 * 0.05)), rel=1e-6)
    assert found.functions["delta_r"] == pytest.approx(2 * 0.05 * found.functions["y"], abs=1e-9)
    assert found.equilibrium == pytest.approx(0.0, abs=1e-12) and not found.jumps
    # a wheel smaller by 0.2 mm in radius is made up for by a shift of 0.1 / (1 / 20) mm to it
    other = tm.geometry(**CONE, diameter=0.92, diameter_left=0.9196)
    assert other.equilibrium == pytest.approx(-0.2e-3 / (2 * 0.05), abs=1e-9)
    assert (other.diameter_right, other.diameter_left) == pytest.approx((0.92, 0.9196))


def test_what_has_no_number_says_why():
    found = tm.geometry(**{**PAIR, "amplitudes": [3e-3, 30e-3]}, amplitude=30e-3)
    assert math.isnan(found.conicity.tan_gamma_e[1]) and found.conicity.reasons[0] == "" != found.conicity.reasons[1]
    assert math.isnan(found.numbers["conicity_at.tan_gamma_e"]) and found.reasons["conicity_at"] == found.conicity.reasons[1]
    assert any("no conicity at 1 of 2 amplitudes" in note for note in found.notes)
    crooked = tm.geometry(**CONE, diameter_left=0.90)
    assert math.isnan(crooked.equilibrium) and crooked.reasons["equilibrium"]


def test_arrays_in_place_of_files(milled, tmp_path):
    """A profile (n, 2) of y and z in metres is that of a file with the same numbers."""
    profile = 1e-3 * np.loadtxt(milled, delimiter=";", skiprows=1)
    places = {"rail_origins": 1.5077, "cant": "1:40", "amplitudes": [1e-3]}
    by_file, by_array = (tm.geometry("S1002", rail, **places) for rail in (milled, profile))
    assert by_array.functions["delta_r"] == pytest.approx(by_file.functions["delta_r"], abs=1e-9)
    assert "rail-" in repr(by_array) and tempfile.gettempdir() not in by_array.to_json() + repr(by_array.notes)
    of_file, of_array, of_many = tm.measure("rail", milled), tm.measure("rail", profile), tm.measure_files("rail", [profile, milled])
    assert of_array.numbers["crown_radius"].value == pytest.approx(of_file.numbers["crown_radius"].value, rel=1e-6)
    assert [m.numbers["crown_radius"].value for m in of_many] == pytest.approx([of_file.numbers["crown_radius"].value] * 2, rel=1e-6)
    assert tm.check(profile, body="rail").profiles[0].facts and tm.check(profile).kind == "profile"
    case = {"wheel.shape.standard": "S1002", "wheelset.vertical_force_N": 80e3, "discretisation": {"dx_mm": 2.0, "ds_mm": 2.0}}
    runs = [tm.run({**case, **given}) for given in ({"rail.shape.file": milled}, {"rail": {"shape": {"file": profile}}}, {"rail.shape.file": profile})]
    assert [run.cases[0].patches[0].pmax for run in runs] == pytest.approx([runs[0].cases[0].patches[0].pmax] * 3, rel=1e-6)
    runs[-1].write(tmp_path / "run")  # which asks for the profile again
    dented = tm.Surface.of_case({"rail.shape.standard": "60E1", "wheel.shape.standard": "S1002", "wheelset.vertical_force_N": 1.0, "rail.offsets.file": (
        np.linspace(-0.1, 0.1, 201), np.linspace(-0.03, 0.03, 61), np.full((201, 61), 1e-4))}, "rail")
    assert dented.heights(0.0, 0.0) - tm.Surface.standard("60E1").heights(0.0, 0.0) == pytest.approx(1e-4, abs=1e-7)
    for wrong in (profile[:, :1], profile.ravel(), np.array([["a", "b"]]), (profile, profile)):
        with pytest.raises((tm.InputError, TypeError), match="rail (has the shape|must be)"):
            tm.geometry("S1002", wrong, **places)


def test_a_case_says_where_wheel_and_rail_are(program, examples):
    found = tm.geometry(case=examples / "squat.toml", set={"track.gauge_mm": 1434.0}, roll="free", amplitudes="1:3:1")
    told = json.loads(program("geometry", examples / "squat.toml", "--set", "track.gauge_mm=1434.0", "--roll", "free", "--amplitudes-mm", "1:3:1",
                              "--json", "-", "--quiet"))
    assert found.document == told and found.gauge == pytest.approx(1.434) and found.conicity.amplitude == pytest.approx([1e-3, 2e-3, 3e-3])


def test_geometry_through_samples_and_profiles_that_are_files(tmp_path, milled):
    plain = tm.geometry(**PAIR, amplitudes=[3e-3])
    sampled = tm.geometry(**PAIR, amplitudes=[3e-3], backend="spline", resolution=0.25e-3)
    assert 0 < abs(sampled.conicity_3mm - plain.conicity_3mm) < 5e-3
    places = {"rail_origins": 1.5077, "cant": "1:40", "amplitudes": [1e-3]}
    own = tm.geometry("S1002", milled, **places)
    shift = np.linspace(-3e-3, 3e-3, 61)
    differences = [np.interp(shift, found.functions["y"], found.functions["delta_r"]) for found in (own, tm.geometry("S1002", "60E1", **places))]
    assert abs(differences[0] - differences[1]).max() > 0.1e-3
    same = tm.geometry(pathlib.Path("S1002"), str(milled), rail_left=milled, wheel_left="S1002", **{**places, "cant": 1 / 40})
    assert same.functions["delta_r"] == pytest.approx(own.functions["delta_r"], abs=1e-12)


def test_its_files_and_pictures(tmp_path, pair):
    pair.write(tmp_path / "out")
    names = {file.name for file in (tmp_path / "out").iterdir()}
    assert names == {"functions.csv", "conicity.csv", "charts.svg", "contact_points.svg", "gauges.csv", "gauges.svg", "geometry.json"}
    assert (tmp_path / "out" / "geometry.json").read_text() == pair.to_json()
    rows = list(csv.DictReader((tmp_path / "out" / "functions.csv").open()))
    assert [1e-3 * float(row["delta_r_mm"]) for row in rows] == pytest.approx(pair.functions["delta_r"], abs=1e-15)
    assert all(pair.svg(what).startswith("<svg") for what in ("charts", "points", "gauges")) and pair._repr_svg_() == pair.svg()
    assert "<svg" in pair._repr_html_() and "track.gauge" in pair._repr_html_() and "S1002 on 60E1" in repr(pair) and "60E1" in pair.summary()
    for what in ("colours", "gauges"):
        with pytest.raises(ValueError, match="what must be"):
            tm.geometry(**CONE).svg(what)
    for again in (pickle.loads(pickle.dumps(pair)), copy.copy(pair), copy.deepcopy(pair)):
        assert again.numbers == pytest.approx(pair.numbers, nan_ok=True) and again.svg() == pair.svg() and again.document == pair.document
    with pytest.raises(ValueError, match="pickled"):
        pickle.loads(pickle.dumps(pair)).report(tmp_path / "never.html")
    pandas = pytest.importorskip("pandas")
    assert isinstance(pair.to_pandas(), pandas.DataFrame) and list(pair.to_pandas()["y"]) == list(pair.functions["y"])


@needs_report
def test_reports(tmp_path, pair, milled):
    pair.report(tmp_path / "geometry.html")
    tm.measure("rail", milled, nominal="60E1", alignment="none").report(tmp_path / "rail.html")
    for name in ("geometry.html", "rail.html"):
        assert "<html" in (tmp_path / name).read_text()[:400]


@pytest.mark.parametrize("given, what", [
    ({"wheel": None}, "wheel is missing"),
    ({"rail": None}, "rail is missing"),
    ({"gauge": None}, "where the rails are"),
    ({"rail_origins": 1.5}, "twice"),
    ({"wheel": "60E1"}, "rail"),
    ({"rail": "S1002"}, "wheel"),
    ({"wheel": "nowhere.whl"}, "nowhere.whl"),
    ({"gauge": math.nan}, "gauge_mm"),
    ({"gauge": -1.435}, "gauge_mm"),
    ({"gauge": "wide"}, "gauge must be a number in m, not 'wide'"),
    ({"cant": "1:0"}, "1:0"),
    ({"cant": math.inf}, "inf"),
    ({"amplitudes": []}, "amplitudes"),
    ({"amplitudes": [3e-3, math.nan]}, "amplitudes_mm"),
    ({"amplitudes": ["far"]}, "amplitudes must be a list of numbers in m or text"),
    ({"amplitudes": "1:2"}, "from:to:step"),
    ({"amplitudes": [0.5]}, "amplitude"),
    ({"gauges": [0.0]}, "gauges_mm"),
    ({"roll": "some"}, "roll"),
    ({"yaw": 1.0}, "yaw_mrad"),
    ({"step": 1.0}, "step_mm"),
    ({"axle_load": -1.0}, "axle_load_kN"),
    ({"backend": "marble"}, "marble"),
    ({"set": {"wheelset.y_mm": 1.0}}, "no case"),
    ({"set": {"colour": "red"}}, "colour"),
    ({"case": "nowhere.toml"}, "nowhere.toml"),
])
def test_what_cannot_be_is_refused(given, what):
    with pytest.raises((tm.TreadmarkError, TypeError), match=what):
        tm.geometry(**{**PAIR, **given})


def test_wheelsets_that_cannot_stand():
    with pytest.raises(tm.NumericalError):
        tm.geometry(**{**PAIR, "gauge": 1.6})
    with pytest.raises(TypeError):
        tm.geometry(**PAIR, color="red")
    for wrong in (object(), {"shape.standard": "S1002"}):
        with pytest.raises(TypeError):
            tm.geometry(**{**PAIR, "wheel": wrong})


def test_progress_and_interrupts_of_geometry():
    told = []
    tm.geometry(**CONE, progress=lambda *what: told.append(what), threads=1)
    assert told == [(1, 1, "geometry")]

    def fails(*what):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tm.geometry(**CONE, progress=fails)
    sent = []
    timer = threading.Timer(0.3, lambda: (sent.append(time.monotonic()), os.kill(os.getpid(), signal.SIGINT)))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        tm.geometry(**PAIR, step=0.005e-3, gauges="1430:1440:0.01")
    assert time.monotonic() - sent[0] < 2.0
    assert tm.geometry(**CONE).conicity.tan_gamma_e[0] == pytest.approx(0.05)


def test_other_threads_go_on_meanwhile():
    steps = []
    done = threading.Event()

    def count():
        while not done.is_set():
            steps.append(0)
            time.sleep(1e-3)

    other = threading.Thread(target=count)
    other.start()
    begin = time.monotonic()
    tm.geometry(**PAIR, step=0.02e-3)
    seconds = time.monotonic() - begin
    done.set()
    other.join()
    assert len(steps) > 20 * seconds  # a lock held all the time leaves a handful


def test_measures_are_those_of_the_program(program, milled):
    told = json.loads(program("measure", "rail", milled, "--nominal", "60E1", "--alignment", "none", "--json", "-", "--quiet"))
    found = tm.measure("rail", milled, nominal="60E1", alignment="none")
    assert found.document == told and found.body == "rail" and found.kind == "profile" and found.file == str(milled)
    for key, value in told["rail"]["uncertainty"].items():
        name = key.removesuffix("_mm").removesuffix("_mm2").removesuffix("_deg")
        factor = 1e-6 if key.endswith("_mm2") else 1e-3 if key.endswith("_mm") else math.pi / 180 if key.endswith("_deg") else 1.0
        number = found.numbers[name]
        assert number.value == pytest.approx(factor * told["rail"][key], rel=1e-12), name
        assert number.uncertainty == pytest.approx(factor * value, rel=1e-12) and number.reason == "" and number.meaning
    # the crown lies 3 mm below the nominal one (the scatter of 1 nm in the file's numbers is all that is left)
    assert found.numbers["w1"].value == pytest.approx(3e-3, abs=1e-6) and found.numbers["w1"].unit == "m"
    assert math.isnan(found.numbers["roughness_exceedance_db"].value) and "scan" in found.numbers["roughness_exceedance_db"].reason
    assert "w1" in found._repr_html_() and "W1" in found.summary() and "numbers" in repr(found)


def test_a_wheel_by_its_name_has_the_printed_numbers():
    """EN 13715: flange height 28, thickness 32.5, gradient 10.794 mm."""
    found = tm.measure("wheel", "S1002", nominal="S1002", nominal_radius=0.46)
    numbers = found.numbers
    assert [numbers[name].value for name in ("flange_height", "flange_thickness", "flange_gradient")] == pytest.approx([28e-3, 32.5e-3, 10.794e-3], abs=5e-7)
    assert numbers["diameter"].value == pytest.approx(0.92, abs=1e-6) and numbers["flange_angle"].unit == "rad"
    assert numbers["flange_angle"].value == pytest.approx(math.radians(70), abs=1e-3)
    assert found.verdict == "no limits" and found.limits == [] and found.error == "" and "needs a scan" in numbers["runout"].reason
    again = pickle.loads(pickle.dumps(found))
    assert again.document == found.document and again.numbers["flange_height"] == numbers["flange_height"]
    assert again.summary() == found.summary()
    with pytest.raises(ValueError, match="pickled"):
        again.report("never.html")


def test_limits_and_what_is_wrong_with_them(tmp_path):
    limits = tmp_path / "limits.toml"
    limits.write_text("[wheel]\nflange_height_mm = { max = 36 }\nflange_thickness_mm = { min = 32.6, max = 33 }\nrunout_mm = { max = 0.3 }\n")
    found = tm.measure("wheel", "S1002", limits=limits)
    assert found.verdict == "outside" and [limit.status for limit in found.limits] == ["within", "outside", "not measured"]
    assert [limit.name for limit in found.limits] == ["flange_height", "flange_thickness", "runout"]
    assert (found.limits[1].min, found.limits[1].max) == pytest.approx((32.6e-3, 33e-3)) and found.limits[0].min == -math.inf
    assert found.limits[1].value == pytest.approx(32.5e-3, abs=5e-7) and found.limits[1].sure
    limits.write_text("[wheel]\nflange_hight_mm = { max = 36 }\n")
    with pytest.raises(tm.InputError) as caught:
        tm.measure("wheel", "S1002", limits=limits)
    assert (caught.value.file, caught.value.line, caught.value.column) == (str(limits), 2, 1) and "flange_height_mm" in caught.value.advice


@pytest.mark.parametrize("body, file, given, what", [
    ("engine", "S1002", {}, "body must be"),
    ("rail", "S1002", {}, "not a rail"),
    ("wheel", "nowhere.whl", {}, "nowhere.whl"),
    ("wheel", "S1002", {"nominal": "S1003"}, "S1003"),
    ("wheel", "S1002", {"alignment": "top"}, "belongs to rails"),
    ("rail", "60E1", {"alignment": "somehow"}, "alignment"),
    ("rail", "60E1", {"as_in_file": True}, "belongs to wheels"),
    ("rail", "60E1", {"mate": "S1002"}, "other wheel"),
    ("wheel", "S1002", {"nominal_radius": math.nan}, "nominal_radius"),
    ("wheel", "S1002", {"nominal_radius": 460.0}, "nominal_radius of 460 m .*0.46 for 460 mm"),
    ("wheel", "S1002", {"stations": 0}, "stations"),
    ("rail", "60E1", {"line": math.inf}, "line_mm"),
    ("rail", "60E1", {"line_step": 0.0}, "line_step_mm"),
    ("wheel", "S1002", {"limits": "nowhere.toml"}, "nowhere.toml"),
    ("wheel", "", {}, ""),
])
def test_what_cannot_be_measured_is_refused(body, file, given, what):
    with pytest.raises((tm.InputError, TypeError), match=what):
        tm.measure(body, file, **given)


def test_bad_files_are_named(tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("y_mm;z_mm\n0;0\n1;far\n")
    with pytest.raises(tm.InputError) as caught:
        tm.measure("wheel", bad)
    assert caught.value.file == str(bad) and caught.value.line == 3


def test_many_files_and_those_that_fail(tmp_path, milled, program):
    told = []
    found = tm.measure_files("rail", ["60E1", "nowhere.prr", milled, tmp_path], nominal="60E1", alignment="none", progress=lambda *what: told.append(what))
    assert [m.file for m in found] == ["60E1", "nowhere.prr", str(milled), str(milled)]
    assert [bool(m.error) for m in found] == [False, True, False, False] and found[1].verdict == "failed" and "nowhere.prr" in found[1].error
    assert found[1].numbers == {} and "failed" in repr(found[1]) and "nowhere.prr" in found[1]._repr_html_() and found[1].summary() == found[1].error
    assert sorted(count for count, *_ in told) == [1, 2, 3, 4] and {total for _, total, _ in told} == {4}
    assert found[2].document == tm.measure("rail", milled, nominal="60E1", alignment="none").document
    assert [m.document for m in tm.measure_files("rail", tmp_path, nominal="60E1", alignment="none", threads=1)] == [found[2].document]
    some = tm.measure_files("rail", [milled] * 6, progress=lambda count, *rest: count < 2, threads=1)
    assert len(some) == 6 and some[0].error == "" and all("stopped" in m.error for m in some[2:])
    with pytest.raises(tm.InputError, match="in the folder"):
        (tmp_path / "empty").mkdir()
        tm.measure_files("wheel", tmp_path / "empty")
    with pytest.raises(tm.InputError, match="belongs to rails"):
        tm.measure_files("wheel", ["S1002"], alignment="top")
    assert tm.measure_files("wheel", []) == []
    pandas = pytest.importorskip("pandas")
    table = tm.measures_to_pandas(found)
    assert isinstance(table, pandas.DataFrame) and table["w1"][2] == found[2].numbers["w1"].value and math.isnan(table["w1"][1])


def test_many_files_end_at_an_interrupt():
    sent = []
    timer = threading.Timer(0.3, lambda: (sent.append(time.monotonic()), os.kill(os.getpid(), signal.SIGINT)))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            tm.measure_files("wheel", ["S1002"] * 2000, nominal="S1002")
    assert time.monotonic() - sent[0] < 2.0 and tm.measure("wheel", "S1002").error == ""


def test_profiles_of_the_library(program):
    listed = {p.name: p for p in tm.profiles()}
    lines = program("list", "profiles").splitlines()[2:]
    assert len(lines) == len(listed) and all(line.startswith(name) for line, name in zip(lines, listed))
    rail, wheel = listed["60E1"], listed["S1002"]
    # EN 13674-1: 172 mm high, foot 150 mm, 76.70 cm2, 60.21 kg/m
    assert (rail.body, rail.height, rail.width) == ("rail", pytest.approx(0.172), pytest.approx(0.15))
    assert (rail.area, rail.mass) == (pytest.approx(76.70e-4, abs=0.006e-4), pytest.approx(60.21, abs=0.006))
    assert wheel.body == "wheel" and math.isnan(wheel.area) and wheel.source == "EN 13715" and not wheel.family
    assert tm.Surface.standard("EPS").body == "wheel" and tm.Surface.standard("54E1").body == "rail"
    with pytest.raises(tm.InputError, match="wheel"):
        tm.Surface.standard("EPS", body="rail")
    for p in tm.profiles():
        assert native.profile_body(p.name) == p.body, p.name


def test_keywords_are_those_of_the_settings():
    """What the library takes is a keyword, with its meaning in the help."""
    import inspect

    keys = native.request_tables()
    for function, verb, but in ((tm.geometry, "geometry", set()), (tm.measure, "measure", set()), (tm.measure_files, "measure", {"mate"})):
        names = {row[1] for row in keys[verb]} - but
        assert names < set(inspect.signature(function).parameters)
        for key, name, factor, unit, values, meaning in keys[verb]:
            if name in names - {"wheel", "rail"}:
                assert (f"{name} [{unit}]: {meaning}" if unit != "1" else f"{name}: {meaning}") in function.__doc__
    assert ("axle_load_kN", "axle_load", 1e3, "N") in [row[:4] for row in keys["geometry"]]
    assert "SETTINGS" not in tm.geometry.__doc__ + tm.measure.__doc__ + tm.measure_files.__doc__
    with pytest.raises(TypeError, match="did you mean 'gauge'"):
        tm.geometry("S1002", "60E1", gage=1.435)
    with pytest.raises(TypeError, match="no keyword 'colour' of case, wheel"):
        tm.geometry("S1002", "60E1", colour="red")
