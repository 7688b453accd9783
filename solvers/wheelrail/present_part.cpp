// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/present_part.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::wheelrail {

std::string missing_part(const Surface& wheel, double lowest) {
  if (wheel.constant_profile()) return {};
  constexpr int kTurn = 360, kAcross = 17;
  constexpr double kDegree = std::numbers::pi / 180.0;
  const Box3 box = wheel.bounds();
  std::vector<double> y, r(kAcross);
  for (int k = 0; k < kAcross; ++k) y.push_back(box.min.y() + (box.max.y() - box.min.y()) * (k + 0.5) / kAcross);
  if (!std::isfinite(y.front()) || !std::isfinite(y.back())) return {};
  const auto present = [&](double theta) {
    HeightsOut out;
    out.z = r;
    section_heights(wheel, Body::wheel, theta, y, out);
    return ranges::any_of(r, [](double value) { return !std::isnan(value); });
  };
  if (present(wrap_angle(lowest))) return {};
  std::array<bool, kTurn> there{};
  for (int k = 0; k < kTurn; ++k) there[static_cast<std::size_t>(k)] = present(kDegree * (k - kTurn / 2 + 0.5));
  int from = 0, longest = 0;
  for (int start = 0; start < kTurn; ++start) {
    int length = 0;
    while (length < kTurn && there[static_cast<std::size_t>((start + length) % kTurn)]) ++length;
    if (length > longest) {
      longest = length;
      from = start;
    }
  }
  if (longest == 0) return {};
  return fmt::format(
      "; there is a wheel from theta = {} to {} degrees only, and theta = {:.0f} degrees is lowest: "
      "the pitch turns it (wheelset.pitch_rad = -theta)",
      from - kTurn / 2, from - kTurn / 2 + longest, wrap_angle(lowest) / kDegree);
}

}  // namespace treadmark::wheelrail
