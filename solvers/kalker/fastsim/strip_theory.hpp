// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/pose.hpp"
#include "treadmark/solvers/kalker/fastsim/flexibilities.hpp"

namespace treadmark::kalker {

/// Strip theory as FaStrip uses it (Sichani, Enblom & Berg 2016): the two-dimensional solutions of rolling for each
/// strip, creepages scaled so that the linear theory's forces of the whole patch result for small creepage. Along a
/// strip x grows in the direction of rolling, from the strip's middle. Thread-safe.
class StripTheory {
 public:
  /// equivalent: ellipse with the area and extents of the contact; its Hertzian pressure for normal_force [N] is the
  /// theory's scale. sign: +1 for rolling along +x of the grid, -1 along -x. mu and normal_force must be positive.
  StripTheory(const ContactProblem& problem, const Creepage& creepage, double mu, double normal_force,
              const EquivalentEllipse& equivalent, double sign);

  /// What holds in one strip.
  struct Solution {
    bool full_slip = true;
    double half_length = 0.0, shift = 0.0;         ///< a_j, d [m]
    double kappa = 0.0, lambda = 0.0, spin = 0.0;  ///< [-]

    bool adheres(double x) const { return !full_slip && x > 2.0 * shift - half_length; }
  };

  /// Half the length of the strip and where its middle is from the spin centre: lateral (y) and along (x) [m].
  Solution solve(double half_length, double lateral, double along) const;
  /// Traction on body 1 [Pa] in the adhesion area, in the grid's axes.
  Vec2 traction(const Solution& strip, double x) const;
  /// mu p0 [Pa]: a strip where the theory gives more is beyond it.
  double greatest() const { return greatest_; }
  double sign() const { return sign_; }

 private:
  double sign_, a_, poisson_, greatest_;
  double xi_ = 0.0, eta_ = 0.0, phi_ = 0.0;  ///< scaled creepages [-], in the direction of the traction
};

/// Replaces the tractions of FASTSIM in a solution by those of strip theory in its adhesion areas, and scales them to
/// the friction bound elsewhere; slip is that of FASTSIM, 0 in adhesion. A strip is what a row has of one part of the
/// patch, from its first to its last element in contact. A strip where the theory gives more than greatest() keeps
/// FASTSIM. Tractions never exceed the friction bound.
void apply_strip_theory(const ContactProblem& problem, const StripTheory& theory, ContactSolution& solution);

}  // namespace treadmark::kalker
