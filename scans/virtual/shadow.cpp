// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/virtual/shadow.hpp"

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::scans::scanner {

bool in_shadow(const Surface& surface, const Vec3& stand_S, const Vec3& point_S) {
  constexpr double kSame = 20e-6;  // [m] what lies no farther before the point is the point itself
  const Vec3 way = stand_S - point_S;
  const double distance = way.norm();
  // what the beam meets first is the outermost hit: of a rail towards -z of a plane, of a wheel towards +z
  const double out = surface.facing() == Facing::down ? 1.0 : -1.0;
  const Vec3 z_axis = out / distance * way, x_axis = z_axis.unitOrthogonal();
  Pose X_SP;
  X_SP.origin = point_S;
  X_SP.rotation << x_axis, z_axis.cross(x_axis), z_axis;
  const Vec2 here(0.0, 0.0);
  double z = kNaN;
  surface.heights_at(X_SP, {&here, 1}, {{&z, 1}, {}, {}});
  const double before = out * z;  // NaN where the beam only grazes a rim: nothing is met
  if (before > distance)
    throw Error(ErrorKind::configuration,
                fmt::format("the surface lies behind the scanner at ({:g}, {:g}, {:g}) mm, too", kMilli * stand_S.x(),
                            kMilli * stand_S.y(), kMilli * stand_S.z()),
                {}, "put the scanner outside of the surface, farther from it");
  return before > kSame;
}

}  // namespace treadmark::scans::scanner
