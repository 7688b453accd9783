// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"
#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"

namespace treadmark::kalker {

class ContactSolver::State {
 public:
  ContactHistory previous, last;  ///< the instant before the last one, and the last one
  NormalStart normal;
  std::vector<NormalStart> sub_patches;
  std::optional<TangentialStart> tangential;
};

}  // namespace treadmark::kalker
