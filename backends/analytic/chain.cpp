// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/analytic/chain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::analytic {

ChainPoint point_on(const ChainSegment& seg, double d) {
  // Chord of an arc: length d sinc(turn/2), in the direction half way.
  const double half_turn = 0.5 * seg.curvature * d;
  const double sinc = std::fabs(half_turn) < 1e-4 ? 1.0 - half_turn * half_turn / 6.0 : std::sin(half_turn) / half_turn;
  const double direction = seg.angle + half_turn;
  return {seg.y + d * sinc * std::cos(direction), seg.z + d * sinc * std::sin(direction), seg.angle + seg.curvature * d,
          seg.curvature};
}

std::vector<ChainSegment> resolve(const ArcChain& chain) {
  if (chain.segments.empty()) throw Error(ErrorKind::configuration, "an arc chain needs at least one segment");
  if (!std::isfinite(chain.start_y) || !std::isfinite(chain.start_z) || !std::isfinite(chain.start_angle))
    throw Error(ErrorKind::configuration, "the start of an arc chain is not finite");
  std::vector<ChainSegment> resolved;
  resolved.reserve(chain.segments.size());
  ChainPoint at{chain.start_y, chain.start_z, chain.start_angle, 0.0};
  double s = 0.0;
  for (std::size_t i = 0; i < chain.segments.size(); ++i) {
    const auto& segment = chain.segments[i];
    if (!(segment.length > 0.0) || !std::isfinite(segment.length) || !std::isfinite(segment.curvature))
      throw Error(ErrorKind::configuration,
                  fmt::format("segment {} of an arc chain needs a positive length and a finite curvature", i + 1));
    if (std::fabs(segment.length * segment.curvature) > 2.0 * std::numbers::pi)
      throw Error(ErrorKind::configuration,
                  fmt::format("segment {} of an arc chain is longer than a full circle", i + 1));
    resolved.push_back({at.y, at.z, at.angle, segment.length, segment.curvature, s});
    at = point_on(resolved.back(), segment.length);
    s += segment.length;
  }
  return resolved;
}

std::vector<Chord> chords_of(const std::vector<ChainSegment>& chain) {
  std::vector<Chord> all;
  for (const ChainSegment& seg : chain) {
    // sagitta = curvature length^2/8, and no part turns by more than 1/4
    const double k = std::fabs(seg.curvature);
    const double parts =
        std::ceil(std::max(seg.length * std::sqrt(k / (8.0 * GraphCurve::kChordOff)), 4.0 * k * seg.length));
    const int n = to_whole<int>(parts, 1.0, 2000.0);
    ChainPoint a = point_on(seg, 0.0);
    for (int i = 1; i <= n; ++i) {
      const ChainPoint b = point_on(seg, seg.length * i / n);
      all.push_back({a.y, a.z, b.y, b.z, sagitta(k, std::hypot(b.y - a.y, b.z - a.z))});
      a = b;
    }
  }
  return all;
}

GraphCurve graph_of(const ArcChain& chain) {
  GraphCurve curve;
  constexpr double kVertical = 0.5 * std::numbers::pi + 1e-12;
  double y_end = chain.start_y;
  for (const ChainSegment& seg : resolve(chain)) {
    const ChainPoint end = point_on(seg, seg.length);
    if (std::fabs(seg.angle) > kVertical || std::fabs(end.angle) > kVertical || !(end.y > y_end))
      throw Error(ErrorKind::configuration, "the arc chain of a wheel is vertical or turns back", {},
                  "keep its inclination within +-90 degrees");
    // Start from the flatter end, so that a vertical tangent at the other one does no harm.
    const bool from_start = std::fabs(seg.angle) <= std::fabs(end.angle);
    ArcGraph arc;
    arc.x_min = y_end;
    arc.x_max = end.y;
    arc.x0 = from_start ? seg.y : end.y;
    arc.h0 = from_start ? seg.z : end.z;
    const double angle = from_start ? seg.angle : end.angle;
    arc.s0 = std::sin(angle);
    arc.c0 = std::fabs(std::cos(angle));
    arc.k = seg.curvature;
    curve.append(arc);
    y_end = end.y;
  }
  return curve;
}

}  // namespace treadmark::analytic
