// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/study_model.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io {

/// Depths across a body that are sought, the same all along it: at equally spaced places, smooth between them. SI.
struct DesignDepth {
  Body body = Body::rail;
  double from = 0.0, to = 0.0, step = 0.0;  ///< y of the first and the last place, and between two
  std::vector<double> least, most;          ///< of each place; > 0: material goes
  bool level_ends = false;                  ///< beyond the places the depth of the last one goes on; else it ends
  SourcePosition where;
};

/// A number of the base that is sought.
struct DesignParameter {
  std::string key;
  double from = 0.0, to = 0.0;  ///< in the unit of the key
  SourcePosition where;
};

/// Numbers that designs are judged by.
struct DesignedQuantity {
  std::string name;                ///< in its unit: "pmax_MPa", "conicity"
  std::vector<double> amplitudes;  ///< of the conicity [m]
  SourcePosition where;
};

/// A part of the sum that becomes least.
struct DesignGoal {
  DesignedQuantity of;
  bool largest = false;                 ///< of all positions; else the mean by weight
  double weight = 1.0;                  ///< in the sum
  std::optional<double> target, scale;  ///< in the unit of the quantity
};

/// What designs must keep.
struct DesignLimit {
  DesignedQuantity of;
  std::optional<double> at_most, at_least;  ///< in the unit of the quantity
};

/// What a file with [design] asks for. The runs of positions are the positions, each with a case file of its own.
struct DesignFile {
  enum class Method { slsqp, mma };

  StudyFile positions;
  std::vector<double> weights;  ///< of the runs, sum 1
  Method method = Method::slsqp;
  int solutions = 100;  ///< of cases, most
  double tolerance =
      1e-4;  ///< change of the sum, or of all that is sought as a share of its range, that ends the search
  std::optional<DesignDepth> depth;
  std::vector<DesignParameter> parameters;
  std::vector<DesignGoal> goals;
  std::vector<DesignLimit> limits;
};

}  // namespace treadmark::io
