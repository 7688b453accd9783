// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/model/remarks.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::wheelrail {

/// Appends a remark for every number of a problem that no railway has, though it can be solved for: a load in kN, a
/// gauge in metres, a diameter for a radius. Thread-safe.
void judge_values(const Problem& problem, std::vector<Remark>& remarks);

/// The limits as a Markdown table, for the documentation.
std::string usual_value_table();

}  // namespace treadmark::wheelrail
