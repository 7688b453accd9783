// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/app/report/pages/json_tree.hpp"

namespace treadmark::app::report {

/// What a comparison file says about one representation, in the units of the file. NaN where nothing was measured.
struct ComparedCandidate {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string backend, label;    ///< "mesh", "mesh 0.5 mm"
  std::string failure;           ///< why it could not be built or solved; empty if it could
  double resolution_mm = kNone;  ///< NaN: the data as given
  JsonTree wheel, rail;
  std::vector<std::optional<JsonTree>> rows;  ///< of each case of the comparison; nothing where it is missing
  // the largest in size over the cases
  double pmax_error_percent = kNone, area_error_percent = kNone, force_error_percent = kNone, position_error_mm = kNone;
  double mean_search_s = kNone, mean_distance_s = kNone;  ///< per case
  // of wheel and rail the worse, and their sums
  double height_max_um = kNone, height_rms_um = kNone, slope_max_mrad = kNone, curvature_max_per_m = kNone;
  double build_s = kNone, memory_bytes = kNone;
  std::size_t ok = 0, solved = 0;  ///< cases that ended as "ok", and all that have a row

  double mean_seconds() const { return mean_search_s + mean_distance_s; }
  double memory_MB() const { return 1e-6 * memory_bytes; }
  bool as_given() const { return !(resolution_mm > 0.0); }
};

struct ComparedCandidates {
  std::vector<int> cases;                     ///< numbers, increasing
  std::vector<ComparedCandidate> candidates;  ///< the truth first

  const ComparedCandidate* truth() const { return candidates.empty() ? nullptr : &candidates.front(); }
};

/// Candidates and rows of a comparison file. Errors: Error(input_data) for missing keys, and for rows that belong to no
/// candidate.
ComparedCandidates read_compared(const JsonTree& comparison);

}  // namespace treadmark::app::report
