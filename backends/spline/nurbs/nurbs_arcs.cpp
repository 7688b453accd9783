// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <numbers>

#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {
namespace {

// Patches are kept small and flat, so that their boxes say something.
constexpr double kLongestTurn = 0.12;    // [rad] of one profile arc
constexpr double kLongestPiece = 0.012;  // [m] along the profile
constexpr double kLongestSweep = 0.05;   // [m] along a rail
constexpr int kPiecesRound = 96;

void require(bool good, const char* message, const char* advice = "") {
  if (!good) throw Error(ErrorKind::configuration, message, {}, advice);
}

// A planar cubic Bezier curve in homogeneous coordinates (a w, b w, w); successive pieces share a point.
struct Planar {
  double a, b, w;
};

// A rational quadratic (Piegl and Tiller 1997) written as a cubic; all points but the last.
void append(std::vector<Planar>& curve, const Planar& p0, const Planar& p1, const Planar& p2) {
  const auto mix = [](const Planar& p, const Planar& q) {
    return Planar{(p.a + 2.0 * q.a) / 3.0, (p.b + 2.0 * q.b) / 3.0, (p.w + 2.0 * q.w) / 3.0};
  };
  curve.push_back(p0);
  curve.push_back(mix(p0, p1));
  curve.push_back(mix(p2, p1));
}

struct PlanarCurve {
  std::vector<Planar> points;
  std::vector<double> breaks;
};

// a = y, b = z.
PlanarCurve profile_curve(const ArcChain& chain) {
  require(!chain.segments.empty(), "an arc chain needs at least one segment");
  require(std::isfinite(chain.start_y) && std::isfinite(chain.start_z) && std::isfinite(chain.start_angle),
          "the start of an arc chain is not finite");
  PlanarCurve curve;
  double y = chain.start_y, z = chain.start_z, angle = chain.start_angle, s = 0.0;
  for (const ArcChain::Segment& segment : chain.segments) {
    const double turn = segment.length * segment.curvature;
    require(segment.length > 0.0 && std::isfinite(segment.length) && std::isfinite(segment.curvature),
            "segments of an arc chain need a positive length and a finite curvature");
    require(std::abs(turn) <= 2.0 * std::numbers::pi, "a segment of an arc chain is longer than a full circle");
    const int pieces = std::max(
        1, to_whole<int>(std::ceil(std::max(std::abs(turn) / kLongestTurn, segment.length / kLongestPiece) - 1e-9)));
    // Points from the start of the segment, so that errors do not add up.
    const auto at = [&](double d) {
      const double half = 0.5 * segment.curvature * d;
      const double chord = std::abs(half) < 1e-4 ? d * (1.0 - half * half / 6.0) : d * std::sin(half) / half;
      return Vec2(y + chord * std::cos(angle + half), z + chord * std::sin(angle + half));
    };
    const double step = segment.length / pieces, half_turn = 0.5 * turn / pieces, weight = std::cos(half_turn);
    for (int i = 0; i < pieces; ++i) {
      const Vec2 p = at(i * step), q = at((i + 1) * step), middle = 0.5 * (p + q);
      // The tangents meet off the middle of the chord by half of it times tan(half turn), at right angles; times the
      // weight.
      const Vec2 half = 0.5 * (q - p);
      const Vec2 apex = weight * middle - std::sin(half_turn) * Vec2(-half.y(), half.x());
      append(curve.points, {p.x(), p.y(), 1.0}, {apex.x(), apex.y(), weight}, {q.x(), q.y(), 1.0});
      curve.breaks.push_back(s + i * step);
    }
    const Vec2 end = at(segment.length);
    y = end.x(), z = end.y(), angle += turn, s += segment.length;
  }
  curve.points.push_back({y, z, 1.0});
  curve.breaks.push_back(s);
  return curve;
}

}  // namespace

NurbsNet sweep_chain(const ArcChain& chain, double x_min, double x_max) {
  require(std::isfinite(x_min) && std::isfinite(x_max) && x_min < x_max,
          "a swept rail needs a finite range of x with x_min < x_max");
  const PlanarCurve profile = profile_curve(chain);
  const int pieces = std::clamp(to_whole<int>(std::ceil((x_max - x_min) / kLongestSweep)), 1, 100'000);
  std::vector<double> breaks;
  for (int i = 0; i <= pieces; ++i) breaks.push_back(i == pieces ? x_max : x_min + (x_max - x_min) * i / pieces);
  std::vector<Quad> points;
  for (int i = 0; i <= 3 * pieces; ++i) {
    const auto k = static_cast<std::size_t>(i / 3);
    const double x = i % 3 == 0 ? breaks[k] : breaks[k] + (breaks[k + 1] - breaks[k]) * (i % 3) / 3.0;
    for (const Planar& p : profile.points) points.push_back({x * p.w, p.a, p.b, p.w});
  }
  return NurbsNet(std::move(breaks), profile.breaks, std::move(points));
}

NurbsNet revolve_chain(const ArcChain& chain, double nominal_radius) {
  require(nominal_radius > 0.0 && std::isfinite(nominal_radius), "a wheel needs a positive nominal radius");
  const PlanarCurve profile = profile_curve(chain);
  for (const Planar& p : profile.points)
    require(nominal_radius + p.b / p.w > 0.0, "the wheel's profile reaches down to the axle",
            "check the nominal radius and the unit of the chain");
  // a = sine, b = cosine of the angle.
  std::vector<Planar> round;
  std::vector<double> breaks;
  const double step = 2.0 * std::numbers::pi / kPiecesRound, weight = std::cos(0.5 * step);
  const auto angle = [&](int i) { return -std::numbers::pi + step * i; };
  const auto on_circle = [&](int i) {
    return Planar{std::sin(angle(i % kPiecesRound)), std::cos(angle(i % kPiecesRound)), 1.0};
  };
  for (int i = 0; i < kPiecesRound; ++i) {
    const double middle = angle(i) + 0.5 * step;
    append(round, on_circle(i), {std::sin(middle), std::cos(middle), weight}, on_circle(i + 1));
    breaks.push_back(angle(i));
  }
  round.push_back(on_circle(0));
  breaks.push_back(std::numbers::pi);
  std::vector<Quad> points;
  for (const Planar& c : round)
    for (const Planar& p : profile.points) {
      const double r = nominal_radius * p.w + p.b;
      points.push_back({r * c.a, p.a * c.w, r * c.b, p.w * c.w});
    }
  return NurbsNet(std::move(breaks), profile.breaks, std::move(points));
}

}  // namespace treadmark::spline
