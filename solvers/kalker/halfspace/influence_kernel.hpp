// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <span>

#include "treadmark/model/contact/material.hpp"

namespace treadmark {
struct InfluenceSettings;
}

namespace treadmark::kalker {

/// Displacement differences in x, y, n (first letter) by tractions in x, y, n (second letter): u = (1/G) C p, C in [m].
struct InfluenceBlock {
  double xx = 0.0, xy = 0.0, xn = 0.0;
  double yx = 0.0, yy = 0.0, yn = 0.0;
  double nx = 0.0, ny = 0.0, nn = 0.0;
};

/// The coefficients of a symmetric kernel (see InfluenceKernel) where X, Y or both have the other sign.
InfluenceBlock mirrored(const InfluenceBlock& block, bool in_x, bool in_y);

/// block / divisor
InfluenceBlock divided(const InfluenceBlock& block, double divisor);

/// Influence coefficients of one loaded element, a function of where the displacement is looked at. Immutable.
class InfluenceKernel {
 public:
  virtual ~InfluenceKernel() = default;

  /// Coefficients at (X, Y) [m], the observation point minus the centre of the loaded element. Thread-safe.
  virtual InfluenceBlock at(double X, double Y) const = 0;
  /// xx, yy, nn even in X and in Y, xy = yx odd in X and in Y, xn and nx odd in X and even in Y, yn and ny the other
  /// way round: as for half-spaces.
  virtual bool symmetric() const = 0;
  /// The same for Y alone.
  virtual bool symmetric_in_y() const { return symmetric(); }
  /// Whether tangential tractions move surfaces normally and the other way round.
  virtual bool coupled() const = 0;
  /// Coefficients at (k step + shift, Y) for k = first, first + 1 ... with step > 0.
  virtual void row(int first, double step, double shift, double Y, std::span<InfluenceBlock> blocks) const {
    for (InfluenceBlock& block : blocks) block = at(first++ * step + shift, Y);
  }
};

/// The kernel for elements of dx by dy [m] of a pair of bodies; flexibilities of layers and sheets are not in it.
/// velocity: of rolling [m/s], direction along +x (chi = 0) or -x (chi = pi); both matter for viscoelastic bodies only.
/// Errors: Error(configuration) for combinations without meaning (viscoelastic bodies with K != 0, other directions or
/// other than half-space coefficients; a table for other steps; a variant that does not exist) and for inclinations row
/// by row, see RowInclination.
std::shared_ptr<const InfluenceKernel> make_influence_kernel(const Material& material,
                                                             const InfluenceSettings& settings, double dx, double dy,
                                                             double velocity, double chi);

}  // namespace treadmark::kalker
