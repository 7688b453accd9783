// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/loads.hpp"

namespace treadmark::wheelrail {
namespace {

Wrench seen_in(const Wrench& load_T, const Mat3& rotation) {
  return {rotation.transpose() * load_T.force, rotation.transpose() * load_T.moment};
}

// A force is a polar vector, a moment an axial one.
void flip(Wrench& w) {
  w.force.y() = -w.force.y();
  w.moment.x() = -w.moment.x();
  w.moment.z() = -w.moment.z();
}

}  // namespace

Wrenches loads(const Placement& placed, const Pose& X_TC, const Wrench& load_C) {
  return loads(placed, X_TC, load_C, load_C);
}

Wrenches loads(const Placement& placed, const Pose& X_TC, const Wrench& by_rail_C, const Wrench& by_wheel_C) {
  const auto about = [&](const Vec3& point_T, const Wrench& load_C) {
    const Vec3 force_T = X_TC.rotation * load_C.force;
    return Wrench{force_T, (X_TC.origin - point_T).cross(force_T) + X_TC.rotation * load_C.moment};
  };
  Wrenches out;
  out.track = about(placed.X_TR.origin, by_rail_C);
  out.rail = seen_in(out.track, placed.X_TR.rotation);
  const Wrench at_wheel = about(placed.X_TW.origin, by_wheel_C);
  out.wheelset = seen_in(at_wheel, placed.X_TWs.rotation);
  out.wheel = seen_in(at_wheel, placed.X_TW.rotation);
  return out;
}

Wrenches mirrored(Wrenches load) {
  for (Wrench* w : {&load.track, &load.rail, &load.wheelset, &load.wheel}) flip(*w);
  return load;
}

}  // namespace treadmark::wheelrail
