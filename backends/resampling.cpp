// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/backends/sampling/convert_points.hpp"
#include "treadmark/backends/sampling/lateral_nodes.hpp"
#include "treadmark/backends/sampling/sample_points.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark {

Resampling::Resampling(const NaturalSurface& natural, const Representation& wanted)
    : natural_(natural),
      region_(wanted.region),
      resolution_(wanted.resolution > 0.0 ? wanted.resolution : kDefaultResolution),
      asked_(wanted.resolution > 0.0) {
  if (!(wanted.resolution >= 0.0) || !std::isfinite(wanted.resolution))
    throw Error(ErrorKind::configuration, "the resolution of a surface must be positive");
}

void Resampling::limit_rail() {
  if (spec().body != Body::rail) return;
  const Box3 box = surface().bounds();
  const auto limit = [&](double& end, double box_end, double fallback) {
    if (std::isfinite(end)) return;
    end = std::isfinite(box_end) ? box_end : fallback;
  };
  const bool open = !std::isfinite(region_.u_min) || !std::isfinite(region_.u_max);
  limit(region_.u_min, box.min.x(), -kDefaultHalfLength);
  limit(region_.u_max, box.max.x(), kDefaultHalfLength);
  if (open && !std::isfinite(box.max.x()))
    note_ += fmt::format("the rail was sampled from x = {:g} m to {:g} m. ", region_.u_min, region_.u_max);
}

sampling::PointGrid Resampling::points(bool common, bool staggered) {
  limit_rail();
  sampling::SampleSettings s{resolution_, 0.0, region_, common, true, staggered};
  // along a prismatic rail nothing changes: longer steps lose nothing
  constexpr double kLongStep = 4.0;
  if (natural_.constant_profile() && spec().body == Body::rail) s.spacing_u = kLongStep * resolution_;
  // the rows of triangles begin half a step apart: begin earlier, so that the region itself is covered
  if (staggered) {
    const double step =
        (s.spacing_u > 0.0 ? s.spacing_u : resolution_) / (spec().body == Body::wheel ? spec().nominal_radius : 1.0);
    s.region.u_min -= step;
    s.region.u_max += step;
  }
  return kept(sampling::sample_points(surface(), spec().body, spec().nominal_radius, s));
}

Profile Resampling::section() const {
  sampling::SampleSettings s{resolution_, 1e-3, region_, false, false};
  s.region.u_min = 0.0;
  s.region.u_max = spec().body == Body::wheel ? 1e-2 : 3e-3;
  if (spec().body == Body::rail) {
    const Box3 box = surface().bounds();
    if (std::isfinite(box.min.x())) s.region.u_min = box.min.x(), s.region.u_max = box.max.x();
  }
  return sampling::median_section(sampling::sample_points(surface(), spec().body, spec().nominal_radius, s),
                                  spec().nominal_radius, name_of_samples());
}

Profile Resampling::section_at(double u) const {
  const std::vector<double> station{u};
  sampling::PointGrid one;
  one.body = spec().body;
  one.u = station;
  one.y = sampling::lateral_nodes(surface(), spec().body, station, resolution_, region_.y_min, region_.y_max);
  one.h.resize(one.y.size());
  section_heights(surface(), spec().body, u, one.y, {one.h, {}, {}});
  return sampling::to_slices(one, spec().nominal_radius, name_of_samples()).profiles.front();
}

SliceSet Resampling::slices() { return sampling::to_slices(points(false), spec().nominal_radius, name_of_samples()); }

TriangleMesh Resampling::triangles() {
  const auto* given = std::get_if<TriangleMesh>(&spec().shape);
  if (given != nullptr && !asked_ && spec().defects.empty()) {
    resolution_ = 0.0;
    return *given;
  }
  return sampling::to_mesh(points(false, true), name_of_samples());
}

Profile Resampling::median_section() {
  limit_rail();
  constexpr double kStations = 200.0;
  const bool wheel = spec().body == Body::wheel;
  const double R = spec().nominal_radius, length = region_.u_max - region_.u_min;
  const double whole = wheel ? 2.0 * kPi * R : length;
  const double along = wheel && length < 7.0 ? length * R : std::min(whole, length);
  sampling::SampleSettings s{resolution_, 0.0, region_, false, false};
  s.spacing_u = std::max(resolution_, (std::isfinite(along) ? along : whole) / kStations);
  return sampling::median_section(kept(sampling::sample_points(surface(), spec().body, R, s)), R, "median section");
}

std::string Resampling::name_of_samples() const {
  return spec().body == Body::wheel ? "samples of the wheel" : "samples of the rail";
}

/// What was sampled of a part of a wheel is all that the result stands for.
sampling::PointGrid Resampling::kept(sampling::PointGrid grid) {
  if (spec().body == Body::wheel && !grid.closed) {
    region_.u_min = std::max(region_.u_min, grid.u.front());
    region_.u_max = std::min(region_.u_max, grid.u.back());
  }
  return grid;
}

}  // namespace treadmark
