// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/told_spline.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

constexpr double kSameSurface = 1e-12;  // [m]
constexpr int kToldDegree = 3;

std::vector<double> borders(const NurbsNet& net, bool of_u) {
  const int n = of_u ? net.patches_u() : net.patches_v();
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i < n; ++i) out.push_back(of_u ? net.range(i, 0).u0 : net.range(0, i).v0);
  out.push_back(of_u ? net.range(n - 1, 0).u1 : net.range(0, n - 1).v1);
  return out;
}

std::vector<double> cubic_knots(const std::vector<double>& breaks, const std::vector<int>& times) {
  std::vector<double> out(kToldDegree + 1, breaks.front());
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
    out.insert(out.end(), static_cast<std::size_t>(times[i]), breaks[i]);
  out.insert(out.end(), kToldDegree + 1, breaks.back());
  return out;
}

// How often each knot is needed: the second derivatives on both sides of a border, by a step as long as the patches.
std::vector<int> multiplicities(const NurbsNet& net, bool of_u) {
  const int n = of_u ? net.patches_u() : net.patches_v(), across = of_u ? net.patches_v() : net.patches_u();
  std::vector<int> out(static_cast<std::size_t>(n) + 1, 1);
  const std::vector<double> at = borders(net, of_u);
  for (int i = 1; i < n; ++i, check_cancelled()) {
    const auto k = static_cast<std::size_t>(i);
    const double before = at[k] - at[k - 1], after = at[k + 1] - at[k], step = std::max(before, after);
    for (int j = 0; j < across && out[k] == 1; ++j) {
      const BezierPatch a = of_u ? net.patch(i - 1, j) : net.patch(j, i - 1),
                        b = of_u ? net.patch(i, j) : net.patch(j, i);
      for (int m = 0; m < 4; ++m) {
        const auto along = [&](const BezierPatch& patch, int l) {
          const Quad& q = of_u ? patch.b[l][m] : patch.b[m][l];
          return Vec3(q.x(), q.y(), q.z());
        };
        const Vec3 bend_a = (along(a, 3) - 2.0 * along(a, 2) + along(a, 1)) / (before * before),
                   bend_b = (along(b, 2) - 2.0 * along(b, 1) + along(b, 0)) / (after * after);
        if ((bend_b - bend_a).norm() * step * step > kSameSurface) out[k] = 2;
      }
    }
  }
  return out;
}

// The interval in the middle of the inner knots of each function, the longer one of two, and which of its functions it
// is.
struct Home {
  int interval, k;
};
std::vector<Home> homes(const KnotLine& line) {
  std::vector<Home> out(static_cast<std::size_t>(line.functions()), {0, -1});
  const int p = line.degree();
  const auto off = [p](int k) { return std::abs(2 * k - p); };
  for (int i = 0; i < line.intervals(); ++i)
    for (int k = 0; k <= p; ++k) {
      Home& home = out[static_cast<std::size_t>(line.function(i, k))];
      const auto length = [&](int interval) { return line.to(interval) - line.from(interval); };
      if (home.k < 0 || off(k) < off(home.k) || (off(k) == off(home.k) && length(i) > length(home.interval)))
        home = {i, k};
    }
  return out;
}

SplineSurface of_points(const NurbsNet& net) {
  const std::vector<double> u = borders(net, true), v = borders(net, false);
  SplineSurface out;
  out.levels.push_back({SplineKnots{kToldDegree, cubic_knots(u, std::vector<int>(u.size(), kToldDegree))},
                        SplineKnots{kToldDegree, cubic_knots(v, std::vector<int>(v.size(), kToldDegree))}});
  const std::size_t nu = 3 * (u.size() - 1) + 1, nv = 3 * (v.size() - 1) + 1;
  out.points.resize(nu * nv);
  out.weights.resize(nu * nv);
  for (int iu = 0; iu < net.patches_u(); ++iu, check_cancelled())
    for (int iv = 0; iv < net.patches_v(); ++iv) {
      const BezierPatch patch = net.patch(iu, iv);
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
          const std::size_t at = static_cast<std::size_t>(3 * iu + i) + nu * static_cast<std::size_t>(3 * iv + j);
          out.points[at] = patch.point(i, j);
          out.weights[at] = patch.b[i][j].w();
        }
    }
  return out;
}

