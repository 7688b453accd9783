// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/thb/thb_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/backends/spline/thb/coarsest_breaks.hpp"
#include "treadmark/backends/spline/thb/fit_points.hpp"
#include "treadmark/backends/spline/thb/normal_equations.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::spline {
namespace {

constexpr double kPointsAPlace = 4.0;  // scattered

constexpr double kMad = 0.6744897501960817;  // median of the size of a normal number

/// Those along u and along v of a cell, index = 4 i + j.
Eigen::Matrix<double, 16, 16> bending(int degree) {
  const Eigen::Matrix4d one = second_differences(degree);
  Eigen::Matrix<double, 16, 16> out = Eigen::Matrix<double, 16, 16>::Zero();
  for (int i = 0; i <= degree; ++i)
    for (int k = 0; k <= degree; ++k)
      for (int j = 0; j <= degree; ++j) {
        out(4 * i + j, 4 * k + j) += one(i, k);
        out(4 * j + i, 4 * j + k) += one(i, k);
      }
  return out;
}

class Fit {
 public:
  Fit(const FitPoints& points, Body body, double noise, const ThbFitSettings& settings)
      : points_(points),
        body_(body),
        settings_(settings),
        tolerance_{settings.tolerance, noise, points.scattered()},
        bending_(bending(settings.degree)) {}

  ThbFit run() {
    refuse_gaps();
    ThbSpace space(levels());
    space.settle();
    std::vector<Vec3> coefficients(space.functions(), Vec3::Zero());
    Part part = whole(space);
    improve(space, part, coefficients);  // and once more below, free of the smoothing of the whole shape
    for (;;) {
      improve(space, part, coefficients);
      ThbFit fit{{space, {}}, tolerance_.noise, 0.0, 0.0, 0};
      // what a refinement changes is looked at first, then all of it
      bool changed = part.cells.size() < space.cells().size() && mark(space, part, coefficients, fit);
      if (!changed) {
        fit = {{space, {}}, tolerance_.noise, 0.0, 0.0, 0};
        changed = mark(space, whole(space), coefficients, fit);
      }
      if (!changed) {
        fit.spline.coefficients = std::move(coefficients);
        return fit;
      }
      ThbSpace& finer = fit.spline.space;
      finer.settle();
      coefficients = space.refined(coefficients, finer);
      part = changed_part(space, finer);
      space = std::move(finer);
    }
  }

 private:
  /// Level 0, then the longest intervals halved, down to single places.
  std::vector<ThbSpace::Level> levels() {
    CoarsestBreaks coarsest = coarsest_breaks(points_, body_, settings_.degree, tolerance_);
    u_breaks_ = {std::move(coarsest.u)};
    v_breaks_ = {std::move(coarsest.v)};
    const auto longest = [](const std::vector<int>& breaks) {
      int most = 0;
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) most = std::max(most, breaks[i + 1] - breaks[i]);
      return most;
    };
    for (int limit = std::max(longest(u_breaks_[0]), longest(v_breaks_[0]));;) {
      auto next_u = points_.u().halved(u_breaks_.back(), limit), next_v = points_.v().halved(v_breaks_.back(), limit);
      if (next_u.size() != u_breaks_.back().size() || next_v.size() != v_breaks_.back().size()) {
        u_breaks_.push_back(std::move(next_u));
        v_breaks_.push_back(std::move(next_v));
      } else if (limit == 1) {
        break;
      }
      limit = std::max(1, limit / 2);
    }
    std::vector<ThbSpace::Level> out;
    out.reserve(u_breaks_.size());
    for (std::size_t l = 0; l < u_breaks_.size(); ++l)
      out.push_back(
          {points_.u().knots(settings_.degree, u_breaks_[l]), points_.v().knots(settings_.degree, v_breaks_[l])});
    return out;
  }

  FitPoints::Block points_of(const ThbCell& cell) const {
    const auto l = static_cast<std::size_t>(cell.level);
    const auto end = [&](const FitLine& line, const std::vector<int>& breaks, int k) {
      const int to = breaks[static_cast<std::size_t>(k) + 1];
      return to + (!points_.scattered() && !line.closed() && to == line.last() ? 1 : 0);
    };
    return {u_breaks_[l][static_cast<std::size_t>(cell.iu)], end(points_.u(), u_breaks_[l], cell.iu),
            v_breaks_[l][static_cast<std::size_t>(cell.iv)], end(points_.v(), v_breaks_[l], cell.iv)};
  }

