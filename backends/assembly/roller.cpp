// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/assembly/roller.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::assembly {
namespace {

using displacement::OffsetField;
using displacement::OffsetJet;
using displacement::OffsetRange;

/// Turned by half a turn and run through backwards, a chain keeps its angles; its curvatures change sign.
ArcChain turned(const ArcChain& chain) {
  const std::vector<analytic::ChainSegment> segments = analytic::resolve(chain);
  const analytic::ChainPoint end = analytic::point_on(segments.back(), segments.back().length);
  ArcChain out{-end.y, -end.z, end.angle, {}};
  for (auto s = chain.segments.rbegin(); s != chain.segments.rend(); ++s)
    out.segments.push_back({s->length, -s->curvature});
  return out;
}

/// The order of the points becomes that of the other body by itself.
Profile turned(Profile profile, Body body) {
  profile.body = body;
  for (double& y : profile.y) y = -y;
  for (double& z : profile.z) z = -z;
  return profile;
}

SliceSet turned(SliceSet slices, Body body, double factor) {
  slices.body = body;
  for (double& u : slices.u) u *= factor;
  for (Profile& p : slices.profiles) p = turned(std::move(p), body);
  return slices;
}

void turn_over(TriangleMesh& mesh, double radius) {
  for (Vec3& v : mesh.vertices) v = {v.x(), -v.y(), radius - v.z()};
}

/// A field of a rail laid round the wheel: dr(theta, y) = -dz(radius theta, -y).
class FieldRound final : public OffsetField {
 public:
  FieldRound(std::shared_ptr<const OffsetField> rail, double radius) : rail_(std::move(rail)), radius_(radius) {}

  OffsetJet jet(double u, double y) const override {
    const OffsetJet r = rail_->jet(x_of(u), -y);
    return {-r.value, -radius_ * r.d_u, r.d_y, -radius_ * radius_ * r.d_uu, radius_ * r.d_uy, -r.d_yy};
  }
  void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                std::span<double> d_y) const override {
    std::vector<double> x(u.size()), across(y.size());
    std::transform(u.begin(), u.end(), x.begin(), [this](double theta) { return x_of(theta); });
    std::transform(y.begin(), y.end(), across.begin(), [](double v) { return -v; });
    rail_->evaluate(x, across, value, d_u, d_y);
    for (double& v : value) v = -v;
    for (double& v : d_u) v *= -radius_;
  }
  OffsetRange range(const Rectangle& uy) const override {
    const double width = uy.x_max - uy.x_min, start = x_of(uy.x_min), half = kPi * radius_;
    if (!(width < 2.0 * kPi)) return over({-half, half, uy.y_min, uy.y_max});
    const double end = start + radius_ * width;
    const OffsetRange first = over({start, std::min(end, half), uy.y_min, uy.y_max});
    return end <= half ? first : both(first, over({-half, end - 2.0 * half, uy.y_min, uy.y_max}));
  }
  std::size_t memory_bytes() const override { return sizeof(*this) + rail_->memory_bytes(); }

 private:
  double x_of(double theta) const { return radius_ * wrap_angle(theta); }
  OffsetRange over(const Rectangle& r) const {
    const OffsetRange rail = rail_->range({r.x_min, r.x_max, -r.y_max, -r.y_min});
    return {-rail.high, -rail.low, radius_ * rail.max_d_u, rail.max_d_y};
  }
  static OffsetRange both(const OffsetRange& a, const OffsetRange& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high), std::max(a.max_d_u, b.max_d_u),
            std::max(a.max_d_y, b.max_d_y)};
  }

  std::shared_ptr<const OffsetField> rail_;
  double radius_;
};

void require_once_round(const SliceSet& slices, double radius) {
  constexpr double kRounding = 1e-9;
  if (slices.u.empty() || slices.u.back() - slices.u.front() <= 2.0 * kPi * radius * (1.0 + kRounding)) return;
  throw Error(ErrorKind::configuration, "the slices '" + slices.name + "' go round the roller more than once", {},
              "x of the slices is the arc length at the roller's nominal radius");
}

}  // namespace

SurfaceSpec wheel_of_roller(const SurfaceSpec& roller) {
  const double radius = roller.roller_radius;
  if (!(radius > 0.0) || !std::isfinite(radius))
    throw Error(ErrorKind::configuration, "a roller needs a positive nominal radius", {},
                "rings that a wheel runs in (negative radius) are not wheels turned over");
  SurfaceSpec wheel;
  wheel.body = Body::wheel;
  wheel.nominal_radius = radius;
  if (const auto* slices = std::get_if<SliceSet>(&roller.shape)) {
    require_once_round(*slices, radius);
    wheel.shape = turned(*slices, Body::wheel, 1.0 / radius);
  } else if (const auto* points = std::get_if<Profile>(&roller.shape)) {
    wheel.shape = turned(*points, Body::wheel);
  } else if (const auto* chain = std::get_if<ArcChain>(&roller.shape)) {
    wheel.shape = turned(*chain);
  } else if (const auto* mesh = std::get_if<TriangleMesh>(&roller.shape)) {
    TriangleMesh moved = *mesh;
    turn_over(moved, radius);
    wheel.shape = std::move(moved);
  } else {
    wheel.shape = turned(std::get<ArcChain>(analytic::standard_curve(std::get<StandardProfile>(roller.shape).name)));
  }
  return wheel;
}

SliceSet roller_slices(const SliceSet& wheel, double radius) { return turned(wheel, Body::rail, radius); }

TriangleMesh roller_triangles(TriangleMesh wheel, double radius) {
  turn_over(wheel, radius);
  return wheel;
}

std::shared_ptr<const Surface> add_roller_defects(std::shared_ptr<const Surface> wheel, const Defects& defects,
                                                  double radius) {
  if (defects.empty()) return wheel;
  if (!defects.flattened_heads.empty() || !defects.milling_paths.empty())
    throw Error(ErrorKind::configuration,
                "flattened heads and milling paths are straight cuts along a rail, they do not fit a roller", {},
                "use a corrugation or a squat, or triangles of the damaged roller");
  auto field = std::make_shared<FieldRound>(analytic::make_defect_field(defects, Body::rail, 0.0, nullptr), radius);
  std::string name(wheel->backend());
  return displacement::make_displaced_surface(std::move(wheel), std::move(field), Body::wheel, std::move(name));
}

}  // namespace treadmark::assembly
