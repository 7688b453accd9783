// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/model/contact/conventions.hpp"
#include "treadmark/model/contact/numerical_influence.hpp"

namespace treadmark {

/// What is asked of the solver of one contact patch: plain data in SI units.

/// Pressure distribution: solved; assumed from the Hertz ellipse of the problem; approximated from the gap at a given
/// approach.
enum class NormalModel { full, elliptic, parabolic, semi_double_elliptic, kpec, analyn };

/// Tractions: solved, or by a simplified theory.
enum class TangentialModel { full, fastsim, fastsim_one_flexibility, fastrip, linear };

/// Which tangential problem is solved.
enum class Regime {
  frictionless,  ///< normal problem only
  shift,         ///< a finite shift; creepages are lengths and an angle; starts where the history ends
  transient,     ///< a step of rolling from where the history ends
  steady,        ///< steady rolling
};

/// What is carried from one case to the next.
enum class HistoryUse {
  start,         ///< nothing: the bodies come together from rest
  keep_going,    ///< the last solution is the previous instant
  normal_only,   ///< of the last solution only the normal part
  same_instant,  ///< the previous instant stays what it was: the case is solved again
};

/// FASTSIM with slope reduction (Spiryagin et al. 2013).
struct FastsimSettings {
  /// From the leading edge to the middle of the first element. half: half an element, and spin acts midway in each
  /// step: without slip of second order in the size of elements. whole: of first order.
  enum class FirstStep { half, whole };
  double k0 = 1.0;           ///< what is left of the slope at small creepage [-]
  double alpha = 1.0;        ///< slope at large creepage over that at small creepage [-]
  double beta = 1.0;         ///< how fast it falls with creepage [-]
  double flexibility = 0.0;  ///< fastsim_one_flexibility: L [m/Pa]
  FirstStep first_step = FirstStep::half;
  friend bool operator==(const FastsimSettings&, const FastsimSettings&) = default;
};

/// Where coefficients of influence come from.
struct InfluenceSettings {
  /// Of tractions over an element, or where they are taken from.
  enum class Kind { constant, bilinear, angle_corrected, table };
  Kind kind = Kind::constant;
  /// angle_corrected: inclination of the surface [rad] at positions along y [m] (Vollebregt 2018)
  std::vector<double> position, inclination;
  int variant = 4;                                  ///< of the angle correction, 1 to 4
  bool linear = true;                               ///< one straight line through the table, else the table row by row
  std::shared_ptr<const NumericalInfluence> table;  ///< table: numerical coefficients
  friend bool operator==(const InfluenceSettings&, const InfluenceSettings&) = default;
};

/// Accuracy and limits of the iterations.
struct SolverSettings {
  /// sweeps: over single elements, slow; an independent check (tangential problem)
  enum class Method { automatic, sweeps };
  double eps = 1e-5;         ///< relative accuracy of tractions
  int max_iterations = 999;  ///< inner iterations per solve
  int max_outer = 100;       ///< active-set corrections, friction iterations
  int max_force = 30;        ///< iterations on a prescribed tangential force
  int max_coupling = 30;     ///< rounds of normal and tangential problem for dissimilar bodies; 1: the tangential
                             ///< tractions do not act on the normal problem
  Method method = Method::automatic;
  /// Falling friction: slip speeds that the iteration starts from. below: none, above: the rolling velocity, last:
  /// those of the last solution.
  enum class FirstSlip { below, above, last };
  FirstSlip first_slip = FirstSlip::last;
  Conventions conventions = Conventions::treadmark;  ///< of search, distances, parts of patches, KPEC and ANALYN
  friend bool operator==(const SolverSettings&, const SolverSettings&) = default;
};

}  // namespace treadmark