  /// Of scattered points: blocks of places so large that they are not empty by chance.
  void refuse_gaps() const {
    constexpr int kBlock = 4;
    if (!points_.scattered()) return;
    for (int i = 0; i < points_.rows(); i += kBlock / 2)
      for (int j = 0; j < points_.columns(); j += kBlock / 2) {
        const int i1 = std::min(i + kBlock, points_.rows()), j1 = std::min(j + kBlock, points_.columns()),
                  i0 = std::max(0, i1 - kBlock), j0 = std::max(0, j1 - kBlock);
        if (points_.count({i0, i1, j0, j1}) > 0) continue;
        throw Error(
            ErrorKind::input_data,
            fmt::format("there are no points from u = {:.6g} to {:.6g} and v = {:.6g} to {:.6g} m, where {:.0f} "
                        "would lie if they were spread evenly",
                        points_.u().place(i0), points_.u().place(i1), points_.v().place(j0), points_.v().place(j1),
                        kPointsAPlace * (i1 - i0) * (j1 - j0)),
            {}, "limit the region to where there are points");
      }
  }

  /// Functions that are free, and the cells over which some of them do not vanish.
  struct Part {
    static constexpr std::size_t kFixed = static_cast<std::size_t>(-1);
    std::vector<ThbCell> cells;
    std::vector<std::size_t> functions, unknown;  ///< numbers of the free ones; of each function: its place there

    void free(std::size_t function) {
      if (unknown[function] != kFixed) return;
      unknown[function] = functions.size();
      functions.push_back(function);
    }
  };

  static Part whole(const ThbSpace& space) {
    Part out{space.cells(), {}, std::vector<std::size_t>(space.functions(), Part::kFixed)};
    for (std::size_t k = 0; k < space.functions(); ++k) out.free(k);
    return out;
  }

  /// Around the cells that the coarser space does not have.
  static Part changed_part(const ThbSpace& coarser, const ThbSpace& finer) {
    Part out{{}, {}, std::vector<std::size_t>(finer.functions(), Part::kFixed)};
    for (const ThbCell& cell : finer.cells())
      if (!coarser.exists(cell)) finer.each_function(cell, [&](std::size_t k) { out.free(k); });
    for (const ThbCell& cell : finer.cells()) {
      bool touched = false;
      finer.each_function(cell, [&](std::size_t k) { touched |= out.unknown[k] != Part::kFixed; });
      if (touched) out.cells.push_back(cell);
    }
    return out;
  }

  /// Adds the spline of free functions that is nearest to what is left.
  void improve(const ThbSpace& space, const Part& part, std::vector<Vec3>& coefficients) const {
    struct OfCell {
      std::vector<ThbSpace::Column> columns;
      Eigen::MatrixXd products, right;
    };
    constexpr std::size_t kChunk = 4096;
    NormalEquations equations(part.functions.size());
    std::vector<OfCell> chunk;
    const auto& cells = part.cells;
    for (std::size_t begin = 0; begin < cells.size(); begin += kChunk) {
      chunk.assign(std::min(kChunk, cells.size() - begin), {});
      parallel_for(chunk.size(), [&](std::size_t k) {
        const ThbCell& cell = cells[begin + k];
        OfCell& out = chunk[k];
        const FitPoints::Block block = points_of(cell);
        const CellSums sums = points_.sums(block, space.range(cell), settings_.degree, space.piece(cell, coefficients),
                                           settings_.tolerance, false);
        out.columns = space.columns(cell);
        std::erase_if(out.columns, [&](const auto& c) { return part.unknown[c.function] == Part::kFixed; });
        Eigen::Matrix<double, 16, Eigen::Dynamic> c(16, static_cast<Eigen::Index>(out.columns.size()));
        for (std::size_t a = 0; a < out.columns.size(); ++a)
          for (std::size_t b = 0; b < 16; ++b)
            c(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(a)) = out.columns[a].b[b];
        const double smooth = tolerance_.smoothing(static_cast<double>(sums.left.points));
        out.products = c.transpose() * (sums.moments + smooth * bending_) * c;
        out.right = c.transpose() * sums.right;
      });
      for (const OfCell& cell : chunk)
        for (std::size_t a = 0; a < cell.columns.size(); ++a) {
          const auto row = static_cast<Eigen::Index>(a);
          const std::size_t to = part.unknown[cell.columns[a].function];
          equations.add_right(to, cell.right.row(row));
          for (std::size_t b = 0; b <= a; ++b)
            equations.add(to, part.unknown[cell.columns[b].function], cell.products(row, static_cast<Eigen::Index>(b)));
        }
    }
    const NormalEquations::Solution more = equations.iterate();
    for (std::size_t k = 0; k < part.functions.size(); ++k)
      coefficients[part.functions[k]] += more.row(static_cast<Eigen::Index>(k)).transpose();
  }

