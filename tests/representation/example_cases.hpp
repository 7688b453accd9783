// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::testing {

/// examples/wheel-flat.toml at some of its pitch angles [degrees], each of which the file must have.
io::CaseFile wheel_flat_example(const std::vector<double>& pitch_deg);

io::WheelRailCase& wheel_rail(io::Case& c);

}  // namespace treadmark::testing
