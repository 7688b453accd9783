// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/sampled_profile.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::detection {

namespace {

/// An angle at which a wheel has its one profile [rad], if it has one.
std::optional<double> angle_of_profile(const Surface& wheel) {
  if (wheel.constant_profile()) return 0.0;
  constexpr int kAngles = 64;
  constexpr double kStep = 2.0 * std::numbers::pi / kAngles;
  for (int i = 0; i < kAngles; ++i)
    if (wheel.constant_between((i - 0.5) * kStep, (i + 0.5) * kStep)) return i * kStep;
  return std::nullopt;
}

}  // namespace

SampledProfile sample_profile(const Surface& wheel, double angle, double first, double step, int count) {
  SampledProfile p{first, step, angle, std::vector<double>(static_cast<std::size_t>(count)),
                   std::vector<double>(static_cast<std::size_t>(count))};
  const Pose turned = angle == 0.0 ? Pose{} : Pose{Vec3::Zero(), rotation_y(angle)};
  wheel.heights({turned, {0.0, first, 1.0, step, 1, count}}, {p.radius, {}, p.slope});
  return p;
}

std::shared_ptr<const SampledProfile> whole_profile(const Surface& wheel) {
  const std::optional<double> angle = wheel.facing() == Facing::down ? angle_of_profile(wheel) : std::nullopt;
  if (!angle) return nullptr;
  constexpr double kStep = 0.25e-3;  // [m]; cubics between the points are good to a nanometre, kinks apart
  const Box3 box = wheel.bounds();
  const double width = box.max.y() - box.min.y();
  const int count = 2 + std::clamp(to_whole<int>(width / kStep), 14, 19998);
  return std::make_shared<SampledProfile>(sample_profile(wheel, *angle, box.min.y(), width / (count - 1), count));
}

}  // namespace treadmark::detection