  /// Divides cells of the fit's space with too much left, and those around them, so that new functions have room.
  bool mark(const ThbSpace& space, const Part& part, const std::vector<Vec3>& coefficients, ThbFit& fit) const {
    const auto& cells = part.cells;
    std::vector<Remainder> left(cells.size());
    parallel_for(cells.size(), [&](std::size_t k) {
      left[k] = points_
                    .sums(points_of(cells[k]), space.range(cells[k]), settings_.degree,
                          space.piece(cells[k], coefficients), settings_.tolerance, true)
                    .left;
    });
    bool changed = false;
    double sum = 0.0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      fit.most_left = std::max(fit.most_left, std::sqrt(left[k].most));
      sum += left[k].sum;
      if (!tolerance_.exceeded(left[k])) continue;
      const ThbCell& cell = cells[k];
      if (cell.level + 1 == space.levels() || left[k].points < tolerance_.fewest()) {
        ++fit.unresolved;
        continue;
      }
      changed = true;
      divide_around(fit.spline.space, cell);
    }
    fit.rms_left = std::sqrt(sum / static_cast<double>(points_.size()));
    return changed;
  }

  void divide_around(ThbSpace& finer, const ThbCell& cell) const {
    const KnotLine &u = finer.u(cell.level), &v = finer.v(cell.level);
    // where a direction is not halved, functions are as wide as before
    const auto halved = [](const KnotLine& line, const KnotLine& next, int k) {
      return next.find(0.5 * (line.from(k) + line.to(k))) != next.find(line.from(k));
    };
    const int reach_u = halved(u, finer.u(cell.level + 1), cell.iu) ? 1 : 2,
              reach_v = halved(v, finer.v(cell.level + 1), cell.iv) ? 1 : 2;
    for (int du = -reach_u; du <= reach_u; ++du)
      for (int dv = -reach_v; dv <= reach_v; ++dv) {
        ThbCell near{cell.level, cell.iu + du, cell.iv + dv};
        if (u.closed()) near.iu = (near.iu + u.intervals()) % u.intervals();
        if (near.iu < 0 || near.iv < 0 || near.iu >= u.intervals() || near.iv >= v.intervals()) continue;
        if (!finer.exists(near)) finer.divide(finer.parent(near));
        finer.divide(near);
      }
  }

  const FitPoints& points_;
  Body body_;
  ThbFitSettings settings_;
  FitTolerance tolerance_;
  Eigen::Matrix<double, 16, 16> bending_;
  std::vector<std::vector<int>> u_breaks_, v_breaks_;  // by level
};

/// From fourth differences (their standard deviation is sqrt(70) times that of independent noise), along the quieter
/// direction: of clean points it is next to nothing.
double noise_of(const sampling::PointGrid& grid) {
  const std::size_t nu = grid.u.size(), nv = grid.y.size();
  const auto of = [&](std::size_t step_u, std::size_t step_v) {
    std::vector<double> sizes;
    const std::size_t skip = std::max<std::size_t>(1, nu * nv / 1'000'000);
    for (std::size_t i = 0; i + 4 * step_u < nu; ++i)
      for (std::size_t j = i % skip; j + 4 * step_v < nv; j += skip) {
        const auto h = [&](std::size_t k) { return grid.h[grid.index(i + k * step_u, j + k * step_v)]; };
        sizes.push_back(std::abs(h(0) - 4.0 * h(1) + 6.0 * h(2) - 4.0 * h(3) + h(4)));
      }
    return median_of(sizes) / (kMad * std::sqrt(70.0));
  };
  return std::min(of(1, 0), of(0, 1));
}

