// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "treadmark/io/results/result_model.hpp"
#include "treadmark/model/origin.hpp"
#include "treadmark/model/shape/surface_difference.hpp"

namespace treadmark::io {

/// The same cases through several surface representations, as plain data in SI units.

/// How one body is represented in one candidate.
struct RepresentedBody {
  std::string backend;
  double resolution = 0.0;       ///< data spacing [m]; 0 = as given, not sampled again
  double build_seconds = 0.0;    ///< of this representation, from surface to surface
  std::size_t memory_bytes = 0;  ///< of the surface
  SurfaceDifference difference;  ///< from the reference; points = 0 where it was not measured
  std::string note;              ///< repairs, limits; may be empty
};

/// Number of one case in one candidate; errors are against the reference's same case.
struct ComparisonRow {
  int case_number = 0;  ///< as CaseResult::number
  Status status = Status::ok;
  std::string message;
  int patches = 0;  ///< all of them; the numbers down to ncon are those of the one that carries most of the load
  double pmax = 0.0, fn = 0.0, fx = 0.0, fs = 0.0;  ///< [Pa], [N]
  double x_tr = 0.0, y_tr = 0.0;                    ///< contact reference [m]
  double approach = 0.0, area = 0.0;                ///< [m], [m^2]
  int ncon = 0;                                     ///< elements in contact
  double search_s = 0.0, distance_s = 0.0;          ///< [s]
  bool comparable = false;  ///< the reference has contact in this case too: the errors below hold
  /// Relative, (p - p_ref)/p_ref; NaN where the reference's has no limit (RemarkKind::edge_pressure).
  double pmax_error = 0.0;
  double pmax_sigmas = NAN;  ///< the same over the standard deviation of the reference's; NaN where that is not known
  double mean_pressure_error = 0.0;               ///< relative, of fn / area
  double area_error = 0.0, approach_error = 0.0;  ///< relative
  double force_error = 0.0;                       ///< |F - F_ref|/|F_ref| of all patches together
  double position_error = 0.0;                    ///< distance of the references in the track's x-y plane [m]
};

/// All cases in one representation.
struct ComparisonCandidate {
  std::string name;         ///< as asked for, for example "mesh"
  double resolution = 0.0;  ///< [m]; 0 = as given
  RepresentedBody wheel, rail;
  std::string failure;                   ///< not empty: could not be built or solved, why; then there are no rows
  std::vector<ComparisonRow> rows;       ///< one per case, in order
  std::vector<CaseResult> results;       ///< with fields, for pictures
  std::vector<SampledSurface> surfaces;  ///< of the reference only, where asked for

  /// False where the surfaces are as given.
  bool has_resolution() const { return std::isfinite(resolution) && resolution > 0.0; }
};

/// The reference and all candidates, with where they come from.
struct Comparison : Origin {
  int threads = 1;       ///< that the comparison was allowed
  double seconds = 0.0;  ///< wall clock of it all [s]
  std::string truth;     ///< which candidate the others are measured against, in words: "analytic" ...
  bool complete = true;  ///< false when interrupted
  std::vector<ComparisonCandidate> candidates;  ///< the reference first
};

/// One candidate in a few numbers, in SI units. NaN where nothing was measured.
struct CandidateDigest {
  double height_max, height_rms, slope_max, curvature_max;  ///< the worse of wheel and rail [m], [rad], [1/m]
  /// Largest size over the comparable cases [-], [m].
  double pmax_error, mean_pressure_error, area_error, force_error, position_error;
  double search_s, distance_s;   ///< mean per case [s]
  double build_s = 0.0;          ///< wheel and rail together [s]
  std::size_t memory_bytes = 0;  ///< wheel and rail together
  int ok = 0, total = 0;         ///< cases
};

/// Values that are not finite are passed over in means and maxima. Thread-safe, like all functions here.
CandidateDigest digest(const ComparisonCandidate& candidate);

/// The pressure by which candidates are judged.
struct JudgedPressure {
  const char* name;                ///< "pmax"
  const char* words;               ///< "largest pressure"
  double CandidateDigest::*error;  ///< its error
};

/// The largest, or the mean where the largest has no limit in any case.
JudgedPressure judged_pressure(const Comparison& comparison);

/// Numbers of the cases in which the reference's largest pressure has no limit, increasing.
std::vector<int> cases_without_limit(const Comparison& comparison);

/// "mesh 0.5 mm"; without the resolution where it is 0 or not finite.
std::string candidate_label(const ComparisonCandidate& candidate);

/// The same, and " (reference)" for the first candidate.
std::string candidate_label(const Comparison& comparison, std::size_t index);

}  // namespace treadmark::io
