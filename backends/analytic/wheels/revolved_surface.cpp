// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/revolved_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "treadmark/backends/analytic/wheels/wheel_bounds.hpp"
#include "treadmark/backends/analytic/wheels/wheel_lines.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/surface_change.hpp"

namespace treadmark::analytic {

namespace {

/// Normal and principal curvatures from the Hessian of F in the axes e_r, e_theta, e_y.
void fill_shape(const WheelBody& body, const WheelHit& hit, SurfacePoint& point) {
  const double theta = std::atan2(hit.x, hit.z), r = hit.r;
  const Jet curve = body.curve.jet(hit.y, body.curve.find(hit.y, 0));
  const DepthJet d = body.flats.jet(theta, hit.y);
  const Vec3 g(1.0, d.d_theta / r, d.d_y - curve.dh);
  Mat3 H = Mat3::Zero();
  H(0, 1) = H(1, 0) = -d.d_theta / (r * r);
  H(1, 1) = d.d_theta_theta / (r * r) + 1.0 / r;
  H(1, 2) = H(2, 1) = d.d_theta_y / r;
  H(2, 2) = d.d_y_y - curve.ddh;

  const double length = g.norm();
  const Vec3 n = g / length;
  const Vec3 t1 = Vec3(-n.y(), n.x(), 0.0).normalized(), t2 = n.cross(t1);
  const double a = t1.dot(H * t1) / length, b = t1.dot(H * t2) / length, c = t2.dot(H * t2) / length;
  const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
  point.curvature_1 = mean + spread;
  point.curvature_2 = mean - spread;
  const double sin = hit.x / r, cos = hit.z / r;
  point.normal_S = {n.x() * sin + n.y() * cos, n.z(), n.x() * cos - n.y() * sin};
  point.u = theta;
  point.v = hit.y;
}

/// What a piece of a profile that bends by 1/m more adds to the radius.
class BentPiece final : public displacement::OffsetField {
 public:
  BentPiece(const GraphCurve& curve, int piece)
      : from_(curve.piece_start(piece)), to_(curve.piece_end(piece)), held_(std::clamp(0.0, from_, to_)) {}

  displacement::OffsetJet jet(double, double y) const override {
    const double inside = std::clamp(y, from_, to_), lever = inside - held_;
    return {0.5 * lever * lever + lever * (y - inside), 0.0, lever, 0.0, 0.0, inside == y ? 1.0 : 0.0};
  }
  displacement::OffsetRange range(const Rectangle& uy) const override {
    // it grows from the piece's held end on both sides, and so does the size of its slope
    const displacement::OffsetJet a = jet(0.0, uy.y_min), b = jet(0.0, uy.y_max);
    const bool holds = uy.y_min <= held_ && held_ <= uy.y_max;
    return {holds ? 0.0 : std::min(a.value, b.value), std::max(a.value, b.value), 0.0,
            std::max(std::fabs(a.d_y), std::fabs(b.d_y))};
  }
  bool constant_along() const override { return true; }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  double from_, to_, held_;
};

/// What flats take off the radius, once more.
class FlatsAgain final : public displacement::OffsetField {
 public:
  explicit FlatsAgain(FlatDepth flats) : flats_(std::move(flats)) {}

  displacement::OffsetJet jet(double u, double y) const override {
    const DepthJet d = flats_.jet(u, y);
    return {-d.d, -d.d_theta, -d.d_y, -d.d_theta_theta, -d.d_theta_y, -d.d_y_y};
  }
  displacement::OffsetRange range(const Rectangle& uy) const override {
    const FlatDepth::Range r =
        flats_.range(0.5 * (uy.x_min + uy.x_max), 0.5 * (uy.x_max - uy.x_min), uy.y_min, uy.y_max);
    return {-r.high, -r.low, r.max_d_theta, r.max_d_y};
  }
  std::size_t memory_bytes() const override { return sizeof(*this) + flats_.memory_bytes(); }

