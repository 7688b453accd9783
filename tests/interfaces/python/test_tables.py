# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Tables of forces."""
import numpy as np
import pytest

import treadmark as tm

pytestmark = pytest.mark.skipif(not tm.parts()["vehicle"], reason="this build has no vehicles")

SMALL = {"lateral_range_mm": 2, "step_mm": 1, "element_mm": 1, "roll_intervals": 0, "yaw_mrad": 10, "yaw_intervals": 1, "creep_forces": "linear",
         "check_points": 3}
MOTION = dict(yaw=2e-3, vx=20.0, vpitch=-43.5)


@pytest.fixture(scope="module")
def table():
    wheel, rail = tm.Surface.standard("S1002", "wheel", nominal_radius=0.46), tm.Surface.standard("60E1", "rail")
    pair = tm.Pair(rail, wheel, tm.Problem(nominal_radius=0.46, vertical_force=80e3, speed=20.0, pitch_rate=-43.5, set={"track.cant": "1:40"}))
    return tm.ForceTable.of_pair(pair, set=SMALL)


def test_forces_are_arrays(table):
    forces = table.forces(y=[[0.0, 0.5e-3], [-1e-3, 1e-3]], vertical_load=70e3, **MOTION)
    assert list(forces) == [name for name, _, _ in tm.ForceTable.force_numbers]
    assert forces["rail_fz"].shape == (2, 2) and forces["rail_fz"] == pytest.approx(70e3)
    one = table.forces(y=0.5e-3, z=float(forces["z"][0, 1]), **MOTION)
    assert one["normal_force"] == pytest.approx(forces["normal_force"][0, 1], rel=1e-9)
    assert table.forces(z=-1e-3, **MOTION)["normal_force"] == 0.0


def test_outside_there_is_nothing(table):
    with pytest.warns(tm.ConvergenceWarning, match="aside"):
        forces = table.forces(y=[0.0, 5e-3], vertical_load=70e3, **MOTION)
    assert np.isfinite(forces["fx"][0]) and np.isnan(forces["fx"][1])
    with pytest.raises(tm.InputError, match="knows no 'speed'"):
        table.forces(speed=20.0)
    with pytest.raises(tm.InputError, match="fit"):
        table.forces(y=[0.0, 1e-3], yaw=[0.0, 1e-3, 2e-3])


def test_files_and_errors(table, tmp_path):
    assert set(table.errors) == {"z", "normal_force", "fx", "fy", "spin_moment", "t_gamma"}
    assert all(0.0 < error.rms <= error.worst for error in table.errors.values())
    table.write(tmp_path / "t.json")
    again = tm.ForceTable.read(tmp_path / "t.json")
    assert again.errors == table.errors
    assert again.forces(vertical_load=70e3, **MOTION)["fx"] == table.forces(vertical_load=70e3, **MOTION)["fx"]
    with pytest.raises(tm.InputError):
        tm.ForceTable.read(tmp_path / "t.csv")
