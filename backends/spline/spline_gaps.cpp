// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/spline_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/spline/given_spline.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {
namespace {

constexpr double kMeeting = 1e-3, kWorthSaying = 1e-6, kTooFar = 0.1e-3;  // [m]

// A border of a surface.
class Side {
 public:
  Side(const GivenSpline& of, int side) : of_(&of), side_(side) {
    const std::vector<double>& breaks = of.breaks(along());
    constexpr int kSteps = 8;  // of an interval
    constexpr std::size_t kMostIntervals = 500;
    const std::size_t stride = (breaks.size() - 2) / kMostIntervals + 1;
    at_.reserve(kSteps * breaks.size() + 1);
    for (std::size_t i = 0; i + 1 < breaks.size(); i += stride) {
      const double to = breaks[std::min(i + stride, breaks.size() - 1)];
      for (int step = 0; step < kSteps; ++step) at_.push_back(breaks[i] + (to - breaks[i]) * step / kSteps);
    }
    at_.push_back(breaks.back());
    points_.reserve(at_.size());
    for (const double x : at_) points_.push_back(point(x));
  }

  const Vec3& first() const { return points_.front(); }
  const Vec3& last() const { return points_.back(); }
  const std::vector<Vec3>& points() const { return points_; }
  std::string name() const { return fmt::format("side {} of {}", side_, of_->name()); }

  double distance(const Vec3& p) const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < points_.size(); ++i)
      if ((points_[i] - p).squaredNorm() < (points_[nearest] - p).squaredNorm()) nearest = i;
    // by golden section between its neighbours (Kiefer 1953)
    double low = at_[nearest > 0 ? nearest - 1 : 0], high = at_[std::min(nearest + 1, at_.size() - 1)];
    constexpr double kGolden = 0.6180339887498949;
    double least = (points_[nearest] - p).norm();
    for (int i = 0; i < 40; ++i) {
      const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
      const double at_a = (point(a) - p).norm(), at_b = (point(b) - p).norm();
      least = std::min({least, at_a, at_b});
      (at_a < at_b ? high : low) = at_a < at_b ? b : a;
    }
    return least;
  }

 private:
  int along() const { return side_ <= 2 ? 1 : 0; }
  Vec3 point(double x) const {
    const std::vector<double>& across = of_->breaks(1 - along());
    const double fixed = side_ % 2 == 1 ? across.front() : across.back();
    return along() == 1 ? of_->point(fixed, x) : of_->point(x, fixed);
  }

  const GivenSpline* of_;
  int side_;
  std::vector<double> at_;
  std::vector<Vec3> points_;
};

// The greatest distance of a point of one from the other.
double apart(const Side& a, const Side& b) {
  double most = 0.0;
  for (const Vec3& p : a.points()) most = std::max(most, b.distance(p));
  for (const Vec3& p : b.points()) most = std::max(most, a.distance(p));
  return most;
}

bool near(const Vec3& p, const Vec3& q) { return (p - q).norm() < kMeeting; }

bool ends_meet(const Side& a, const Side& b) {
  return (near(a.first(), b.first()) && near(a.last(), b.last())) ||
         (near(a.first(), b.last()) && near(a.last(), b.first()));
}

std::string length(double metres) {
  return metres < 1e-3 ? fmt::format("{:.3g} um", 1e6 * metres) : fmt::format("{:.3g} mm", 1e3 * metres);
}

}  // namespace

std::string spline_gaps(std::span<const SplineSurface> surfaces, std::span<const SplineInterface> interfaces,
                        std::vector<SplineInterface>* met) {
  std::vector<GivenSpline> given;
  given.reserve(surfaces.size());
  for (const SplineSurface& s : surfaces) given.emplace_back(s);
  std::vector<Side> sides;
  std::vector<double> extent;
  sides.reserve(4 * given.size());
  extent.reserve(given.size());
  for (const GivenSpline& g : given) {
    check_cancelled();
    Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
    for (int side = 1; side <= 4; ++side) {
      sides.emplace_back(g, side);
      for (const Vec3& p : sides.back().points()) low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
    extent.push_back((high - low).norm());
  }
  const auto place = [](std::size_t surface, int side) { return 4 * surface + static_cast<std::size_t>(side) - 1; };
  std::string out;
  std::set<std::size_t> meeting, joined;
  const auto say = [&](std::size_t a, std::size_t b, double gap) {
    meeting.insert({a / 4, b / 4});
    if (gap > kWorthSaying)
      out += fmt::format("a gap of {} between {} and {}. ", length(gap), sides[a].name(), sides[b].name());
    if (met == nullptr || a / 4 == b / 4 || gap > kTooFar || joined.contains(a) || joined.contains(b)) return;
    joined.insert({a, b});
    const auto side = [](std::size_t at) { return static_cast<int>(at % 4) + 1; };
    SplineInterface& i = met->emplace_back();
    i.first = a / 4, i.first_side = side(a), i.second = b / 4, i.second_side = side(b);
    i.reversed = !near(sides[a].first(), sides[b].first());
  };
  std::set<std::pair<std::size_t, std::size_t>> looked_at;
  for (const SplineInterface& i : interfaces) {
    check_cancelled();
    const std::size_t a = place(i.first, i.first_side), b = place(i.second, i.second_side);
    looked_at.insert(std::minmax(a, b));
    const double gap = apart(sides[a], sides[b]);
    if (gap > kTooFar)
      throw Error(
          ErrorKind::input_data,
          fmt::format("{} and {} are said to meet, but are {} apart", sides[a].name(), sides[b].name(), length(gap)),
          i.where, "at most 0.1 mm is taken for a gap: leave out the interface if it is none");
    say(a, b, gap);
  }
  // those whose ends meet have middles of the two ends near each other
  std::map<std::array<std::int64_t, 3>, std::vector<std::size_t>> by_middle;
  const auto cell = [](const Vec3& p) {
    const auto of = [](double x) { return to_whole<std::int64_t>(std::floor(std::clamp(x / kMeeting, -1e15, 1e15))); };
    return std::array<std::int64_t, 3>{of(p.x()), of(p.y()), of(p.z())};
  };
  constexpr std::size_t kMostPairs = 8;  // of a side; two meet where a surface ends
  std::size_t compared = 0;
  for (std::size_t b = 0; b < sides.size(); ++b) {
    check_cancelled();
    const auto at = cell(0.5 * (sides[b].first() + sides[b].last()));
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dz = -1; dz <= 1; ++dz) {
          const auto found = by_middle.find({at[0] + dx, at[1] + dy, at[2] + dz});
          if (found == by_middle.end()) continue;
          for (const std::size_t a : found->second) {
            // sides of one surface meet at the seam of a wheel; those of a narrow one are only near
            constexpr double kNarrow = 20.0 * kMeeting;
            if (a / 4 == b / 4 && extent[a / 4] < kNarrow) continue;
            if (looked_at.count(std::minmax(a, b)) > 0 || !ends_meet(sides[a], sides[b])) continue;
            if (++compared > kMostPairs * sides.size())
              throw Error(ErrorKind::input_data, fmt::format("too many sides lie on {}", sides[a].name()),
                          surfaces[a / 4].where, "is the same surface given several times?");
            const double gap = apart(sides[a], sides[b]);
            if (gap < kMeeting) say(a, b, gap);
          }
        }
    by_middle[at].push_back(b);
  }
  if (surfaces.size() > 1)
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      if (meeting.count(s) == 0) out += fmt::format("{} meets no other surface side by side. ", surfaces[s].name);
  return out;
}

}  // namespace treadmark::spline
