// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/assembly/outermost_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::assembly {
namespace {

/// Fields of one part, of which only what is wanted has entries.
struct PartFields {
  std::vector<double> z, dzdx, dzdy;

  PartFields(std::size_t n, const HeightsOut& wanted)
      : z(n), dzdx(wanted.dzdx.empty() ? 0 : n), dzdy(wanted.dzdy.empty() ? 0 : n) {}
  HeightsOut out() { return {z, dzdx, dzdy}; }
};

class OutermostSurface final : public Surface {
 public:
  explicit OutermostSurface(std::vector<std::shared_ptr<const Surface>> parts) : parts_(std::move(parts)) {
    if (parts_.empty()) throw Error(ErrorKind::configuration, "a body of several surfaces needs at least one");
    std::vector<std::string_view> names;
    for (const auto& part : parts_) {
      if (part == nullptr) throw Error(ErrorKind::configuration, "a part of a body has no surface");
      if (part->facing() != facing())
        throw Error(ErrorKind::configuration, "the parts of a body must all be rails, or all wheels");
      if (std::find(names.begin(), names.end(), part->backend()) == names.end()) names.push_back(part->backend());
    }
    std::sort(names.begin(), names.end());
    for (const std::string_view name : names) {
      if (!backend_.empty()) backend_ += '+';
      backend_ += name;
    }
  }

  std::string_view backend() const override { return backend_; }
  Facing facing() const override { return parts_.front()->facing(); }
  Box3 bounds() const override {
    Box3 all = parts_.front()->bounds();
    for (const auto& part : parts_) {
      const Box3 box = part->bounds();
      all.min = all.min.cwiseMin(box.min);
      all.max = all.max.cwiseMax(box.max);
    }
    return all;
  }
  std::size_t memory_bytes() const override {
    std::size_t sum = sizeof(*this);
    for (const auto& part : parts_) sum += part->memory_bytes();
    return sum;
  }
  /// Those of all parts, with the number of the part before their names.
  std::vector<ShapeParameter> parameters() const override {
    std::vector<ShapeParameter> all;
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (ShapeParameter& one : parts_[k]->parameters()) {
        one.name = "part_" + std::to_string(k) + '_' + one.name;
        all.push_back(std::move(one));
      }
    return all;
  }
  std::size_t parameter_count() const override {
    std::size_t sum = 0;
    for (const auto& part : parts_) sum += part->parameter_count();
    return sum;
  }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override {
    std::vector<std::shared_ptr<const Surface>> parts = parts_;
    for (auto& part : parts) {
      const std::size_t count = part->parameter_count();
      if (parameter < count) {
        part = part->changed(parameter, amount);
        return std::make_shared<OutermostSurface>(std::move(parts));
      }
      parameter -= count;
    }
    return nullptr;
  }
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override {
    std::vector<double> z(points_P.size()), own(points_P.size());
    heights_at(X_SP, points_P, {z, {}, {}});
    HeightsBy how = HeightsBy::exact;
    std::vector<char> taken(points_P.size(), 0);
    for (const auto& part : parts_) {
      std::vector<double> of_part(weights.size(), 0.0);
      part->heights_at(X_SP, points_P, {own, {}, {}});
      for (std::size_t i = 0; i < z.size(); ++i)
        if (taken[i] == 0 && own[i] == z[i]) of_part[i] = weights[i], taken[i] = 1;
      const std::size_t count = part->parameter_count();
      if (part->pull_back(X_SP, points_P, of_part, by.first(count)) == HeightsBy::differences)
        how = HeightsBy::differences;
      by = by.subspan(count);
    }
    return how;
  }
  bool outside_of(double z, double other) const { return facing() == Facing::up ? z < other : z > other; }

  /// Whether z replaces what has been found so far (NaN: nothing).
  bool wins(double z, double best) const { return !std::isnan(z) && (std::isnan(best) || outside_of(z, best)); }

  /// best_z: the outermost heights so far.
  void merge(const PartFields& part, std::vector<double>& best_z, const HeightsOut& out) const {
    for (std::size_t i = 0; i < best_z.size(); ++i) {
      if (!wins(part.z[i], best_z[i])) continue;
      best_z[i] = part.z[i];
      if (!out.dzdx.empty()) out.dzdx[i] = part.dzdx[i];
      if (!out.dzdy.empty()) out.dzdy[i] = part.dzdy[i];
    }
  }

