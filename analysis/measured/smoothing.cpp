// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "treadmark/analysis/measured/interpolation.hpp"
#include "treadmark/analysis/measured/noise.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/core/recent.hpp"
#include "treadmark/core/roots.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measured {

namespace {

using Row = std::array<double, 4>;
using Values = std::vector<double>;

// Everything below is in mm.
constexpr double kMm = 1e3;
constexpr double kFinestKnots = 0.1, kCoarsestKnots = 0.5;  ///< the step of the points between these
constexpr int kRounds = 4;                                  ///< of straightening the curve and laying it anew
constexpr int kErrorDraws = 16;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The sum of the logarithms of positive numbers.
class LogSum {
 public:
  void add(double x) {
    constexpr double kFar = 1e100;
    product_ *= x;
    if (product_ > 1.0 / kFar && product_ < kFar) return;
    sum_ += std::log(product_);
    product_ = 1.0;
  }
  double value() const { return sum_ + std::log(product_); }

 private:
  double sum_ = 0.0, product_ = 1.0;
};

/// Symmetric matrix of half bandwidth 3, rows from the diagonal to the left; factorised into L D L'.
class Band {
 public:
  explicit Band(int size) : rows_(at(size), Row{}) {}
  explicit Band(std::vector<Row> factor) : rows_(std::move(factor)) {}
  int size() const { return static_cast<int>(rows_.size()); }
  double& entry(int i, int left) { return rows_[at(i)][at(left)]; }
  const std::vector<Row>& rows() const { return rows_; }

  bool factor() {
    LogSum logs;
    Row one{1.0, 0.0, 0.0, 0.0}, two = one, three = one;  // the rows above; there is nothing to the left of the first
    for (Row& row : rows_) {
      row[3] /= three[0];
      const double third = row[3] * three[0];
      row[2] = (row[2] - third * two[1]) / two[0];
      const double second = row[2] * two[0];
      row[1] = (row[1] - third * one[2] - second * one[1]) / one[0];
      row[0] = row[0] - third * row[3] - second * row[2] - row[1] * one[0] * row[1];
      if (!(row[0] > 0.0)) return false;
      logs.add(row[0]);
      three = two, two = one, one = row;
    }
    log_determinant_ = logs.value();
    return true;
  }
  double log_determinant() const { return log_determinant_; }

  void solve(Values& x) const {
    lower(x);
    for (int i = 0; i < size(); ++i) x[at(i)] /= get(i, 0);
    upper(x);
  }
  /// From independent unit numbers to ones whose covariance is the inverse.
  void draw(Values& x) const {
    for (int i = 0; i < size(); ++i) x[at(i)] /= std::sqrt(get(i, 0));
    upper(x);
  }
  /// x' (L D L')^-1 x
  double inverse_square(Values x) const {
    lower(x);
    double sum = 0.0;
    for (int i = 0; i < size(); ++i) sum += x[at(i)] * x[at(i)] / get(i, 0);
    return sum;
  }
  /// The same of an x that is 0 but for few numbers from one on. What is far from them adds nothing.
  double inverse_square_of_few(std::size_t from, std::span<const double> few) const {
    constexpr double kNothing = 1e-14;
    double one = 0.0, two = 0.0, three = 0.0;  // solutions of the rows above
    double sum = 0.0;
    for (std::size_t i = from, none = 0; i < rows_.size() && none < 3; ++i) {
      const Row& row = rows_[i];
      const bool given = i - from < few.size();
      const double x = (given ? few[i - from] : 0.0) - row[1] * one - row[2] * two - row[3] * three;
      three = two, two = one, one = x;
      const double more = x * x / row[0];
      sum += more;
      none = !given && more < kNothing * sum ? none + 1 : 0;
    }
    return sum;
  }

 private:
  double get(int i, int left) const { return rows_[at(i)][at(left)]; }
  void lower(Values& x) const {
    double one = 0.0, two = 0.0, three = 0.0;  // solutions of the rows above
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Row& row = rows_[i];
      x[i] = x[i] - row[1] * one - row[2] * two - row[3] * three;
      three = two, two = one, one = x[i];
    }
  }
  void upper(Values& x) const {
    constexpr Row kNone{};
    const Row *a = &kNone, *b = a, *c = a;  // the rows below
    double one = 0.0, two = 0.0, three = 0.0;
    for (std::size_t i = x.size(); i-- > 0;) {
      x[i] = x[i] - (*a)[1] * one - (*b)[2] * two - (*c)[3] * three;
      three = two, two = one, one = x[i];
      c = b, b = a, a = &rows_[i];
    }
  }
  std::vector<Row> rows_;
  double log_determinant_ = 0.0;
};

/// Cubic B-splines of equal knots: cells + 3 of them.
struct Knots {
  double first = 0.0, step = 1.0;
  int cells = 1;

