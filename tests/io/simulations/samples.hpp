// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "treadmark/tests/support/refusal.hpp"

namespace treadmark::io::samples {

/// A wheelset that moves freely below a guided mass.
inline const std::string kVehicle = R"([vehicle]
name = "small"

[[bodies]]
name = "mass"
mass_kg = 9000
position_m = [0, 0, -1]
free = ["z"]

[[bodies]]
name = "axle"
mass_kg = 1800
inertia_kg_m2 = [1100, 110, 1100]
position_m = [0, 0, -0.46]
free = ["x", "y", "z", "roll", "pitch", "yaw"]

[[springs]]
name = "primary"
between = ["axle", "mass"]
at_m = [[0, -1, -0.46], [0, 1, -0.46]]
stiffness_N_per_m = [30e6, 4e6, 1.2e6]
damping_N_s_per_m = [0, 0, 4e3]
damper_stiffness_N_per_m = [0, 0, 1e6]

[[bump_stops]]
name = "stop"
between = ["axle", "mass"]
at_m = [[0, 0, -0.6]]
direction = "y"
displacement_mm = [25, 30]
force_N = [0, 600]

[[wheelsets]]
body = "axle"
nominal_radius_mm = 460
)";

/// The same with a wheelset that bends and twists, from line 36 on.
inline const std::string kWithAxle = kVehicle + R"(axle = "shaft"

[[axles]]
name = "shaft"
wheel_distance_mm = 1500
wheel_polar_inertia_kg_m2 = 50
places_mm = [-1000, -750, 750, 1000]

[[axles.bending]]
frequency_Hz = 80
damping_ratio = 0.01
modal_mass_kg = 300
shape = [1, 0.2, 0.2, 1]
slope_per_m = [-3, -2, 2, 3]

[[axles.torsion]]
frequency_Hz = 60
modal_inertia_kg_m2 = 102
wheel_rotation = [-1, 1]
)";

inline const std::string kTrack = R"([track]
name = "springs"
rails = ["left", "right"]

[[bodies]]
name = "left"
mass_kg = 80
position_m = [0, -0.75, 0.1]
free = ["y", "z"]

[[bodies]]
name = "right"
mass_kg = 80
position_m = [0, 0.75, 0.1]
free = ["y", "z"]

[[springs]]
name = "pad"
stiffness_N_per_m = [0, 30e6, 160e6]
damping_N_s_per_m = [0, 150e3, 190e3]
places = [{ between = ["ground", "left"], at_m = [[0, -0.75, 0.17]] }, { between = ["ground", "right"], at_m = [[0, 0.75, 0.17]] }]
)";

inline const std::string kSimulation = R"(title = "A flat"

[simulation]
vehicle = "vehicle.toml"
track = "track.toml"
speed_m_s = 20
distance_m = 3

[[simulation.wheels]]
wheelset = 1
side = "left"
contact = "full"
pitch_deg = 30

[case]
regime = "transient"

[wheel]
shape.standard = "S1002"
flats = [{ length_mm = 60, depth_mm = 0.9 }]

[rail]
shape.standard = "60E1"

[track]
cant = "1:40"

[discretisation]
dx_mm = 0.5
)";

/// The text with the first occurrence of one part replaced, which must be there.
inline std::string with(std::string text, const std::string& part, const std::string& other) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), other);
}

/// What an action says is wrong.
template <class Action>
std::string error_of(Action action) {
  return treadmark::testing::refusal_of(action, ErrorKind::configuration);
}

}  // namespace treadmark::io::samples