 private:
  FlatDepth flats_;
};

}  // namespace

std::vector<ShapeParameter> RevolvedSurface::parameters() const {
  constexpr double kFar = 5e-8, kAmount = 1e-4;  // [m] by which the ends move, of depths of some tenths of a millimetre
  const GraphCurve& curve = body_.curve;
  std::vector<ShapeParameter> all;
  for (int k = 0; k < curve.piece_count(); ++k) {
    const double from = curve.piece_start(k), to = curve.piece_end(k), y = 0.5 * (from + to);
    const Vec3 place(0.0, y, body_.nominal_radius + curve.height(y, k));
    all.push_back(
        {"piece_" + std::to_string(k) + "_bend", "1/m", kFar / ((to - from) * (curve.y_max() - curve.y_min())), place});
  }
  if (!body_.flats.empty()) all.push_back({"flats", "1", kAmount});
  return all;
}

std::shared_ptr<const Surface> RevolvedSurface::do_change(std::size_t parameter, double amount) const {
  std::shared_ptr<const displacement::OffsetField> part;
  if (parameter < static_cast<std::size_t>(body_.curve.piece_count()))
    part = std::make_shared<BentPiece>(body_.curve, static_cast<int>(parameter));
  else
    part = std::make_shared<FlatsAgain>(body_.flats);
  return displacement::make_displaced_surface(std::make_shared<RevolvedSurface>(*this),
                                              displacement::with_more(nullptr, std::move(part), amount), Body::wheel,
                                              std::string(backend()));
}

std::optional<HeightsBy> RevolvedSurface::do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                                       std::span<const double> weights, std::span<double> by) const {
  std::vector<BentPiece> pieces;
  for (int k = 0; k < body_.curve.piece_count(); ++k) pieces.emplace_back(body_.curve, k);
  pull_back_by_displacement(*this, X_SP, points_P, weights,
                            [&](std::size_t, const SurfacePoint& at, const Vec3& force) {
                              const double pull = std::sin(at.u) * force.x() + std::cos(at.u) * force.z();
                              for (std::size_t k = 0; k < pieces.size(); ++k)
                                by[k] += pull * pieces[k].jet(at.u, at.v).value;
                              if (pieces.size() < by.size()) by.back() -= pull * body_.flats.jet(at.u, at.v).d;
                            });
  return HeightsBy::exact;
}

void RevolvedSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const WheelLines lines(body_, plane_grid.X_SP, out);
  const Grid2& g = plane_grid.grid;
  // lines of points along x, or along y where those are longer and there are few; neighbouring ones one after the other
  constexpr int kFew = 8, kLinesPerTask = 8;
  const bool along_x = g.nx >= kFew || g.nx >= g.ny;
  const int count = along_x ? g.ny : g.nx;
  const auto task = [&](std::size_t k) {
    const int begin = static_cast<int>(k) * kLinesPerTask;
    lines.march(g, along_x, begin, std::min(count, begin + kLinesPerTask));
  };
  const auto tasks = static_cast<std::size_t>((count + kLinesPerTask - 1) / kLinesPerTask);
  constexpr std::size_t kWorthThreads = 4000;
  if (g.size() < kWorthThreads)
    for (std::size_t k = 0; k < tasks; ++k) task(k);
  else
    parallel_for(tasks, task);
}

void RevolvedSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  const WheelLines lines(body_, X_SP, out);
  constexpr std::size_t kPointsPerTask = 1024;
  parallel_for((points_P.size() + kPointsPerTask - 1) / kPointsPerTask, [&](std::size_t task) {
    lines.follow(points_P, task * kPointsPerTask, std::min(points_P.size(), (task + 1) * kPointsPerTask));
  });
}

void RevolvedSurface::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double theta = uv[i].x(), y = uv[i].y();
    out[i] = {};
    if (!std::isfinite(theta) || !(y >= body_.curve.y_min() && y <= body_.curve.y_max())) continue;
    const Jet curve = body_.curve.jet(y, body_.curve.find(y, 0));
    const DepthJet d = body_.flats.jet(theta, y);
    const double r = body_.nominal_radius + curve.h - d.d, r_y = curve.dh - d.d_y;
    const Vec3 e(std::sin(theta), 0.0, std::cos(theta)), along(e.z(), 0.0, -e.x()), axle = Vec3::UnitY();
    out[i] = {r * e + y * axle,
              r * along - d.d_theta * e,
              r_y * e + axle,
              (-d.d_theta_theta - r) * e - 2.0 * d.d_theta * along,
              r_y * along - d.d_theta_y * e,
              (curve.ddh - d.d_y_y) * e,
              1.0};
  }
}

void RevolvedSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  WheelRay ray(body_, X_SP.rotation.col(2));
  WheelHit hit;
  Vec3 before = Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), normal = before;
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    out[i] = {};
    const Vec3 origin = X_SP.apply({points_P[i].x(), points_P[i].y(), 0.0});
    // from the tangent plane at the point before
    const double guess = normal.dot(before - origin) / normal.dot(X_SP.rotation.col(2));
    if (!ray.cast(origin, guess, hit)) continue;
    ray.refine(hit);
    out[i].position_S = before = {hit.x, hit.y, hit.z};
    fill_shape(body_, hit, out[i]);
    normal = out[i].normal_S;
    out[i].status = ray.hides_others(hit) ? LocateStatus::ambiguous : LocateStatus::converged;
  }
}

HeightBounds RevolvedSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const auto bounds = body_.hull.heights(body_.nominal_radius, body_.flats, X_SP, r);
  return bounds ? *bounds : WheelBounds(body_, X_SP, r).heights();
}

}  // namespace treadmark::analytic