SplineSurface of_corners(const NurbsNet& net) {
  const std::vector<double> u = borders(net, true), v = borders(net, false);
  SplineSurface out;
  out.levels.push_back({SplineKnots{kToldDegree, cubic_knots(u, multiplicities(net, true))},
                        SplineKnots{kToldDegree, cubic_knots(v, multiplicities(net, false))}});
  const KnotLine lu = KnotLine::of_knots(out.levels[0][0]), lv = KnotLine::of_knots(out.levels[0][1]);
  const std::vector<Home> home_u = homes(lu), home_v = homes(lv);
  out.points.reserve(home_u.size() * home_v.size());
  for (const Home& hv : home_v) {
    check_cancelled();
    const KnotWeights wv =
        bernstein_blossom(kToldDegree, lv.inner_knots(hv.interval, hv.k), lv.from(hv.interval), lv.to(hv.interval));
    for (const Home& hu : home_u) {
      const KnotWeights wu =
          bernstein_blossom(kToldDegree, lu.inner_knots(hu.interval, hu.k), lu.from(hu.interval), lu.to(hu.interval));
      const BezierPatch patch = net.patch(hu.interval, hv.interval);
      Vec3 sum = Vec3::Zero();
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          sum += wu[static_cast<std::size_t>(i)] * wv[static_cast<std::size_t>(j)] * patch.point(i, j);
      out.points.push_back(sum);
    }
  }
  return out;
}

// With ends instead of a seam: the same cells over lines of full knots at both ends.
ThbSpline opened(const ThbSpline& closed) {
  const ThbSpace& from = closed.space;
  std::vector<ThbSpace::Level> levels;
  levels.reserve(static_cast<std::size_t>(from.levels()));
  for (int l = 0; l < from.levels(); ++l) {
    const auto with_ends = [](const KnotLine& line) {
      return line.closed() ? KnotLine::open(line.degree(), line.breaks()) : line;
    };
    levels.push_back({with_ends(from.u(l)), with_ends(from.v(l))});
  }
  ThbSpline out{ThbSpace(std::move(levels)), {}};
  for (int l = 0; l + 1 < from.levels(); ++l)
    for (int iu = 0; iu < from.u(l).intervals(); ++iu)
      for (int iv = 0; iv < from.v(l).intervals(); ++iv)
        if (const ThbCell cell{l, iu, iv}; from.divided(cell)) out.space.divide_alone(cell);
  out.space.settle();
  out.coefficients = out.space.coefficients([&](const ThbCell& cell) { return from.piece(cell, closed.coefficients); });
  for (const ThbCell& cell : out.space.cells()) {
    const ThbPiece a = from.piece(cell, closed.coefficients), b = out.space.piece(cell, out.coefficients);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        if (!((a[i][j] - b[i][j]).norm() < kSameSurface))
          throw Error(ErrorKind::numerical, "a hierarchical spline round a wheel is not the same with a seam", {},
                      "write it as nurbs");
  }
  return out;
}

// Cells above level 0, in strips along v.
std::vector<SplineBox> strips(const ThbSpace& space) {
  std::vector<ThbCell> cells = space.cells();
  std::erase_if(cells, [](const ThbCell& cell) { return cell.level == 0; });
  std::sort(cells.begin(), cells.end(), [](const ThbCell& a, const ThbCell& b) {
    return std::tie(a.level, a.iu, a.iv) < std::tie(b.level, b.iu, b.iv);
  });
  std::vector<SplineBox> out;
  for (const ThbCell& cell : cells) {
    if (!out.empty()) {
      SplineBox& last = out.back();
      if (last.level == cell.level && last.lower[0] + 1 == last.upper[0] && last.lower[0] == cell.iu &&
          last.upper[1] == cell.iv) {
        ++last.upper[1];
        continue;
      }
    }
    out.push_back({cell.level, {cell.iu, cell.iv}, {cell.iu + 1, cell.iv + 1}, 0});
  }
  return out;
}

}  // namespace

SplineSurface told_spline(const NurbsNet& net) {
  if (net.is_list()) throw Error(ErrorKind::configuration, "a list of patches is no tensor spline");
  return net.by_corners() ? of_corners(net) : of_points(net);
}

SplineSurface told_spline(const ThbSpline& spline) {
  if (spline.space.u(0).closed() || spline.space.v(0).closed()) return told_spline(opened(spline));
  const ThbSpace& space = spline.space;
  SplineSurface out;
  out.hierarchical = true;
  int levels = 1;
  for (const ThbCell& cell : space.cells()) levels = std::max(levels, cell.level + 1);
  out.levels.reserve(static_cast<std::size_t>(levels));
  for (int l = 0; l < levels; ++l)
    out.levels.push_back(
        {SplineKnots{space.u(l).degree(), space.u(l).knots()}, SplineKnots{space.v(l).degree(), space.v(l).knots()}});
  out.boxes = strips(space);
  struct Numbered {
    ThbSpace::Function function;
    std::size_t number;
  };
  std::vector<Numbered> order;
  order.reserve(space.functions());
  for (std::size_t k = 0; k < space.functions(); ++k) order.push_back({space.function(k), k});
  std::sort(order.begin(), order.end(), [](const Numbered& a, const Numbered& b) {
    if (a.function.level != b.function.level) return a.function.level < b.function.level;
    return a.function.v != b.function.v ? a.function.v < b.function.v : a.function.u < b.function.u;
  });
  out.points.reserve(order.size());
  for (const Numbered& n : order) out.points.push_back(spline.coefficients[n.number]);
  return out;
}

}  // namespace treadmark::spline