  /// evaluate: const Surface&, HeightsOut; empty: const Surface& -> whether the part is nowhere near.
  template <class Evaluate, class Empty>
  void outermost(std::size_t n, const HeightsOut& out, Evaluate evaluate, Empty empty) const {
    std::vector<double> best_z(n, kNaN);
    for (const auto field : {out.dzdx, out.dzdy}) std::fill(field.begin(), field.end(), kNaN);
    PartFields fields(n, out);
    for (const auto& part : parts_) {
      if (empty(*part)) continue;
      evaluate(*part, fields.out());
      merge(fields, best_z, out);
    }
    std::copy_n(best_z.begin(), out.z.size(), out.z.begin());
  }

  /// Whether the part has nothing over the points; bounds are dearer than a few points of a few parts.
  bool nowhere_over(const Surface& part, const Pose& X_SP, std::span<const Vec2> points_P) const {
    constexpr std::size_t kFewParts = 8;
    if (parts_.size() <= kFewParts || points_P.empty()) return false;
    Rectangle whole{points_P[0].x(), points_P[0].x(), points_P[0].y(), points_P[0].y()};
    for (const Vec2& p : points_P)
      whole = {std::min(whole.x_min, p.x()), std::max(whole.x_max, p.x()), std::min(whole.y_min, p.y()),
               std::max(whole.y_max, p.y())};
    return whole.x_max >= whole.x_min && whole.y_max >= whole.y_min && part.height_bounds(X_SP, whole).empty;
  }

  void do_heights(const PlaneGrid& plane, const HeightsOut& out) const override {
    const Grid2& g = plane.grid;
    const Rectangle whole{g.x0, g.x(g.nx - 1), g.y0, g.y(g.ny - 1)};
    outermost(
        g.size(), out, [&](const Surface& part, const HeightsOut& fields) { part.heights(plane, fields); },
        [&](const Surface& part) { return part.height_bounds(plane.X_SP, whole).empty; });
  }

  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override {
    outermost(
        points_P.size(), out,
        [&](const Surface& part, const HeightsOut& fields) { part.heights_at(X_SP, points_P, fields); },
        [&](const Surface& part) { return nowhere_over(part, X_SP, points_P); });
  }

  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override {
    std::vector<double> best_z(out.size(), kNaN);
    std::fill(out.begin(), out.end(), SurfacePoint{});
    std::vector<SurfacePoint> found(out.size());
    const Vec3 normal = X_SP.rotation.col(2);
    for (const auto& part : parts_) {
      if (nowhere_over(*part, X_SP, points_P)) continue;
      part->locate(X_SP, points_P, found);
      for (std::size_t i = 0; i < out.size(); ++i) {
        if (found[i].status == LocateStatus::outside) continue;
        const double z = normal.dot(found[i].position_S - X_SP.origin);
        if (!wins(z, best_z[i])) continue;
        best_z[i] = z;
        out[i] = found[i];
        // every part has parameters and a zero of its own
        out[i].arc_length = kNaN;
        const Vec3& p = found[i].position_S;
        out[i].u = facing() == Facing::up ? p.x() : std::atan2(p.x(), p.z());
        out[i].v = p.y();
      }
    }
  }

  static HeightBounds both(const HeightBounds& a, const HeightBounds& b) {
    if (a.empty || b.empty) return a.empty ? b : a;
    return {std::min(a.z_min, b.z_min), std::max(a.z_max, b.z_max), false};
  }

  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override {
    HeightBounds all{0.0, 0.0, true};
    for (const auto& part : parts_) all = both(all, part->height_bounds(X_SP, rectangle_P));
    return all;
  }

  void do_grid_bounds(const Pose& X_SP, const RectangleGrid& rectangles_P, std::span<HeightBounds> out) const override {
    std::fill(out.begin(), out.end(), HeightBounds{0.0, 0.0, true});
    std::vector<HeightBounds> found(out.size());
    for (const auto& part : parts_) {
      part->height_bounds(X_SP, rectangles_P, found);
      std::transform(out.begin(), out.end(), found.begin(), out.begin(), both);
    }
  }

  std::vector<std::shared_ptr<const Surface>> parts_;
  std::string backend_;
};

}  // namespace

std::shared_ptr<const Surface> outermost_of(std::vector<std::shared_ptr<const Surface>> parts) {
  return std::make_shared<OutermostSurface>(std::move(parts));
}

}  // namespace treadmark::assembly