  static Knots over(double from, double to, double step) {
    const int cells = std::max(4, to_whole<int>(std::round((to - from) / step)));
    return {from, (to - from) / cells, cells};
  }
  int size() const { return cells + 3; }
  double last() const { return first + cells * step; }
  double node(int k) const { return first + k * step; }
  /// The cell of s, and the four B-splines there or one of their derivatives.
  int basis(double s, int derivative, Row& out) const {
    const double x = (s - first) / step;
    const int cell = std::clamp(to_whole<int>(std::floor(x)), 0, cells - 1);
    const double t = x - cell, u = 1.0 - t;
    if (derivative == 0)
      out = {u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
             (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) / 6.0, t * t * t / 6.0};
    else if (derivative == 1)
      out = {-u * u / (2.0 * step), (3.0 * t * t - 4.0 * t) / (2.0 * step),
             (-3.0 * t * t + 2.0 * t + 1.0) / (2.0 * step), t * t / (2.0 * step)};
    else
      out = {u / (step * step), (3.0 * t - 2.0) / (step * step), (1.0 - 3.0 * t) / (step * step), t / (step * step)};
    return cell;
  }
  static double sum_of(const Row& b, int cell, const Values& c) {
    const double* const of = c.data() + cell;
    return b[0] * of[0] + b[1] * of[1] + b[2] * of[2] + b[3] * of[3];
  }
  double value(const Values& c, double s, int derivative = 0) const {
    Row b;
    const int cell = basis(s, derivative, b);
    return sum_of(b, cell, c);
  }
};

/// The B-splines at places that are asked for again and again.
struct Bases {
  std::vector<int> cells;
  std::vector<Row> rows;

  Bases(const Knots& knots, const Values& s) : cells(s.size()), rows(s.size()) {
    for (std::size_t i = 0; i < s.size(); ++i) cells[i] = knots.basis(s[i], 0, rows[i]);
  }
  double value(const Values& c, std::size_t i) const { return Knots::sum_of(rows[i], cells[i], c); }
};

/// Adds weights times products of B-splines, and with them times the data.
void add_products(const Bases& bases, const Values& weights, Band& matrix) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Row& b = bases.rows[i];
    for (int p = 0; p < 4; ++p)
      for (int q = 0; q <= p; ++q) matrix.entry(bases.cells[i] + p, p - q) += weights[i] * b[at(p)] * b[at(q)];
  }
}
Values products_with(const Knots& knots, const Bases& bases, const Values& data) {
  Values out(at(knots.size()), 0.0);
  for (std::size_t i = 0; i < data.size(); ++i)
    for (std::size_t p = 0; p < 4; ++p) out[at(bases.cells[i]) + p] += bases.rows[i][p] * data[i];
  return out;
}

double third_difference(const Values& c, int cell) {
  return c[at(cell + 3)] - 3.0 * c[at(cell + 2)] + 3.0 * c[at(cell + 1)] - c[at(cell)];
}
/// Adds penalties on squares of third differences, one a cell.
void add_penalty(const Values& penalty, Band& matrix) {
  double one = 0.0, two = 0.0, three = 0.0;  // of the cells before
  for (int i = 0; i < matrix.size(); ++i) {
    const double own = at(i) < penalty.size() ? penalty[at(i)] : 0.0;
    matrix.entry(i, 0) = matrix.entry(i, 0) + three + 3.0 * (3.0 * two) + 3.0 * (3.0 * one) + own;
    matrix.entry(i, 1) = matrix.entry(i, 1) - 3.0 * three - 3.0 * (3.0 * two) - 3.0 * one;
    matrix.entry(i, 2) = matrix.entry(i, 2) + 3.0 * three + 3.0 * two;
    matrix.entry(i, 3) -= three;
    three = two, two = one, one = own;
  }
}

/// A curve with its arc length as the parameter, nearly.
struct Curve {
  Knots knots;
  Values y, z;

  double at_y(double s, int derivative = 0) const { return knots.value(y, s, derivative); }
  double at_z(double s, int derivative = 0) const { return knots.value(z, s, derivative); }
  double speed(double s) const {
    Row b;
    const int cell = knots.basis(s, 1, b);
    return std::hypot(Knots::sum_of(b, cell, y), Knots::sum_of(b, cell, z));
  }
  double angle(double s) const { return std::atan2(at_z(s, 1), at_y(s, 1)); }
};

/// Through the points, with one penalty everywhere.
Curve even_curve(const Knots& knots, const Values& s, const Values& y, const Values& z, double penalty) {
  const Bases bases(knots, s);
  Band matrix(knots.size());
  add_products(bases, Values(s.size(), 1.0), matrix);
  add_penalty(Values(at(knots.cells), penalty), matrix);
  Curve curve{knots, products_with(knots, bases, y), products_with(knots, bases, z)};
  if (!matrix.factor()) return {knots, {}, {}};
  matrix.solve(curve.y);
  matrix.solve(curve.z);
  return curve;
}

/// The points across a curve, laid out straight: heights whose second derivative is a curvature.
struct Straightened {
  Knots knots;                   ///< over the true arc length of the curve
  Values node_y, node_z, angle;  ///< of the curve at the knots
  Values node_height;            ///< the curve itself, straightened
  Values s, height, half_step;   ///< of the points; half of what rounding leaves open, across the curve
  Values weight;                 ///< of the points: the usual variance over theirs
};

double unwrapped(double angle, double near) { return angle + 2.0 * kPi * std::round((near - angle) / (2.0 * kPi)); }

struct Points {
  Values y, z, s;
  double rounding_y = 0.0, rounding_z = 0.0, step = 1.0;
  double variance_y = 1.0, variance_z = 1.0;  ///< over the usual one
  std::size_t size() const { return y.size(); }
};

/// Moves the points' parameters to their feet on the curve.
void to_feet(Points& points, const Curve& curve) {
  const double most = 0.5 * std::max(points.step, 0.2);
  for (int turn = 0; turn < 2; ++turn)
    for (std::size_t i = 0; i < points.size(); ++i) {
      double& s = points.s[i];
      const double ty = curve.at_y(s, 1), tz = curve.at_z(s, 1);
      const double along = (points.y[i] - curve.at_y(s)) * ty + (points.z[i] - curve.at_z(s)) * tz;
      s += std::clamp(along / (ty * ty + tz * tz), -most, most);
    }
}

