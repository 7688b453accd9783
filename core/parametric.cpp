// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parametric.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark {

Pose station_plane(Facing facing, double u) {
  Pose X;
  if (facing == Facing::up) {
    X.origin.x() = u;
    return X;
  }
  const double s = std::sin(u), c = std::cos(u);
  X.rotation.col(0) = Vec3(c, 0.0, -s);
  X.rotation.col(2) = Vec3(s, 0.0, c);
  return X;
}

namespace {

constexpr double kStep = 1e-4;       // of differences [m]
constexpr double kFarthest = 0.5;    // y of surfaces without lateral ends [m]
constexpr int kScan = 128;           // places across where v is looked for
constexpr double kTurnNear = 1e-10;  // of v, in its own unit and relative

/// Points of one section by the parameter v that locate() tells.
class Section {
 public:
  Section(const Surface& surface, double u) : surface_(surface), plane_(station_plane(surface.facing(), u)) {}

  SurfacePoint at_y(double y) const {
    SurfacePoint found;
    const Vec2 point(0.0, y);
    surface_.locate(plane_, {&point, 1}, {&found, 1});
    return found;
  }

  /// near: y of a point with nearly the same v, NaN if none is known.
  std::optional<SurfacePoint> at_v(double v, double near) const {
    const auto off = [&](const SurfacePoint& p) { return p.v - v; };
    const auto close = [&](const SurfacePoint& p) {
      return p.status != LocateStatus::outside && std::fabs(off(p)) <= kTurnNear * (1.0 + std::fabs(v));
    };
    if (!std::isnan(near))
      if (auto found = secant(v, near)) return found;
    const SurfacePoint direct = at_y(v);  // where v is y itself
    if (close(direct)) return direct;
    const Box3 box = surface_.bounds();
    const double low = std::max(box.min.y(), -kFarthest), high = std::min(box.max.y(), kFarthest);
    SurfacePoint before;
    double y_before = low;
    const auto there = [](const SurfacePoint& p) { return p.status != LocateStatus::outside && !std::isnan(p.v); };
    for (int i = 0; i <= kScan; ++i) {
      const double y = low + (high - low) * i / kScan;
      SurfacePoint p = at_y(y), from = before, to = p;
      // much of v may lie between the last place and the end
      if (there(p) && !there(before) && i > 0) from = rim(y, y_before);
      if (!there(p) && there(before)) to = rim(y_before, y);
      if (there(from) && there(to) && off(from) * off(to) <= 0.0)
        if (auto found = bisect(v, from, to)) return found;
      before = p, y_before = y;
    }
    return std::nullopt;
  }

 private:
  double accepted(double v) const { return kTurnNear * (1.0 + std::fabs(v)); }

  /// From a near point, as close as v is told; nothing if it does not settle at once.
  std::optional<SurfacePoint> secant(double v, double near) const {
    constexpr int kMost = 15;
    constexpr double kFarthestStep = 20.0 * kStep;
    double y = near, y_before = near + 1e-5;
    SurfacePoint p = at_y(y), before = at_y(y_before);
    if (before.status == LocateStatus::outside) before = at_y(y_before = near - 1e-5);
    std::optional<SurfacePoint> best;
    for (int i = 0; i < kMost && p.status != LocateStatus::outside && before.status != LocateStatus::outside; ++i) {
      const double off = std::fabs(p.v - v);
      const bool better = !best || off < 0.5 * std::fabs(best->v - v);
      if (!better && std::fabs(best->v - v) <= accepted(v)) break;  // rounding decides
      if (!best || off < std::fabs(best->v - v)) best = p;
      if (off == 0.0) break;
      const double next = y - (p.v - v) * (y - y_before) / (p.v - before.v);
      if (!std::isfinite(next) || std::fabs(next - near) > kFarthestStep) break;
      y_before = y, before = p;
      y = next, p = at_y(y);
    }
    if (best && std::fabs(best->v - v) <= accepted(v)) return best;
    return std::nullopt;
  }

  /// The last point from a place with a surface towards one without.
  SurfacePoint rim(double there, double gone) const {
    constexpr int kHalvings = 45;
    SurfacePoint last = at_y(there);
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (there + gone);
      const SurfacePoint p = at_y(middle);
      if (p.status == LocateStatus::outside || std::isnan(p.v))
        gone = middle;
      else
        there = middle, last = p;
    }
    return last;
  }

  /// a and b lie on either side of v.
  std::optional<SurfacePoint> bisect(double v, SurfacePoint a, SurfacePoint b) const {
    constexpr int kMost = 60;
    for (int i = 0; i < kMost; ++i) {
      const double y = 0.5 * (a.position_S.y() + b.position_S.y());
      if (auto found = secant(v, y)) return found;
      const SurfacePoint p = at_y(y);
      if (p.status == LocateStatus::outside || std::isnan(p.v)) return std::nullopt;
      ((p.v - v) * (a.v - v) <= 0.0 ? b : a) = p;
    }
    return std::nullopt;
  }

  const Surface& surface_;
  Pose plane_;
};

/// First and second derivative from three places a step apart, of which the middle one is shifted so many steps from
/// where they are wanted: weights of a parabola.
struct Weights {
  std::array<double, 3> first{}, second{};

