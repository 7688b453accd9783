// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/slice_net.hpp"
#include "treadmark/core/slices.hpp"

namespace treadmark::spline {

/// Points of one slice at the positions first .. first + points.size() - 1 (counted from 0); the others are missing.
struct SampledSlice {
  int first = 0;
  std::vector<NetPair> points;
};

struct SampledSlices {
  int positions = 0;
  std::vector<SampledSlice> slices;
};

/// See fit_slices.
SampledSlices sample_slices(const SliceSet& slices);

}  // namespace treadmark::spline
