// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/core/recent.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {

/// What of a rail is the same at every instant, kept from one to the next: its box, the gauge point, from where to
/// where it is seen. What is asked for is the same to the last bit whatever was asked before: answers are kept by
/// everything that they depend on. One per thread.
class RailMemory {
 public:
  /// The rail must outlive this.
  explicit RailMemory(const Surface& rail) : rail_(&rail) {}

  const Box3& box();
  /// As gauge_point().
  GaugePoint gauge(double cant, const Track& track, double x);
  /// As visible_range(), of a rail of one profile from its own place on, which no position along or across the track
  /// changes.
  LateralRange visible(const Pose& X_TS, double x_T);

 private:
  struct GaugeKey {
    double cant = 0.0, height = 0.0, x = 0.0;
    bool at_innermost = false;
    friend bool operator==(const GaugeKey&, const GaugeKey&) = default;
  };
  const Surface* rail_;
  std::optional<Box3> box_;
  Recent<GaugeKey, GaugePoint> gauges_;
  Recent<Mat3, LateralRange> ranges_;  ///< by the rotation of the rail
};

}  // namespace treadmark::wheelrail
