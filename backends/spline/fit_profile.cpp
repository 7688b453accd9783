// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/spline/fit_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {

namespace {

// Penalties below these interpolate: 1e-10 in mm^3 (unweighted) and mm^4 (weighted).
constexpr double kTinyPenaltyUnweighted = 1e-19;
constexpr double kTinyPenaltyWeighted = 1e-22;
constexpr double kKinkWeight = 100.0;       // corners hardly move
constexpr double kEndWeight = 20.0;         // nor do the ends in the weighted cubic method
constexpr double kLeastKnotSpacing = 1e-6;  // [m]

std::vector<double> interval_weights(const std::vector<double>& s, double end_factor) {
  const std::size_t n = s.size();
  std::vector<double> weights(n);
  weights[0] = end_factor * (s[1] - s[0]);
  weights[n - 1] = end_factor * (s[n - 1] - s[n - 2]);
  for (std::size_t i = 1; i + 1 < n; ++i) weights[i] = 0.5 * (s[i + 1] - s[i - 1]);
  return weights;
}

}  // namespace

ProfileSpline fit_profile(const Profile& profile) {
  using Method = SmoothingOptions::Method;
  const double strength = profile.smoothing.strength;
  if (!(strength >= 0.0) || !std::isfinite(strength))
    throw Error(ErrorKind::configuration,
                "the smoothing strength of profile '" + profile.name + "' must be 0 or positive");

  const std::vector<double> s = arc_length(profile);
  const std::vector<int> kinks = find_kinks(profile, s);
  const Method method = profile.smoothing.method;
  std::vector<double> weights(s.size(), 1.0);
  if (method == Method::weighted_spline) weights = interval_weights(s, kEndWeight);
  if (method == Method::weighted_bspline) weights = interval_weights(s, 1.0);
  for (std::size_t k = 1; k + 1 < kinks.size(); ++k) weights[static_cast<std::size_t>(kinks[k])] *= kKinkWeight;
  const ProfileData data{s, profile.y, profile.z, kinks, weights};

  // A filter of this penalty halves a sine whose wavelength is the strength.
  const double cutoff = strength / (2.0 * std::numbers::pi);
  switch (method) {
    case Method::by_noise:  // the points have been smoothed where they were read
    case Method::spline:
      return fit_cubic_smoothing(data, strength <= kTinyPenaltyUnweighted ? 0.0 : strength);
    case Method::weighted_spline: {
      const double lambda = std::pow(cutoff, 4);
      return fit_cubic_smoothing(data, lambda <= kTinyPenaltyWeighted ? 0.0 : lambda);
    }
    case Method::weighted_bspline:
      return fit_bspline_smoothing(data, std::pow(cutoff, 6), std::max(kLeastKnotSpacing, 0.25 * strength));
  }
  throw Error(ErrorKind::configuration, "unknown smoothing method");
}

