// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/detection/contact_program/rail_sections.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/detection/contact_program/natural_curve.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::detection {

bool section_heights(const BodyPair& bodies, const Pose& X_TC, const Grid2& g, std::span<double> rail_n) {
  constexpr double kMargin = 6e-3;  // a dozen data: what lies further off does not bend the curve over the grid
  constexpr std::size_t kFewest = 4;
  const Pose X_RC = bodies.X_TR.inverse() * X_TC;
  const LateralInterval range{g.y(0) - kMargin, g.y(g.ny - 1) + kMargin};
  for (int ix = 0; ix < g.nx; ++ix) {
    std::vector<Vec2> nodes;
    for (const double y : lateral_nodes(*bodies.rail, X_RC, g.x(ix), range)) nodes.emplace_back(g.x(ix), y);
    std::vector<double> n(nodes.size());
    if (!nodes.empty()) bodies.rail->heights_at(X_RC, nodes, {n, {}, {}});
    for (std::size_t j = 0; j < nodes.size(); ++j) nodes[j] = {nodes[j].y(), n[j]};
    if (nodes.size() < kFewest) return false;
    const NaturalCurve curve(std::move(nodes));
    for (int iy = 0; iy < g.ny; ++iy) rail_n[g.index(ix, iy)] = curve.least_over(g.y(iy));
  }
  return true;
}

namespace {

std::vector<double> equal_steps(double low, double high) {
  constexpr double kLongest = 0.5e-3;  // [m]
  const int n = 1 + to_whole<int>(std::floor((high - low) / kLongest));
  std::vector<double> y;
  for (int i = 0; i <= n; ++i) y.push_back(low + (high - low) * i / n);
  return y;
}

/// Points between which v is taken as linear.
struct Lattice {
  explicit Lattice(const LateralInterval& y)
      : range(y), steps(std::max(2, to_whole<int>(std::ceil((y.high - y.low) / kStep)))) {}
  double y(int i) const { return range.low + (range.high - range.low) * i / steps; }
  /// The last point not above, between both ends.
  int below(double at) const {
    return to_whole<int>((at - range.low) / (range.high - range.low) * steps, 0.0, 1.0 * steps);
  }

  static constexpr double kStep = 0.1e-3;  // [m]
  LateralInterval range;
  int steps;
};

std::vector<double> nodes_between(const Surface& surface, const std::vector<double>& data_v, const Pose& X_SP,
                                  double x_P, const Lattice& lattice, int first, int last) {
  constexpr std::ptrdiff_t kHidden = 10;  // more data than that between two points: something lies behind the rest
  std::vector<Vec2> points;
  for (int i = first; i <= last; ++i) points.emplace_back(x_P, lattice.y(i));
  std::vector<SurfacePoint> found(points.size());
  surface.locate(X_SP, points, found);

  std::vector<double> y;
  for (std::size_t i = 0; i + 1 < found.size(); ++i) {
    const SurfacePoint &a = found[i], &b = found[i + 1];
    if (a.status == LocateStatus::outside || b.status == LocateStatus::outside) continue;
    const auto begin = ranges::lower_bound(data_v, std::min(a.v, b.v)),
               end = ranges::lower_bound(data_v, std::max(a.v, b.v));
    if (end - begin > kHidden) continue;
    const auto first_y = static_cast<std::ptrdiff_t>(y.size());
    for (auto v = begin; v != end; ++v)
      y.push_back(points[i].y() + (points[i + 1].y() - points[i].y()) * (*v - a.v) / (b.v - a.v));
    if (b.v < a.v) std::reverse(y.begin() + first_y, y.end());
  }
  return y;
}

}  // namespace

void rail_heights(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C, std::span<double> rail_n) {
  const bool on_sections = bodies.distance_mesh && bodies.distance_mesh->rail_sections &&
                           !bodies.rail->constant_profile() && section_heights(bodies, X_TC, grid_C, rail_n);
  if (!on_sections) bodies.rail->heights({bodies.X_TR.inverse() * X_TC, grid_C}, {rail_n, {}, {}});
}

double lowest_angle(const Pose& X_TW) { return -std::atan2(X_TW.rotation(0, 2), X_TW.rotation(0, 0)); }

std::vector<double> mesh_lines(const Surface& wheel, double angle) {
  const Box3 box = wheel.bounds();
  return mesh_lines(wheel, angle, {box.min.y(), box.max.y()}, 0);
}

std::vector<double> mesh_lines(const Surface& wheel, double angle, const LateralInterval& y, int beside) {
  constexpr std::size_t kFewest = 4;
  constexpr double kFirstMargin = 2e-3;  // [m]
  const Box3 box = wheel.bounds();
  const Lattice lattice({box.min.y(), box.max.y()});
  const std::vector<double> data_v = wheel.data_v();
  if (data_v.empty()) return equal_steps(box.min.y(), box.max.y());
  for (double margin = beside > 0 ? kFirstMargin : 0.0;; margin *= 2.0) {
    const int first = std::max(0, lattice.below(y.low - margin) - 1),
              last = std::min(lattice.steps, lattice.below(y.high + margin) + 2);
    std::vector<double> found =
        nodes_between(wheel, data_v, {Vec3::Zero(), rotation_y(angle)}, 0.0, lattice, first, last);
    const auto low = ranges::lower_bound(found, y.low) - found.begin(),
               high = found.end() - ranges::upper_bound(found, y.high);
    const bool whole = first == 0 && last == lattice.steps;
    if (!whole && !((first == 0 || low >= beside) && (last == lattice.steps || high >= beside))) continue;
    if (found.size() >= kFewest) return found;
    if (whole) return equal_steps(box.min.y(), box.max.y());
  }
}

ProfileLines profile_lines(const Surface& wheel, double angle) {
  ProfileLines lines{mesh_lines(wheel, angle), {}, {}};
  lines.radius.resize(lines.y.size()), lines.slope.resize(lines.y.size());
  treadmark::section_heights(wheel, Body::wheel, angle, lines.y, {lines.radius, {}, lines.slope});
  return lines;
}

std::vector<double> section_radius(const Surface& wheel, double angle, std::span<const double> y) {
  std::vector<double> radius(y.size());
  treadmark::section_heights(wheel, Body::wheel, angle, y, {radius, {}, {}});
  return radius;
}

std::vector<double> lateral_nodes(const Surface& surface, const Pose& X_SP, double x_P, const LateralInterval& y_P) {
  const std::vector<double> data_v = surface.data_v();
  if (data_v.empty()) return {};
  const Lattice all(y_P);
  return nodes_between(surface, data_v, X_SP, x_P, all, 0, all.steps);
}

}  // namespace treadmark::detection
