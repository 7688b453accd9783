# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""A backend of one's own, in Python: a rail as a sum of waves, compared with a built-in one.

Any class with heights(u, y) will do. It is sampled once; how finely shows in the error against the formula itself.

    python3 own_backend.py [FOLDER FOR PICTURES]
"""
import numpy as np

import treadmark as tm
from _pictures import save

base = tm.Surface.standard("60E1")


class Corrugated:
    """The head of a 60E1 with waves along the track: u is x [m], z grows downwards."""

    def __init__(self, wavelength=0.04, amplitude=30e-6):
        self.wavelength, self.amplitude = wavelength, amplitude

    def heights(self, u, y):
        return base.heights(0.0, y) + self.amplitude * np.cos(2 * np.pi * u / self.wavelength)


own = Corrugated()
same = base.with_defects(corrugations=[{"x_start_mm": -1000.0, "x_end_mm": 1000.0, "ramp_mm": 10.0, "waves": [{"wavelength_mm": 40.0, "amplitude_um": 30.0}]}])
x, y = np.meshgrid(np.linspace(-0.05, 0.05, 101), np.linspace(-0.02, 0.02, 41))
print("spacing [mm]   error of heights [um]")
errors = {}
for points in (21, 41, 81, 161):
    rail = tm.Surface.function(own, "rail", u=(-0.1, 0.1), y=(-0.032, 0.032), n_u=points, n_y=161)
    errors[200 / (points - 1)] = 1e6 * abs(rail.heights(x, y) - same.heights(x, y)).max()
    print(f"{200 / (points - 1):12.2f}   {errors[200 / (points - 1)]:10.4f}")
assert min(errors.values()) < 0.1 < 0.5 < max(errors.values())

wheel = tm.Surface.standard("S1002")
# What is sampled has no gauge point: both rails are placed by their origin.
settings = tm.Problem(vertical_force=80e3, speed=20.0, pitch_rate=-43.478, track__rail_y=0.7535, track__rail_z=0.0, track__cant=0.025, dx=1e-3, ds=1e-3)
stations = np.linspace(-0.02, 0.02, 9)
mine = [s.patches[0].pmax for s in tm.Pair(rail, wheel, settings).solve(s=stations)]
theirs = [s.patches[0].pmax for s in tm.Pair(same, wheel, settings).solve(s=stations)]
print("largest pressures agree to", f"{max(abs(np.array(mine) / theirs - 1)):.1e}")
assert np.allclose(mine, theirs, rtol=5e-3)


def draw(error, pressure):
    error.loglog(list(errors), list(errors.values()), "o-")
    error.set(title="Samples against the formula", xlabel="spacing [mm]", ylabel="error of heights [um]")
    pressure.plot(1e3 * stations, np.array(theirs) / 1e6, label="built in")
    pressure.plot(1e3 * stations, np.array(mine) / 1e6, "x", label="in Python")
    pressure.set(title="Largest pressure along the corrugation", xlabel="along the track [mm]", ylabel="[MPa]")
    pressure.legend()


save("own_backend.png", draw, panels=2)