/// Nothing where the curve folds.
std::optional<Straightened> straighten(Points& points, const Curve& curve, double knot_step) {
  to_feet(points, curve);
  const Knots& old = curve.knots;
  const auto simpson = [&](double from, double to) {
    return (to - from) / 6.0 * (curve.speed(from) + 4.0 * curve.speed(0.5 * (from + to)) + curve.speed(to));
  };
  Values arc(at(old.cells + 1), 0.0);
  for (int k = 0; k < old.cells; ++k) arc[at(k + 1)] = arc[at(k)] + simpson(old.node(k), old.node(k + 1));
  const auto arc_at = [&](double s) {
    const int cell = std::clamp(to_whole<int>(std::floor((s - old.first) / old.step)), 0, old.cells - 1);
    return arc[at(cell)] + simpson(old.node(cell), s);
  };
  Straightened out;
  Values feet(points.s);
  for (double& s : points.s) s = arc_at(s);
  const auto [least, greatest] = ranges::minmax_element(points.s);
  constexpr double kFolded = 1.5;
  const bool folded = !ranges::all_of(points.s, [](double s) { return std::isfinite(s); }) ||
                      !(arc.back() < kFolded * (old.last() - old.first)) || !(*greatest - *least < 2.0 * arc.back());
  if (folded) return std::nullopt;
  out.knots = Knots::over(*least, *greatest, knot_step);
  const auto parameter_at = [&](double length) {
    double s = old.first + length / arc.back() * (old.last() - old.first);
    for (int turn = 0; turn < 4; ++turn) s -= (arc_at(s) - length) / curve.speed(s);
    return s;
  };
  const int cells = out.knots.cells;
  const double h = out.knots.step;
  out.node_height.assign(at(cells + 1), 0.0);
  Values middle(at(cells), 0.0);
  for (int k = 0; k <= cells; ++k) {
    const double s = parameter_at(out.knots.node(k));
    out.node_y.push_back(curve.at_y(s));
    out.node_z.push_back(curve.at_z(s));
    out.angle.push_back(unwrapped(curve.angle(s), k > 0 ? out.angle.back() : curve.angle(s)));
    if (k < cells) middle[at(k)] = unwrapped(curve.angle(parameter_at(out.knots.node(k) + 0.5 * h)), out.angle.back());
  }
  const double level = out.angle[at(cells / 2)];
  for (int k = 0; k < cells; ++k)
    out.node_height[at(k + 1)] =
        out.node_height[at(k)] +
        h / 6.0 * (out.angle[at(k)] + 4.0 * middle[at(k)] + out.angle[at(k + 1)] - 6.0 * level);
  const auto height_at = [&](double s) {  // Hermite's cubic between knots
    const double x = (s - out.knots.first) / h;
    const int k = std::clamp(to_whole<int>(std::floor(x)), 0, cells - 1);
    const double t = x - k, t2 = t * t, t3 = t2 * t;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * out.node_height[at(k)] + (3.0 * t2 - 2.0 * t3) * out.node_height[at(k + 1)] +
           h * ((t3 - 2.0 * t2 + t) * (out.angle[at(k)] - level) + (t3 - t2) * (out.angle[at(k + 1)] - level));
  };
  out.s = points.s;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = feet[i], ty = curve.at_y(s, 1), tz = curve.at_z(s, 1), length = std::hypot(ty, tz);
    const double across = ((points.z[i] - curve.at_z(s)) * ty - (points.y[i] - curve.at_y(s)) * tz) / length;
    out.height.push_back(height_at(points.s[i]) + across);
    out.weight.push_back(length * length / (points.variance_y * tz * tz + points.variance_z * ty * ty));
    out.half_step.push_back(0.5 * (points.rounding_y * std::fabs(tz) + points.rounding_z * std::fabs(ty)) / length);
  }
  return out;
}

/// The curve that the moved heights mean.
Curve moved_curve(const Straightened& line, const Values& heights) {
  Values s, y, z;
  for (int k = 0; k <= line.knots.cells; ++k) {
    const double node = line.knots.node(k), move = line.knots.value(heights, node) - line.node_height[at(k)];
    s.push_back(node);
    y.push_back(line.node_y[at(k)] - move * std::sin(line.angle[at(k)]));
    z.push_back(line.node_z[at(k)] + move * std::cos(line.angle[at(k)]));
  }
  constexpr double kNearlyNone = 1e-9;  // makes the three splines beyond the number of nodes certain
  return even_curve(line.knots, s, y, z, kNearlyNone);
}

struct Fit {
  Values heights;                                            ///< coefficients
  double penalty = 0.0;                                      ///< factor of the penalties
  double variance = 0.0;                                     ///< of a point
  double badness = std::numeric_limits<double>::infinity();  ///< -2 log of the likelihood, but for a constant
  Band precision{1};                                         ///< of the coefficients times the variance, factorised
};

/// Means of a number of each cell and its neighbours, weighted by a normal density of this deviation.
Values means_around(const Knots& knots, const Values& numbers, double deviation) {
  constexpr double kReach = 3.0;
  const int reach = to_whole<int>(std::round(kReach * deviation / knots.step));
  Values weight, out;
  for (int d = 0; d <= reach; ++d) weight.push_back(std::exp(-0.5 * std::pow(d * knots.step / deviation, 2)));
  for (int k = 0; k < knots.cells; ++k) {
    double sum = 0.0, weights = 0.0;
    for (int j = std::max(0, k - reach); j <= std::min(knots.cells - 1, k + reach); ++j) {
      sum += weight[at(std::abs(j - k))] * numbers[at(j)];
      weights += weight[at(std::abs(j - k))];
    }
    out.push_back(sum / weights);
  }
  return out;
}

