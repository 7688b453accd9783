// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/stability/falling_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kWindowsHeld = 3.0;

/// Integrals of a signal and its square over the distance, from the first instant.
class Integrals {
 public:
  Integrals(const std::vector<double>& x, const std::vector<double>& y) : x_(x), y_(y) {
    sum_.assign(x.size(), 0.0);
    squares_ = sum_;
    for (std::size_t i = 1; i < x.size(); ++i) {
      const double h = x[i] - x[i - 1];
      sum_[i] = sum_[i - 1] + h * mean(y[i - 1], y[i]);
      squares_[i] = squares_[i - 1] + h * mean_square(y[i - 1], y[i]);
    }
  }

  /// Root mean square about the mean between two places.
  double rms(double from, double to) const {
    const auto [a, aa] = up_to(from);
    const auto [b, bb] = up_to(to);
    const double length = to - from, average = (b - a) / length;
    return std::sqrt(std::max(0.0, (bb - aa) / length - average * average));
  }

 private:
  static double mean(double a, double b) { return 0.5 * (a + b); }
  static double mean_square(double a, double b) { return (a * a + a * b + b * b) / 3.0; }

  std::pair<double, double> up_to(double place) const {
    const std::size_t k = piece_at(x_, place);
    const double h = place - x_[k], y = BrokenLine(x_, y_).at(place);
    return {sum_[k] + h * mean(y_[k], y), squares_[k] + h * mean_square(y_[k], y)};
  }

  const std::vector<double>&x_, &y_;
  std::vector<double> sum_, squares_;
};

/// By what the sway changes in a window, by the trend of its logarithm.
double change_in_a_window(std::span<const SwayAt> sway, double window) {
  double distance = 0.0, logarithm = 0.0, squares = 0.0, products = 0.0;
  const auto log_of = [](const SwayAt& at) { return std::log(std::max(at.rms, std::numeric_limits<double>::min())); };
  for (const SwayAt& at : sway) distance += at.distance, logarithm += log_of(at);
  distance /= static_cast<double>(sway.size()), logarithm /= static_cast<double>(sway.size());
  for (const SwayAt& at : sway) {
    squares += (at.distance - distance) * (at.distance - distance);
    products += (at.distance - distance) * (log_of(at) - logarithm);
  }
  return std::exp(products / squares * window);
}

}  // namespace

SpeedProfile profile_of(const FallSettings& s) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::configuration, what); };
  if (!(s.to > 0.0) || !(s.from > s.to) || !std::isfinite(s.from))
    refuse(fmt::format("a speed cannot fall from {:g} to {:g} m/s", s.from, s.to));
  if (!(s.deceleration > 0.0) || !std::isfinite(s.deceleration))
    refuse(fmt::format("a speed does not fall at {:g} m/s2", s.deceleration));
  if (!(s.window > 0.0) || !(s.amplitude > 0.0))
    refuse("the window and the least amplitude of hunting must be positive");
  if (!(s.hold > kWindowsHeld * s.window))
    refuse(
        fmt::format("{:g} m at the first speed are too short: hunting is averaged over {:g} m, and three times that "
                    "must show whether it lasts",
                    s.hold, s.window));
  SpeedProfile profile{{0.0, s.hold / s.from}, {s.from, s.from}};
  profile.time.push_back(profile.time.back() + (s.from - s.to) / s.deceleration);
  profile.speed.push_back(s.to);
  return profile;
}

std::vector<SwayAt> running_sway(const SwayHistory& history, double window) {
  constexpr double kApart = 0.25;
  const std::vector<double>& x = history.distance;
  std::vector<SwayAt> out;
  if (x.size() < 2) return out;
  std::vector<Integrals> wheelsets;
  for (const std::vector<double>& y : history.sway) wheelsets.emplace_back(x, y);
  for (int i = 0;; ++i) {
    const double from = x.front() + kApart * i * window, to = from + window;
    if (!(to <= x.back())) return out;
    SwayAt at;
    at.distance = 0.5 * (from + to);
    at.speed = BrokenLine(x, history.speed).at(at.distance);
    for (const Integrals& one : wheelsets) at.rms = std::max(at.rms, one.rms(from, to));
    out.push_back(at);
  }
}

LastAbove last_above(const std::vector<SwayAt>& sway, double limit) {
  const auto last = ranges::find_if(sway.rbegin(), sway.rend(), [&](const SwayAt& at) { return at.rms > limit; });
  LastAbove out;
  out.never_above = last == sway.rend();
  out.at_end = last == sway.rbegin();
  if (out.never_above || out.at_end) return out;
  const SwayAt &above = *last, &below = *std::prev(last);
  // Decaying, it is a straight line by its logarithm.
  const double least = 1e-12 * limit;
  const double share = std::log(above.rms / limit) / std::log(above.rms / std::max(below.rms, least));
  out.speed = std::lerp(above.speed, below.speed, share);
  return out;
}

FallResult judge_fall(const SwayHistory& history, const FallSettings& s) {
  FallResult out;
  out.sway = running_sway(history, s.window);
  const double limit = s.amplitude / std::sqrt(2.0), end_of_hold = s.hold - 0.5 * s.window;
  std::vector<SwayAt> held;
  for (const SwayAt& at : out.sway)
    if (at.distance <= end_of_hold) held.push_back(at);
  constexpr std::size_t kOneWindow = 4;
  if (held.size() <= kOneWindow) throw Error(ErrorKind::configuration, "the run ends before its speed begins to fall");
  const double now = held.back().rms;
  out.first_amplitude = std::sqrt(2.0) * now;
  // A sway that still dies away is no limit cycle. One window with the one before says nothing: between the flanges a
  // cycle swells and fades by a tenth.
  constexpr double kDyingAway = 0.9;
  const std::span<const SwayAt> later = std::span(held).last(std::max(kOneWindow + 1, held.size() / 2));
  if (!(now > limit) || change_in_a_window(later, s.window) < kDyingAway) return out;
  const LastAbove last = last_above(out.sway, limit);
  out.verdict = last.at_end ? FallVerdict::lasting : FallVerdict::died;
  out.speed = last.speed;
  return out;
}

SlowFall slowest_fall(double fast, double slow) {
  constexpr double kMargin = 1.5;
  return {slow, slow + kMargin * std::max(0.0, slow - fast)};
}

}  // namespace treadmark::vehicle
