# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Profiles of one's own, from points: rail heads of two radii under the same wheel.

    python3 own_profile.py [FOLDER FOR PICTURES]
"""
import numpy as np

import treadmark as tm
from _pictures import save

y = np.linspace(-0.025, 0.025, 251)
heads = {f"{1e3 * radius:.0f} mm": tm.Surface.profile(y, radius - np.sqrt(radius**2 - y**2), "rail") for radius in (0.08, 0.12)}
wheel = tm.Surface.standard("S1002", nominal_radius=0.46)
# Such a head has no gauge point: the rail is placed by its origin.
settings = tm.Problem(vertical_force=100e3, speed=20.0, pitch_rate=-43.478, track__rail_y=0.7535, track__rail_z=0.0, track__cant=0.025, dx=1e-3, ds=1e-3)

lateral = np.linspace(-3e-3, 1e-3, 5)
found = {name: tm.Pair(rail, wheel, settings).solve(y=lateral) for name, rail in heads.items()}
for name, solutions in found.items():
    print(f"radius {name}:", *(f"{max(p.pmax for p in s.patches) / 1e6:6.0f}" for s in solutions), "MPa")
assert all(solution.ok for solutions in found.values() for solution in solutions)
area = {name: sum(p.ncon for s in solutions for p in s.patches) for name, solutions in found.items()}
print("elements in contact:", area)
assert area["120 mm"] > 1.1 * area["80 mm"]  # the flatter head is touched over more of it


def draw(section, pressure):
    for name, rail in heads.items():
        section.plot(1e3 * y, -1e3 * rail.heights(0.0, y), label=name)
        pressure.plot(1e3 * lateral, [max(p.pmax for p in s.patches) / 1e6 for s in found[name]], "o-", label=name)
    section.set(title="Rail heads", xlabel="y [mm]", ylabel="height [mm]")
    pressure.set(title="Largest pressure", xlabel="lateral position of the wheelset [mm]", ylabel="[MPa]", ylim=(0, None))
    section.legend()
    pressure.legend()


save("own_profile.png", draw, panels=2)
