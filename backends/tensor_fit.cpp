// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/tensor_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "treadmark/backends/natural_kind.hpp"
#include "treadmark/backends/resampling.hpp"
#include "treadmark/backends/sampling/lateral_nodes.hpp"
#include "treadmark/backends/sampling/sample_points.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark {
namespace {

constexpr double kAcross = 1e-3, kAlong = 4e-3;  // between points where nothing else is asked for [m]
constexpr double kFinest = 10e-6;                // [m]
constexpr int kMostPasses = 16;
constexpr double kPlaces[] = {0.25, 0.5, 0.75};  // between two points

/// Greatest deviations beside the middles of intervals.
struct Off {
  std::vector<double> along, across;
  double most = 0.0;
};

class Fit {
 public:
  Fit(const Surface& surface, Body body) : surface_(surface), body_(body) {}

  void fill(sampling::PointGrid& grid) const {
    grid.h.assign(grid.u.size() * grid.y.size(), 0.0);
    parallel_for(grid.u.size(), [&](std::size_t i) {
      section_heights(surface_, body_, grid.u[i], grid.y,
                      {std::span(grid.h).subspan(i * grid.y.size(), grid.y.size()), {}, {}});
    });
    for (const double h : grid.h)
      if (std::isnan(h))
        throw Error(ErrorKind::input_data, "a surface with gaps cannot become one spline", {},
                    "write triangles, or limit the range");
  }

  Off off(const sampling::PointGrid& grid, const Surface& spline, bool along_too, double tolerance) const {
    const std::size_t nu = grid.u.size(), ny = grid.y.size(), intervals = nu - (grid.closed ? 0 : 1);
    std::vector<double> between;
    between.reserve(3 * ny);
    for (std::size_t k = 0; k + 1 < ny; ++k)
      for (const double share : kPlaces) between.push_back(grid.y[k] + share * (grid.y[k + 1] - grid.y[k]));
    std::vector<std::vector<double>> across(nu);
    std::vector<double> along(intervals), both(intervals);
    parallel_for(nu, [&](std::size_t i) {
      across[i] = distances(spline, grid.u[i], between);
      if (!along_too || i >= intervals) return;
      const double next = i + 1 < nu ? grid.u[i + 1] : grid.u[0] + 2.0 * kPi;
      for (const double share : kPlaces) {
        const double u = grid.u[i] + share * (next - grid.u[i]);
        const std::vector<double> at_nodes = distances(spline, u, grid.y);
        along[i] = std::max(along[i], *ranges::max_element(at_nodes));
        const std::vector<double> inside = distances(spline, u, between);
        both[i] = std::max(both[i], *ranges::max_element(inside));
      }
    });
    Off out{along, std::vector<double>(ny - 1), 0.0};
    for (const auto& row : across)
      for (std::size_t k = 0; k < row.size(); ++k) out.across[k / 3] = std::max(out.across[k / 3], row[k]);
    for (const auto* list : {&out.along, &out.across, &both})
      for (const double d : *list) out.most = std::max(out.most, d);
    // what is left where both directions are good by themselves
    const auto good = [tolerance](double d) { return d <= tolerance; };
    if (ranges::all_of(out.along, good) && ranges::all_of(out.across, good)) out.along = both;
    return out;
  }

 private:
  /// Normal to the surface; 0 beside its ends.
  std::vector<double> distances(const Surface& spline, double u, const std::vector<double>& y) const {
    std::vector<double> z(y.size()), dx(y.size()), dy(y.size()), other(y.size());
    section_heights(surface_, body_, u, y, {z, dx, dy});
    section_heights(spline, body_, u, y, {other, {}, {}});
    for (std::size_t k = 0; k < y.size(); ++k) {
      const double d = std::fabs(other[k] - z[k]) / std::sqrt(1.0 + dx[k] * dx[k] + dy[k] * dy[k]);
      z[k] = std::isnan(d) ? 0.0 : d;
    }
    return z;
  }

