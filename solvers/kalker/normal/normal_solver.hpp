// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/kalker/contact_gradient.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

/// Start values for the next problem: the last pressures on their grid [Pa]; empty = none.
struct NormalStart {
  Grid2 grid;
  std::vector<double> pressure;
};

/// Frictionless normal contact of one patch: pressures p >= 0 with p e = 0 for the deformed distance
/// e = h - approach + u_n >= 0, for a prescribed force or approach (Kalker 1990; method in README.md of this folder).
/// Work grows with the size of the contact, not of the potential contact area. Keeps influence coefficients and the
/// last pressures; the latter start the next problem when its grid has the same steps and is displaced by whole
/// elements. Not thread-safe; use one per thread. Results depend on the sequence of problems only within the accuracy
/// asked for.
class NormalSolver {
 public:
  NormalSolver();
  ~NormalSolver();
  NormalSolver(NormalSolver&&) noexcept;
  NormalSolver& operator=(NormalSolver&&) noexcept;

  /// Out: pressure, displacement_n (of what is in contact or interpenetrates; elsewhere it may be 0), state (adhesion =
  /// in contact), approach, force_n, max_pressure, status and the report `normal`, whose residual is the estimated
  /// error of the pressures relative to their rms; settings.eps is the accuracy asked for. The other fields are
  /// emptied. normal_model elliptic, parabolic or semi_double_elliptic: pressures from problem.hertz, about the origin
  /// of the grid's axes; kpec, analyn: approximate ones at a prescribed approach (virtual_penetration.hpp). No element
  /// in contact: Status::no_contact. Errors: Error(configuration) for inconsistent input.
  void solve(const ContactProblem& problem, ContactSolution& solution);

  /// Change of the pressures with the approach [Pa/m], the contact area staying as it is: their sum times the cell area
  /// is the normal stiffness. Errors: Error(configuration) for a solution of another grid.
  std::vector<double> pressure_by_approach(const ContactProblem& problem, const ContactSolution& solution);

  /// Derivatives, by the gap of every element and by what is prescribed, of a number of which those by pressures
  /// [unit/Pa] and by the approach [unit/m] are given; elements in contact stay in it and others out of it. One linear
  /// system of the contact's elements. Errors: Error(configuration) for a solution of another grid, approximate
  /// pressures, parts that share an influence, and coefficients of influence that are not symmetric.
  Gradient gradient_by_gap(const ContactProblem& problem, const ContactSolution& solution,
                           std::span<const double> by_pressure, double by_approach);

  /// Forgets the last pressures (not the coefficients).
  void reset();
  /// What the next problem starts from, to be saved and restored.
  NormalStart start() const;
  void start_from(NormalStart start);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

void write(const NormalStart& start, ByteWriter& out);

/// Errors: Error(input_data) for bytes that are no start values.
NormalStart read_normal_start(ByteReader& in);

}  // namespace treadmark::kalker
