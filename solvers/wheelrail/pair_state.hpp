// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/patch_memory.hpp"

namespace treadmark::wheelrail {

class Pair::State {
 public:
  Instant previous, last;  ///< the instant before the last solution, and what it left
  Side side = Side::right;
};

}  // namespace treadmark::wheelrail
