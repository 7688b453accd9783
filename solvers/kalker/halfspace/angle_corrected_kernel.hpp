// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <span>

#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {

/// How coefficients of the half-space follow the inclinations of a conformal contact: y and n are then the directions
/// along and across the surface at the loaded or the observed element, alpha is the inclination of the load minus that
/// of the observation.
enum class AngleCorrection {
  rotated_loads = 1,          ///< the tractions are turned into the observation's directions
  rotated_loads_but_xn = 2,   ///< the same, but the rolling displacement by pressure stays as it is
  rotated_displacements = 3,  ///< the displacements are turned into the load's directions instead
  half_and_half = 4,          ///< both are turned by half the angle; keeps reciprocity
};

/// Coefficients for a surface whose inclination alpha [rad] is a linear function of y (Vollebregt 2018), so that they
/// depend on the offset only.
class AngleCorrectedKernel final : public InfluenceKernel {
 public:
  /// half_space: coefficients on the plane. curvature: d alpha / d y [rad/m]. Errors: Error(configuration) without a
  /// half-space.
  AngleCorrectedKernel(std::shared_ptr<const InfluenceKernel> half_space, double curvature, AngleCorrection correction);

  InfluenceBlock at(double X, double Y) const override;
  bool symmetric() const override { return correction_ == AngleCorrection::half_and_half && half_space_->symmetric(); }
  bool coupled() const override { return true; }

 private:
  std::shared_ptr<const InfluenceKernel> half_space_;
  double curvature_;
  AngleCorrection correction_;
};

/// Cosine and sine of an angle alpha [rad] and of half of it.
struct AngleFactors {
  explicit AngleFactors(double alpha);
  double c, s, half_c, half_s;
};

/// Coefficients between a load and an observation whose inclinations differ by alpha [rad], from those of the
/// half-space.
InfluenceBlock corrected_for_angle(const InfluenceBlock& half_space, const AngleFactors& alpha,
                                   AngleCorrection correction);
InfluenceBlock corrected_for_angle(const InfluenceBlock& half_space, double alpha, AngleCorrection correction);

/// Slope of the least-squares straight line through the points. Errors: Error(configuration) for different lengths,
/// numbers that are not finite, or less than two different positions.
double regression_slope(std::span<const double> position, std::span<const double> value);

}  // namespace treadmark::kalker
