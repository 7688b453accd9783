// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::testing {

/// A decaying oscillation of Q and T_y after an impact at t = 0.05 s, with contact lost before it, in `rows` instants
/// of 0.2 s; all parts of a result are filled.
io::SimulationResult sample_simulation(double speed, std::size_t rows = 2001);

/// Lines of a file.
std::vector<std::string> read_lines(const std::string& text);

}  // namespace treadmark::testing