/// How restless the curvature is at each cell: its variance a length, but for one factor. Roughness grows with how much
/// the curve is bent within a few millimetres.
Values restlessness(const Knots& knots, const Knots& before, const Values& heights) {
  constexpr double kWindow = 4.0, kFlattest = 1.0 / 200.0;
  Values squares;
  for (int k = 0; k < knots.cells; ++k) {
    const double s = std::clamp(knots.node(k) + 0.5 * knots.step, before.first, before.last());
    squares.push_back(std::pow(before.value(heights, s, 2), 2));
  }
  Values out = means_around(knots, squares, kWindow);
  for (double& bent : out) bent = std::pow(bent + kFlattest * kFlattest, 2);
  return out;
}

/// Where the curvature of a rail's head changed in the fit before it may change more: arcs that meet in jumps.
Values changes(const Knots& knots, const Knots& before, const Values& heights) {
  constexpr double kWindow = 3.0, kLeast = 0.05;
  Values squares;
  double mean = 0.0;
  for (int k = 0; k < knots.cells; ++k) {
    Row unused;
    const double s = std::clamp(knots.node(k) + 0.5 * knots.step, before.first, before.last());
    squares.push_back(std::pow(third_difference(heights, before.basis(s, 0, unused)), 2));
    mean += squares.back() / knots.cells;
  }
  Values out = means_around(knots, squares, kWindow);
  for (double& change : out) change = std::pow(change / mean + kLeast, 3);
  return out;
}

double log_normal_share(double from, double to, double& slope, double& bend) {
  // log of the normal probability between two bounds, its derivative by the mean and the negative second one
  constexpr double kRoot = 0.7071067811865476, kDensity = 0.3989422804014327, kFar = 5.0;
  if (from > kFar || to < -kFar) {  // beyond: as if the nearer bound had been measured
    const double beyond = from > kFar ? from : to;
    slope = beyond, bend = 1.0;
    return -0.5 * beyond * beyond - std::log(std::fabs(beyond) / kDensity);
  }
  const double share = from > 0.0 ? 0.5 * (std::erfc(from * kRoot) - std::erfc(to * kRoot))
                                  : 0.5 * (std::erfc(-to * kRoot) - std::erfc(-from * kRoot));
  const double low = kDensity * std::exp(-0.5 * from * from), high = kDensity * std::exp(-0.5 * to * to);
  slope = (low - high) / share;
  bend = std::max(0.0, (to * high - from * low) / share + slope * slope);
  return std::log(share);
}

/// A place where the curve may change its slope (a corner) or its curvature (where two arcs meet) at once, by how much,
/// and how many standard deviations that is.
struct Break {
  double s = 0.0, turn = 0.0, bend = 0.0, significance = 0.0;
};

/// One smoothing problem: heights over s, the penalties but for their factor.
class Problem {
 public:
  /// third_differences: standard deviations of those that are known otherwise; 0 for all others.
  Problem(const Straightened& line, Values restless, Values third_differences)
      : line_(line),
        restless_(std::move(restless)),
        third_differences_(std::move(third_differences)),
        step5_(std::pow(line.knots.step, 5)),
        bases_(line.knots, line.s),
        products_(line.knots.size()),
        right_(products_with(line.knots, bases_, weighted(line))) {
    add_products(bases_, line.weight, products_);
  }

  /// White noise of unknown variance.
  Fit white(double log_factor, double noise) const {
    Fit fit = begin(log_factor, noise);
    Band matrix = products_;
    add_penalty(penalties_, matrix);
    if (!matrix.factor()) return fit;
    fit.heights = right_;
    matrix.solve(fit.heights);
    double sum = penalty_of(fit.heights);
    for (std::size_t i = 0; i < line_.s.size(); ++i) {
      const double rest = line_.height[i] - bases_.value(fit.heights, i);
      sum += line_.weight[i] * rest * rest;
    }
    const auto free = static_cast<double>(line_.s.size() - 3);
    fit.variance = sum / free;
    fit.badness = free * std::log(fit.variance) + matrix.log_determinant() - log_penalties_;
    fit.precision = std::move(matrix);
    return fit;
  }

  /// Numbers that were rounded, with white noise of this standard deviation before: Newton's method.
  Fit rounded(double log_factor, double noise, const Values& start) const {
    constexpr int kMost = 30;
    constexpr double kSame = 1e-5;
    Fit fit = begin(log_factor, 1.0);
    fit.variance = 1.0;
    Values now = start;
    double badness = std::numeric_limits<double>::infinity();
    const std::size_t n = line_.s.size();
    Values slope(n), bend(n);
    const auto value_of = [&](const Values& c) {
      double sum = penalty_of(c);
      for (std::size_t i = 0; i < n; ++i) {
        const double rest = line_.height[i] - bases_.value(c, i), half = line_.half_step[i];
        sum -= 2.0 * log_normal_share((rest - half) / noise, (rest + half) / noise, slope[i], bend[i]);
      }
      return sum;
    };
    double value = value_of(now);
    for (int turn = 0; turn < kMost; ++turn) {
      Band matrix(line_.knots.size());
      Values weights(n), data(n);
      for (std::size_t i = 0; i < n; ++i) {
        weights[i] = bend[i] / (noise * noise);
        data[i] = weights[i] * bases_.value(now, i) + slope[i] / noise;
      }
      add_products(bases_, weights, matrix);
      add_penalty(penalties_, matrix);
      if (!matrix.factor()) return fit;
      Values next = products_with(line_.knots, bases_, data);
      matrix.solve(next);
      double next_value = value_of(next);
      for (int half = 0; half < 8 && next_value > value; ++half) {
        for (std::size_t k = 0; k < next.size(); ++k) next[k] = 0.5 * (next[k] + now[k]);
        next_value = value_of(next);
      }
      const bool done = !(value - next_value > kSame * (1.0 + std::fabs(value)));
      if (next_value <= value) now = next, value = next_value;
      badness = value + matrix.log_determinant() - log_penalties_;
      fit.precision = std::move(matrix);
      if (done) break;
    }
    fit.heights = now;
    fit.badness = badness;
    return fit;
  }

