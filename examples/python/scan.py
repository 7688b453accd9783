# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""From points of a scanner to a surface that carries a wheel.

The scan is made up: a worn rail with a squat, with noise. A real one is a file as well (.xyz .ply .las .e57 ...).

    python3 scan.py [FOLDER FOR PICTURES]
"""
import pathlib
import tempfile

import numpy as np

import treadmark as tm
from _pictures import save

truth = tm.Surface.standard("60E1").with_defects(squats=[{"length_mm": 40.0, "width_mm": 30.0, "depth_mm": 0.5, "x_center_mm": 80.0}])
random = np.random.default_rng(1)
x, y = np.meshgrid(np.arange(0.0, 0.16, 0.8e-3), np.linspace(-0.034, 0.034, 130))
z = truth.heights(x, y) + 3e-6 * random.normal(size=x.shape)

with tempfile.TemporaryDirectory() as folder:
    scan, made = pathlib.Path(folder) / "scan.xyz", pathlib.Path(folder) / "rail.slcs"
    np.savetxt(scan, 1e3 * np.column_stack([x.ravel(), y.ravel(), z.ravel()]), fmt="%.5f")
    audit = tm.import_scan(scan, made, set={"scan.body": "rail", "scan.unit": "mm", "fit.resolution_mm": 1.0})
    rail = tm.Surface.read(made, "rail")

fitted = audit.maps["fitted"]
print(audit.summary().splitlines()[0])
print(f"deepest place {-1e3 * np.nanmin(fitted.values):.3f} mm")
assert abs(np.nanmin(fitted.values) + 0.5e-3) < 0.05e-3

row = np.unravel_index(np.nanargmin(fitted.values), fitted.values.shape)[0]
middle = np.linspace(fitted.a_min, fitted.a_max, len(fitted.values))[row]
pair = tm.Pair(rail, tm.Surface.standard("S1002"), tm.Problem(vertical_force=80e3, speed=20.0, pitch_rate=-43.478, track__cant=0.025, track__rail_y=0.7535, dx=1e-3, ds=1e-3))
solution = pair.solve(s=middle)
print(solution, *solution.patches, sep="\n")
assert solution.ok


def draw(damage, pressure):
    shown = damage.imshow(1e3 * fitted.values.T, extent=(1e3 * fitted.a_min, 1e3 * fitted.a_max, 1e3 * fitted.s_min, 1e3 * fitted.s_max), aspect="auto", origin="lower")
    damage.set(title="Distance from the section [mm]", xlabel="along the track [mm]", ylabel="along the section [mm]")
    damage.figure.colorbar(shown, ax=damage)
    for patch in solution.patches:
        pressure.contourf(1e3 * patch.x + 1e3 * patch.x_tr, 1e3 * (patch.s + patch.y_tr), patch.pressure / 1e6, 12)
    pressure.set(title="Pressure of a wheel over the squat", xlabel="x [mm]", ylabel="y of the track [mm]", aspect="equal")


save("scan.png", draw, panels=2)
