# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""A wheel flat under load: pressures and normal force as the flat rolls into the contact.

    python3 wheel_flat.py [FOLDER FOR PICTURES]
"""
import numpy as np

import treadmark as tm
from _pictures import save

rail = tm.Surface.standard("60E1")
wheel = tm.Surface.standard("S1002", nominal_radius=0.49).with_flat(length=0.160, depth=1.4e-3, y=6e-3, width=60e-3)
pair = tm.Pair(rail, wheel, tm.Problem(nominal_radius=0.49, vertical_force=125e3, speed=2.0, pitch_rate=-4.0819, track__cant=0.025, dx=1e-3, ds=1e-3))

# An array makes one problem a value; they are solved in parallel.
angles = np.radians([-14, -10, -8, -6, -4, -2, 0])
solutions = pair.solve(pitch=angles)
print(" angle    height  patches  largest pressure")
for angle, solution in zip(angles, solutions):
    peak = max(patch.pmax for patch in solution.patches)
    print(f"{np.degrees(angle):6.0f}  {1e3 * solution.z:6.3f} mm  {len(solution.patches):7}  {peak / 1e6:8.0f} MPa")
assert all(solution.ok for solution in solutions)
assert max(solution.z for solution in solutions) - solutions[0].z > 0.4e-3  # the wheel comes down into its flat


def draw(*axes):
    for panel, k in zip(axes, (0, 3, 6)):
        for patch in solutions[k].patches:
            shown = panel.pcolormesh(1e3 * (patch.x + patch.x_tr), 1e3 * (patch.s + patch.y_tr), np.where(patch.pressure > 0, patch.pressure / 1e6, np.nan),
                                     vmin=0, vmax=1500, shading="nearest")
        panel.set(title=f"{np.degrees(angles[k]):.0f} degrees from the flat's middle", xlabel="x [mm]", ylabel="y of the track [mm]", aspect="equal")
    panel.figure.colorbar(shown, ax=list(axes), label="pressure [MPa]")


save("wheel_flat.png", draw, panels=3)
