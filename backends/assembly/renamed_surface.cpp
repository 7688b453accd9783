// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/assembly/renamed_surface.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parametric.hpp"

namespace treadmark::assembly {
namespace {

class RenamedSurface final : public Surface, public Parametric {
 public:
  RenamedSurface(std::shared_ptr<const Surface> made, std::string name)
      : made_(std::move(made)), name_(std::move(name)) {
    if (made_ == nullptr) throw Error(ErrorKind::configuration, "there is no surface to be named");
  }

  std::string_view backend() const override { return name_; }
  Facing facing() const override { return made_->facing(); }
  Box3 bounds() const override { return made_->bounds(); }
  std::size_t memory_bytes() const override { return made_->memory_bytes(); }
  bool constant_profile() const override { return made_->constant_profile(); }
  bool constant_between(double u_min, double u_max) const override { return made_->constant_between(u_min, u_max); }
  std::vector<double> data_v() const override { return made_->data_v(); }
  std::vector<ShapeParameter> parameters() const override { return made_->parameters(); }
  std::size_t parameter_count() const override { return made_->parameter_count(); }
  void do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const override { evaluate(*made_, uv, out); }
  bool exact_derivatives() const override { return has_exact_derivatives(*made_); }

 private:
  std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const override {
    return std::make_shared<RenamedSurface>(made_->changed(parameter, amount), name_);
  }
  bool do_heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const override {
    return made_->heights_by(parameter, plane_grid, by) == HeightsBy::exact;
  }
  std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                        std::span<const double> weights, std::span<double> by) const override {
    return made_->pull_back(X_SP, points_P, weights, by);
  }
  void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const override {
    made_->heights(plane_grid, out);
  }
  void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const override {
    made_->heights_at(X_SP, points_P, out);
  }
  void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const override {
    made_->locate(X_SP, points_P, out);
  }
  HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const override {
    return made_->height_bounds(X_SP, rectangle_P);
  }
  void do_grid_bounds(const Pose& X_SP, const RectangleGrid& rectangles_P, std::span<HeightBounds> out) const override {
    made_->height_bounds(X_SP, rectangles_P, out);
  }

  std::shared_ptr<const Surface> made_;
  std::string name_;
};

}  // namespace

std::shared_ptr<const Surface> rename_surface(std::shared_ptr<const Surface> surface, std::string backend) {
  return std::make_shared<RenamedSurface>(std::move(surface), std::move(backend));
}

}  // namespace treadmark::assembly
