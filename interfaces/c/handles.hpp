// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "treadmark/app/cases/basic_case.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

// What stands behind the types of treadmark.h.

struct tm_case {
  std::shared_ptr<treadmark::io::Case> content;  ///< shared with solutions: copied before it changes
  std::filesystem::path folder;                  ///< from which relative paths count
  mutable bool checked = false;                  ///< since the last change
};

struct tm_surface {
  std::shared_ptr<const treadmark::NaturalSurface> natural;
  treadmark::RepresentedSurface represented;
};

struct tm_pair {
  treadmark::wheelrail::Geometry geometry;
  treadmark::wheelrail::Pair pair;
  double wheel_radius = 0.0, roller_radius = 0.0;  ///< of the surfaces [m]; 0 = unknown, no roller
  mutable std::vector<double> samples = {};        ///< heights of rail and wheel [m], by which states know them
};

struct tm_patch {
  treadmark::app::BasicSequence sequence;
};

struct tm_state {
  std::shared_ptr<const treadmark::wheelrail::Pair::State> state;
  std::vector<double> samples;  ///< of its pair
};

struct tm_solution {
  std::shared_ptr<const treadmark::io::Case> input;
  std::optional<treadmark::wheelrail::PairSolution> pair;  ///< of a wheel on a rail; its texts are lent
  std::optional<treadmark::io::CaseResult> result;         ///< of a pair: once results are asked for
  treadmark::wheelrail::Geometry geometry = {};            ///< of a pair: of what it is a solution
};

namespace treadmark::c {

/// Made from the solution of the pair when it is first asked for: a program that wants forces only does not pay for it.
io::CaseResult& result_of(tm_solution* s);

}  // namespace treadmark::c
