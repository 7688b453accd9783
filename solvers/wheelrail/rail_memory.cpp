// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/rail_memory.hpp"

#include <cmath>
#include <memory>

namespace treadmark::wheelrail {

const Box3& RailMemory::box() {
  if (!box_) box_ = rail_->bounds();
  return *box_;
}

GaugePoint RailMemory::gauge(double cant, const Track& track, double x) {
  return *gauges_.of({cant, track.gauge_height, x, track.gauge_at_innermost},
                     [&] { return std::make_shared<const GaugePoint>(gauge_point(*rail_, cant, track, x)); });
}

LateralRange RailMemory::visible(const Pose& X_TS, double x_T) {
  const bool endless = std::isinf(box().min.x()) && std::isinf(box().max.x());
  const bool along = X_TS.rotation(1, 0) == 0.0 && X_TS.rotation(2, 0) == 0.0;
  if (!rail_->constant_profile() || !endless || !along) return visible_range(*rail_, X_TS.inverse(), x_T);
  LateralRange range = *ranges_.of(X_TS.rotation, [&] {
    const Pose turned{Vec3::Zero(), X_TS.rotation.transpose()};
    return std::make_shared<const LateralRange>(visible_range(*rail_, turned, 0.0));
  });
  range.y_min += X_TS.origin.y(), range.y_max += X_TS.origin.y();
  return range;
}

}  // namespace treadmark::wheelrail
