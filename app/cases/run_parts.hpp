// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "treadmark/app/cases/noise_of_results.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::app {

/// What runs of few cases and of long lists share.

/// The surfaces of a case, read and built. Errors: those of the store.
wheelrail::Geometry geometry_of(const io::WheelRailCase& input, SurfaceStore& store, const SampledRegions& all);

/// A result that says where it comes from, without cases.
io::RunResult head_of(const io::CaseFile& file);

/// The case of the file that each result is of.
std::vector<const io::Case*> solved_cases(const io::CaseFile& file, const io::RunResult& run);

/// What is to be said of results on surfaces that are there, and what noise of measured profiles leaves uncertain. The
/// arguments of the constructor must outlive it, and nobody else may use the store meanwhile. Thread-safe.
class ResultNotes {
 public:
  ResultNotes(const ProfilesOfRun& profiles, SurfaceStore& store) : profiles_(profiles), store_(store) {}

  /// given: the case, or another one with its surfaces whose profiles were judged in its stead.
  void add(const io::Case& given, const io::Case& c, io::CaseResult& result);

 private:
  const ProfilesOfRun& profiles_;
  std::mutex mutex_;
  SurfaceStore& store_;
  SurfaceDoubts doubted_;
  std::map<std::pair<const NaturalSurface*, const NaturalSurface*>, NoiseOfResults> pairs_;
};

}  // namespace treadmark::app
