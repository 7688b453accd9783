// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/profile_points.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {
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
