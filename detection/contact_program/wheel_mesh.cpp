// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_program/wheel_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"
#include "treadmark/detection/contact_program/search_mesh.hpp"

namespace treadmark::detection {
namespace {

/// Corners in the contact frame, row by row (along the wheel), lateral index fastest.
struct Mesh {
  int rows = 0, columns = 0;
  std::vector<Vec3> corners;
  const Vec3& at(int k, int j) const {
    return corners[static_cast<std::size_t>(k) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j)];
  }
};

/// What part of the wheel the mesh must cover, in the frame of the wheel's axle without pitch.
struct Reach {
  double x_min, x_max, y_min, y_max, z_min;
};

/// Elements in the contact plane and, on the rail, how far off it the bodies face each other.
struct Elements {
  const Grid2& grid;
  std::span<const double> rows_s, rail_n;
};

Reach reach_of(const Pose& X_TU, const Pose& X_TC, const Elements& e) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kMargin = 2.0;
  const Grid2& g = e.grid;
  Reach r{kInfinity, -kInfinity, kInfinity, -kInfinity, kInfinity};
  const Vec3 lateral = X_TC.rotation.col(1), normal = X_TC.rotation.col(2);
  const auto [s_min, s_max] = ranges::minmax(e.rows_s);
  for (const double x : {g.x0 - 0.5 * g.dx, g.x(g.nx - 1) + 0.5 * g.dx})
    for (const double s : {s_min - 0.5 * g.dy, s_max + 0.5 * g.dy}) {
      const Vec3 p = X_TU.apply_inverse(X_TC.origin + s * lateral + Vec3(x, 0.0, 0.0));
      r.x_min = std::min(r.x_min, p.x()), r.x_max = std::max(r.x_max, p.x());
      r.y_min = std::min(r.y_min, p.y()), r.y_max = std::max(r.y_max, p.y());
      r.z_min = std::min(r.z_min, p.z());
    }
  // Far off a steep plane the bodies meet beside the plane's own points.
  for (int iy = 0; iy < g.ny; ++iy)
    for (const int ix : {0, g.nx / 2, g.nx - 1}) {
      const double n = e.rail_n[g.index(ix, iy)];
      if (std::isnan(n)) continue;
      const double s = e.rows_s[static_cast<std::size_t>(iy)];
      const double y = X_TU.apply_inverse(X_TC.origin + s * lateral + n * normal + Vec3(g.x(ix), 0.0, 0.0)).y();
      r.y_min = std::min(r.y_min, y), r.y_max = std::max(r.y_max, y);
    }
  r.x_min -= kMargin * g.dx, r.x_max += kMargin * g.dx;
  r.y_min -= kMargin * g.dy, r.y_max += kMargin * g.dy;
  r.z_min -= g.dy * std::abs(lateral.z());
  return r;
}

/// Lateral positions about the reach whose distance along the profile from y_through is a whole multiple of a step.
std::vector<double> equal_arcs(const Surface& wheel, double angle, const Reach& r, double y_through, double step) {
  constexpr int kParts = 10;
  const double fine = step / kParts;
  const auto steps_over = [&](double length) { return std::max(1, to_whole<int>(std::ceil(length / fine))); };
  const int below = steps_over(y_through - r.y_min + step), above = steps_over(r.y_max + step - y_through);
  std::vector<double> y;
  for (int i = -below; i <= above; ++i) y.push_back(y_through + i * fine);
  const auto through = static_cast<std::size_t>(below);
  const std::vector<double> radius = section_radius(wheel, angle, y);
  std::vector<double> nodes{y_through};
  const auto walk = [&](int direction) {
    double length = 0.0, next = step;
    for (auto i = static_cast<std::ptrdiff_t>(through);
         i + direction >= 0 && i + direction < static_cast<std::ptrdiff_t>(y.size()); i += direction) {
      const auto from = static_cast<std::size_t>(i), to = static_cast<std::size_t>(i + direction);
      const double piece = std::hypot(fine, radius[to] - radius[from]);
      if (std::isnan(piece)) return;
      for (; length + piece >= next; next += step)
        nodes.push_back(y[from] + (y[to] - y[from]) * (next - length) / piece);
      length += piece;
    }
  };
  walk(-1);
  ranges::reverse(nodes);
  walk(1);
  const double spare = 2.0 * step;
  std::erase_if(nodes, [&](double node) { return node < r.y_min - spare || node > r.y_max + spare; });
  return nodes;
}

