# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""A vehicle with a wheel flat on its track in time.

    python3 simulation.py [FOLDER FOR PICTURES]
"""
import pathlib

import numpy as np

import treadmark as tm
from _pictures import save

file = pathlib.Path(__file__).parent.parent / "flat-at-speed.toml"
# Coarse and short, to be quick: the flat comes down right after the start.
simulation = tm.simulate(file, set={"simulation.distance_m": 0.17, "simulation.wheels.0.pitch_deg": 14.0, "discretisation.dx_mm": 3.0,
                                    "discretisation.ds_mm": 3.0})
print(simulation)
for value in list(simulation.summary.values())[:6]:
    print(f"{value.name:24} {value.value:12.5g} {value.unit:4} {value.meaning}")
time, force = simulation["t_s"], simulation["Q_N"]
assert simulation.status == "complete" and force.max() > 1.5 * force[0] and np.shares_memory(force, simulation.values)


def draw(axes):
    axes.plot(1e3 * time, force / 1e3)
    axes.set(title="A flat of 1.4 mm at 40 m/s", xlabel="time [ms]", ylabel="vertical force of the wheel [kN]")


save("simulation.png", draw)
