// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/thb/coarsest_breaks.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/backends/spline/thb/normal_equations.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {
namespace {

constexpr std::size_t kLines = 15;
constexpr int kCoarsestInterval = 64;         // places
constexpr std::size_t kPointsAStrip = 30000;  // about

struct LinePoint {
  double x;
  Vec3 point;
  double doubt;
};
struct PointLine {
  Vec3 beside = Vec3::UnitY();    // normal of the plane that the line lies in
  std::vector<LinePoint> points;  // x does not decrease
};

/// What a fit with these knots leaves of each interval.
std::vector<Remainder> remainders(const PointLine& line, const KnotLine& knots, const FitTolerance& tolerance) {
  const std::vector<LinePoint>& points = line.points;
  const int p = knots.degree(), intervals = knots.intervals();
  const auto function = [&](int i, int k) { return static_cast<std::size_t>(knots.function(i, k)); };
  std::vector<std::size_t> begin{0};
  begin.reserve(static_cast<std::size_t>(intervals) + 1);
  for (int i = 0; i + 1 < intervals; ++i)
    begin.push_back(
        static_cast<std::size_t>(std::lower_bound(points.begin(), points.end(), knots.to(i),
                                                  [](const LinePoint& point, double x) { return point.x < x; }) -
                                 points.begin()));
  begin.push_back(points.size());
  const auto each = [&](int i, const auto& use) {
    const double per = 1.0 / (knots.to(i) - knots.from(i));
    for (std::size_t k = begin[static_cast<std::size_t>(i)]; k < begin[static_cast<std::size_t>(i) + 1]; ++k) {
      const double s = (points[k].x - knots.from(i)) * per;
      const KnotWeights w = bernstein_values(p, s);
      use(points[k], s, Eigen::Vector4d(w[0], w[1], w[2], w[3]));
    }
  };
  const auto bernstein_of = [&](int i) {  // row: Bernstein coefficient, column: function
    Eigen::Matrix4d out = Eigen::Matrix4d::Zero();
    for (int k = 0; k <= p; ++k) {
      const KnotWeights w = knots.bernstein(i, k);
      for (int m = 0; m <= p; ++m) out(k, m) = w[static_cast<std::size_t>(m)];
    }
    return out;
  };
  NormalEquations equations(static_cast<std::size_t>(knots.functions()));
  for (int i = 0; i < intervals; ++i) {
    Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, 3> sums = Eigen::Matrix<double, 4, 3>::Zero();
    each(i, [&](const LinePoint& of, double, const Eigen::Vector4d& b) {
      moments += b * b.transpose();
      sums += b * of.point.transpose();
    });
    moments += tolerance.smoothing(moments.sum()) * second_differences(p);
    const Eigen::Matrix4d to = bernstein_of(i), products = to.transpose() * moments * to;
    const Eigen::Matrix<double, 4, 3> right = to.transpose() * sums;
    for (int a = 0; a <= p; ++a) {
      equations.add_right(function(i, a), right.row(a));
      for (int b = 0; b <= p; ++b)
        if (function(i, b) <= function(i, a)) equations.add(function(i, a), function(i, b), products(a, b));
    }
  }
  const auto x = equations.solve();
  std::vector<Remainder> out(static_cast<std::size_t>(intervals));
  for (int i = 0; i < intervals; ++i) {
    Eigen::Matrix<double, 4, 3> local = Eigen::Matrix<double, 4, 3>::Zero();
    for (int k = 0; k <= p; ++k) local.row(k) = x.row(static_cast<Eigen::Index>(function(i, k)));
    const Eigen::Matrix<double, 4, 3> b = bernstein_of(i) * local;
    const KnotWeights d = bernstein_values(p - 1, 0.5);
    Vec3 tangent = Vec3::Zero();
    for (int k = 0; k < p; ++k) tangent += d[static_cast<std::size_t>(k)] * (b.row(k + 1) - b.row(k)).transpose();
    const Vec3 normal = tangent.cross(line.beside).normalized();
    RemainderSum sum;
    each(i, [&](const LinePoint& of, double s, const Eigen::Vector4d& w) {
      const Vec3 left = of.point - b.transpose() * w;
      sum.add(left.squaredNorm(), normal.dot(left), std::max(tolerance.distance, of.doubt), s, 0.0);
    });
    out[static_cast<std::size_t>(i)] = sum.result();
  }
  return out;
}

/// Neighbours differ by no more than a factor of about two.
std::vector<int> breaks_for(const FitLine& line, const std::vector<PointLine>& lines, int degree,
                            const FitTolerance& tolerance) {
  std::vector<int> breaks = line.even(line.last() / kCoarsestInterval, degree);
  for (;;) {
    check_cancelled();
    const KnotLine knots = line.knots(degree, breaks);
    const int intervals = knots.intervals();
    std::vector<int> votes(static_cast<std::size_t>(intervals), 0), voters = votes;
    for (const PointLine& points : lines) {
      const std::vector<Remainder> left = remainders(points, knots, tolerance);
      for (std::size_t i = 0; i < left.size(); ++i) {
        votes[i] += tolerance.exceeded(left[i]) && left[i].points >= tolerance.fewest() ? 1 : 0;
        voters[i] += left[i].points > 0 ? 1 : 0;
      }
    }
    std::vector<char> halve(static_cast<std::size_t>(intervals), 0);
    for (int i = 0; i < intervals; ++i) {
      if (2 * votes[static_cast<std::size_t>(i)] <= voters[static_cast<std::size_t>(i)]) continue;
      // with its neighbours, so that new functions have room
      for (int k = i - 1; k <= i + 1; ++k) {
        const int at = line.closed() ? (k + intervals) % intervals : k;
        if (at >= 0 && at < intervals) halve[static_cast<std::size_t>(at)] = 1;
      }
    }
    std::vector<int> next{0};
    for (int i = 0; i < intervals; ++i) {
      const int from = breaks[static_cast<std::size_t>(i)], to = breaks[static_cast<std::size_t>(i) + 1];
      const int middle = halve[static_cast<std::size_t>(i)] ? line.half(from, to) : 0;
      if (middle > 0) next.push_back(middle);
      next.push_back(to);
    }
    if (next.size() == breaks.size()) return breaks;
    breaks = std::move(next);
  }
}

/// The median height over each column of scattered points.
std::vector<double> median_section(const FitPoints& points, const auto& height) {
  const int columns = points.v().last(), rows = points.u().last();
  std::vector<double> out, heights;
  out.reserve(static_cast<std::size_t>(columns));
  for (int j = 0; j < columns; ++j) {
    heights.clear();
    points.each({0, rows, j, j + 1}, [&](std::size_t, double, double, const Vec3& p) { heights.push_back(height(p)); });
    const double last = out.empty() ? 0.0 : out.back();
    out.push_back(heights.empty() ? last : median_of(heights));
  }
  return out;
}

}  // namespace

