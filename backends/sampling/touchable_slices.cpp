// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/touchable_slices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/sampling/lateral_nodes.hpp"
#include "treadmark/backends/sampling/sample_points.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/model/natural_view.hpp"

namespace treadmark::sampling {
namespace {

constexpr double kPerSpacing = 4.0;              // places looked at per spacing
constexpr double kTouchableEndAccuracy = 1e-10;  // [m]

[[noreturn]] void refuse(double x, const char* what) {
  throw Error(ErrorKind::input_data, fmt::format("the section of the rail at x = {:.6g} mm {}", 1e3 * x, what));
}

/// Touchable places of one section.
class Section {
 public:
  Section(const Surface& rail, double x) : rail_(rail), x_(x) {}

  std::vector<bool> touchable(const std::vector<double>& y) const {
    std::vector<double> h(y.size()), slope(y.size());
    section_heights(rail_, Body::rail, x_, y, {h, {}, slope});
    std::vector<bool> yes(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) yes[i] = std::fabs(slope[i]) <= kSteepestTouchable;  // false for NaN
    return yes;
  }

  /// Last touchable place on the way from inside, which is one, to outside, which is not.
  double end(double inside, double outside) const {
    for (int left = kMostHalvings; left > 0 && std::fabs(outside - inside) > kTouchableEndAccuracy; --left) {
      const double middle = 0.5 * (inside + outside);
      (touchable({middle}).front() ? inside : outside) = middle;
    }
    return inside;
  }

 private:
  const Surface& rail_;
  double x_;
};

Profile section_at(const Surface& rail, double x, double low, double high, double spacing) {
  const int n = std::max(32, static_cast<int>(std::ceil((high - low) / spacing * kPerSpacing)));
  std::vector<double> raster(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i <= n; ++i) raster[static_cast<std::size_t>(i)] = low + (high - low) * i / n;
  const Section section(rail, x);
  const std::vector<bool> yes = section.touchable(raster);
  const auto first = static_cast<std::size_t>(std::find(yes.begin(), yes.end(), true) - yes.begin());
  if (first == yes.size()) refuse(x, "is missing or stands upright");
  std::size_t last = yes.size() - 1;
  while (!yes[last]) --last;
  const double from = first == 0 ? raster[0] : section.end(raster[first], raster[first - 1]);
  const double to = last + 1 == yes.size() ? raster[last] : section.end(raster[last], raster[last + 1]);
  const std::array<double, 1> here{x};
  Profile profile;
  profile.y = lateral_nodes(rail, Body::rail, here, spacing, from, to, false);
  profile.z.resize(profile.y.size());
  section_heights(rail, Body::rail, x, profile.y, {profile.z, {}, {}});
  if (std::any_of(profile.z.begin(), profile.z.end(), [](double z) { return std::isnan(z); })) refuse(x, "has a gap");
  return profile;
}

/// Whether the same features are there in two slices.
bool same_parts(const SliceSet& slices, std::size_t a, std::size_t b) {
  const auto missing = [](double s) { return std::isnan(s); };
  return slices.features.empty() || std::ranges::equal(slices.features[a], slices.features[b], {}, missing, missing);
}

}  // namespace

SliceSet thinned_slices(const SliceSet& slices, double apart) {
  SliceSet some = slices;
  some.u.clear(), some.profiles.clear(), some.features.clear();
  const std::size_t n = slices.u.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = i < 2 || i + 2 >= n || !same_parts(slices, i - 1, i) || !same_parts(slices, i, i + 1) ||
                     !same_parts(slices, i - 2, i - 1) || !same_parts(slices, i + 1, i + 2);
    if (!end && slices.u[i] - some.u.back() < apart) continue;
    some.u.push_back(slices.u[i]);
    some.profiles.push_back(slices.profiles[i]);
    if (!slices.features.empty()) some.features.push_back(slices.features[i]);
  }
  return some;
}

SliceSet touchable_slices(const Surface& rail, const Region& region, double spacing_u, double spacing) {
  if (!(spacing > 0.0)) throw Error(ErrorKind::configuration, "the spacing of samples must be positive");
  const Box3 box = rail.bounds();
  const double low = std::max(region.y_min, box.min.y()), high = std::min(region.y_max, box.max.y());
  if (!(high > low) || !std::isfinite(high - low))
    throw Error(ErrorKind::configuration, "there is no surface in the range to be sampled");
  SliceSet slices;
  slices.name = "touchable sections";
  bool closed = false;
  slices.u = stations(rail, Body::rail, 0.0, region, spacing_u, closed);
  slices.profiles.resize(slices.u.size());
  parallel_for(slices.u.size(),
               [&](std::size_t i) { slices.profiles[i] = section_at(rail, slices.u[i], low, high, spacing); });
  return slices;
}

}  // namespace treadmark::sampling
