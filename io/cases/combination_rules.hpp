// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

/// The setting to blame when settings of a case do not go together; readers turn it into a place in their file.
enum class CaseSetting {
  regime,
  normal_model,
  load,
  subsurface,
  friction,
  influence,
  material,
  elastic_constants,
  layer,
  grid,
  geometry,
  extra_slip,
  heat,
  force,
  reference_surface,
};

struct Contradiction {
  CaseSetting setting;
  std::string message, advice;
};

/// Settings that exclude each other or have no meaning together, in either file format; empty if all is well.
/// Values that are missing or out of range are not looked at here. Thread-safe.
std::vector<Contradiction> contradictions(const Case& c);
std::vector<Contradiction> contradictions(const WheelRailCase& c);
/// The same for a case and the one before it in its sequence.
std::vector<Contradiction> contradictions(const Case& previous, const Case& next);

/// How far surfaces move through the contact from one case of transient rolling to the next [m].
struct RolledStep {
  double moved = 0.0;    ///< along the track, or round the wheel
  double rolled = 0.0;   ///< rolling step of the solver
  double longest = 0.0;  ///< beyond that distance histories do not fit: two elements, dt = 2 dx/V
  bool too_long() const { return moved > longest * (1.0 + 1e-9); }
  /// What does not fit, in words; empty if all is well or nothing moves.
  std::string complaint() const;
};
/// What a case takes over from the one before it is not quite what was there, in words; empty if all is well.
std::string doubt_about_history(const Case& previous, const Case& next);
/// A wheel that is meant to roll and does not move, in words; empty if it moves.
std::string doubt_about_motion(const Case& c);
/// None unless next is transient rolling of a wheel on a rail that goes on from previous.
std::optional<RolledStep> rolled_step(const Case& previous, const Case& next);

}  // namespace treadmark::io
