// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// The parts of wheel and rail that the cases of a file can bring into contact: what has to be sampled.
struct SampledRegions {
  sampling::Region wheel, rail;
};

/// Wheel: angles round the lowest point of every case, as far as the contact search looks; from half a turn on the
/// whole wheel. Rail: positions along the track likewise. Without a wheel-rail case everything.
SampledRegions sampled_regions(const io::CaseFile& file);

}  // namespace treadmark::app