Mesh round_mesh(const BodyPair& bodies, const Pose& X_TU, const Pose& X_TC, const Elements& e) {
  const Grid2& g = e.grid;
  const Reach r = reach_of(X_TU, X_TC, e);
  const double angle = lowest_angle(bodies.X_TW);
  // Lines through the origin of the grid, which lies far off where grids line up in time.
  const Vec3 marker = X_TU.apply_inverse(X_TC.origin);
  std::vector<double> y = equal_arcs(*bodies.wheel, angle, r, marker.y(), g.dy);
  if (y.size() < 2)
    y = equal_arcs(*bodies.wheel, angle, r, 0.5 * (r.y_min + r.y_max), g.dy);  // the origin is beside the wheel
  const std::vector<double> radius = section_radius(*bodies.wheel, angle, y);
  const double first = std::floor((r.x_min - marker.x()) / g.dx), last = std::ceil((r.x_max - marker.x()) / g.dx);
  Mesh mesh{static_cast<int>(last - first) + 1, static_cast<int>(y.size()), {}};
  const Pose X_CU = X_TC.inverse() * X_TU;
  for (int k = 0; k < mesh.rows; ++k) {
    const double x = marker.x() + (first + k) * g.dx;
    for (std::size_t j = 0; j < y.size(); ++j)
      mesh.corners.push_back(X_CU.apply({x, y[j], std::sqrt(radius[j] * radius[j] - x * x)}));
  }
  return mesh;
}

Mesh slices_mesh(const BodyPair& bodies, const Pose& X_TU, const Pose& X_TC, const Elements& e) {
  constexpr int kMargin = 3;
  const Grid2& g = e.grid;
  const Reach r = reach_of(X_TU, X_TC, e);
  const double lowest = lowest_angle(bodies.X_TW), from = std::atan(r.x_min / r.z_min),
               to = std::atan(r.x_max / r.z_min);
  int rows = to_whole<int>(std::round((to - from) * bodies.distance_mesh->nominal_radius / g.dx)) + 2;
  if (rows % 2 == 0) ++rows;

  const std::vector<double> all = mesh_lines(*bodies.wheel, lowest + 0.5 * (from + to), {r.y_min, r.y_max}, kMargin);
  auto first = static_cast<std::size_t>(ranges::lower_bound(all, r.y_min) - all.begin());
  auto last = static_cast<std::size_t>(ranges::upper_bound(all, r.y_max) - all.begin());
  first -= std::min<std::size_t>(first, kMargin);
  last = std::min<std::size_t>(all.size(), last + kMargin);
  const std::span<const double> y = std::span(all).subspan(first, last - first);
  Mesh mesh{rows, static_cast<int>(y.size()), {}};
  for (int k = 0; k < rows; ++k) {
    const double angle = lowest + from + (to - from) * k / (rows - 1);
    const std::vector<double> section = section_radius(*bodies.wheel, angle, y);
    const Pose X_CP = X_TC.inverse() * bodies.X_TW * Pose{Vec3::Zero(), rotation_y(angle)};
    for (std::size_t j = 0; j < y.size(); ++j) mesh.corners.push_back(X_CP.apply({0.0, y[j], section[j]}));
  }
  return mesh;
}

