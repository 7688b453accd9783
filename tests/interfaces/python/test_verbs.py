# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""compare, bench, import, simulate, assess, stability and sweep, against the program and the files that it writes."""
import csv
import json
import pickle

import numpy as np
import pytest

import treadmark as tm
from conftest import CASE

FLAT = {**CASE, "wheel.flats": [{"length_mm": 30.0, "depth_mm": 0.3}]}


def needs(*parts):
    missing = [part for part in parts if not tm.parts()[part]]
    return pytest.mark.skipif(bool(missing), reason=f"this build leaves out {missing}")


@needs("report", "report_scripts")
def test_page_that_solves(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TREADMARK_MODULES", str(tmp_path))
    with pytest.raises(tm.InputError, match="no program for browsers"):
        tm.live(CASE)
    (tmp_path / "treadmark-web.wasm").write_bytes(b"\0asm")
    (tmp_path / "treadmark-web.js").write_text("var createTreadmark;")
    assert 'src="live.html"' in tm.live({"title": "of a notebook", **CASE})._repr_html_()
    html = (tmp_path / "live.html").read_text(encoding="utf-8")
    assert "var createTreadmark;" in html and "<title>of a notebook</title>" in html
    assert 'src="a%20%22b%22.html"' in tm.live(CASE, tmp_path / 'a "b".html')._repr_html_()
    with pytest.raises(tm.InputError, match="no case of this number"):
        tm.live(CASE, number=2)
    with pytest.raises(tm.InputError, match="no contact"):
        tm.live(CASE, set={"wheelset.y_mm": 300.0})
    with pytest.raises(tm.MissingFileError):
        tm.live(tmp_path / "nothing.toml")


def test_comparison(tmp_path):
    compared = tm.compare(FLAT, backends=["analytic", "spline"], resolutions=[2e-3])
    assert compared.complete and [c["backend"] for c in compared.candidates][:1] == ["analytic"] and len(compared.candidates) == 2
    truth, other = compared.cases(0)[0], compared.cases(1)[0]
    error = other.patches[0].pmax / truth.patches[0].pmax - 1
    assert compared.rows()[1]["pmax_error_percent"] == pytest.approx(100 * error, rel=1e-6) and abs(error) < 0.1
    compared.write(tmp_path / "folder")
    again = tm.read_comparison(tmp_path / "folder")
    assert again.table() == compared.table()
    written = list(csv.DictReader((tmp_path / "folder" / "compare.csv").open()))
    assert [float(row["pmax_MPa"]) for row in written] == [row["pmax_MPa"] for row in compared.rows()]
    assert all(compared.svg(what).startswith("<svg") for what in ("errors", "costs", "pressures")) and "<svg" in compared._repr_html_()
    with pytest.raises(ValueError):
        compared.svg("colours")
    with pytest.raises(IndexError):
        compared.cases(2)
    with pytest.raises(tm.InputError, match="splint"):
        tm.compare(FLAT, backends=["splint"])


def test_bench(tmp_path):
    timed = tm.bench(FLAT, backends=["spline"], resolutions=[2e-3], seconds_per_measure=0.001)
    rows = timed.rows()
    assert {row["body"] for row in rows} == {"wheel", "rail"} and all(row["agrees"] for row in rows)
    timed.write(tmp_path)
    assert tm.read_bench(tmp_path).rows() == rows and timed.svg().startswith("<svg")


@needs("vehicle", "hdf5")
def test_simulation(tmp_path, examples):
    found = tm.simulate(examples / "flat-at-speed.toml", set={
        "simulation.distance_m": 0.02, "discretisation.dx_mm": 2.0, "discretisation.ds_mm": 2.0})
    assert found.status == "complete" and found.values.shape == (len(found["t_s"]), len(found.columns)) and not found.values.flags.writeable
    assert (np.diff(found["t_s"]) > 0).all() and np.shares_memory(found["t_s"], found.values)
    found.write(tmp_path)
    again = tm.read_simulation(tmp_path)
    assert (again.values == found.values).all() and again.summary.keys() == found.summary.keys() and again.modes == found.modes
    assert found.svg().startswith("<svg") and "<svg" in found._repr_html_() and json.loads(found.to_json())
    with pytest.raises(KeyError, match="Q_N"):
        found["Q_M"]
    pandas = pytest.importorskip("pandas")
    assert isinstance(found.to_pandas(), pandas.DataFrame) and list(found.to_pandas()["t_s"]) == list(found["t_s"])


@needs("vehicle")
def test_modes(examples, program):
    modes = tm.simulate(examples / "flat-at-speed.toml", modes_only=True)
    assert len(modes.values) == 0 and modes.modes and modes.statics


@needs("vehicle", "hdf5", "openvdb")
def test_evolve(tmp_path, examples, program):
    file, short = examples / "tired-rail.toml", {"evolve.passages": 1000, "discretisation.dx_mm": 2.0, "discretisation.ds_mm": 2.0,
                                                  "evolve.rail.fatigue.depths_mm": [3.0]}
    told = []
    found = tm.evolve(file, tmp_path / "out", set=short, progress=lambda *what: told.append(what))
    assert found.status == "complete" and told and (tmp_path / "out" / "rail_0001.vdb").exists()
    words = [word for key, value in short.items() for word in ("--set", f"{key}={value}")]
    assert found.document["generations"] == json.loads(program("evolve", file, "-o", tmp_path / "again", *words, "--json", "-"))["generations"]
    last = found.document["generations"][-1]
    assert last["rail_yield_share_ever"] > 0.5 and last["cases"][0]["rail"]["fi_surf"] < 0.0 and "passages" in found.summary()
    table = found.to_pandas()
    assert len(table) == len(found.document["generations"]) and table["rail_depth_mm"].iloc[-1] > 0.0
    with pytest.raises(tm.InputError, match="another evolution"):
        tm.evolve(file, tmp_path / "out")
    with pytest.raises(tm.InputError, match="no evolution"):
        tm.evolve(file, tmp_path / "new", resume=True)


@needs("vehicle")
def test_track(tmp_path, examples):
    found = tm.track(examples / "tracks" / "zhai-equivalent.toml", set={"scale_stiffness": 2.0}, count=20, fit=1)
    receptance = found.receptances["rail"]
    assert found.frequencies.shape == receptance.shape == (20,) and (abs(receptance) > 0.0).all()
    softer = tm.track(examples / "tracks" / "zhai-equivalent.toml", count=20)
    assert abs(softer.receptances["rail"][0]) > 1.5 * abs(receptance[0]) and "fitted" not in softer.receptances
    found.write(tmp_path)
    assert json.loads((tmp_path / "track.json").read_text()) == found.document
    refit = tm.track(tmp_path / "fitted.toml", count=20)
    assert np.allclose(refit.receptances["rail"], found.receptances["fitted"], rtol=1e-6)
    assert found.svg().startswith("<svg") and "kg on" in found.summary()
    with pytest.raises(tm.InputError, match="Hz|frequenc"):
        tm.track(examples / "tracks" / "zhai-equivalent.toml", from_Hz=100.0, to_Hz=10.0)


@needs("vehicle")
def test_stability(tmp_path, examples, program):
    file, wheels = examples / "flat-at-speed.toml", {"simulation.wheels": []}
    found = tm.stability(file, set=wheels, from_m_s=60.0, to_m_s=90.0, count=3)
    told = json.loads(program("stability", file, "--set", "simulation.wheels=[]", "--from", "60", "--to", "90", "--count", "3", "--json", "-"))
    assert found.document == told and found.verdict == "critical" and 60.0 < found.critical_speed < 90.0
    pandas = pytest.importorskip("pandas")
    table = found.to_pandas()
    assert isinstance(table, pandas.DataFrame) and (table["real_1_per_s"][table["speed_m_s"] == 60.0] < 0.0).all()
    assert (table["real_1_per_s"][table["speed_m_s"] == 90.0] > 0.0).any()
    found.write(tmp_path)
    assert json.loads((tmp_path / "stability.json").read_text()) == told and found.svg().startswith("<svg") and "m/s" in found.summary()
    with pytest.raises(tm.InputError):
        tm.stability(file, set=wheels, from_m_s=90.0, to_m_s=60.0)


@needs("vehicle")
def test_response(tmp_path, examples, program):
    file, wheels = examples / "curve.toml", {"simulation.vehicle": str(examples / "vehicles" / "single-wheelset.toml")}
    found = tm.response(file, set=wheels, from_Hz=1.0, to_Hz=30.0, count=4, inputs=["longitudinal_level", "ws1_left.*"], channels=["ws1_left.Q_N"])
    told = json.loads(program("response", file, "--set", f"simulation.vehicle=\"{wheels['simulation.vehicle']}\"", "--from", "1", "--to", "30", "--count", "4",
                              "--inputs", "longitudinal_level,ws1_left.*", "--channels", "ws1_left.Q_N", "--json", "-"))
    assert found.document == told and found.frequencies.shape == (4,)
    curve = found.curves["longitudinal_level", "ws1_left.Q_N"]
    assert curve.shape == (4,) and (abs(curve) > 0.0).all() and ("ws1_left.roughness", "ws1_left.Q_N") in found.curves
    assert found.spectra["ws1_left.Q_N"].shape == (4,)
    found.write(tmp_path)
    assert (tmp_path / "spectra.csv").exists() and found.svg().startswith("<svg") and found.modes_svg().startswith("<svg")
    with pytest.raises(tm.InputError):
        tm.response(file, set=wheels, inputs=["no_such_input"])


@needs("vehicle", "hdf5")
def test_assessment(tmp_path, examples, program):
    tm.simulate(examples / "flat-at-speed.toml", set={"simulation.wheels": [], "simulation.distance_m": 3.0}).write(tmp_path / "run")
    found = tm.assess(tmp_path / "run", sections=[("first", 0.0, 1.0), ("rest", 1.0, 3.0, "curve")], spectra=["ws1_left.Q_N"],
                      laws=["british-rail"])
    told = json.loads(program("assess", tmp_path / "run", "--section", "first:0:1", "--section", "rest:1:3:curve", "--spectra", "ws1_left.Q_N",
                              "--laws", "british-rail", "--json", "-"))
    assert found.document == told and "rest" in found.summary()
    pandas = pytest.importorskip("pandas")
    table = found.to_pandas()
    assert isinstance(table, pandas.DataFrame) and set(table["section"]) == {"first", "rest"}
    found.write(tmp_path / "assessed")
    assert json.loads((tmp_path / "assessed" / "assessment.json").read_text())
    limits = tmp_path / "limits.toml"
    limits.write_text('edition = "made up"\n[[limits]]\nquantity = "Q"\nvalue = 90e3\n')
    assert "made up, not verified" in tm.assess(tmp_path / "run", limits=limits).summary()
    limits.write_text('edition = "made up"\n[[limits]]\nquantity = "q"\nvalue = 90e3\n')
    with pytest.raises(tm.InputError):
        tm.assess(tmp_path / "run", limits=limits)
    for wrong in ({"vehicle": "bicycle"}, {"sections": [("a", 0.0, 1.0, "bridge")]}, {"channels": ["ws1_left.Q_M"]},
                  {"laws": ["jendel"]}, {"laws": ["nobody_1900"]}):
        with pytest.raises(tm.InputError):
            tm.assess([tmp_path / "run"], **wrong)
    with pytest.raises(tm.InputError):
        tm.assess(tmp_path)


@needs("vehicle", "hdf5")
def test_sweep(tmp_path, examples):
    study = tmp_path / "study.toml"
    (tmp_path / "case.toml").write_text(tm._inputs.to_toml(CASE))
    study.write_text('[study]\nbase = "case.toml"\n[[study.vary]]\nkey = "wheelset.y_mm"\nvalues = [0.0, 3.0]\n')
    told = []
    swept = tm.sweep(study, tmp_path / "out", progress=lambda *what: told.append(what))
    assert swept.complete and len(swept.runs) == 2 == swept.runs_total and told
    rows = swept.rows()
    assert [row["wheelset.y_mm"] for row in rows] == [0.0, 3.0]
    again = tm.read_sweep(tmp_path / "out")
    assert [r["wheelset.y_mm"] for r in again.rows()] == [0.0, 3.0] and again.rows()[0].keys() == rows[0].keys()
    with pytest.raises(tm.InputError, match="treadmark.simulate"):
        tm.sweep(examples / "flat-at-speed.toml", tmp_path / "other")
    tm.report(tmp_path / "out", tmp_path / "report.html") if tm.parts()["report"] else None


@needs("scans")
def test_import(tmp_path):
    """Points on a turned section: a rail of a hundred millimetres, as a scanner sees it."""
    rail = tm.Surface.standard("60E1")
    y = np.linspace(-0.034, 0.034, 180)
    points = np.array([(x, a, b) for x in np.arange(0, 0.12, 1e-3) for a, b in zip(y, rail.heights(0.0, y))])
    np.savetxt(tmp_path / "scan.xyz", 1e3 * points, fmt="%.5f")
    told = []
    audit = tm.import_scan(tmp_path / "scan.xyz", tmp_path / "rail.slcs", set={"scan.body": "rail", "scan.unit": "mm"},
                           progress=lambda *what: told.append(what))
    assert audit.document["points"]["read"] == len(points) if "points" in audit.document else audit.document
    made = tm.Surface.read(tmp_path / "rail.slcs", "rail")
    assert made.heights(0.05, np.linspace(-0.02, 0.02, 9)).ptp() == pytest.approx(rail.heights(0.0, np.linspace(-0.02, 0.02, 9)).ptp(), abs=2e-5)
    assert audit.maps["fitted"].values.ndim == 2 and audit.svg().startswith("<svg") and "60E1" in audit.summary()
    if tm.parts()["hdf5"]:
        audit.write(tmp_path / "audit")
        assert tm.read_import(tmp_path / "audit").to_json() == audit.to_json()
    cloud = tm.import_scan(points, tmp_path / "cloud.slcs", set={"scan.body": "rail"})  # in metres
    assert cloud.maps["fitted"].values == pytest.approx(audit.maps["fitted"].values, abs=1e-6, nan_ok=True)
    assert tm.Surface.read(tmp_path / "cloud.slcs", "rail").heights(0.05, 0.0) == pytest.approx(made.heights(0.05, 0.0), abs=1e-6)
    map_of = (np.linspace(0.0, 0.2, 41), np.linspace(-0.03, 0.03, 61), np.full((41, 61), 2e-5))
    tm.import_scan(map_of, tmp_path / "map.slcs", set={"scan.body": "rail"})
    assert tm.Surface.read(tmp_path / "map.slcs", "rail").heights(0.1, 0.0) == pytest.approx(rail.heights(0.0, 0.0) + 2e-5, abs=2e-6)
    again = pickle.loads(pickle.dumps(audit))
    assert again.summary() == audit.summary() and (again.maps["fitted"].values.shape == audit.maps["fitted"].values.shape)
    with pytest.raises(tm.InputError, match="nowhere"):
        tm.import_scan("nowhere.xyz", tmp_path / "rail.slcs", set={"scan.body": "rail"})
    with pytest.raises(tm.InputError):
        tm.import_scan([], tmp_path / "rail.slcs")


def test_parts_and_version(program):
    assert tm.version_text().split() == program("--version").split()[-len(tm.version_text().split()):]
    assert tm.parts()["python"] and tm.__version__ in tm.version_text()
