// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::io::profiles {
namespace {

/// Fewer points are a sketch, in which a corner cannot be told from a spike.
constexpr std::size_t kFewestToJudge = 10;

double distance(const RawPoints& p, std::size_t i, std::size_t k) {
  return std::hypot(p.y[k] - p.y[i], p.z[k] - p.z[i]);
}

/// Of the point (y, z) from the straight line between the points i and k.
double distance_to_chord(const RawPoints& p, std::size_t i, std::size_t k, double y, double z) {
  const double dy = p.y[k] - p.y[i], dz = p.z[k] - p.z[i];
  const double square = dy * dy + dz * dz;
  const double t = square > 0.0 ? std::clamp(((y - p.y[i]) * dy + (z - p.z[i]) * dz) / square, 0.0, 1.0) : 0.0;
  return std::hypot(y - p.y[i] - t * dy, z - p.z[i] - t * dz);
}

/// Numbers that instruments write for "nothing measured" among values of one coordinate: far from all others, and
/// nothing but nines (-99.999), a power of two or the number before it (-32768), or beyond all bodies.
class VoidMarks {
 public:
  explicit VoidMarks(std::vector<double> values) {
    std::vector<double> others;
    ranges::copy_if(values, std::back_inserter(others), [](double v) { return !is_mark(std::fabs(v)); });
    if (!others.empty()) values = std::move(others);
    ranges::sort(values);
    const auto at = [&](double share) {
      return values[to_whole<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    middle_ = at(0.5);
    spread_ = at(0.75) - at(0.25);
  }
  bool hold(double value) const {
    constexpr double kFar = 4.0;
    return std::fabs(value - middle_) > kFar * spread_ && is_mark(std::fabs(value));
  }

 private:
  static bool is_mark(double size) {
    constexpr double kHuge = 1e9;
    return size >= kHuge || is_power(size) || is_nines(size);
  }
  static bool is_nines(double size) {
    constexpr double kFewestNines = 0.998;  // of the next power of ten; most numbers need not be written out
    double power = 10.0;
    while (power <= size) power *= 10.0;
    if (size < kFewestNines * power) return false;
    const std::string digits = fmt::format("{:.10g}", size);
    const auto nines = ranges::count(digits, '9');
    // thousands of an instrument that counts in quarters
    return size == 999.25 ||
           (nines >= 3 && nines + ranges::count(digits, '.') == static_cast<std::ptrdiff_t>(digits.size()));
  }
  static bool is_power(double size) {
    constexpr double kLeast = 16384.0, kMost = 4294967296.0;
    if (!(size >= kLeast && size <= kMost) || size != std::floor(size)) return false;
    const auto whole = to_whole<std::uint64_t>(size);
    return (whole & (whole - 1)) == 0 || (whole & (whole + 1)) == 0;
  }

  double middle_ = 0.0, spread_ = 0.0;
};

template <class IsOut>
void remove(RawPoints& p, const IsOut& is_out, const char* what, std::vector<std::string>& notes) {
  constexpr double kMostOfAll = 0.3;
  RawPoints kept;
  kept.file = p.file;
  int first = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!is_out(i))
      kept.add(p.y[i], p.z[i], p.line[i]);
    else if (first == 0)
      first = p.line[i];
  const std::size_t removed = p.size() - kept.size();
  if (removed == 0) return;
  // at both ends an instrument may look beside the profile for as long as it likes
  std::size_t before = 0, behind = 0;
  while (before < p.size() && is_out(before)) ++before;
  while (behind + before < p.size() && is_out(p.size() - 1 - behind)) ++behind;
  const std::size_t within = removed - std::min(removed, before + behind);
  if (static_cast<double>(within) > kMostOfAll * static_cast<double>(kept.size() + within) || kept.size() == 0)
    throw Error(ErrorKind::input_data, fmt::format("{} of {} points are {}", removed, p.size(), what),
                {p.file, first, 0}, "measure again, or remove them");
  notes.push_back(fmt::format("{} point{} removed, {} (line {}{})", removed, removed == 1 ? " was" : "s were", what,
                              first, removed == 1 ? "" : " and on"));
  p = std::move(kept);
}

/// Points at exactly 0 0 that lie beside the line through their neighbours.
std::vector<bool> zeros_beside(const RawPoints& p) {
  constexpr double kSteps = 3.0, kShare = 0.005;  // of the usual step, of the size of the profile
  std::vector<bool> out(p.size(), false);
  const auto is_zero = [&](std::size_t i) { return p.y[i] == 0.0 && p.z[i] == 0.0; };
  RawPoints other;
  std::vector<std::size_t> at;  // of the zeros: how many others stand before
  for (std::size_t i = 0; i < p.size(); ++i)
    if (is_zero(i))
      at.push_back(other.size());
    else
      other.add(p.y[i], p.z[i], p.line[i]);
  if (at.empty() || other.size() < kFewestToJudge) return out;
  std::vector<double> steps;
  for (std::size_t i = 1; i < other.size(); ++i) steps.push_back(distance(other, i - 1, i));
  const auto [y0, y1] = std::minmax_element(other.y.begin(), other.y.end());
  const auto [z0, z1] = std::minmax_element(other.z.begin(), other.z.end());
  const double far = std::max(kSteps * median(steps), kShare * std::max(*y1 - *y0, *z1 - *z0));
  std::size_t k = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_zero(i)) continue;
    const std::size_t next = std::min(at[k], other.size() - 1), before = at[k] == 0 ? 0 : at[k] - 1;
    ++k;
    out[i] = distance_to_chord(other, before, next, 0.0, 0.0) > far;
  }
  return out;
}

