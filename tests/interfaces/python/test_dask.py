# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Studies on workers of Dask give the bytes of the program's own run, also where a worker dies."""
import os
import signal
import threading
import time

import pytest

import treadmark as tm

if os.environ.get("CI") != "true":
    pytest.importorskip("distributed", reason="needs the Debian package python3-distributed")

SIMULATION = """
[simulation]
vehicle = "{examples}/vehicles/wheel-on-mass.toml"
speed_m_s = 20.0
distance_m = 4.0
checkpoint_s = 0.02
[[simulation.wheels]]
wheelset = 1
side = "right"
contact = "full"
pitch_deg = 6.0
[case]
regime = "transient"
[wheel]
shape.standard = "S1002"
flats = [{{ length_mm = 40.0, depth_mm = 0.4 }}]
[rail]
shape.standard = "60E1"
[discretisation]
dx_mm = 2.0
ds_mm = 2.0
"""
STUDY = """
[study]
base = "simulation.toml"
[[study.vary]]
key = "simulation.speed_m_s"
values = [20, 25, 30, 35, 40]
[[study.figures]]
file = "forces.svg"
kind = "summary"
x = "simulation.speed_m_s"
y = ["q_max_N"]
"""
FILES = ("sweep.h5", "sweep.csv", "forces.svg", "forces.csv")


@pytest.fixture
def study(tmp_path, examples):
    if not (tm.parts()["vehicle"] and tm.parts()["hdf5"]):
        pytest.skip("studies are left out of this build")
    (tmp_path / "simulation.toml").write_text(SIMULATION.format(examples=examples))
    (tmp_path / "study.toml").write_text(STUDY)
    return tmp_path / "study.toml"


def kill_a_worker_at_work(client, folder, killed):
    """Kills the process that has written a checkpoint of a run."""
    pids = client.run(os.getpid)
    while not killed:
        begun = list(folder.glob("runs/*/unfinished.h5"))
        for worker, tasks in client.processing().items():
            if begun and tasks:
                os.kill(pids[worker], signal.SIGKILL)
                return killed.append(worker)
        time.sleep(0.02)


def test_workers_of_dask_one_of_which_is_killed(tmp_path, study, program):
    from distributed import Client, LocalCluster

    program("sweep", study, "-o", tmp_path / "alone")
    told, killed = [], []
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1") as cluster, Client(cluster) as client:
        killer = threading.Thread(target=kill_a_worker_at_work, args=(client, tmp_path / "out", killed), daemon=True)
        killer.start()
        swept = tm.sweep(study, tmp_path / "out", client=client, progress=lambda *what: told.append(what))
        again = tm.sweep(study, tmp_path / "out", client=client)
        killer.join(10)
    assert killed and swept.complete and len(swept.runs) == 5 == len(again.runs)
    assert [finished for finished, *_ in told] == [1, 2, 3, 4, 5]
    for name in FILES:
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "alone" / name).read_bytes(), name


class NoClient:
    def submit(self, *_, **__):
        raise AssertionError("nothing is to be submitted")


def test_what_is_wrong_is_told_before_any_work(tmp_path, study):
    with pytest.raises(tm.InputError, match="runs_per_task"):
        tm.sweep(study, tmp_path / "out", client=NoClient(), runs_per_task=0)
    with pytest.raises(tm.InputError, match="no study to go on with"):
        tm.sweep(study, tmp_path / "out", client=NoClient(), resume=True)
    study.write_text(STUDY.replace('x = "simulation.speed_m_s"', 'x = "simulation.speed"'))
    with pytest.raises(tm.InputError, match="no varied key"):
        tm.sweep(study, tmp_path / "out", client=NoClient())


def test_progress_ends_the_work_and_the_same_call_goes_on(tmp_path, study):
    from distributed import Client

    (tmp_path / "simulation.toml").write_text((tmp_path / "simulation.toml").read_text().replace("distance_m = 4.0", "distance_m = 0.05"))
    with Client(n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None) as client:
        begun = tm.sweep(study, tmp_path / "out", client=client, runs_per_task=2, progress=lambda *_: False)
        assert not begun.complete and len(begun.runs) >= 2 and not (tmp_path / "out" / "sweep.h5").exists()
        went_on = tm.sweep(study, tmp_path / "out", client=client, runs_per_task=2, resume=True)
    assert went_on.complete and len(went_on.runs) == 5 == len(tm.read_sweep(tmp_path / "out").runs)