  /// The most significant break of the fit that was made last: what freeing two third differences, of a corner, or one,
  /// of a bend, would gain (score test, Rao 1948). Beside a bend the test of a corner would find one as well.
  Break likeliest_break(const Fit& fit) const {
    constexpr double kEnds = 2.0;  ///< no corner is told from a bend so near an end
    constexpr double kTold = 1e-9;
    constexpr double kDifference[] = {-1.0, 3.0, -3.0, 1.0};
    Break best;
    const double first = line_.knots.first, last = line_.knots.last(), step = line_.knots.step;
    const auto judge = [&](int k, double s, double score, double whole, std::span<const double> pull, bool corner) {
      if (s < first + kEnds || s > last - kEnds) return;
      const double information = whole - fit.precision.inverse_square_of_few(at(k), pull);
      if (!(information > kTold * whole)) return;
      const double t = std::fabs(score) / std::sqrt(information * fit.variance), size = std::fabs(score) / information;
      if (t > best.significance) best = {s, corner ? size : 0.0, corner ? 0.0 : size / (step * step), t};
    };
    for (int k = 0; k < line_.knots.cells; ++k) {
      const double penalty = penalties_[at(k)], score = penalty * third_difference(fit.heights, k);
      std::array<double, 4> pull{};
      for (std::size_t m = 0; m < 4; ++m) pull[m] = penalty * kDifference[m];
      judge(k, line_.knots.node(k) + 0.5 * step, score, penalty, pull, false);
    }
    for (int k = 1; k < line_.knots.cells; ++k) {
      const double before = step * penalties_[at(k - 1)], after = step * penalties_[at(k)];
      std::array<double, 5> pull{};
      for (std::size_t m = 0; m < 4; ++m) pull[m] += before * kDifference[m], pull[m + 1] -= after * kDifference[m];
      judge(k - 1, line_.knots.node(k),
            before * third_difference(fit.heights, k - 1) - after * third_difference(fit.heights, k),
            step * (before + after), pull, true);
    }
    return best;
  }

 private:
  static Values weighted(const Straightened& line) {
    Values out;
    for (std::size_t i = 0; i < line.s.size(); ++i) out.push_back(line.weight[i] * line.height[i]);
    return out;
  }
  Fit begin(double log_factor, double noise) const {
    Fit fit;
    fit.penalty = std::exp(log_factor);
    penalties_.clear();
    LogSum logs;
    for (std::size_t k = 0; k < restless_.size(); ++k) {
      penalties_.push_back(fit.penalty / (restless_[k] * step5_));
      if (const double known = third_differences_[k]; known > 0.0)
        penalties_.back() = std::min(penalties_.back(), std::pow(noise / known, 2));
      logs.add(penalties_.back());
    }
    log_penalties_ = logs.value();
    return fit;
  }
  double penalty_of(const Values& c) const {
    double sum = 0.0;
    for (int k = 0; k < line_.knots.cells; ++k) sum += penalties_[at(k)] * std::pow(third_difference(c, k), 2);
    return sum;
  }

  const Straightened& line_;
  Values restless_, third_differences_;
  double step5_;  ///< fifth power of the knots' step
  Bases bases_;
  Band products_;
  Values right_;
  mutable Values penalties_;
  mutable double log_penalties_ = 0.0;
};

/// The least of a function of one valley between the bounds: by steps, then by the golden section.
template <class Badness>
double lowest(double from, double to, double step, Badness badness) {
  double best = from, least = std::numeric_limits<double>::infinity();
  for (double x = from; x <= to; x += step)
    if (const double b = badness(x); b < least) least = b, best = x;
  constexpr double kNear = 0.02;
  return golden_section(best - step, best + step, kNear, badness).middle();
}

/// Where the curvature may change most.
enum class Restless : std::uint8_t {
  anywhere,
  in_bends,    ///< as in a wheel: the tread hardly bends, flange and throat do
  at_changes,  ///< as in the head of a rail, whose arcs of 300 and 80 mm meet in a jump
};

/// The curve of the points, and what is known of it.
struct Laid {
  Restless where = Restless::anywhere;
  Straightened line;
  Curve curve;
  Fit fit;
  Values third_differences;   ///< that breaks leave free
  double first_factor = 0.0;  ///< log of the penalty of a curve that is equally restless anywhere
};

/// Lets slope or curvature change by about as much as a break does, across two cells to each side of a corner.
void free_break(const Knots& knots, const Break& found, Values& third_differences) {
  constexpr double kCells = 2.0, kCellsOfBend = 1.25, kTimes = 2.0;
  const bool corner = found.turn > 0.0;
  const double size = corner ? found.turn * knots.step : found.bend * knots.step * knots.step;
  for (int k = 0; k < knots.cells; ++k)
    if (std::fabs(knots.node(k) + 0.5 * knots.step - found.s) < (corner ? kCells : kCellsOfBend) * knots.step)
      third_differences[at(k)] = std::max(third_differences[at(k)], kTimes * size);
}

