// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/kalker/contact_gradient.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/history/contact_history.hpp"

namespace treadmark::kalker {

/// Start values for the next problem: the last solution on its grid.
struct TangentialStart {
  Grid2 grid;
  bool steady = false, forward = true;
  std::vector<double> traction_x, traction_y, bound, slip_speed;
  Creepage creepage;
  bool force_prescribed = false;
};

/// Tangential problem of one patch with given pressures: tractions, slip, division into adhesion and slip areas, and
/// the creepages that belong to prescribed forces (Kalker 1990; method in README.md of this folder). Keeps influence
/// coefficients and the last tractions; the latter are the start values of the next problem when its grid has the same
/// steps and is displaced by whole elements. Not thread-safe; use one per thread. Results depend on the sequence of
/// problems only within the accuracy asked for (settings.eps), and not on the number of threads.
class TangentialSolver {
 public:
  TangentialSolver();
  ~TangentialSolver();
  TangentialSolver(TangentialSolver&&) noexcept;
  TangentialSolver& operator=(TangentialSolver&&) noexcept;

  /// In: problem.grid, material, friction, regime shift, transient or steady, creepage, rolling, settings;
  /// solution.pressure and solution.state (not exterior = in contact; an empty state: where the pressure is positive).
  /// Out: traction_x/y, displacement_x/y (elements of the contact area's bounding box, else 0), slip_x/y, friction,
  /// state, creepage, rolling_step and the report `tangential`: residual is the rms violation of the friction
  /// conditions relative to the rms friction bound. A solution that misses the accuracy has Status::not_converged.
  /// TangentialModel::linear: Kalker's linear theory (1967), steady rolling without slip in any element, right for
  /// vanishing creepage; a force beyond friction times the normal force has Status::not_converged.
  /// previous: the instant before, on the problem's grid or empty. frictional_power is that of slip and plastic shear.
  /// Errors: Error(configuration) for inconsistent sizes, directions of steady rolling other than 0 and pi, steps or
  /// velocities that are not positive.
  /// solution.temperature_1, if it is there, decides on friction that depends on temperature.
  void solve(const ContactProblem& problem, ContactSolution& solution, const ContactHistory& previous = {});

  /// Change of the last solution's forces with the creepages and the approach. pressure_by_approach: per element
  /// [Pa/m]. Errors: Error(configuration) without a solution of this problem.
  Sensitivities sensitivities(const ContactProblem& problem, const ContactSolution& solution,
                              const ContactHistory& previous, std::span<const double> pressure_by_approach);

  /// Derivatives of a number of a solution by creepages, from those by tractions and slip; what pressures do to it as
  /// the bound of tractions is added to weights.pressure. Adhesion and slip areas and the instant before stay. Errors:
  /// Error(configuration) for what ContactSolver::gradient refuses of tractions.
  Gradient gradient(const ContactProblem& problem, const ContactSolution& solution, FieldWeights& weights);

  /// Whether tangential tractions and normal displacements have to do with each other (dissimilar bodies, curved
  /// contact).
  bool couples(const ContactProblem& problem);
  /// Normal displacement of all elements by the tangential tractions of a solution [m]; empty if there is none.
  std::vector<double> normal_displacement(const ContactProblem& problem, const ContactSolution& solution);

  /// Forgets the last tractions (not the coefficients).
  void reset();
  /// What the next problem starts from, to be saved and restored.
  std::optional<TangentialStart> start() const;
  void start_from(std::optional<TangentialStart> start);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

void write(const TangentialStart& start, ByteWriter& out);

/// Errors: Error(input_data) for bytes that are no start values.
TangentialStart read_tangential_start(ByteReader& in);

}  // namespace treadmark::kalker