/// From quadratics through the points around some places, of their height over the plane of least squares.
double noise_of(const FitPoints& points) {
  constexpr std::size_t kPlaces = 2000, kFewest = 24;
  const int rows = points.u().last(), columns = points.v().last();
  const std::size_t all = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  const std::size_t skip = std::max<std::size_t>(1, all / kPlaces) | 1;
  std::vector<double> sizes;
  for (std::size_t cell = skip / 2; cell < all; cell += skip) {
    const int i = static_cast<int>(cell / static_cast<std::size_t>(columns)),
              j = static_cast<int>(cell % static_cast<std::size_t>(columns));
    const FitPoints::Block around{std::max(0, i - 1), std::min(rows, i + 2), std::max(0, j - 1),
                                  std::min(columns, j + 2)};
    std::vector<Vec3> near;
    near.reserve(points.count(around));
    points.each(around, [&](std::size_t, double, double, const Vec3& p) { near.push_back(p); });
    if (near.size() < kFewest) continue;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : near) middle += p / static_cast<double>(near.size());
    Mat3 spread = Mat3::Zero();
    for (const Vec3& p : near) spread += (p - middle) * (p - middle).transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
    const double size = std::sqrt(axes.eigenvalues()[2] / static_cast<double>(near.size()));
    Eigen::Matrix<double, Eigen::Dynamic, 6> a(static_cast<Eigen::Index>(near.size()), 6);
    Eigen::VectorXd h(a.rows());
    for (Eigen::Index k = 0; k < a.rows(); ++k) {
      const Vec3 q = axes.eigenvectors().transpose() * (near[static_cast<std::size_t>(k)] - middle);
      const double x = q[1] / size, y = q[2] / size;
      a.row(k) << 1.0, x, y, x * x, x * y, y * y;
      h[k] = q[0];
    }
    const Eigen::VectorXd left = h - a * (a.transpose() * a).ldlt().solve(a.transpose() * h);
    sizes.push_back(std::sqrt(left.squaredNorm() / static_cast<double>(near.size() - 6)));
  }
  return median_of(sizes);
}

void check(const ThbFitSettings& settings) {
  if (settings.degree != 2 && settings.degree != 3)
    throw Error(ErrorKind::configuration,
                fmt::format("hierarchical splines are fitted with degree 2 or 3, not {}", settings.degree));
  if (!(settings.tolerance >= 0.0) || !(settings.noise.value_or(0.0) >= 0.0))
    throw Error(ErrorKind::configuration, "tolerance and noise of a hierarchical spline are lengths, 0 or more");
}

}  // namespace

ThbFit fit_thb(const sampling::PointGrid& grid, const ThbFitSettings& settings) {
  check(settings);
  check_points(grid);
  const FitPoints points(grid, settings.degree);
  return Fit(points, grid.body, settings.noise ? *settings.noise : noise_of(grid), settings).run();
}

ThbFit fit_thb(std::span<const Vec3> points, Body body, const sampling::Region& region,
               const ThbFitSettings& settings) {
  check(settings);
  std::vector<double> u, v;
  std::vector<Vec3> kept;
  u.reserve(points.size()), v.reserve(points.size()), kept.reserve(points.size());
  double radius = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3& p = points[k];
    if (!p.allFinite())
      throw Error(ErrorKind::input_data, fmt::format("point {} of a scan is not finite", k + 1), {}, "leave it out");
    const double at = body == Body::rail ? p.x() : std::atan2(p.x(), p.z());
    if (at < region.u_min || at > region.u_max || p.y() < region.y_min || p.y() > region.y_max) continue;
    u.push_back(at), v.push_back(p.y()), kept.push_back(p);
    radius += std::hypot(p.x(), p.z());
  }
  const bool closed = body == Body::wheel && !(region.u_max - region.u_min < 2.0 * std::numbers::pi);
  const auto fewest =
      std::size_t{4} * static_cast<std::size_t>(settings.degree + 1) * static_cast<std::size_t>(settings.degree + 1);
  if (kept.size() < fewest)
    throw Error(ErrorKind::input_data,
                fmt::format("{} points in the region are too few for a hierarchical spline of degree {}: {} at least",
                            kept.size(), settings.degree, fewest));
  const auto flat = [](const std::vector<double>& x) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    return !(*high > *low);
  };
  if (flat(u) || flat(v))
    throw Error(ErrorKind::input_data, "the points of a scan lie on a line; a surface needs them beside each other");
  radius = body == Body::rail ? 1.0 : radius / static_cast<double>(kept.size());
  const FitPoints sorted(std::move(u), std::move(v), std::move(kept), closed, radius, kPointsAPlace);
  return Fit(sorted, body, settings.noise ? *settings.noise : noise_of(sorted), settings).run();
}

}  // namespace treadmark::spline
