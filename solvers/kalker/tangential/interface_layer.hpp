// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/kalker/tangential/patch.hpp"

namespace treadmark::kalker {

/// Elasto-plastic interface layer between the bodies (Vollebregt 2015; Six et al. 2015). In an element that the layer
/// yields in, |p| = yield stress; with hardening it grows by the distance of plastic shear. Where friction gives way
/// first, the surfaces slip.
class InterfaceLayer {
 public:
  InterfaceLayer(const Material& material, const Patch& patch);

  /// Yield stress of the material a step ago [Pa], per element; none: fresh material (and in steady rolling what the
  /// element ahead left).
  void start_from(std::vector<double> yield_before) { before_ = std::move(yield_before); }

  bool plastic() const { return yield_ > 0.0; }
  bool hardens() const { return plastic() && hardening_ != 0.0; }
  /// Least of friction and layer [Pa]. distance: slip and plastic shear together, per element [m].
  std::vector<double> bound(std::span<const double> friction_bound, std::span<const double> distance) const;

  struct Shear {
    std::vector<double> distance;  ///< of plastic shear in this step [m]
    std::vector<double> yield;     ///< at its end [Pa]
    std::vector<char> only;        ///< shear without slip
  };
  /// How the distance of slip and plastic shear together divides.
  Shear divide(std::span<const double> friction_bound, std::span<const double> distance) const;

 private:
  double yield_, hardening_;
  const Patch& patch_;
  std::vector<double> before_;
};

}  // namespace treadmark::kalker
