// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/sampled_region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/core/pose.hpp"

namespace treadmark::app {
namespace {

constexpr double kSearchAngle = 0.2;  // of the contact search, to both sides [rad]
constexpr double kMarginAngle = 0.05;
constexpr double kHalfGauge = 0.8;  // lever arm of the yaw angle [m]

/// Grows to hold the interval round a value.
struct Interval {
  double low = 0.0, high = 0.0;
  bool any = false;
  void include(double middle, double half) {
    low = any ? std::min(low, middle - half) : middle - half;
    high = any ? std::max(high, middle + half) : middle + half;
    any = true;
  }
};

}  // namespace

SampledRegions sampled_regions(const io::CaseFile& file) {
  Interval theta, x;
  for (const io::Case& c : file.cases) {
    const auto* input = std::get_if<io::WheelRailCase>(&c.content);
    if (input == nullptr) continue;
    const WheelsetState& w = input->state;
    const double turned = std::fabs(w.position.yaw) + std::fabs(w.wheel_offset.yaw);
    const double sideways = std::fabs(w.position.roll) + std::fabs(w.wheel_offset.roll) + std::fabs(input->track.cant);
    theta.include(wrap_angle(-(w.position.pitch + w.wheel_offset.pitch)),
                  kSearchAngle + kMarginAngle + turned + 0.2 * sideways);
    x.include(w.position.x + w.wheel_offset.x,
              (kSearchAngle + kMarginAngle) * input->wheelset.nominal_radius + kHalfGauge * turned);
  }
  SampledRegions regions;
  if (!x.any) return regions;
  regions.rail.u_min = x.low;
  regions.rail.u_max = x.high;
  if (theta.high - theta.low < std::numbers::pi) {
    regions.wheel.u_min = theta.low;
    regions.wheel.u_max = theta.high;
  }
  return regions;
}

}  // namespace treadmark::app
