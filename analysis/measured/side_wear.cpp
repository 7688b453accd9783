// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/side_wear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/rail_head.hpp"

namespace treadmark::measured {
namespace {

constexpr double kGaugeDepth = 14e-3, kLost = 1e-3;        ///< [m]
constexpr std::size_t kSideFrom = 14, kSideTo = 34;        ///< of depths below the top [kHalfStep]
constexpr std::size_t kFewestDepths = 10, kDeepest = 100;  ///< [1], [kHalfStep]

/// y over the depth below the top of a head, where a section first comes to it on its way down; NaN: nowhere.
struct Sides {
  double top = 0.0;  ///< z of it [m]
  std::vector<double> low, high;
};

std::optional<Sides> sides_of(const Profile& p) {
  const std::optional<RailHead> head = head_of_rail(p.y, p.z, kGaugeDepth);
  if (!head) return std::nullopt;
  Sides out{head->z_top, std::vector<double>(kDeepest, kNaN), std::vector<double>(kDeepest, kNaN)};
  const auto go_down = [&](std::vector<double>& side, bool back) {
    std::size_t next = 1;
    for (std::size_t i = head->top; back ? i > 0 : i + 1 < p.y.size(); i = back ? i - 1 : i + 1) {
      const std::size_t to = back ? i - 1 : i + 1;
      const double above = p.z[i] - out.top, below = p.z[to] - out.top;
      for (; next < kDeepest && kHalfStep * static_cast<double>(next) <= below; ++next) {
        const double t = (kHalfStep * static_cast<double>(next) - above) / (below - above);
        side[next] = p.y[i] + t * (p.y[to] - p.y[i]);
      }
    }
  };
  go_down(out.low, true), go_down(out.high, false);
  return out;
}

/// Least squares line over depths, and what is left beside it.
struct DepthLine {
  std::size_t count = 0;
  double at_top = 0.0, slope = 0.0, rms = 0.0;
};

/// value: of a depth [kHalfStep]; NaN does not count.
template <class Value>
DepthLine line_over(std::size_t from, std::size_t to, Value value) {
  double n = 0.0, st = 0.0, sv = 0.0, stt = 0.0, stv = 0.0, svv = 0.0;
  for (std::size_t k = from; k < to; ++k) {
    const double t = kHalfStep * static_cast<double>(k), v = value(k);
    if (std::isnan(v)) continue;
    n += 1.0, st += t, sv += v, stt += t * t, stv += t * v, svv += v * v;
  }
  DepthLine line{to_whole<std::size_t>(n), 0.0, 0.0, 0.0};
  const double square = n * stt - st * st;
  if (!(square > 0.0)) return line;
  line.slope = (n * stv - st * sv) / square;
  line.at_top = (sv - line.slope * st) / n;
  line.rms = std::sqrt(std::max(0.0, (svv - line.at_top * sv - line.slope * stv) / n));
  return line;
}

/// By how much more the side of great y has lost; nothing without a web.
std::optional<double> lost_from_web(const Sides& s) {
  constexpr std::size_t kWebFrom = 45, kLeastWeb = 20;
  constexpr double kWidestWeb = 45e-3, kStraight = 0.3e-3;
  const DepthLine middle = line_over(kWebFrom, kDeepest, [&](std::size_t k) {
    return s.high[k] - s.low[k] < kWidestWeb ? 0.5 * (s.low[k] + s.high[k]) : kNaN;
  });
  if (middle.count < kLeastWeb || middle.rms > kStraight) return std::nullopt;
  double sum = 0.0, count = 0.0;
  for (std::size_t k = kSideFrom; k < kSideTo; ++k) {
    const double at = middle.at_top + middle.slope * kHalfStep * static_cast<double>(k);
    if (const double more = 2.0 * at - s.low[k] - s.high[k]; !std::isnan(more)) sum += more, count += 1.0;
  }
  if (count < static_cast<double>(kFewestDepths)) return std::nullopt;
  return sum / count;
}

/// A side of 1:20 on a rail that is rolled by 1:18 at most against one that is steeper than that.
std::optional<std::string> inclined_face(const Sides& s) {
  constexpr std::size_t kFaceFrom = 12, kFaceTo = 27;
  constexpr double kLeastUnworn = -0.02, kMostUnworn = 0.11, kWornFace = 0.155, kDegree = kPi / 180.0;
  const DepthLine low = line_over(kFaceFrom, kFaceTo, [&](std::size_t k) { return -s.low[k]; }),
                  high = line_over(kFaceFrom, kFaceTo, [&](std::size_t k) { return s.high[k]; });
  if (low.count < kFewestDepths || high.count < kFewestDepths) return std::nullopt;
  if (low.slope < kLeastUnworn || low.slope > kMostUnworn || high.slope < kWornFace) return std::nullopt;
  return fmt::format(
      "12 to 26 mm below the top the side of great y leans by {:.0f} degrees, as a worn gauge face does, and that of "
      "small y by {:.0f}",
      std::atan(high.slope) / kDegree, std::atan(low.slope) / kDegree);
}

double half_at(const NominalOutline& nominal, double z) {
  const double t = z / kHalfStep;
  if (!(t >= 0.0) || t + 1.0 >= static_cast<double>(nominal.half.size())) return kNaN;
  const auto k = to_whole<std::size_t>(std::floor(t));
  return nominal.half[k] + (t - std::floor(t)) * (nominal.half[k + 1] - nominal.half[k]);
}

/// A rail that lies with its worn top below that of a nominal one, and with its side of small y upon that one's.
std::optional<std::string> lost_in_its_axes(const Sides& s, std::span<const NominalOutline> nominals) {
  constexpr double kLeastTop = 0.2e-3, kMostTop = 20e-3, kUpon = 0.3e-3, kAlike = 0.15e-3;
  if (s.top < kLeastTop || s.top > kMostTop) return std::nullopt;
  // a symmetric head lies aside of those axes, whatever it coincides with
  const DepthLine skew = line_over(2, kSideTo, [&](std::size_t k) { return s.low[k] + s.high[k]; });
  if (skew.rms < kAlike) return std::nullopt;
  for (const NominalOutline& nominal : nominals) {
    const auto beside = [&](const std::vector<double>& side, double sign) {
      return line_over(kSideFrom, kSideTo, [&, sign](std::size_t k) {
        return half_at(nominal, s.top + kHalfStep * static_cast<double>(k)) - sign * side[k];
      });
    };
    const auto mean = [](const DepthLine& line) {
      constexpr double kMiddle = 0.5 * kHalfStep * static_cast<double>(kSideFrom + kSideTo);
      return line.at_top + line.slope * kMiddle;
    };
    const DepthLine low = beside(s.low, -1.0), high = beside(s.high, 1.0);
    if (low.count < kFewestDepths || high.count < kFewestDepths) continue;
    if (std::fabs(mean(low)) < kUpon && std::fabs(low.slope) < kUpon / kGaugeDepth && low.rms < kAlike &&
        mean(high) > kLost)
      return fmt::format("as it lies the side of small y is that of {}, and that of great y has lost {:.2g} mm",
                         nominal.name, kMilli * mean(high));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> worn_at_great_y(const Profile& rail, std::span<const NominalOutline> nominals) {
  const std::optional<Sides> sides = sides_of(rail);
  if (!sides) return std::nullopt;
  if (const std::optional<double> more = lost_from_web(*sides)) {
    constexpr double kSome = 0.2e-3;  // of a face that leans, most is lost where it is not looked at
    if (*more < kSome) return std::nullopt;
    if (*more < kLost) return inclined_face(*sides);
    return fmt::format("from the middle of its web the side of great y has lost {:.2g} mm more than that of small y",
                       kMilli * *more);
  }
  if (std::optional<std::string> face = inclined_face(*sides)) return face;
  return lost_in_its_axes(*sides, nominals);
}

}  // namespace treadmark::measured