/// What is assumed of a curve before its points are seen.
struct Assumptions {
  Restless where = Restless::anywhere;
  double least_break = 0.0;  ///< standard deviations from which on a break is believed
};

Values restless_cells(Restless where, const Knots& knots, const Knots& before, const Values& heights) {
  switch (where) {
    case Restless::anywhere:
      break;
    case Restless::in_bends:
      return restlessness(knots, before, heights);
    case Restless::at_changes:
      return changes(knots, before, heights);
  }
  return Values(at(knots.cells), 1.0);
}

constexpr double kNarrow = 3.0, kFine = 1.0;  ///< of the logarithm of the penalties

double normal(Random& random) {  // Box and Muller (1958)
  const double size = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return size * std::cos(2.0 * kPi * random.uniform());
}

/// Errors that the curve may have, as coefficients: of curves laid anew, penalties and all, through points that other
/// probable curves would have given (Efron 1979). The curve's own covariance alone takes the penalties for known.
std::vector<Values> errors_of(const Laid& laid, double across, bool rounded, std::uint64_t seed) {
  constexpr int kTurns = 3;
  Random random(seed);
  const Knots& knots = laid.line.knots;
  const double deviation = std::sqrt(laid.fit.variance);
  std::vector<Values> out;
  Straightened line = laid.line;
  for (int draw = 0; draw < kErrorDraws; ++draw) {
    Values error(laid.fit.heights.size());
    for (double& e : error) e = normal(random);
    laid.fit.precision.draw(error);
    for (double& e : error) e *= deviation;
    if (!rounded) {
      Values curve = laid.fit.heights;
      for (std::size_t k = 0; k < curve.size(); ++k) curve[k] += error[k];
      for (std::size_t i = 0; i < line.s.size(); ++i)
        line.height[i] = knots.value(curve, line.s[i]) + deviation / std::sqrt(line.weight[i]) * normal(random);
      Values heights;
      for (int turn = 0; turn < kTurns; ++turn) {
        const Problem problem(line, restless_cells(turn > 0 ? laid.where : Restless::anywhere, knots, knots, heights),
                              laid.third_differences);
        const double middle = turn > 0 ? std::log(laid.fit.penalty) : laid.first_factor;
        const double found = lowest(middle - kNarrow, middle + kNarrow, kFine,
                                    [&](double x) { return problem.white(x, across).badness; });
        heights = problem.white(found, across).heights;
        if (heights.empty()) break;  // no curve goes through these: the error by the first one's covariance stays
      }
      if (!heights.empty())
        for (std::size_t k = 0; k < error.size(); ++k) error[k] = curve[k] - heights[k];
    }
    out.push_back(std::move(error));
  }
  return out;
}

/// Whether rounding makes most of the noise.
bool is_rounded(const PointNoise& noise) {
  return std::max(noise.rounding_y, noise.rounding_z) / std::sqrt(12.0) > 0.5 * noise.across;
}

std::optional<Laid> lay_curve(Points points, const PointNoise& noise, const Assumptions& assumed) {
  constexpr std::size_t kMostBreaks = 12;
  constexpr double kFirstCutoff = 1.0;  ///< wavelength that the first curve halves, which only has to lie near
  constexpr double kLowest = -40.0, kHighest = 40.0, kCoarse = 2.0, kMostMore = 20.0;
  constexpr double kOfStep = 0.1;  ///< least noise before rounding, of the step
  const double knot_step = std::clamp(points.step, kFinestKnots, kCoarsestKnots);
  const Knots knots = Knots::over(points.s.front(), points.s.back(), knot_step);
  const double cutoff = kFirstCutoff * std::max(1.0, points.step) / (2.0 * kPi);
  Laid laid;
  laid.where = assumed.where;
  laid.curve =
      even_curve(knots, points.s, points.y, points.z, std::pow(cutoff, 6) / (points.step * std::pow(knots.step, 5)));
  if (laid.curve.y.empty()) return std::nullopt;

  const double rounding = std::max(points.rounding_y, points.rounding_z), rounded = rounding / std::sqrt(12.0);
  const double across = kMm * noise.across;
  const bool by_halves = is_rounded(noise);
  const double before = std::sqrt(std::max(across * across - rounded * rounded, std::pow(kOfStep * rounding, 2)));
  double found = 0.0;
  std::vector<std::pair<std::size_t, Break>> breaks;  ///< and the point nearest to each
  for (int round = 0; round < kRounds; ++round) {
    std::optional<Straightened> straight = straighten(points, laid.curve, knot_step);
    if (!straight) return std::nullopt;
    Straightened line = std::move(*straight);
    const Values restless =
        restless_cells(round > 0 ? assumed.where : Restless::anywhere, line.knots, laid.line.knots, laid.fit.heights);
    Values third_differences(at(line.knots.cells), 0.0);
    for (auto& [point, known] : breaks) {
      known.s = line.s[point];
      free_break(line.knots, known, third_differences);
    }
    for (bool wide = round < 2;; wide = false) {
      const Problem problem(line, restless, third_differences);
      const auto search = [&](auto&& fit_of) {
        const auto badness = [&](double x) { return fit_of(x).badness; };
        const double middle = found;
        if (!wide) found = lowest(middle - kNarrow, middle + kNarrow, kFine, badness);
        if (wide || std::fabs(found - middle) > kNarrow - kFine) found = lowest(kLowest, kHighest, kCoarse, badness);
        return fit_of(found);
      };
      if (by_halves) {
        // a penalty that is too small leaves knots without a point undetermined
        Values start;
        for (double more = 0.0; start.empty() && more <= kMostMore; more += kCoarse)
          start = problem.white(6.0 * std::log(cutoff) - std::log(points.step) + more, across).heights;
        if (start.empty()) return std::nullopt;
        laid.fit = search([&](double x) {
          Fit fit = problem.rounded(x, before, start);
          if (!fit.heights.empty()) start = fit.heights;
          return fit;
        });
      } else {
        laid.fit = search([&](double x) { return problem.white(x, across); });
      }
      if (laid.fit.heights.empty() || !std::isfinite(laid.fit.badness)) return std::nullopt;
      if (round == 0 || breaks.size() == kMostBreaks) break;
      const Break found_break = problem.likeliest_break(laid.fit);
      if (found_break.significance < assumed.least_break) break;
      const auto nearest = ranges::min_element(line.s, {}, [&](double s) { return std::fabs(s - found_break.s); });
      breaks.emplace_back(static_cast<std::size_t>(nearest - line.s.begin()), found_break);
      free_break(line.knots, found_break, third_differences);
    }
    laid.curve = moved_curve(line, laid.fit.heights);
    if (laid.curve.y.empty()) return std::nullopt;
    laid.line = std::move(line);
    laid.third_differences = std::move(third_differences);
    if (round == 0) laid.first_factor = found;
  }
  return laid;
}

