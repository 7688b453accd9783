// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <string>
#include <vector>

#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark::io {

/// What holds a model from outside, for the check that springs hold the rest.
struct Foundation {
  std::string name;                    ///< for messages: "the wheelsets", "the ground"
  std::vector<std::string> bodies;     ///< where chains of springs may end; kGround among them: there too
  std::array<bool, kFreedoms> held{};  ///< directions in which these bodies need no spring
};

/// Checks that springs hold every body in every direction in which it is free: a chain of springs must connect it with
/// the foundation, and the stiffness matrix of all of them at rest must not have a mechanism. Dampers and bump stops
/// hold nothing, dry friction holds as the spring as which it sticks. Errors: Error(configuration) at the body, which
/// is named.
void check_held(const std::vector<BodySpec>& bodies, const std::vector<SpringSpec>& springs,
                const Foundation& foundation);

}  // namespace treadmark::io
