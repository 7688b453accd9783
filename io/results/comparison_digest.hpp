// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// One candidate in a few numbers, in SI units. NaN where nothing was measured.
struct CandidateDigest {
  double height_max, height_rms, slope_max, curvature_max;     ///< the worse of wheel and rail [m], [rad], [1/m]
  double pmax_error, area_error, force_error, position_error;  ///< largest size over the comparable cases [-], [m]
  double search_s, distance_s;                                 ///< mean per case [s]
  double build_s = 0.0;                                        ///< wheel and rail together [s]
  std::size_t memory_bytes = 0;                                ///< wheel and rail together
  int ok = 0, total = 0;                                       ///< cases
};

/// Values that are not finite are passed over in means and maxima. Thread-safe, like all functions here.
CandidateDigest digest(const ComparisonCandidate& candidate);

/// "mesh 0.5 mm"; without the resolution where it is 0 or not finite.
std::string candidate_label(const ComparisonCandidate& candidate);

/// The same, and " (truth)" for the first candidate.
std::string candidate_label(const Comparison& comparison, std::size_t index);

}  // namespace treadmark::io
