// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/study_model.hpp"
#include "treadmark/model/damage/fatigue.hpp"
#include "treadmark/model/damage/flow_law.hpp"
#include "treadmark/model/damage/wear_law.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io {

/// A body that evolves. SI.
struct EvolvingBody {
  Body body = Body::wheel;
  double amount = 0.0;  ///< distance that a wheel rolls [m], or wheels that pass over a rail
  bool local = false;   ///< every place by itself; else the same all along
  double du = 1e-3, dy = 0.5e-3, smoothing = 1e-3;  ///< [m]
  WearLaw law;
  FatigueSettings fatigue;
  FlowLaw flow;
  SourcePosition where;  ///< of its table
};

/// What a file with [evolve] asks for. The runs of positions are the positions: each has a case file or a simulation of
/// its own.
struct EvolutionFile {
  StudyFile positions;
  std::vector<double> weights;       ///< of the runs, sum 1
  std::vector<EvolvingBody> bodies;  ///< one or two, the wheel first
  double max_depth = 0.05e-3;        ///< of an update [m]
  double max_pressure_change = 0.1;  ///< of an update, share
  double smallest_step = 1e-3;       ///< share of the whole
  int updates = 0;                   ///< equal ones; 0: as the limits allow
  int fields_every = 1;              ///< 0: never
};

}  // namespace treadmark::io
