// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <variant>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::fuzz {

inline constexpr int kMostElements = 400, kMostCases = 3, kMostIterations = 200;

/// Makes a solution of the case cheap; false: it is large by its nature, or reads files.
inline bool make_small(io::BasicCase& patch) {
  patch.solver.max_iterations = std::min(patch.solver.max_iterations, kMostIterations);
  std::size_t points = 0;
  for (const auto& block : patch.subsurface.blocks) points += block.z.size();
  return patch.mx * patch.my <= kMostElements && points < 5 && patch.influence.file.empty();
}

inline bool make_small(io::WheelRailCase& c) {
  constexpr double kLeastSize = 1e-3;  // [m]
  c.solver.max_iterations = std::min(c.solver.max_iterations, kMostIterations);
  c.discretisation.max_elements = std::min(c.discretisation.max_elements, kMostElements);
  const auto small = [](const io::SurfaceSource& source) {
    return !std::holds_alternative<io::GeometryFile>(source.geometry) && source.parts.empty() && source.backend.empty();
  };
  return c.discretisation.dx >= kLeastSize && c.discretisation.ds >= kLeastSize && c.subsurface.blocks.empty() &&
         c.influence.file.empty() && small(c.rail) && small(c.wheel);
}

/// Solves what was read, if it is small. An Error is a fair answer; a result that says ok must be finite.
inline void run_if_small(io::CaseFile file) {
  if (file.cases.size() > kMostCases) return;
  for (io::Case& c : file.cases)
    if (!std::visit([](auto& content) { return make_small(content); }, c.content)) return;
  for (const io::CaseResult& c : app::run_cases(file).cases) {
    if (c.status != Status::ok) continue;
    for (const io::PatchResult& p : c.patches) {
      bool sound = true;
      for (const double v : {p.fn, p.fx, p.fs, p.mn, p.approach, p.pmax}) sound = sound && std::isfinite(v);
      for (const double v : p.fields.pressure) sound = sound && std::isfinite(v) && v >= 0.0;
      for (const auto* field : {&p.fields.traction_x, &p.fields.traction_s})
        for (const double v : *field) sound = sound && std::isfinite(v);
      if (!sound) std::abort();
    }
  }
}

}  // namespace treadmark::fuzz