  Weights(int shift, double h) {
    const double s = shift;
    first = {(-s - 0.5) / h, 2.0 * s / h, (0.5 - s) / h};
    second = {1.0 / (h * h), -2.0 / (h * h), 1.0 / (h * h)};
  }
};

using Stencil = std::array<std::array<Vec3, 3>, 3>;

/// Nine points about (u, v), the middle one shifted by so many steps; false where the surface ends among them.
bool fill(const Surface& surface, const Vec2& uv, const Vec2& step, int shift_u, int shift_v, double y, Stencil& at) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Section section(surface, uv.x() + (shift_u + static_cast<int>(i) - 1) * step.x());
    for (std::size_t j = 0; j < 3; ++j) {
      const auto found = section.at_v(uv.y() + (shift_v + static_cast<int>(j) - 1) * step.y(), y);
      if (!found) return false;
      at[i][j] = found->position_S;
    }
  }
  return true;
}

SurfaceJet by_differences(const Surface& surface, double u, double v) {
  SurfaceJet jet;
  const Section section(surface, u);
  const auto middle = section.at_v(v, SurfaceJet::kNone);
  if (!middle) return jet;
  jet.p = middle->position_S;
  const double y = jet.p.y();
  const double hu = surface.facing() == Facing::up ? kStep : kStep / std::hypot(jet.p.x(), jet.p.z());
  // as much of v as moves the point by about a step
  constexpr double kNear = 1e-6;  // [m]
  SurfacePoint beside = section.at_y(y + kNear), other = section.at_y(y - kNear);
  if (beside.status == LocateStatus::outside) beside = *middle;
  if (other.status == LocateStatus::outside) other = *middle;
  const double hv = kStep * std::fabs(beside.v - other.v) / (beside.position_S - other.position_S).norm();
  if (!(hv > 0.0) || !std::isfinite(hv)) return jet;
  // at an end to one side of the point
  for (const auto& [su, sv] : {std::pair{0, 0}, {0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
    Stencil at;
    if (!fill(surface, {u, v}, {hu, hv}, su, sv, y, at)) continue;
    const Weights wu(su, hu), wv(sv, hv);
    const auto sum = [&](const auto& along_u, const auto& along_v) {
      Vec3 all = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) all += along_u[i] * along_v[j] * at[i][j];
      return all;
    };
    const auto here = [](int shift) {
      std::array<double, 3> one{};
      one[static_cast<std::size_t>(1 - shift)] = 1.0;
      return one;
    };
    jet.pu = sum(wu.first, here(sv));
    jet.pv = sum(here(su), wv.first);
    jet.puu = sum(wu.second, here(sv));
    jet.pvv = sum(here(su), wv.second);
    jet.puv = sum(wu.first, wv.first);
    jet.outward = jet.pu.cross(jet.pv).dot(middle->normal_S) < 0.0 ? -1.0 : 1.0;
    break;
  }
  return jet;
}

const Parametric* parametric(const Surface& surface) { return dynamic_cast<const Parametric*>(&surface); }

}  // namespace

void evaluate(const Surface& surface, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  if (uv.size() != out.size()) throw Error(ErrorKind::configuration, "evaluate() needs as many results as parameters");
  if (const Parametric* own = parametric(surface)) return own->do_evaluate(uv, out);
  for (std::size_t i = 0; i < uv.size(); ++i)
    out[i] = uv[i].allFinite() ? by_differences(surface, uv[i].x(), uv[i].y()) : SurfaceJet{};
}

bool has_exact_derivatives(const Surface& surface) {
  const Parametric* own = parametric(surface);
  return own != nullptr && own->exact_derivatives();
}

SurfaceShape shape_of(const SurfaceJet& jet) {
  SurfaceShape out;
  out.normal = jet.outward * jet.pu.cross(jet.pv).normalized();
  const double e = jet.pu.dot(jet.pu), f = jet.pu.dot(jet.pv), g = jet.pv.dot(jet.pv);
  const double l = -jet.puu.dot(out.normal), m = -jet.puv.dot(out.normal), n = -jet.pvv.dot(out.normal);
  // the second form in unit tangents along pu and at right angles to it, so that equal curvatures lose no digits
  const double skew = f / e, across = g - f * skew;
  const double a = l / e, b = (m - skew * l) / std::sqrt(e * across), c = (n - skew * (2.0 * m - skew * l)) / across;
  const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
  out.curvature_1 = mean + spread;
  out.curvature_2 = mean - spread;
  const double angle = 0.5 * std::atan2(2.0 * b, a - c);
  const Vec3 t1 = jet.pu / std::sqrt(e), t2 = (jet.pv - skew * jet.pu) / std::sqrt(across);
  out.direction_1 = std::cos(angle) * t1 + std::sin(angle) * t2;
  out.direction_2 = out.normal.cross(out.direction_1);
  return out;
}

double normal_curvature(const SurfaceShape& s, const Vec3& direction) {
  const double c = direction.dot(s.direction_1), d = direction.dot(s.direction_2);
  return (s.curvature_1 * c * c + s.curvature_2 * d * d) / (c * c + d * d);
}

}  // namespace treadmark