/// Half the difference of the neighbours, one-sided at an edge.
template <class Value>
double slope(Value&& value, int i, int count) {
  const double here = value(i), below = i > 0 ? value(i - 1) : kNaN, above = i + 1 < count ? value(i + 1) : kNaN;
  if (std::isnan(below)) return std::isnan(above) ? 0.0 : above - here;
  return std::isnan(above) ? here - below : 0.5 * (above - below);
}

/// Hermite's cubic: values and slopes at both ends.
double hermite(double t, double a, double b, double slope_a, double slope_b) {
  const double rise = b - a;
  return a + t * (slope_a + t * (3.0 * rise - 2.0 * slope_a - slope_b + t * (slope_a + slope_b - 2.0 * rise)));
}

/// Slopes at the corners, per facet: along the wheel, across, and of one along the other.
struct Slopes {
  void find(const Mesh& m) {
    columns = m.columns;
    const std::size_t size = m.corners.size();
    along.resize(size), across.resize(size), mixed.resize(size);
    const auto each = [&](std::vector<double>& to, const auto& value) {
      for (int k = 0; k < m.rows; ++k)
        for (int j = 0; j < m.columns; ++j) to[at(k, j)] = value(k, j);
    };
    each(along, [&](int k, int j) { return slope([&](int i) { return m.at(i, j).z(); }, k, m.rows); });
    each(across, [&](int k, int j) { return slope([&](int i) { return m.at(k, i).z(); }, j, m.columns); });
    each(mixed, [&](int k, int j) { return slope([&](int i) { return along[at(k, i)]; }, j, m.columns); });
  }
  std::size_t at(int k, int j) const {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j);
  }

  int columns = 0;
  std::vector<double> along, across, mixed;
};

double bicubic(const Mesh& mesh, const Slopes& slopes, const FacetPlace& p) {
  std::array<double, 2> value{}, by_v{};
  for (const int i : {0, 1}) {
    const int j = p.j + i;
    const std::size_t a = slopes.at(p.k, j), b = slopes.at(p.k + 1, j);
    value[static_cast<std::size_t>(i)] =
        hermite(p.u, mesh.at(p.k, j).z(), mesh.at(p.k + 1, j).z(), slopes.along[a], slopes.along[b]);
    by_v[static_cast<std::size_t>(i)] =
        hermite(p.u, slopes.across[a], slopes.across[b], slopes.mixed[a], slopes.mixed[b]);
  }
  return hermite(p.v, value[0], value[1], by_v[0], by_v[1]);
}

double bilinear(const Mesh& mesh, const FacetPlace& p) {
  const auto n = [&](int k, int j) { return mesh.at(k, j).z(); };
  const double first = n(p.k, p.j) + p.u * (n(p.k + 1, p.j) - n(p.k, p.j)),
               second = n(p.k, p.j + 1) + p.u * (n(p.k + 1, p.j + 1) - n(p.k, p.j + 1));
  return first + p.v * (second - first);
}

/// Does a section turn back, seen along the normal of the contact plane?
bool turns_back(const Mesh& mesh, int k) {
  bool up = false, down = false;
  for (int j = 1; j < mesh.columns; ++j) {
    const double step = mesh.at(k, j).y() - mesh.at(k, j - 1).y();
    up |= step > 0.0, down |= step < 0.0;
  }
  return up && down;
}

/// Index, not whole, of a section's corners where it has the greatest height at s; NaN where it is not there.
double foremost(const Mesh& mesh, int k, double s) {
  double found = kNaN, greatest = -std::numeric_limits<double>::infinity();
  for (int j = 0; j + 1 < mesh.columns; ++j) {
    const Vec3 &a = mesh.at(k, j), &b = mesh.at(k, j + 1);
    if (!((a.y() <= s && s <= b.y()) || (b.y() <= s && s <= a.y())) || a.y() == b.y()) continue;
    const double share = (s - a.y()) / (b.y() - a.y()), n = a.z() + share * (b.z() - a.z());
    if (n > greatest) greatest = n, found = j + share;
  }
  return found;
}

