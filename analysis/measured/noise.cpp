// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>

#include "treadmark/core/median.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measured {

namespace {

constexpr std::size_t kFewest = 8;
constexpr double kUniform = 0.28867513459481287;  // standard deviation of what rounding to 1 takes away

/// Where a profile runs nearer to y than to z, or elsewhere.
enum class Part { all, flat, steep };

/// Standard deviation across the profile, from divided differences of an order over every stride-th point. They vanish
/// for polynomials of a lower degree, and their weights say what noise makes of them.
double difference_noise(const Profile& p, const std::vector<double>& s, std::size_t order, std::size_t stride,
                        Part part) {
  constexpr double kNormal = 0.6744897501960817;  // median of the size of a standard normal number
  std::vector<double> sizes;
  const std::size_t reach = order * stride;
  for (std::size_t i = 0; i + reach < s.size(); ++i) {
    const double whole = s[i + reach] - s[i];
    double y = 0.0, z = 0.0, squares = 0.0;
    for (std::size_t j = i; j <= i + reach; j += stride) {
      double weight = 1.0;
      for (std::size_t k = i; k <= i + reach; k += stride)
        if (k != j) weight /= (s[j] - s[k]) / whole;
      y += weight * p.y[j];
      z += weight * p.z[j];
      squares += weight * weight;
    }
    const double ty = p.y[i + reach] - p.y[i], tz = p.z[i + reach] - p.z[i];
    const double length = std::hypot(ty, tz);
    if (part != Part::all && (part == Part::flat) != (std::fabs(ty) > std::fabs(tz))) continue;
    if (length > 0.0 && std::isfinite(squares) && std::isfinite(y) && std::isfinite(z))
      sizes.push_back(std::fabs(z * ty - y * tz) / (length * std::sqrt(squares)));
  }
  return sizes.size() < kFewest / 2 ? std::numeric_limits<double>::infinity() : median_of(sizes) / kNormal;
}

double least_noise(const Profile& p, const std::vector<double>& s, std::size_t highest, std::size_t stride,
                   Part part = Part::all) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t order = 3; order <= highest; ++order)
    least = std::min(least, difference_noise(p, s, order, stride, part));
  return std::isfinite(least) ? least : 0.0;
}

/// The largest usual step of which all numbers are multiples, but for a common remainder. 0: none, or the numbers are
/// equal steps themselves.
double rounding_of(const std::vector<double>& values) {
  constexpr double kExact = 1e-4, kMostEqual = 0.6;
  constexpr double kDigits[] = {5.0, 2.0, 1.0}, kInch[] = {25.4e-6, 12.7e-6, 2.54e-6};
  std::vector<double> steps;
  for (double power = 1e-3; power > 0.5e-9; power *= 0.1)
    for (const double digit : kDigits) steps.push_back(0.1 * power * digit);
  steps.insert(steps.end(), std::begin(kInch), std::end(kInch));
  std::sort(steps.rbegin(), steps.rend());
  const auto fits = [&values](double step) {
    return ranges::all_of(values, [&](double v) {
      const double multiples = (v - values.front()) / step;
      return std::fabs(multiples - std::round(multiples)) < kExact + 1e-12 / step;
    });
  };
  const auto step = ranges::find_if(steps, fits);
  if (step == steps.end()) return 0.0;
  std::map<long long, std::size_t> increments;
  for (std::size_t i = 1; i < values.size(); ++i)
    ++increments[to_whole<long long>(std::round((values[i] - values[i - 1]) / *step))];
  const auto usual = ranges::max_element(increments, {}, [](const auto& entry) { return entry.second; });
  const bool gauge =
      usual->first != 0 && static_cast<double>(usual->second) > kMostEqual * static_cast<double>(values.size() - 1);
  return gauge ? 0.0 : *step;
}

}  // namespace

std::vector<double> rough_arc_length(const Profile& p) {
  constexpr double kSpan = 1e-3;  // [m] more than any noise
  const std::size_t n = p.y.size();
  std::vector<double> s(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) {
    std::size_t from = i - 1, to = i;
    const auto chord = [&] { return std::hypot(p.y[to] - p.y[from], p.z[to] - p.z[from]); };
    while (from > 0 && to + 1 < n && chord() < kSpan) --from, ++to;
    while (from > 0 && chord() < kSpan) --from;
    while (to + 1 < n && chord() < kSpan) ++to;
    const double along = (p.y[i] - p.y[i - 1]) * (p.y[to] - p.y[from]) + (p.z[i] - p.z[i - 1]) * (p.z[to] - p.z[from]);
    const double length = chord();
    s[i] = s[i - 1] + (length > 0.0 ? std::max(0.0, along / length) : 0.0);
  }
  return s;
}

PointNoise profile_noise(const Profile& p) {
  constexpr std::size_t kHighest = 7, kHighestFar = 4, kFewestFar = 24;
  constexpr double kTrace = 0.3;  // of what rounding makes: less, and the numbers are exact
  PointNoise noise;
  const std::size_t n = p.y.size();
  if (n < kFewest) return noise;
  const std::vector<double> s = rough_arc_length(p);
  std::vector<double> steps;
  for (std::size_t i = 1; i < n; ++i) steps.push_back(s[i] - s[i - 1]);
  noise.step = median_of(steps);
  noise.across = least_noise(p, s, kHighest, 1);
  noise.flat = least_noise(p, s, kHighest, 1, Part::flat);
  noise.steep = least_noise(p, s, kHighest, 1, Part::steep);
  noise.rounding_y = rounding_of(p.y);
  noise.rounding_z = rounding_of(p.z);
  const double rounded = kUniform * std::max(noise.rounding_y, noise.rounding_z);
  if (rounded == 0.0) return noise;
  // where rounded numbers repeat, their differences tell nothing: farther points do
  double far = noise.across;
  for (std::size_t stride = 2; n / stride >= kFewestFar; stride *= 2)
    far = std::max(far, least_noise(p, s, kHighestFar, stride));
  if (far < kTrace * rounded)
    noise.rounding_y = noise.rounding_z = 0.0;
  else
    noise.across = std::max(noise.across, rounded);
  return noise;
}

}  // namespace treadmark::measured
