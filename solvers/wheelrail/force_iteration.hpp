// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/solvers/wheelrail/pair_step.hpp"

namespace treadmark::wheelrail {

/// Where prescribed forces were found, or why not.
struct Balance {
  Status status = Status::ok;
  std::string message;
  double z = 0.0;                       ///< wheelset height over the undeflected rail [m]
  double pitch_rate = 0.0;              ///< [rad/s]
  double rail_dy = 0.0, rail_dz = 0.0;  ///< deflection of a rail on springs [m]
  double stiffness = 0.0;               ///< vertical force / penetration^1.5 at the end [N/m^1.5]; 0 = no contact
  double end_slope = 0.0;               ///< how force^(2/3) grows at the end, over how it grew until then; 0 = unknown
  std::vector<std::pair<double, double>> iterations;  ///< (z [m], vertical force [N])
};

/// Puts the bodies where vertical force, longitudinal force and the rail's springs are in balance, as far as they are
/// prescribed, and solves the contact there. The pitch rate only acts on tractions, the height on everything, the
/// lateral deflection on the contact search as well: three loops inside one another, the cheapest innermost. Of a
/// single patch the height is no loop but an unknown of its normal problem. stiffness,
/// end_slope: as in Balance; known: of a balance, else stiffer than the contact may be.
Balance find_balance(PairStep& step, const Problem& right_hand_problem, double stiffness, double end_slope, bool known);

}  // namespace treadmark::wheelrail