namespace {

// Interior knots of one section between corners (points first .. last).
void add_section_knots(const ProfileData& data, int first, int last, double lambda, double spacing,
                       std::vector<double>& knots) {
  const auto position = [&data](int i) { return data.s[static_cast<std::size_t>(i)]; };
  const double begin = position(first), length = position(last) - begin;
  if (last - first < 2) return;
  if (lambda >= kTinyBsplinePenalty) {
    const int intervals = std::max(1, to_whole<int>(std::round(length / spacing)));
    for (int i = 1; i < intervals; ++i) knots.push_back(begin + length * i / intervals);
    return;
  }
  // Without much of a penalty every coefficient needs data of its own (Schoenberg and Whitney 1953).
  const double least = std::pow(20.0 * lambda * 1e-6, 1.0 / 6.0);
  double previous = begin;
  for (int i = first + 2; i <= last - 2; ++i)
    if (position(i) - previous >= least) knots.push_back(previous = position(i));
}

std::vector<double> knot_sequence(const ProfileData& data, double lambda, double spacing) {
  std::vector<double> knots(4, data.s.front());
  for (std::size_t k = 0; k + 1 < data.kinks.size(); ++k) {
    add_section_knots(data, data.kinks[k], data.kinks[k + 1], lambda, spacing, knots);
    const bool at_end = k + 2 == data.kinks.size();
    knots.insert(knots.end(), at_end ? 4 : 3, data.s[static_cast<std::size_t>(data.kinks[k + 1])]);
  }
  return knots;
}

struct Observation {
  double s, y, z, weight;
};

// A section of two points only gets two more on its chord, which makes it straight.
std::vector<Observation> observations(const ProfileData& data) {
  std::vector<Observation> all;
  for (std::size_t i = 0; i < data.s.size(); ++i) all.push_back({data.s[i], data.y[i], data.z[i], data.weights[i]});
  for (std::size_t k = 0; k + 1 < data.kinks.size(); ++k) {
    if (data.kinks[k + 1] - data.kinks[k] != 1) continue;
    const Observation a = all[static_cast<std::size_t>(data.kinks[k])],
                      b = all[static_cast<std::size_t>(data.kinks[k]) + 1];
    for (const double f : {1.0 / 3.0, 2.0 / 3.0})
      all.push_back({a.s + f * (b.s - a.s), a.y + f * (b.y - a.y), a.z + f * (b.z - a.z), 0.5 * (a.weight + b.weight)});
  }
  return all;
}

}  // namespace

ProfileSpline fit_bspline_smoothing(const ProfileData& data, double lambda, double knot_spacing) {
  const std::vector<double> knots = knot_sequence(data, lambda, knot_spacing);
  const int size = static_cast<int>(knots.size()) - 4;
  BandedCholesky matrix(size, 3);
  std::vector<double> y(static_cast<std::size_t>(size), 0.0), z(y);

  // Least squares.
  for (const Observation& o : observations(data)) {
    int span = find_span(knots, o.s, 3, size - 1);
    const BasisPowers basis = basis_powers(knots, span);
    const double t = o.s - knots[static_cast<std::size_t>(span)];
    for (int a = 0; a < 4; ++a) {
      const double value = power_value(basis[static_cast<std::size_t>(a)], t);
      const int row = span - 3 + a;
      y[static_cast<std::size_t>(row)] += o.weight * value * o.y;
      z[static_cast<std::size_t>(row)] += o.weight * value * o.z;
      for (int b = 0; b <= a; ++b)
        matrix.at(row, span - 3 + b) += o.weight * value * power_value(basis[static_cast<std::size_t>(b)], t);
    }
  }
  // Penalty: f''' is constant on every knot interval.
  for (int span = 3; span < size; ++span) {
    const double h = knots[static_cast<std::size_t>(span) + 1] - knots[static_cast<std::size_t>(span)];
    if (!(h > 0.0)) continue;
    const BasisPowers basis = basis_powers(knots, span);
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b <= a; ++b)
        matrix.at(span - 3 + static_cast<int>(a), span - 3 + static_cast<int>(b)) +=
            lambda * h * 36.0 * basis[a][3] * basis[b][3];
  }
  matrix.factor();
  matrix.solve(y);
  matrix.solve(z);

  // Piecewise cubics on the knot intervals.
  std::vector<double> breaks{knots.front()};
  std::vector<CubicSegment> segments;
  for (int span = 3; span < size; ++span) {
    const double end = knots[static_cast<std::size_t>(span) + 1];
    if (!(end > knots[static_cast<std::size_t>(span)])) continue;
    const BasisPowers basis = basis_powers(knots, span);
    CubicSegment segment;
    for (std::size_t b = 0; b < 4; ++b)
      for (std::size_t k = 0; k < 4; ++k) {
        segment.y[k] += basis[b][k] * y[static_cast<std::size_t>(span) - 3 + b];
        segment.z[k] += basis[b][k] * z[static_cast<std::size_t>(span) - 3 + b];
      }
    segments.push_back(segment);
    breaks.push_back(end);
  }
  std::vector<double> kinks;
  for (std::size_t k = 1; k + 1 < data.kinks.size(); ++k)
    kinks.push_back(data.s[static_cast<std::size_t>(data.kinks[k])]);
  return ProfileSpline(std::move(breaks), std::move(segments), std::move(kinks));
}

