// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Parts of a long band, fitted one by one: where they meet they must be what one fit of the whole band is.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "treadmark/scans/cleaning/coverage.hpp"
#include "treadmark/scans/fit/band_surface.hpp"
#include "treadmark/scans/fit/fit_field.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

constexpr double kFinestOfParts = 4e-3, kSquatAt = 0.6, kSeamAgreement = 10e-9;  // [m]
constexpr std::size_t kOverlapOfParts = 24;                                      // coarsest intervals

class PartsOfBands : public ::testing::Test {
 protected:
  struct Fit {
    Projection projection;
    LocalNoise noise;
    FitResult fit;

    double at(double x, double s) const { return fit.field.value(x - projection.band.a_min, s); }
  };

  PartsOfBands() {
    const auto rail =
        create_surface({Body::rail,
                        0.0,
                        StandardProfile{"60E1"},
                        {.squats = {{.length = 60e-3, .width = 30e-3, .depth = 0.5e-3, .x_center = kSquatAt}}}});
    constexpr double kReach = 30e-3, kHalf = 4.0, kScatter = 20e-6;
    constexpr int kStations = 4000, kAcross = 40;
    cloud_ = tests::simple_cloud(*rail, Body::rail, -kHalf, kHalf, -kReach, kReach, kStations, kAcross, kScatter, 0.0,
                                 Pose{}, 1)
                 .points_S;
    auto nominal = tests::nominal_points("60E1", Body::rail);
    std::erase_if(nominal, [](const Vec2& p) { return std::fabs(p.x()) > kReach; });
    section_ = Section(nominal);
    Projection all = project(cloud_, {}, Pose{}, section_, how_);
    const LocalNoise noise = find_noise(all.points, all.band, {});
    FitResult fit = fit_field(all.points, all.band, noise, {});
    whole_.emplace(Fit{std::move(all), noise, std::move(fit)});
  }

  /// Intervals [from, to) and the overlap to both sides.
  Fit part(std::size_t from, std::size_t to) {
    const BandIntervals all = intervals_of(whole_->projection);
    const std::size_t first = from - std::min(from, kOverlapOfParts), last = std::min(all.count, to + kOverlapOfParts);
    ProjectSettings how = how_;
    how.part = BandIntervals{all.from + all.step * static_cast<double>(first), all.step, last - first};
    std::vector<Vec3> points;
    numbers_.clear();
    for (std::size_t i = 0; i < cloud_.size(); ++i) {
      const double x = cloud_[i].x() - how.part->from;
      if (x < 0.0 || x > all.step * static_cast<double>(last - first)) continue;
      points.push_back(cloud_[i]);
      numbers_.push_back(static_cast<std::uint32_t>(i));
    }
    Projection projection = project(points, {}, Pose{}, section_, how);
    projection.points.numbers = numbers_;
    NoiseSettings how_noise;
    how_noise.window = whole_->noise.window;
    how_noise.typical = whole_->noise.typical;
    const LocalNoise noise = find_noise(projection.points, projection.band, how_noise);
    FitSettings how_fit;
    how_fit.rows_of_whole = whole_->projection.points.rows;
    how_fit.sweeps = whole_->fit.sweeps;
    FitResult fit = fit_field(projection.points, projection.band, noise, how_fit);
    projection.points.numbers = {};
    return {std::move(projection), noise, std::move(fit)};
  }

  /// Largest difference of two fits for x from one place to another [m].
  double apart(const Fit& a, const Fit& b, double from, double to, bool without_squat) const {
    double most = 0.0;
    for (double x = from; x < to; x += 3.1e-3)
      for (double s = 1e-3; s < section_.length(); s += 1.7e-3)
        if (!without_squat || std::fabs(x - kSquatAt) > 0.15) most = std::max(most, std::fabs(a.at(x, s) - b.at(x, s)));
    return most;
  }

  const ProjectSettings how_{Body::rail, 1.0, 8e-3, kFinestOfParts};
  std::vector<Vec3> cloud_;
  std::vector<std::uint32_t> numbers_;
  Section section_;
  std::optional<Fit> whole_;
};

TEST_F(PartsOfBands, AreWhatTheWholeBandIs) {
  const BandIntervals all = intervals_of(whole_->projection);
  ASSERT_GT(all.count, 100u);
  const std::size_t seam = all.count / 2;
  const double place = all.from + all.step * static_cast<double>(seam);
  const Fit before = part(seam - 16, seam), after = part(seam, seam + 16);
  constexpr double kAround = 0.2;  // [m]
  EXPECT_LT(apart(before, after, place - kAround, place + kAround, false), kSeamAgreement);
  const double end = all.from + all.step * static_cast<double>(seam + 16);
  EXPECT_LT(apart(*whole_, after, place, end, true), kSeamAgreement);
  constexpr double kInTheSquat = 1e-6;  // where a function may just be one that stands out, or not
  EXPECT_LT(apart(*whole_, after, place, end, false), kInTheSquat);
  EXPECT_LT(whole_->at(kSquatAt, 0.5 * section_.length()), -0.4e-3);
}

TEST_F(PartsOfBands, HaveTheirSlicesAtTheSamePlaces) {
  const BandIntervals all = intervals_of(whole_->projection);
  const std::size_t seam = all.count / 2;
  const auto stations = [&](const Fit& fit) {
    constexpr double kTolerance = 0.5e-6;
    const FittedBand band{fit.projection.band, fit.fit.field, 0.0, section_.length(), 0.0};
    std::vector<double> out = slice_stations(band, kTolerance, whole_->projection.points.cell_a);
    for (double& x : out) x += fit.projection.band.a_min;
    std::erase_if(out, [&](double x) {
      const double from = all.from + all.step * static_cast<double>(seam);
      return x < from - 1e-9 || x > from + 16.0 * all.step - 1e-9;
    });
    std::sort(out.begin(), out.end());
    return out;
  };
  const std::vector<double> whole = stations(*whole_), here = stations(part(seam, seam + 16));
  ASSERT_EQ(here.size(), whole.size());
  for (std::size_t k = 0; k < here.size(); ++k) EXPECT_NEAR(here[k], whole[k], 1e-9);
}

TEST_F(PartsOfBands, MayLackPoints) {
  ProjectSettings how = how_;
  how.part = BandIntervals{10.0, 64e-3, 40};
  Projection none = project(cloud_, {}, Pose{}, section_, how);
  EXPECT_EQ(none.points.size(), 0u);
  EXPECT_EQ(none.beyond_length, cloud_.size() - none.beyond_section - none.far_off);
  Coverage usual;
  usual.gap_a = usual.gap_s = 4e-3, usual.limit = 10e-3;
  usual.first_column = 2, usual.last_column = none.points.columns;
  CoverageSettings how_covered;
  how_covered.usual = &usual;
  const Coverage found = find_coverage(none.points, none.band, how_covered);
  ASSERT_EQ(found.holes.size(), 1u);
  EXPECT_FALSE(found.holes.front().filled);
  EXPECT_EQ(found.first_column, 2u);
}

}  // namespace
}  // namespace treadmark::scans
