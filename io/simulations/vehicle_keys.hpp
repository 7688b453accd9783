// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/simulations/track_keys.hpp"
#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark::io {

/// Two bodies, and the points at which parts of one kind connect them.
struct Places {
  std::vector<std::string> between;
  std::vector<Vec3> points;
  std::vector<Places> several;  ///< in place of both
};

/// [[axles.bending]] and [[axles.torsion]].
struct AxleMode {
  double frequency = 0.0, damping_ratio = 0.0;  ///< [Hz], [-]
  double mass = 0.0;                            ///< modal mass [kg] or moment of inertia [kg m2]
  std::vector<double> shape, slope;             ///< of bending
  std::vector<double> rotation;                 ///< of torsion
};

/// The tables of vehicle files, with the keys of each.
const TableKeys& vehicle_tables();
const KeyTable<ModelHead>& vehicle_keys();
const KeyTable<BodySpec>& body_keys();
/// between and at_m as [[springs.places]] has them.
const KeyTable<Places>& place_keys();
/// All keys of [[springs]]; those of its places, and its own but for its name.
const TableKeys& spring_table_keys();
const KeyTable<Places>& spring_place_keys();
const KeyTable<SpringSpec>& spring_keys();
/// The same of [[bump_stops]].
const TableKeys& bump_stop_table_keys();
const KeyTable<Places>& bump_stop_place_keys();
const KeyTable<BumpStopSpec>& bump_stop_keys();
/// The same of [[damper_curves]], [[frictions]] and [[air_springs]].
const TableKeys& damper_curve_table_keys();
const KeyTable<Places>& damper_curve_place_keys();
const KeyTable<DamperCurveSpec>& damper_curve_keys();
const TableKeys& friction_table_keys();
const KeyTable<Places>& friction_place_keys();
const KeyTable<DryFrictionSpec>& friction_keys();
const TableKeys& air_spring_table_keys();
const KeyTable<Places>& air_spring_place_keys();
const KeyTable<AirSpringSpec>& air_spring_keys();
const KeyTable<WheelsetSpec>& wheelset_keys();
const KeyTable<FlexibleAxle>& axle_keys();
const KeyTable<AxleMode>& bending_keys();
const KeyTable<AxleMode>& torsion_keys();

}  // namespace treadmark::io
