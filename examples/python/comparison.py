# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The same contact with the wheel in several representations: what do samples cost in accuracy?

    python3 comparison.py [FOLDER FOR PICTURES]
"""
import treadmark as tm
from _pictures import FOLDER, save

case = {
    "rail.shape.standard": "60E1",
    "wheel": {"shape.standard": "S1002", "flats": [{"length_mm": 60.0, "depth_mm": 0.9, "y_center_mm": 0.0}]},
    "track.cant": "1:40",
    "wheelset": {"vertical_force_N": 80e3, "velocity_m_s": 10.0, "vpitch_rad_s": -21.739, "pitch_deg": -2.0},
    "discretisation": {"dx_mm": 1.0, "ds_mm": 1.0},
}
compared = tm.compare(case, backends=["analytic", "spline", "nurbs"], resolutions=[4e-3, 2e-3])
print(compared.table())
worst = max(abs(row.get("pmax_error_percent") or 0.0) for row in compared.rows())
assert compared.complete and worst < 5.0, worst
FOLDER.mkdir(parents=True, exist_ok=True)
(FOLDER / "comparison.svg").write_text(compared.svg("pressures"))


def draw(axes):
    for backend in ("spline", "nurbs"):
        rows = [row for row in compared.rows() if row["backend"] == backend and row["resolution_mm"]]
        axes.loglog([row["resolution_mm"] for row in rows], [abs(row["pmax_error_percent"]) for row in rows], "o-", label=backend)
    axes.set(title="Error of the largest pressure", xlabel="spacing of the samples [mm]", ylabel="[%]")
    axes.legend()


save("comparison.png", draw)