namespace {

// Second differences that start at point i - 1: column of Q for the interior point i (Reinsch 1967).
struct SecondDifference {
  int point;
  double left, middle, right;
};

std::vector<SecondDifference> differences_of_points(const ProfileData& data) {
  std::vector<SecondDifference> columns;
  const int n = static_cast<int>(data.s.size());
  for (int i = 1; i + 1 < n; ++i) {
    // At a corner both second derivatives vanish, so it is no unknown.
    if (std::binary_search(data.kinks.begin(), data.kinks.end(), i)) continue;
    const auto k = static_cast<std::size_t>(i);
    const double before = 1.0 / (data.s[k] - data.s[k - 1]), after = 1.0 / (data.s[k + 1] - data.s[k]);
    columns.push_back({i, before, -before - after, after});
  }
  return columns;
}

double entry(const SecondDifference& column, int point) {
  switch (point - column.point) {
    case -1:
      return column.left;
    case 0:
      return column.middle;
    case 1:
      return column.right;
    default:
      return 0.0;
  }
}

// Matrix R + lambda Q' W^-1 Q of the second derivatives, already factorised.
BandedCholesky curvature_equations(const ProfileData& data, const std::vector<SecondDifference>& q, double lambda) {
  const int m = static_cast<int>(q.size());
  BandedCholesky matrix(m, 2);
  for (int a = 0; a < m; ++a) {
    const auto& qa = q[static_cast<std::size_t>(a)];
    const auto k = static_cast<std::size_t>(qa.point);
    matrix.at(a, a) += (data.s[k + 1] - data.s[k - 1]) / 3.0;
    for (int b = std::max(0, a - 2); b <= a; ++b) {
      const auto& qb = q[static_cast<std::size_t>(b)];
      if (qb.point == qa.point - 1) matrix.at(a, b) += (data.s[k] - data.s[k - 1]) / 6.0;
      double product = 0.0;
      for (int p = qa.point - 1; p <= qa.point + 1; ++p)
        product += entry(qa, p) * entry(qb, p) / data.weights[static_cast<std::size_t>(p)];
      matrix.at(a, b) += lambda * product;
    }
  }
  matrix.factor();
  return matrix;
}

struct FittedValues {
  std::vector<double> value, second;  // at the data positions
};

FittedValues fit(const ProfileData& data, const std::vector<SecondDifference>& q, const BandedCholesky& matrix,
                 double lambda, std::span<const double> f) {
  std::vector<double> g(q.size());
  for (std::size_t a = 0; a < q.size(); ++a) {
    const auto k = static_cast<std::size_t>(q[a].point);
    g[a] = q[a].left * f[k - 1] + q[a].middle * f[k] + q[a].right * f[k + 1];
  }
  matrix.solve(g);
  FittedValues fitted{{f.begin(), f.end()}, std::vector<double>(f.size(), 0.0)};
  for (std::size_t a = 0; a < q.size(); ++a) {
    const auto k = static_cast<std::size_t>(q[a].point);
    fitted.second[k] = g[a];
    fitted.value[k - 1] -= lambda / data.weights[k - 1] * q[a].left * g[a];
    fitted.value[k] -= lambda / data.weights[k] * q[a].middle * g[a];
    fitted.value[k + 1] -= lambda / data.weights[k + 1] * q[a].right * g[a];
  }
  return fitted;
}

void set_cubic(double (&c)[4], const FittedValues& f, std::size_t k, double h) {
  c[0] = f.value[k];
  c[1] = (f.value[k + 1] - f.value[k]) / h - h * (2.0 * f.second[k] + f.second[k + 1]) / 6.0;
  c[2] = 0.5 * f.second[k];
  c[3] = (f.second[k + 1] - f.second[k]) / (6.0 * h);
}

}  // namespace

