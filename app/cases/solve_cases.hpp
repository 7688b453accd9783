// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::app {

/// The cases of a file over surfaces that are there: geometries has one entry a case, none for patches by themselves.
/// What run_cases does but for the surfaces, which the result does not name. Errors as run_cases.
io::RunResult solve_cases(const io::CaseFile& file, const std::vector<std::optional<wheelrail::Geometry>>& geometries,
                          const Progress& progress = {});

}  // namespace treadmark::app
