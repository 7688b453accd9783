// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
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

/// A solver's state as bytes; null stays null. They bear no format number: whoever writes them into something larger
/// gives it one.
void write(const std::shared_ptr<const ContactSolver::State>& state, ByteWriter& out);

/// Errors: Error(input_data) for bytes that are no state.
std::shared_ptr<const ContactSolver::State> read_solver_state(ByteReader& in);

}  // namespace treadmark::kalker