std::optional<Laid> usual_curve(const Points& points, const PointNoise& noise, Body body) {
  constexpr double kCorner = 4.5;
  constexpr double kFails = 0.25;  ///< in badness of a point: as if the noise were an eighth larger
  if (body == Body::wheel) return lay_curve(points, noise, {Restless::in_bends, kCorner});
  std::optional<Laid> changing = lay_curve(points, noise, {Restless::at_changes, kCorner}),
                      even = lay_curve(points, noise, {Restless::anywhere, kCorner});
  const double more = kFails * static_cast<double>(points.size());
  return changing && (!even || changing->fit.badness < even->fit.badness + more) ? changing : even;
}

/// Of assumptions that may be right as well.
std::vector<Laid> other_curves(const Points& points, const PointNoise& noise, Body body) {
  constexpr double kPerhapsCorner = 3.0;
  std::vector<Laid> out;
  for (const Restless where : {Restless::anywhere, body == Body::wheel ? Restless::at_changes : Restless::in_bends})
    if (std::optional<Laid> other = lay_curve(points, noise, {where, kPerhapsCorner})) out.push_back(std::move(*other));
  return out;
}

/// Of exact points: splines that vanish at them and are as large midway as the curve may be off there.
void add_errors_between(const Profile& profile, ProfileScatter& scatter) {
  constexpr double kNearlyNone = 1e-9;  // makes splines certain where points are farther apart than knots
  const BetweenPoints known = known_between(profile);
  if (known.deviation.empty()) return;
  Values s, deviation;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < known.s.size(); ++i) {
    s.push_back(kMm * known.s[i]);
    deviation.push_back(0.0);
    if (i == known.deviation.size() || !(known.deviation[i] > 0.0)) continue;
    const double half = 0.5 * kMm * (known.s[i + 1] - known.s[i]);
    s.push_back(kMm * known.s[i] + half);
    deviation.push_back(kMm * known.deviation[i]);
    step = std::min(step, half);
  }
  const Knots knots = Knots::over(s.front(), s.back(), step);
  Random random(profile.body == Body::rail ? 4 : 3);
  std::vector<Values> errors;
  while (errors.size() < at(kErrorDraws)) {
    Values one(deviation), other(deviation);
    for (std::size_t i = 0; i < deviation.size(); ++i) one[i] *= normal(random), other[i] *= normal(random);
    Curve pair = even_curve(knots, s, one, other, kNearlyNone);
    if (pair.y.empty()) return;
    errors.push_back(std::move(pair.y));
    errors.push_back(std::move(pair.z));
  }
  for (Values& error : errors)
    for (double& e : error) e /= kMm;
  scatter.s = known.s;
  scatter.between = known.deviation;
  scatter.first_knot = knots.first / kMm;
  scatter.knot_step = knots.step / kMm;
  scatter.errors = std::move(errors);
}