ProfileSpline fit_cubic_smoothing(const ProfileData& data, double lambda) {
  const auto q = differences_of_points(data);
  const BandedCholesky matrix = curvature_equations(data, q, lambda);
  const FittedValues y = fit(data, q, matrix, lambda, data.y), z = fit(data, q, matrix, lambda, data.z);

  std::vector<CubicSegment> segments(data.s.size() - 1);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const double h = data.s[k + 1] - data.s[k];
    set_cubic(segments[k].y, y, k, h);
    set_cubic(segments[k].z, z, k, h);
  }
  std::vector<double> kinks;
  for (std::size_t k = 1; k + 1 < data.kinks.size(); ++k)
    kinks.push_back(data.s[static_cast<std::size_t>(data.kinks[k])]);
  return ProfileSpline({data.s.begin(), data.s.end()}, std::move(segments), std::move(kinks));
}

namespace {

Error bad_profile(const Profile& profile, const std::string& problem) {
  return Error(ErrorKind::input_data, "the profile '" + profile.name + "' " + problem, {}, "clean the points first");
}

double origin_of_arc_length(const Profile& profile, const std::vector<double>& s) {
  const auto& y = profile.y;
  const bool increasing = std::is_sorted(y.begin(), y.end(), std::less_equal<>());
  const bool decreasing = std::is_sorted(y.begin(), y.end(), std::greater_equal<>());
  if (increasing || decreasing) {
    if (std::min(y.front(), y.back()) > 0.0 || std::max(y.front(), y.back()) < 0.0)
      return std::abs(y.front()) < std::abs(y.back()) ? s.front() : s.back();
    for (std::size_t i = 0; i + 1 < y.size(); ++i)
      if (std::min(y[i], y[i + 1]) <= 0.0 && std::max(y[i], y[i + 1]) >= 0.0)
        return s[i] + (s[i + 1] - s[i]) * (0.0 - y[i]) / (y[i + 1] - y[i]);
  }
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < y.size(); ++i)
    if (std::hypot(y[i], profile.z[i]) < std::hypot(y[nearest], profile.z[nearest])) nearest = i;
  return s[nearest];
}

}  // namespace

std::vector<double> arc_length(const Profile& profile) {
  const std::size_t n = profile.y.size();
  if (n < 2 || profile.z.size() != n) throw bad_profile(profile, "needs at least two points with y and z each");
  std::vector<double> s(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) {
    const double chord = std::hypot(profile.y[i] - profile.y[i - 1], profile.z[i] - profile.z[i - 1]);
    if (!std::isfinite(chord)) throw bad_profile(profile, "has a point that is not a number");
    if (!(chord > 0.0)) throw bad_profile(profile, "has the same point twice, number " + std::to_string(i + 1));
    s[i] = s[i - 1] + chord;
  }
  const double origin = origin_of_arc_length(profile, s);
  for (double& value : s) value -= origin;
  return s;
}

std::vector<int> find_kinks(const Profile& profile, const std::vector<double>& s) {
  const std::size_t n = s.size();
  const SmoothingOptions& options = profile.smoothing;
  std::vector<double> turn(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i)
    turn[i] = std::abs(wrap_angle(std::atan2(profile.z[i + 1] - profile.z[i], profile.y[i + 1] - profile.y[i]) -
                                  std::atan2(profile.z[i] - profile.z[i - 1], profile.y[i] - profile.y[i - 1])));
  const auto stands_alone = [&](std::size_t i) {
    for (std::size_t k = i; k-- > 0 && s[i] - s[k] <= options.kink_width;)
      if (turn[k] > options.kink_low) return false;
    for (std::size_t k = i + 1; k < n && s[k] - s[i] <= options.kink_width; ++k)
      if (turn[k] > options.kink_low) return false;
    return true;
  };
  std::vector<int> kinks{0};
  const auto add = [&kinks](std::size_t i) {
    if (static_cast<int>(i) == kinks.back() + 2) kinks.push_back(static_cast<int>(i) - 1);
    kinks.push_back(static_cast<int>(i));
  };
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (turn[i] > options.kink_high && stands_alone(i)) add(i);
  add(n - 1);
  return kinks;
}

}  // namespace treadmark::spline
