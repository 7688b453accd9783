// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "treadmark/model/remarks.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/refinement.hpp"

namespace treadmark::kalker {

/// What a patch is judged by besides its solution.
struct PatchSetting {
  const Grid2& grid;
  const Material& material;
  double static_friction = 0.3;
  bool rolling = false;       ///< steady or transient
  bool shift = false;         ///< creepages and slip are lengths
  double pressure_limit = 0;  ///< beyond_half_space above it [Pa]
  /// beyond_yield above it and up to the former [Pa]
  double yield_limit = std::numeric_limits<double>::infinity();
  bool closed_border = false;  ///< the bodies may not touch beyond the grid
  NormalModel normal_model = NormalModel::full;
  TangentialModel tangential_model = TangentialModel::full;
  double flexibility = 0.0;  ///< of FASTSIM with one flexibility [m/Pa]
};

/// Appends what is doubtful about the solution of one patch to remarks; patch: its number there. Thread-safe.
void judge(const PatchSetting& setting, const ContactSolution& solution, int patch, std::vector<Remark>& remarks);

/// The same about what smaller elements would change.
void judge_refinement(const Refinement& refinement, int patch, std::vector<Remark>& remarks);

/// E' = G / (1 - nu) of both bodies [Pa].
double contact_modulus(const Material& material);

/// A force that was asked for and the one that was found [N]. meant: why they may differ; empty: they may not.
void judge_force(const char* name, double wanted, double found, std::vector<Remark>& remarks,
                 std::string_view meant = {});

}  // namespace treadmark::kalker
