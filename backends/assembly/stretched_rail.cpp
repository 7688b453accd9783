// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/assembly/stretched_rail.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <utility>

#include "treadmark/backends/assembly/limited_surface.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::assembly {
namespace {

class StretchedRail final : public Surface, public Parametric {
 public:
  explicit StretchedRail(RailStretches stretches) : all_(std::move(stretches)) {
    const std::vector<double>& ends = all_.ends;
    if (ends.size() < 2 ||
        std::adjacent_find(ends.begin(), ends.end(), [](double a, double b) { return !(a < b); }) != ends.end())
      throw Error(ErrorKind::configuration, "the ends of stretches of a rail must increase");
  }

  std::string_view backend() const override { return all_.backend; }
  Facing facing() const override { return Facing::up; }
  Box3 bounds() const override {
    return {Vec3(all_.ends.front(), all_.y_min, all_.z_min), Vec3(all_.ends.back(), all_.y_max, all_.z_max)};
  }
  std::size_t memory_bytes() const override {
    const std::lock_guard lock(mutex_);
    std::size_t sum = sizeof(*this);
    for (const auto& [number, surface] : open_) sum += surface->memory_bytes();
    return sum;
  }

 private:
  using Part = std::shared_ptr<const Surface>;

  std::size_t count() const { return all_.ends.size() - 1; }

  Part part(std::size_t number) const {
    const auto kept = [&]() -> Part {
      for (auto one = open_.begin(); one != open_.end(); ++one)
        if (one->first == number) {
          open_.splice(open_.begin(), open_, one);
          return one->second;
        }
      return nullptr;
    };
    {
      const std::lock_guard lock(mutex_);
      if (Part found = kept()) return found;
    }
    Part made = limit_along(all_.open(number), all_.ends[number], all_.ends[number + 1]);
    const std::lock_guard lock(mutex_);
    if (Part found = kept()) return found;  // another thread was faster
    open_.emplace_front(number, made);
    if (open_.size() > std::max<std::size_t>(1, all_.most_open)) open_.pop_back();
    return made;
  }

  /// Where the rail is over a rectangle of a plane: x in its own frame, z in the plane's.
  struct Reach {
    double x_min = -kInfinity, x_max = kInfinity, z_min = -kInfinity, z_max = kInfinity;
  };
  Reach reach(const Pose& X_SP, const Rectangle& r) const {
    const Mat3& R = X_SP.rotation;
    constexpr double kLeastUp = 0.05;  // of the plane's normal
    const bool finite =
        std::isfinite(r.x_min) && std::isfinite(r.x_max) && std::isfinite(r.y_min) && std::isfinite(r.y_max);
    if (!finite || !(std::fabs(R(2, 2)) > kLeastUp)) return {};
    Reach out{kInfinity, -kInfinity, kInfinity, -kInfinity};
    for (const double x : {r.x_min, r.x_max})
      for (const double y : {r.y_min, r.y_max})
        for (const double z_S : {all_.z_min, all_.z_max}) {
          const double z = (z_S - X_SP.origin.z() - R(2, 0) * x - R(2, 1) * y) / R(2, 2),
                       x_S = X_SP.origin.x() + R(0, 0) * x + R(0, 1) * y + R(0, 2) * z;
          out.x_min = std::min(out.x_min, x_S), out.x_max = std::max(out.x_max, x_S);
          out.z_min = std::min(out.z_min, z), out.z_max = std::max(out.z_max, z);
        }
    return out;
  }

  std::size_t number_at(double x) const {
    const auto after = std::upper_bound(all_.ends.begin() + 1, all_.ends.end() - 1, x);
    return static_cast<std::size_t>(after - all_.ends.begin()) - 1;
  }
  /// Numbers of the first and last stretch; none where the rail does not reach.
  std::vector<std::size_t> over(const Reach& reach) const {
    std::vector<std::size_t> out;
    if (reach.x_max < all_.ends.front() || reach.x_min > all_.ends.back()) return out;
    for (std::size_t k = number_at(reach.x_min); k < count() && (out.empty() || all_.ends[k] <= reach.x_max); ++k)
      out.push_back(k);
    return out;
  }