int nearest_corner(const Mesh& mesh, int k, double s) {
  int near = 0;
  for (int j = 1; j < mesh.columns; ++j)
    if (std::abs(mesh.at(k, j).y() - s) < std::abs(mesh.at(k, near).y() - s)) near = j;
  return near;
}

}  // namespace

void mesh_heights(const BodyPair& bodies, const Pose& X_TC, const Grid2& g, std::span<const double> rows_s,
                  std::span<const double> rail_n, std::span<double> wheel_n) {
  const bool round = bodies.wheel->constant_profile();
  const Pose X_TU = bodies.X_TW * Pose{Vec3::Zero(), rotation_y(lowest_angle(bodies.X_TW))};
  const Elements elements{g, rows_s, rail_n};
  const Mesh mesh = round ? round_mesh(bodies, X_TU, X_TC, elements) : slices_mesh(bodies, X_TU, X_TC, elements);
  ranges::fill(wheel_n, kNaN);
  if (mesh.rows < 2 || mesh.columns < 2) return;
  const auto corner = [&](int k, int j) -> const Vec3& { return mesh.at(k, j); };
  Slopes slopes;
  if (!round) slopes.find(mesh);
  const int middle = mesh.rows / 2;
  const bool folded = turns_back(mesh, middle);
  const double start_a =
      std::clamp((g.x(0) - corner(0, 0).x()) / (corner(mesh.rows - 1, 0).x() - corner(0, 0).x()), 0.0, 1.0) *
      (mesh.rows - 1);
  for (int iy = 0; iy < g.ny; ++iy) {
    const double s = rows_s[static_cast<std::size_t>(iy)];
    // From the corner of the middle section next to the row, then from element to element.
    const double near = nearest_corner(mesh, middle, s);
    double a = start_a, b = near;
    for (int ix = 0; ix < g.nx; ++ix) {
      FacetPlace place;
      const double a_again = std::clamp(start_a + ix, 0.0, mesh.rows - 1.0);
      if (folded) {
        a = a_again;
        b = foremost(mesh, to_whole<int>(std::round(a)), s);
        if (std::isnan(b)) continue;
      }
      double a_try = a, b_try = b;
      if (!find_facet(corner, mesh.rows, mesh.columns, g.x(ix), s, a_try, b_try, place)) {
        a_try = a_again, b_try = near;
        if (folded || !find_facet(corner, mesh.rows, mesh.columns, g.x(ix), s, a_try, b_try, place)) continue;
      }
      a = a_try, b = b_try;
      wheel_n[g.index(ix, iy)] = round ? bilinear(mesh, place) : bicubic(mesh, slopes, place);
    }
  }
}

UndeformedDistance projected_distance(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid,
                                      const ReferenceRows& reference) {
  const auto width = static_cast<std::size_t>(grid.nx);
  std::vector<double> rail(grid.size()), wheel(grid.size()), rows_s;
  Grid2 centred = grid;
  centred.x0 -= reference.reference_C.x();
  for (int iy = 0; iy < grid.ny; ++iy) {
    rows_s.push_back(reference.rows[static_cast<std::size_t>(iy)].y);
    const Grid2 line{centred.x0, rows_s.back(), grid.dx, grid.dy, grid.nx, 1};
    rail_heights(bodies, X_TC, line, {rail.data() + grid.index(0, iy), width});
    if (!bodies.distance_mesh)
      bodies.wheel->heights({bodies.X_TW.inverse() * X_TC, line}, {{wheel.data() + grid.index(0, iy), width}, {}, {}});
  }
  if (bodies.distance_mesh) mesh_heights(bodies, X_TC, centred, rows_s, rail, wheel);
  for (int iy = 0; iy < grid.ny; ++iy) {
    const double across = std::cos(reference.rows[static_cast<std::size_t>(iy)].angle);
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      rail[i] = across * (rail[i] - wheel[i]);
    }
  }
  ranges::fill(wheel, 0.0);
  return undeformed_distance(std::move(rail), wheel);
}

}  // namespace treadmark::detection
