// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

/// The setting to blame when settings of a case do not go together; readers turn it into a place in their file.
enum class CaseSetting {
  regime, normal_model, load, subsurface, friction, influence, material, elastic_constants, layer, grid, geometry, extra_slip,
  heat,
};

struct Contradiction {
  CaseSetting setting;
  std::string message, advice;
};

/// Settings that exclude each other or have no meaning together, in either file format; empty if all is well.
/// Values that are missing or out of range are not looked at here. Thread-safe.
std::vector<Contradiction> contradictions(const Case& c);
/// The same for a case and the one before it in its sequence.
std::vector<Contradiction> contradictions(const Case& previous, const Case& next);

}  // namespace treadmark::io
