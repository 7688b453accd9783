// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slice_sampling.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

constexpr double kPositionSpacing = 0.5e-3;  // [m]
constexpr double kLengthSlack = 1e-9;        // [m]
constexpr int kLeastPositions = 4;

Error bad_slice(const SliceSet& slices, std::size_t i, const std::string& problem) {
  return Error(ErrorKind::input_data, "slice " + std::to_string(i + 1) + " of '" + slices.name + "' " + problem);
}

// Features of a slice, measured from its first point; without features the whole slice is one part.
std::vector<double> features_of(const SliceSet& slices, std::size_t i, double length) {
  if (slices.features.empty()) return {0.0, length};
  std::vector<double> features = slices.features[i];
  if (features.size() < 2) throw bad_slice(slices, i, "needs at least two features or none");
  if (!std::isnan(features.back())) features.back() = std::min(features.back(), length);
  bool present = false, ended = false;
  double previous = 0.0;
  for (const double s : features) {
    if (std::isnan(s)) {
      ended = present;
      continue;
    }
    if (ended)
      throw bad_slice(slices, i, "lacks a feature in the middle; only leading or trailing ones may be missing");
    if (present && !(s > previous)) throw bad_slice(slices, i, "has features that do not increase");
    if (s < 0.0 || s > length + kLengthSlack) throw bad_slice(slices, i, "has a feature beyond its end");
    previous = s;
    present = true;
  }
  return features;
}

}  // namespace

SampledSlices sample_slices(const SliceSet& slices) {
  const std::size_t count = slices.profiles.size();
  if (!slices.features.empty() && slices.features.size() != count)
    throw Error(ErrorKind::input_data, "'" + slices.name + "' has features for another number of slices");
  std::vector<ProfileSpline> splines;
  std::vector<std::vector<double>> features;
  for (std::size_t i = 0; i < count; ++i) {
    splines.push_back(fit_profile(slices.profiles[i]));
    features.push_back(features_of(slices, i, splines.back().end() - splines.back().begin()));
    if (features.back().size() != features.front().size()) throw bad_slice(slices, i, "has another number of features");
  }

  // Equally many intervals in every slice, for the longest one.
  const std::size_t parts = features.front().size() - 1;
  std::vector<int> intervals(parts, 0);
  SampledSlices sampled;
  sampled.positions = 1;
  for (std::size_t p = 0; p < parts; ++p) {
    double longest = 0.0;
    for (const auto& f : features)
      if (f[p + 1] > f[p]) longest = std::max(longest, f[p + 1] - f[p]);  // false where one of them is missing
    intervals[p] = 1 + static_cast<int>((longest + kLengthSlack) / kPositionSpacing);
    sampled.positions += intervals[p];
  }

  for (std::size_t i = 0; i < count; ++i) {
    SampledSlice slice;
    int position = 0;
    for (std::size_t p = 0; p < parts; position += intervals[p], ++p) {
      const double from = features[i][p], to = features[i][p + 1];
      if (std::isnan(from) || std::isnan(to)) continue;
      if (slice.points.empty()) slice.first = position;
      for (int k = slice.points.empty() ? 0 : 1; k <= intervals[p]; ++k) {
        const Vec2 point = splines[i].position(splines[i].begin() + from + (to - from) * k / intervals[p]);
        slice.points.push_back({point.x(), point.y()});
      }
    }
    if (!slice.points.empty() && static_cast<int>(slice.points.size()) < kLeastPositions)
      throw bad_slice(slices, i, "is too short for a spline across");
    sampled.slices.push_back(std::move(slice));
  }
  return sampled;
}

}  // namespace treadmark::spline
