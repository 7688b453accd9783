// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::testing {

/// Expects everything that files of results hold to be equal to the last bit, NaN to NaN. Wall-clock times of cases
/// only if asked for.
void expect_same_run(const io::RunResult& read, const io::RunResult& written);
void expect_same_case(const io::CaseResult& read, const io::CaseResult& written, bool seconds = true);
void expect_same_surface(const io::SampledSurface& read, const io::SampledSurface& written);

/// A wheel of three stations and two points across, with a missing point and deviations, and a rail without.
std::vector<io::SampledSurface> sample_surfaces();

}  // namespace treadmark::testing