  static Rectangle around(std::span<const Vec2> points) {
    Rectangle out{kInfinity, -kInfinity, kInfinity, -kInfinity};
    for (const Vec2& p : points)
      out = {std::min(out.x_min, p.x()), std::max(out.x_max, p.x()), std::min(out.y_min, p.y()),
             std::max(out.y_max, p.y())};
    return out;
  }

  /// evaluate: const Surface&, const HeightsOut&.
  template <class Evaluate>
  void join(std::size_t points, const std::vector<std::size_t>& parts, const HeightsOut& out,
            const Evaluate& evaluate) const {
    if (parts.size() == 1) return evaluate(*part(parts.front()), out);
    for (const auto field : {out.z, out.dzdx, out.dzdy}) std::fill(field.begin(), field.end(), kNaN);
    std::vector<double> z(points), dzdx(out.dzdx.size()), dzdy(out.dzdy.size());
    for (const std::size_t number : parts) {
      evaluate(*part(number), HeightsOut{z, dzdx, dzdy});
      for (std::size_t i = 0; i < points; ++i) {
        if (std::isnan(z[i])) continue;
        if (!out.z.empty()) out.z[i] = z[i];
        if (!dzdx.empty()) out.dzdx[i] = dzdx[i];
        if (!dzdy.empty()) out.dzdy[i] = dzdy[i];
      }
    }
  }

  void do_heights(const PlaneGrid& plane, const HeightsOut& out) const override {
    const Grid2& g = plane.grid;
    join(g.size(), over(reach(plane.X_SP, {g.x0, g.x(g.nx - 1), g.y0, g.y(g.ny - 1)})), out,
         [&](const Surface& part, const HeightsOut& fields) { part.heights(plane, fields); });
  }
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override {
    join(points_P.size(), points_P.empty() ? std::vector<std::size_t>{} : over(reach(X_SP, around(points_P))), out,
         [&](const Surface& part, const HeightsOut& fields) { part.heights_at(X_SP, points_P, fields); });
  }
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override {
    std::fill(out.begin(), out.end(), SurfacePoint{});
    if (points_P.empty()) return;
    std::vector<SurfacePoint> found(out.size());
    for (const std::size_t number : over(reach(X_SP, around(points_P)))) {
      part(number)->locate(X_SP, points_P, found);
      for (std::size_t i = 0; i < out.size(); ++i)
        if (found[i].status != LocateStatus::outside) out[i] = found[i];
    }
  }
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override {
    for (std::size_t i = 0; i < uv.size(); ++i) {
      out[i] = {};
      if (uv[i].x() >= all_.ends.front() && uv[i].x() <= all_.ends.back())
        treadmark::evaluate(*part(number_at(uv[i].x())), uv.subspan(i, 1), out.subspan(i, 1));
    }
  }
  bool exact_derivatives() const override { return has_exact_derivatives(*part(0)); }

  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override {
    const Reach here = reach(X_SP, rectangle_P);
    const std::vector<std::size_t> parts = over(here);
    // of a large part the box says enough
    constexpr std::size_t kMostAsked = 4;
    if (parts.size() > kMostAsked && std::isfinite(here.z_min)) return {here.z_min, here.z_max, false};
    HeightBounds out{0.0, 0.0, true};
    for (const std::size_t number : parts) {
      const HeightBounds one = part(number)->height_bounds(X_SP, rectangle_P);
      if (one.empty) continue;
      out = out.empty ? one : HeightBounds{std::min(out.z_min, one.z_min), std::max(out.z_max, one.z_max), false};
    }
    return out;
  }

  RailStretches all_;
  mutable std::mutex mutex_;
  mutable std::list<std::pair<std::size_t, Part>> open_;  ///< the last one asked for first
};

}  // namespace

std::shared_ptr<const Surface> join_stretches(RailStretches stretches) {
  return std::make_shared<StretchedRail>(std::move(stretches));
}

}  // namespace treadmark::assembly