Profile smoothed(Profile profile) {
  constexpr std::size_t kFewest = 16;
  const std::size_t n = profile.y.size();
  if (n < kFewest) return profile;
  const PointNoise noise = profile_noise(profile);
  auto scatter = std::make_shared<ProfileScatter>();
  scatter->white = noise.across;
  scatter->rounding_y = noise.rounding_y;
  scatter->rounding_z = noise.rounding_z;
  scatter->step = noise.step;
  profile.scatter = scatter;
  if (noise.across < kExactPoints) add_errors_between(profile, *scatter);
  if (noise.across < kExactPoints || !(noise.step > 0.0)) return profile;

  Points points;
  for (std::size_t i = 0; i < n; ++i) points.y.push_back(kMm * profile.y[i]), points.z.push_back(kMm * profile.z[i]);
  points.s = rough_arc_length(profile);
  for (double& s : points.s) s *= kMm;
  points.rounding_y = kMm * noise.rounding_y;
  points.rounding_z = kMm * noise.rounding_z;
  points.step = kMm * noise.step;
  // as far as both parts are long enough to tell
  constexpr double kMostApart = 5.0;
  if (noise.flat > 0.0 && noise.steep > 0.0) {
    const double usual = noise.across * noise.across;
    const auto over_usual = [&](double part) {
      return std::clamp(part * part / usual, 1.0 / (kMostApart * kMostApart), kMostApart * kMostApart);
    };
    points.variance_z = over_usual(noise.flat);
    points.variance_y = over_usual(noise.steep);
  }
  const std::optional<Laid> laid = usual_curve(points, noise, profile.body);
  if (!laid) return profile;
  const std::vector<Laid> others = other_curves(points, noise, profile.body);
  scatter->others.resize(others.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double s = laid->line.s[i], y = laid->curve.at_y(s), z = laid->curve.at_z(s);
    squares += std::pow(y - points.y[i], 2) + std::pow(z - points.z[i], 2);
    profile.y[i] = y / kMm;
    profile.z[i] = z / kMm;
    scatter->s.push_back(s / kMm);
    const double ty = laid->curve.at_y(s, 1), tz = laid->curve.at_z(s, 1);
    for (std::size_t k = 0; k < others.size(); ++k) {
      const double foot = others[k].line.s[i], dy = others[k].curve.at_y(foot) - y, dz = others[k].curve.at_z(foot) - z;
      scatter->others[k].push_back((dz * ty - dy * tz) / std::hypot(ty, tz) / kMm);
    }
  }
  scatter->removed = std::sqrt(squares / static_cast<double>(n)) / kMm;
  scatter->first_knot = laid->line.knots.first / kMm;
  scatter->knot_step = laid->line.knots.step / kMm;
  scatter->errors = errors_of(*laid, kMm * noise.across, is_rounded(noise), profile.body == Body::rail ? 2 : 1);
  for (Values& error : scatter->errors)
    for (double& e : error) e /= kMm;
  scatter->factor = laid->fit.precision.rows();
  for (Row& row : scatter->factor) row[0] *= kMm * kMm / laid->fit.variance;
  return profile;
}

}  // namespace

Profile smoothed_by_noise(Profile profile) {
  profile.smoothing.method = SmoothingOptions::Method::spline;
  profile.smoothing.strength = 0.0;
  struct Read {
    Body body = Body::rail;
    Values y, z;
    bool operator==(const Read&) const = default;
  };
  thread_local Recent<Read, Profile> recent;  // a case reads the same file more than once
  const std::shared_ptr<const Profile> known = recent.of(
      {profile.body, profile.y, profile.z}, [&] { return std::make_shared<const Profile>(smoothed(profile)); });
  profile.y = known->y;
  profile.z = known->z;
  profile.scatter = known->scatter;
  return profile;
}

ErrorDraws::ErrorDraws(const Profile& profile)
    : scatter_(profile.scatter), shift_(profile.body == Body::rail ? 0 : 2) {}

std::size_t ErrorDraws::size() const { return scatter_->errors.size(); }

double ErrorDraws::at(std::size_t draw, double s) const {
  if (draw >= size()) return 0.0;
  const Values& coefficients = scatter_->errors[draw];
  const Knots knots{scatter_->first_knot, scatter_->knot_step, static_cast<int>(coefficients.size()) - 3};
  double sum = knots.value(coefficients, std::clamp(s, knots.first, knots.last()));
  for (std::size_t k = 0; k < scatter_->others.size(); ++k)
    sum += ((draw >> (k + shift_)) % 2 == 0 ? 1.0 : -1.0) * BrokenLine(scatter_->s, scatter_->others[k]).held_at(s);
  return sum;
}

Profile ErrorDraws::moved(Profile profile, std::size_t draw) const {
  Values s = scatter_->s;
  if (!scatter_->between.empty()) {
    profile = with_middles(profile, {scatter_->s, scatter_->between}, s);
    profile.scatter = nullptr;  // of the points that there were
  }
  const Values y = profile.y, z = profile.z;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t a = i > 0 ? i - 1 : i, b = std::min(i + 1, y.size() - 1);
    const double length = std::hypot(y[b] - y[a], z[b] - z[a]), error = at(draw, s[i]);
    profile.y[i] -= error * (z[b] - z[a]) / length;
    profile.z[i] += error * (y[b] - y[a]) / length;
  }
  return profile;
}

double deviation_of_sum(const ProfileScatter& scatter, std::span<const double> s, std::span<const double> weights) {
  if (scatter.factor.empty()) return 0.0;
  const Knots knots{scatter.first_knot, scatter.knot_step, static_cast<int>(scatter.factor.size()) - 3};
  Values sum(scatter.factor.size(), 0.0);
  Row b;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const int cell = knots.basis(s[i], 0, b);
    for (int p = 0; p < 4; ++p) sum[at(cell + p)] += weights[i] * b[at(p)];
  }
  return std::sqrt(Band(scatter.factor).inverse_square(std::move(sum)));
}

std::vector<double> deviations(const ProfileScatter& scatter) {
  std::vector<double> out;
  const double one = 1.0;
  for (std::size_t i = 0; i < scatter.s.size(); ++i) {
    out.push_back(deviation_of_sum(scatter, {&scatter.s[i], 1}, {&one, 1}));
    for (const std::vector<double>& other : scatter.others) out.back() = std::hypot(out.back(), other[i]);
    for (const std::size_t k : {i - 1, i})  // beside the first point there is none before it
      if (k < scatter.between.size()) out.back() = std::max(out.back(), scatter.between[k]);
  }
  return out;
}

}  // namespace treadmark::measured