CoarsestBreaks coarsest_breaks(const FitPoints& points, Body body, int degree, const FitTolerance& wanted) {
  FitTolerance tolerance = wanted;
  if (points.scattered()) tolerance.noise = std::max(tolerance.noise, 2.0 * tolerance.distance);  // strips are wide
  const int rows = points.rows(), columns = points.columns();
  const auto height = [&](const Vec3& p) { return body == Body::rail ? p.z() : std::hypot(p.x(), p.z()); };
  std::vector<double> section;
  if (points.scattered()) section = median_section(points, height);
  const FitLine& v = points.v();
  const auto section_at = [&](double y) {
    // linear between the middles of columns
    const double at = (y - v.at.front()) / (v.at[1] - v.at[0]) - 0.5;
    const int j = std::clamp(to_whole<int>(std::floor(at)), 0, std::max(0, columns - 2));
    const auto k = static_cast<std::size_t>(j);
    return columns < 2 ? section[k] : section[k] + (at - j) * (section[k + 1] - section[k]);
  };
  const double radius = section.empty() ? 0.0 : section[section.size() / 2];
  const auto collected = [&](bool along) {
    const int all = along ? columns : rows;
    // narrow, but of enough points
    const std::size_t widest = std::max<std::size_t>(1, static_cast<std::size_t>(all) / (2 * kLines));
    const int width = points.scattered()
                          ? static_cast<int>(std::clamp<std::size_t>(
                                kPointsAStrip * static_cast<std::size_t>(all) / points.size(), 1, widest))
                          : 1;
    const int count = std::min(static_cast<int>(kLines), all / width);
    std::vector<PointLine> lines(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) {
      PointLine& line = lines[static_cast<std::size_t>(k)];
      const int first = to_whole<int>((k + 0.5) * (all - width) / count);
      const FitPoints::Block block =
          along ? FitPoints::Block{0, rows, first, first + width} : FitPoints::Block{first, first + width, 0, columns};
      line.points.reserve(points.count(block));
      points.each(block, [&](std::size_t place, double at_u, double at_v, const Vec3& p) {
        if (!points.scattered()) {
          if (!along) line.beside = body == Body::rail ? Vec3::UnitX() : Vec3(std::cos(at_u), 0.0, -std::sin(at_u));
          line.points.push_back({along ? at_u : at_v, p, points.doubt(place)});
        } else if (!along) {
          line.beside = Vec3::UnitX();
          line.points.push_back({at_v, {0.0, p.y(), height(p)}, 0.0});
        } else {
          const double off = height(p) - section_at(p.y());
          const Vec3 at = body == Body::rail
                              ? Vec3(at_u, 0.0, off)
                              : Vec3((radius + off) * std::sin(at_u), 0.0, (radius + off) * std::cos(at_u));
          line.points.push_back({at_u, at, 0.0});
        }
      });
      if (points.scattered())
        std::sort(line.points.begin(), line.points.end(),
                  [](const LinePoint& a, const LinePoint& b) { return a.x < b.x; });
    }
    // refused later, with a name, if nothing else lies there
    std::erase_if(lines, [&](const PointLine& line) { return line.points.size() <= static_cast<std::size_t>(degree); });
    return lines;
  };
  return {breaks_for(points.u(), collected(true), degree, tolerance),
          breaks_for(points.v(), collected(false), degree, tolerance)};
}

}  // namespace treadmark::spline