/// The profile jumps away and back again within a few points.
void refuse_spikes(const RawPoints& p) {
  constexpr std::size_t kMostPoints = 4;
  constexpr double kHighest_mm = 1.0;  // what dirt and burrs reach
  constexpr double kWidest_mm = 10.0;  // a flange is thicker
  constexpr double kJump = 0.5;        // of the height, in one step
  constexpr double kSharp = 0.7;       // height over width: sharper than the edge of a rim
  constexpr double kNarrow_mm = 4.0;   // the tip of a coarse flange is wider
  for (std::size_t i = 0; i + 2 < p.size(); ++i)
    for (std::size_t k = i + 2; k <= std::min(i + kMostPoints + 1, p.size() - 1); ++k) {
      const double width = distance(p, i, k);
      if (width > kWidest_mm) continue;
      double height = 0.0;
      std::size_t top = i;
      for (std::size_t j = i + 1; j < k; ++j)
        if (const double d = distance_to_chord(p, i, k, p.y[j], p.z[j]); d > height) height = d, top = j;
      if (height < std::max(kHighest_mm, (width < kNarrow_mm ? kSharp : 1.0) * width)) continue;
      if (distance(p, i, i + 1) < kJump * height || distance(p, k - 1, k) < kJump * height) continue;
      throw Error(ErrorKind::input_data,
                  fmt::format("a spike of {:.3g} mm at y = {:.4g} mm, z = {:.4g} mm", height, p.y[top], p.z[top]),
                  {p.file, p.line[top], 0}, "remove the point, or measure again");
    }
}

/// A jump back to where the profile began, and another profile from there on.
void refuse_second_profile(const RawPoints& p) {
  constexpr double kJump_mm = 15.0, kOverlap = 0.6;
  std::vector<double> low(p.size()), high(p.size());  // of y from here to the end
  for (std::size_t i = p.size(); i-- > 0;) {
    low[i] = i + 1 < p.size() ? std::min(p.y[i], low[i + 1]) : p.y[i];
    high[i] = i + 1 < p.size() ? std::max(p.y[i], high[i + 1]) : p.y[i];
  }
  double from = p.y[0], to = p.y[0];
  for (std::size_t i = 0; i + kFewestToJudge < p.size(); ++i) {
    from = std::min(from, p.y[i]);
    to = std::max(to, p.y[i]);
    if (i + 1 < kFewestToJudge || distance(p, i, i + 1) < kJump_mm) continue;
    const double common = std::min(to, high[i + 1]) - std::max(from, low[i + 1]);
    if (common < kOverlap * std::min(to - from, high[i + 1] - low[i + 1]) || common < kJump_mm) continue;
    throw Error(ErrorKind::input_data,
                fmt::format("a second profile begins here: the points jump by {:.3g} mm, back over the first",
                            distance(p, i, i + 1)),
                {p.file, p.line[i + 1], 0}, "keep one profile in a file");
  }
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void remove_drop_outs(RawPoints& p, std::vector<std::string>& notes) {
  if (p.size() < kFewestToJudge) return;
  const VoidMarks in_y(p.y), in_z(p.z);
  remove(
      p, [&](std::size_t i) { return in_y.hold(p.y[i]) || in_z.hold(p.z[i]); }, "marks of nothing measured", notes);
  const std::vector<bool> zeros = zeros_beside(p);
  remove(
      p, [&](std::size_t i) { return zeros[i]; }, "drop-outs at 0 0", notes);
}

bool seem_exchanged(const std::vector<double>& y, const std::vector<double>& z) {
  constexpr double kOneWay = 1.1, kToAndFro = 1.3;  // way over range
  const auto way_and_range = [](const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    double way = 0.0;
    for (std::size_t i = 1; i < values.size(); ++i) way += std::fabs(values[i] - values[i - 1]);
    return std::pair{way, *high - *low};
  };
  if (y.size() < kFewestToJudge) return false;
  const auto [way_y, range_y] = way_and_range(y);
  const auto [way_z, range_z] = way_and_range(z);
  return range_z > range_y && way_z < kOneWay * range_z && way_y > kToAndFro * range_y;
}

void refuse_faults(const RawPoints& points) {
  if (points.size() < kFewestToJudge) return;
  refuse_second_profile(points);
  refuse_spikes(points);
}

}  // namespace treadmark::io::profiles
