# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Where a wheelset stands, from what was measured: its lateral position and yaw from the lateral force and the place of contact, found by SciPy
with derivatives from Pair.gradient.

    python3 find_position.py
"""
import numpy as np

import treadmark as tm

try:
    from scipy.optimize import least_squares
except ImportError:
    print("this needs SciPy, which is not installed (Debian: python3-scipy)")
    raise SystemExit(0) from None

pair = tm.Pair(tm.Surface.standard("60E1"), tm.Surface.standard("S1002", nominal_radius=0.46),
               tm.Problem(vertical_force=80e3, speed=20.0, pitch_rate=-43.478, cant="1:40", dx=1e-3, ds=1e-3, set={"solver.tolerance": 1e-8}))
names, quantities, sizes = ["y_mm", "yaw"], ["fy_tr", "y_tr"], np.array([1e3, 1e-3])  # [mm], [rad]; of differences that matter: [N], [m]
scale = np.array([1.0, 1e-3])
true = np.array([2.0, 3e-3])
measured = np.array([pair.gradient(name, names, y=1e-3 * true[0], yaw=true[1]).value for name in quantities])


def asked(x):
    """Both quantities with their derivatives at a position."""
    return [pair.gradient(name, names, y=1e-3 * x[0] * scale[0], yaw=x[1] * scale[1]) for name in quantities]


found = least_squares(lambda x: (np.array([g.value for g in asked(x)]) - measured) / sizes, x0=[1.5, 0.0],
                      jac=lambda x: np.array([g.by * scale for g in asked(x)]) / sizes[:, None])
position = found.x * scale
print(f"y = {position[0]:.4f} mm, yaw = {1e3 * position[1]:.4f} mrad after {found.nfev} instants")
assert np.allclose(position, true, rtol=1e-3)