  const Surface& surface_;
  Body body_;
};

/// With the middles of intervals that lie off and are not yet short; length(i): of interval i [m].
template <class Length>
std::vector<double> parted(const std::vector<double>& at, double end, const std::vector<double>& off, double tolerance,
                           const Length& length) {
  std::vector<double> out;
  out.reserve(2 * at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    out.push_back(at[i]);
    const double next = i + 1 < at.size() ? at[i + 1] : end;
    if (i < off.size() && off[i] > tolerance && length(i) > 2.0 * kFinest) out.push_back(0.5 * (at[i] + next));
  }
  return out;
}

/// The grid to begin with.
sampling::PointGrid coarse_grid(Resampling& r, bool one_section) {
  const Body body = r.spec().body;
  const double across = r.asked() ? r.resolution() : kAcross, along = r.asked() ? r.resolution() : kAlong;
  sampling::SampleSettings s{across, along, r.region(), true};
  if (one_section) {
    s.region.u_min = 0.0;
    s.region.u_max = body == Body::wheel ? 1e-2 : 3e-3;
    s.spacing_u = 1e-3;
    if (const Box3 box = r.surface().bounds(); body == Body::rail && std::isfinite(box.min.x()))
      s.region.u_min = box.min.x(), s.region.u_max = box.max.x(), s.spacing_u = (box.max.x() - box.min.x()) / 3.0;
  }
  return sampling::sample_points(r.surface(), body, r.spec().nominal_radius, s);
}

}  // namespace

TensorFit to_tensor_spline(const NaturalSurface& natural, const Representation& wanted, double tolerance) {
  const SurfaceSpec& spec = natural.spec;
  TensorFit out;
  const SplineSurface* given = given_splines(natural, {"", wanted.resolution, wanted.region});
  if (given != nullptr && !given->hierarchical) {
    out.spline = *given;
    out.sampled.region = wanted.region;
    return out;
  }
  Resampling r(natural, wanted);
  r.limit_rail();
  out.one_section = natural.constant_profile();
  sampling::PointGrid grid = coarse_grid(r, out.one_section);
  const Fit fit(r.surface(), spec.body);
  const double per_u = spec.body == Body::wheel ? spec.nominal_radius : 1.0;
  for (int pass = 0;; ++pass) {
    fit.fill(grid);
    const auto spline = spline::fit_tensor_spline(grid);
    const Off off = fit.off(grid, *spline.surface, !out.one_section, tolerance);
    out.spline = spline.spline;
    out.deviation = off.most;
    if (off.most <= tolerance || pass == kMostPasses) break;
    sampling::PointGrid next = grid;
    const double end = grid.closed ? grid.u.front() + 2.0 * kPi : grid.u.back();
    next.u = parted(grid.u, end, off.along, tolerance,
                    [&](std::size_t i) { return per_u * ((i + 1 < grid.u.size() ? grid.u[i + 1] : end) - grid.u[i]); });
    // where the section is steep y alone says little
    next.y = parted(grid.y, grid.y.back(), off.across, tolerance, [&](std::size_t k) {
      const std::size_t middle = grid.u.size() / 2;
      return (grid.point(middle, k + 1) - grid.point(middle, k)).norm();
    });
    const bool same = next.u.size() == grid.u.size() && next.y.size() == grid.y.size();
    if (same || static_cast<double>(next.u.size()) * static_cast<double>(next.y.size()) > kMostFitPoints) break;
    grid = std::move(next);
  }
  out.sampled = r.sampled();
  if (!r.asked()) out.sampled.resolution = kAcross;
  if (spec.body == Body::wheel && !grid.closed && !out.one_section) {
    out.sampled.region.u_min = std::max(out.sampled.region.u_min, grid.u.front());
    out.sampled.region.u_max = std::min(out.sampled.region.u_max, grid.u.back());
  }
  return out;
}

}  // namespace treadmark
