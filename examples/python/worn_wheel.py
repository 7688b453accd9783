# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""A profile of one's own: how worn is it, and how does it run? A wheel with a hollow tread, from its file.

    python3 worn_wheel.py [FOLDER FOR PICTURES]
"""
import numpy as np

import treadmark as tm
from _pictures import FOLDER, save

# What an instrument would have written: S1002 whose tread lost up to 1.5 mm.
y = np.linspace(-70e-3, 60e-3, 651)
new = tm.Surface.standard("S1002").section(0.0, y)
worn = new - 1.5e-3 * np.exp(-(((y - 2e-3) / 18e-3) ** 2))
FOLDER.mkdir(parents=True, exist_ok=True)
file = FOLDER / "worn_wheel.csv"
np.savetxt(file, 1e3 * np.stack([y, worn], axis=1), fmt="%.4f", delimiter=";", header="y_mm;z_mm", comments="")

# First what was understood of it, then what is left of it ...
understood = dict(tm.check(file, body="wheel").profiles[0].facts)
for name in ("kind", "unit", "z", "flange", "flange back"):
    print(f"{name}: {understood[name]}")
measured = tm.measure("wheel", file, nominal="S1002")
for name in ("flange_height", "flange_thickness", "hollow", "tread_wear"):
    number = measured.numbers[name]
    print(f"{number.meaning}: {1e3 * number.value:.2f} ± {1e3 * number.uncertainty:.2g} mm {number.reason}")
# ... and how it runs, beside a new one.
wheels = {"new": "S1002", "worn": file}
found = {name: tm.geometry(wheel, "60E1", gauge=1.435, cant="1:40") for name, wheel in wheels.items()}
for name, geometry in found.items():
    print(f"{name}: conicity {geometry.conicity_3mm:.3f} at 3 mm, contact covers {1e3 * geometry.contact_spread_wheel:.1f} mm of the wheel")
assert abs(measured.numbers["tread_wear"].value - 1.5e-3 * np.exp(-((2 / 18) ** 2))) < 0.05e-3
assert found["worn"].conicity_3mm > found["new"].conicity_3mm


def draw(difference, conicity):
    for name, geometry in found.items():
        difference.plot(1e3 * geometry.functions["y"], 1e3 * geometry.functions["delta_r"], label=name)
        conicity.plot(1e3 * geometry.conicity.amplitude, geometry.conicity.tan_gamma_e, label=name)
    difference.set(title="Difference of rolling radii", xlabel="shift [mm]", ylabel="[mm]", xlim=(-8, 8), ylim=(-6, 6))
    conicity.set(title="Equivalent conicity", xlabel="amplitude [mm]", ylim=(0, None))
    difference.legend()
    conicity.legend()


save("worn_wheel.png", draw, panels=2)
