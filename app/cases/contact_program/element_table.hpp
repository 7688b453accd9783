// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::app {

/// What the head of a .mat file says of a basic case.
io::MatFileHead mat_head(const io::BasicCase& input, int case_number);

/// The same of one patch (counted from 0) of a wheel on a rail.
io::MatFileHead mat_head(const io::WheelRailCase& input, const wheelrail::PairSolution& solution, std::size_t patch,
                         int case_number);

}  // namespace treadmark::app
