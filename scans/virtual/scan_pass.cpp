// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/virtual/scan_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "treadmark/scans/virtual/draws.hpp"
#include "treadmark/scans/virtual/scan_line.hpp"

namespace treadmark::scans::scanner {
namespace {

constexpr double kAdvance = 0.75;  // of the width of a pass, to the next one
constexpr double kFullTurn = 2.0 * std::numbers::pi;

bool holds(const Pass& pass, const Patch& patch, bool wheel) {
  if (patch.y < pass.y_min || patch.y > pass.y_max) return false;
  if (!wheel) return true;
  const double along = std::fmod(patch.u - pass.u_min + 2.0 * kFullTurn, kFullTurn);
  return along <= pass.u_max - pass.u_min;
}

/// Beginning and end of pass k of n over a length from 0; round a closed one they overlap all round.
std::array<double, 2> share(double length, int k, int n, bool closed) {
  const double width = n == 1 ? length : closed ? length / (kAdvance * n) : length / (1.0 + kAdvance * (n - 1));
  const double from = kAdvance * width * k;
  return {from, k + 1 == n && !closed ? length : from + width};
}

void measure(Pass& pass, const FirstLook& part, const ScannerSettings& settings, Draws& draws) {
  const bool wheel = settings.body == Body::wheel;
  const double registration = settings.registration;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  bool first = true;
  for (const Patch& patch : part.patches) {
    if (!holds(pass, patch, wheel)) continue;
    pass.area += patch.area;
    pass.nominal_area += patch.nominal_area;
    low = first ? patch.position_S : low.cwiseMin(patch.position_S).eval();
    high = first ? patch.position_S : high.cwiseMax(patch.position_S).eval();
    first = false;
  }
  pass.middle_S = along_line(settings, 0.5 * (low + high));
  if (!(registration > 0.0)) return;
  // an angle about each axis that moves the farthest ends across it by the same length
  const Vec3 half = 0.5 * (high - low), shift = registration * draws.gaussian3(),
             turn = registration * draws.gaussian3();
  const auto angle = [&](int axis) {
    const double reach = std::max(half[(axis + 1) % 3], half[(axis + 2) % 3]);
    return reach > 0.0 ? turn[axis] / reach : 0.0;
  };
  pass.error_S.rotation = rotation({angle(0), angle(2), angle(1)});
  pass.error_S.origin = pass.middle_S + shift - pass.error_S.rotation * pass.middle_S;
}

}  // namespace

std::vector<Pass> plan_passes(const FirstLook& part, const ScannerSettings& settings) {
  const bool wheel = settings.body == Body::wheel;
  const bool from_stands = !settings.stands.empty();
  std::vector<Pass> passes(from_stands ? settings.stands.size() : static_cast<std::size_t>(settings.passes));
  for (std::size_t i = 0; i < passes.size(); ++i) {
    Pass& pass = passes[i];
    pass.u_min = part.u_min;
    pass.u_max = part.u_max;
    pass.y_min = part.y_min;
    pass.y_max = part.y_max;
    const int k = static_cast<int>(i);
    if (from_stands) {
      pass.stand_S = settings.stands[i];
    } else if (wheel) {
      const auto [from, to] = share(part.u_max - part.u_min, k, settings.passes, part.closed);
      pass.u_min = part.u_min + from;
      pass.u_max = part.u_min + to;
    } else {
      // shares of the arc length, so that passes over the sides have as many points as those over the top
      const auto [from, to] = share(part.reference.length(), k, settings.passes, false);
      std::size_t piece = 1;
      if (k > 0) pass.y_min = part.reference.y_at(from, piece);
      if (k + 1 < settings.passes) pass.y_max = part.reference.y_at(to, piece);
    }
    Draws draws(settings.seed, Purpose::registration, i);
    measure(pass, part, settings, draws);
  }
  return passes;
}

}  // namespace treadmark::scans::scanner
