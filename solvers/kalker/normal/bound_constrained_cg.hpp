// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/solvers/kalker/halfspace/fft_plan.hpp"
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

namespace treadmark::kalker {

/// Gap of elements that can never be in contact [m]; finite, so that 0 * gap = 0.
inline constexpr double kNeverInContact = 1e30;

/// Normal contact on a box of elements: find p >= 0 with p e = 0, e = gap - approach + A p >= 0.
struct BoxProblem {
  const NormalOperator* op = nullptr;
  std::span<const double> gap;  ///< [m], rows of nx
  int nx = 0, ny = 0;
  bool sum_prescribed = false;  ///< sum of p given, approach unknown; else approach given
  double pressure_sum = 0.0;    ///< [Pa]
  double eps = 1e-5;            ///< wanted accuracy of p relative to its rms
  int max_iterations = 999;
  /// Sides behind which the grid continues: contact in their border elements stops the iteration.
  bool open_left = false, open_right = false, open_low = false, open_high = false;
};

/// Conjugate gradients that let elements enter and leave the contact at every iteration (Polonsky & Keer 1999,
/// Vollebregt 2014), preconditioned by the inverse of the convolution.
class BoundConstrainedCg {
 public:
  enum class Outcome { converged, box_too_small, iteration_limit, no_contact };

  AlignedVector<double> p, u;  ///< in: start values of p (positive = in contact); out: pressure [Pa], A p [m]
  double approach = 0.0;       ///< in when prescribed, out otherwise [m]
  int iterations = 0;          ///< accumulated over calls
  int products = 0;            ///< convolutions, accumulated over calls
  double residual = 0.0;       ///< rms of the preconditioned residual relative to the rms of p

  Outcome solve(const BoxProblem& problem);

  /// Elements enter the contact when they overlap by more than this [m].
  double negligible_overlap(double eps) const;

 private:
  void start(const BoxProblem& problem);
  void update_displacement(const BoxProblem& problem);
  void update_residual(const BoxProblem& problem);
  void release(const BoxProblem& problem);
  bool touches_open_side(const BoxProblem& problem) const;
  double remove_mean(std::span<double> field) const;
  void scale_to_sum(const BoxProblem& problem);
  bool clip();

  AlignedVector<double> inside_;  ///< 1 in contact, 0 outside
  AlignedVector<double> e_, r_, r_previous_, z_, v_, q_;
  double count_ = 0.0;  ///< elements in contact
};

}  // namespace treadmark::kalker
