// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/contact_shape.hpp"

#include <array>
#include <cmath>

#include "treadmark/core/constants.hpp"

namespace treadmark::wheelrail {

std::optional<ContactShape> contact_shape(const Surface& surface, const Pose& X_SC) {
  const Vec2 reference = Vec2::Zero();
  SurfacePoint at;
  surface.locate(X_SC, {&reference, 1}, {&at, 1});
  if (at.status == LocateStatus::outside || !std::isfinite(at.curvature_1 + at.curvature_2)) return std::nullopt;
  ContactShape out{at.curvature_1, at.curvature_2, 0.0};
  constexpr double kStep = 1e-5, kEqual = 1e-9;  // [m], [1/m]
  if (!(out.curvature_1 - out.curvature_2 > kEqual)) return out;
  const std::array<Vec2, 4> beside{Vec2(kStep, 0.0), Vec2(-kStep, 0.0), Vec2(0.0, kStep), Vec2(0.0, -kStep)};
  std::array<double, 4> dzdx{}, dzds{};
  surface.heights_at(X_SC, beside, {{}, dzdx, dzds});
  const double side = surface.facing() == Facing::up ? 1.0 : -1.0;
  const double xx = side * (dzdx[0] - dzdx[1]) / (2.0 * kStep), ss = side * (dzds[2] - dzds[3]) / (2.0 * kStep),
               xs = side * (dzds[0] - dzds[1] + dzdx[2] - dzdx[3]) / (4.0 * kStep);
  out.angle = 0.5 * std::atan2(2.0 * xs, xx - ss);
  // at the rim there is no difference: what is not known is not told
  if (!std::isfinite(out.angle)) return std::nullopt;
  if (out.angle <= -0.5 * kPi) out.angle = 0.5 * kPi;
  return out;
}

}  // namespace treadmark::wheelrail
