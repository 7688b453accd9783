// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "treadmark/backends/registry.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::testing {

/// Another surface but for faults that no height gives away: curvatures of its points, and bounds that are too narrow.
class WrongSurface : public Surface, public Parametric {
 public:
  WrongSurface(std::shared_ptr<const Surface> right, std::string name, double bend, double narrow)
      : right_(std::move(right)), name_(std::move(name)), bend_(bend), narrow_(narrow) {}
  std::string_view backend() const override { return name_; }
  Facing facing() const override { return right_->facing(); }
  Box3 bounds() const override { return right_->bounds(); }
  std::size_t memory_bytes() const override { return right_->memory_bytes(); }
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override { evaluate(*right_, uv, out); }
  bool exact_derivatives() const override { return has_exact_derivatives(*right_); }

 protected:
  std::shared_ptr<const Surface> right_;

 private:
  void do_heights(const PlaneGrid& plane, const HeightsOut& out) const override { right_->heights(plane, out); }
  void do_locate(const Pose& X_SP, std::span<const Vec2> points, std::span<SurfacePoint> out) const override {
    right_->locate(X_SP, points, out);
    for (SurfacePoint& p : out) p.curvature_1 *= bend_, p.curvature_2 *= bend_;
  }
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle) const override {
    const HeightBounds b = right_->height_bounds(X_SP, rectangle);
    const double middle = 0.5 * (b.z_min + b.z_max), half = 0.5 * (b.z_max - b.z_min) / narrow_;
    return {middle - half, middle + half, b.empty};
  }

  std::string name_;
  double bend_, narrow_;
};

/// "bent" has ten times the curvatures, bounds of "narrow" are twenty times too narrow. Once a program.
inline void register_wrong_backends() {
  for (const auto& [name, bend, narrow] : {std::tuple{"bent", 10.0, 1.0}, {"narrow", 1.0, 20.0}}) {
    Backend row{name, "wrong on purpose", 2.0};
    row.resample = [name = row.name, bend = bend, narrow = narrow](Resampling& r) {
      return std::make_shared<const WrongSurface>(r.natural().surface, name, bend, narrow);
    };
    register_backend(row);
  }
}

}  // namespace treadmark::testing
