// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/patch_memory.hpp"

namespace treadmark::wheelrail {

/// What Pair::save() keeps.
class Pair::State {
 public:
  Instant previous, last;  ///< the instant before the last solution, and what it left
  Side side = Side::right;
};

/// What Pair::save() gave as bytes of this machine's order; Pair::restore() of what is read from them, in any process,
/// into a pair of the same geometry goes on to the same bits. A format number comes first.
void write(const std::shared_ptr<const Pair::State>& state, ByteWriter& out);

/// Never null. Errors: Error(input_data) for another format and for bytes that are no state.
std::shared_ptr<const Pair::State> read_state(ByteReader& in);

}  // namespace treadmark::wheelrail
