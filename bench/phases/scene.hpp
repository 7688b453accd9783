// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>

#include "treadmark/detection/contact_search.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::bench {

/// The generated wheel flat (S1002, 160 mm x 1.4 mm, off-centre) on 60E1, 125 kN, at a pitch angle on the flank of the flat.
struct Scene {
  wheelrail::Geometry geometry;
  wheelrail::Problem problem;
  wheelrail::PairSolution solution;    ///< solved once
  detection::BodyPair bodies;          ///< placed as solved
  detection::SearchSettings search;
};

/// backend: of the wheel, "analytic" or "spline".
const Scene& scene(std::string_view backend);

/// Normal or whole problem of the scene's patch.
kalker::ContactProblem patch_problem(const Scene& scene);

}  // namespace treadmark::bench
