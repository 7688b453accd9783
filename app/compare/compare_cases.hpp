// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::app {

/// What is compared on the cases of a file.
struct CompareSettings {
  /// Representations; empty = all that the shapes allow.
  std::vector<std::string> backends;
  std::vector<double> resolutions{1e-3, 0.5e-3, 0.25e-3};  ///< [m]
  /// Bodies that take part in the comparison; the other one stays as it is given. automatic: those that change along
  /// their length (flats, defects, slices), both if neither does.
  enum class Bodies { automatic, wheel, rail, both };
  Bodies bodies = Bodies::automatic;
  /// Not empty: every one of these for the wheel with every one for the rail, instead of the same backend for both.
  std::vector<std::string> wheel_backends, rail_backends;
  /// Not empty: these detectors on the surfaces as they are given, in place of representations.
  std::vector<std::string> detectors;
  bool sample_surfaces = false;  ///< those of the reference become part of the result, for pictures
};

/// Solves the same cases with the surfaces as given (the reference) and in every representation at every resolution.
/// Formulas and data as given need no samples: "analytic", and "spline" for measured points, also appear once without a
/// resolution. A representation that cannot be built, or cases that cannot be solved with it, become a failure of that
/// candidate; promises of surfaces (backends/conformance/promises.hpp) that it breaks stand in the notes of its bodies.
/// Progress counts candidates times cases. Deterministic but for the times. Errors: those of the reference;
/// Error(configuration) for unknown backends or detectors, bad resolutions, or no wheel-rail case.
io::Comparison compare_cases(const io::CaseFile& file, const CompareSettings& settings, const Progress& progress = {});

}  // namespace treadmark::app
