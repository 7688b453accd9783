# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""From the points of a scanned wheel to what its flat does under a vehicle: forces in time, over the speed, and the pressure in the flat.

The scan is made up; one of your own is an array of points, too, by any package that reads it, or the name of its file. Coarse and short, to be
quick: examples/figure5.toml to figure7.toml are the whole studies.

    python3 scan_to_figures.py [FOLDER FOR PICTURES]
"""
import pathlib
import tempfile

import numpy as np

import treadmark as tm
from _pictures import save

truth = tm.Surface.standard("S1002", nominal_radius=0.46).with_flat(length=60e-3, depth=0.9e-3)
random = np.random.default_rng(1)
tilted = np.linalg.qr(random.normal(size=(3, 3)))[0]
points = truth.triangles(4e-3)[0]
cloud = points @ (tilted * np.sign(np.linalg.det(tilted))) + 3e-6 * random.normal(size=points.shape)  # (n, 3) [m]

with tempfile.TemporaryDirectory() as folder:
    wheel = pathlib.Path(folder) / "wheel.slcw"
    audit = tm.import_scan(cloud, wheel, set={"scan.body": "wheel", "placement.nominal_radius_mm": 460.0, "fit.resolution_mm": 2.0})
    print(audit.summary().splitlines()[0])

    # The scanned wheel is the right one of the first wheelset; the left one is round and needs a shape of its own. The import has put the flat at 0.
    scanned = {"wheel.shape.file": wheel, "wheel.flats": [], "simulation.other_wheel.shape.standard": "S1002", "simulation.wheels.0.pitch_deg": 10.0,
               "simulation.distance_m": 0.14, "discretisation.dx_mm": 3.0, "discretisation.ds_mm": 3.0}
    study = pathlib.Path(__file__).parent.parent / "flat-at-speed.toml"
    theories = {"FASTSIM": {"case.regime": "steady", "solver.tangential_model": "fastsim"}, "transient rolling": {"case.regime": "transient"}}
    runs = {name: tm.simulate(study, set={**scanned, **theory}) for name, theory in theories.items()}
    speeds = [10.0, 20.0, 40.0]
    largest = [tm.simulate(study, set={**scanned, "simulation.speed_m_s": speed})["Q_N"].max() for speed in speeds]
    seen = tm.simulate(study, set={**scanned, "simulation.speed_m_s": 6.0, "simulation.fields.pitch_deg": [1.0]})

force = runs["transient rolling"]["Q_N"]
print("largest forces [kN] by speed [m/s]:", {speed: round(most / 1e3, 1) for speed, most in zip(speeds, largest)})
assert all(run.status == "complete" for run in runs.values()) and force.max() > 1.3 * force[0] and seen.snapshots[0].patches


def draw(time, speed, patch):
    for name, run in runs.items():
        time.plot(1e3 * run["t_s"], run["Q_N"] / 1e3, label=name)
    time.legend()
    time.set(title="The flat at 40 m/s", xlabel="time [ms]", ylabel="vertical force [kN]")
    speed.plot(speeds, np.divide(largest, 1e3), "o-")
    speed.set(title="Largest force", xlabel="speed [m/s]", ylabel="vertical force [kN]")
    seen.snapshots[0].patches[0].plot(ax=patch)
    patch.set_title("Pressure in the flat, 1 degree before it is down")


save("scan_to_figures.png", draw, panels=3)
