// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/half_fits.hpp"

#include <atomic>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/scans/fit/section_levels.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

using tests::kWheelRadius;

constexpr double kFrom = -60e-3, kTo = 60e-3;

/// A wheel that is out of round by 0.1 mm, once and five times a turn, and hollow by 0.5 mm.
std::vector<Vec3> moved(std::vector<Vec3> points) {
  for (Vec3& p : points) {
    const double r = std::hypot(p.x(), p.z()), u = std::atan2(p.x(), p.z());
    const double off = 50e-6 * (std::cos(u) + std::sin(5.0 * u)) - 0.5e-3 * std::exp(-std::pow(p.y() / 15e-3, 2));
    p.x() *= 1.0 + off / r;
    p.z() *= 1.0 + off / r;
  }
  return points;
}

/// The same without noise: what a surface of this form is, along the section's normal from a place of the band.
double true_distance(const Surface& wheel, const Band& band, double a, double s) {
  const double u = (band.a_min + a) / kWheelRadius;
  const auto at = band.section.at(s);
  std::vector<double> y(1), h(1), slope(1);
  double d = 0.0;
  for (int turn = 0; turn < 20; ++turn) {
    const Vec2 p = at.position + d * at.normal;
    y[0] = p.x();
    HeightsOut heights;
    heights.z = h;
    heights.dzdy = slope;
    section_heights(wheel, Body::wheel, u, y, heights);
    const double off = 50e-6 * (std::cos(u) + std::sin(5.0 * u)) - 0.5e-3 * std::exp(-std::pow(y[0] / 15e-3, 2));
    d += (h[0] + off - p.y()) * at.normal.y();
  }
  return d;
}

struct Told {
  Band band;
  BandPoints points;
  LocalNoise noise;
  FitResult fit;
  SurfaceErrors errors;
  std::vector<double> stations;
};

Told told(double noise_in, std::uint64_t seed, int stations = 1500) {
  const auto wheel = create_surface({Body::wheel, kWheelRadius, StandardProfile{"S1002"}, {}});
  const auto cloud =
      tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, kFrom, kTo, stations, 200, noise_in, 0.0, Pose{}, seed);
  auto nominal = tests::nominal_points("S1002", Body::wheel);
  std::erase_if(nominal, [](const Vec2& p) { return p.x() < kFrom || p.x() > kTo; });
  for (Vec2& p : nominal) p.y() += kWheelRadius;
  const std::vector<Vec3> points = moved(cloud.points_S);
  Projection projection = project(points, {}, Pose{}, Section(nominal), {Body::wheel, kWheelRadius});
  const auto halves = half_sections(projection.points, projection.band, 1e-3);
  projection = project(points, {}, Pose{}, refine_section(projection.points, projection.band, 1e-3),
                       {Body::wheel, kWheelRadius});
  const LocalNoise noise = find_noise(projection.points, projection.band, {});
  Told out{projection.band, {}, noise, fit_field(projection.points, projection.band, noise, {}), {}, {}};
  const double length = projection.band.section.length();
  const FittedBand fitted{out.band, out.fit.field, 0.02 * length, 0.98 * length, 0.0};
  out.stations = error_stations(out.band, {});
  out.errors = half_fit_errors(fitted, projection.points, noise, {}, &halves, out.stations, kWheelRadius);
  out.points = std::move(projection.points);
  return out;
}

/// Mean square of what is left of values without their mean and slope, which contact does not feel.
double waviness(const std::vector<double>& values) {
  double mean = 0.0, slope = 0.0, squares = 0.0, sum = 0.0;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) mean += v / n;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) - 0.5 * (n - 1.0);
    slope += x * values[i], squares += x * x;
  }
  slope /= squares;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += std::pow(values[i] - mean - slope * (static_cast<double>(i) - 0.5 * (n - 1.0)), 2);
  return sum / n;
}

TEST(HalfFits, DrawsAreAsLargeAsTheTrueError) {
  const auto wheel = create_surface({Body::wheel, kWheelRadius, StandardProfile{"S1002"}, {}});
  for (const double noise : {10e-6, 30e-6, 50e-6}) {
    double drawn = 0.0, truly = 0.0, drawn_waves = 0.0, true_waves = 0.0;
    for (const std::uint64_t seed : {1u, 2u}) {
      const Told t = told(noise, seed);
      for (std::size_t k = 0; k < t.stations.size(); ++k) {
        std::vector<double> off;
        for (std::size_t i = 0; i < t.errors.y.size(); ++i) {
          const double s = t.band.section.s_at(t.errors.y[i]);
          off.push_back(t.fit.field.value(t.stations[k], s) - true_distance(*wheel, t.band, t.stations[k], s));
          drawn += std::pow(t.errors.draws[k][i], 2);
          truly += off.back() * off.back();
        }
        drawn_waves += waviness(t.errors.draws[k]);
        true_waves += waviness(off);
      }
    }
    EXPECT_NEAR(std::sqrt(drawn / truly), 1.0, 0.3) << noise;
    EXPECT_NEAR(std::sqrt(drawn_waves / true_waves), 1.0, 0.3) << noise;
  }
}

TEST(HalfFits, PlacesRunAsProfilesAndStationsAsTheSurface) {
  const Told t = told(20e-6, 3, 600);
  ASSERT_EQ(t.errors.draws.size(), 32u);
  ASSERT_EQ(t.errors.u.size(), 32u);
  EXPECT_TRUE(ranges::is_sorted(t.errors.y, std::greater<>()));
  for (std::size_t i = 1; i < t.errors.y.size(); ++i)
    EXPECT_LT(std::hypot(t.errors.y[i] - t.errors.y[i - 1], t.errors.z[i] - t.errors.z[i - 1]), 0.51e-3);
  for (std::size_t k = 0; k < t.stations.size(); ++k) {
    EXPECT_EQ(t.errors.draws[k].size(), t.errors.y.size());
    EXPECT_NEAR(t.errors.u[k], (t.band.a_min + t.stations[k]) / kWheelRadius, 1e-12);
  }
}

TEST(HalfFits, StationsAreCloserInDamage) {
  Band band;
  band.a_max = 3.0;
  band.closed = true;
  std::vector<Damage> damage(5);
  for (Damage& one : damage) one.a = 0.01, one.length = 0.08;
  EXPECT_EQ(error_stations(band, {}).size(), 32u);
  const std::vector<double> stations = error_stations(band, damage);
  EXPECT_EQ(stations.size(), 32u + 4u * 8u) << "in the four largest";
  const auto near = ranges::count_if(stations, [](double a) { return a < 0.05 || a > 3.0 - 0.03; });
  EXPECT_GE(near, 32);
  for (const double a : stations) EXPECT_TRUE(a >= 0.0 && a < 3.0) << a;
}

TEST(HalfFits, TheSameForAnyNumberOfThreads) {
  std::optional<SurfaceErrors> one;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const SurfaceErrors errors = told(30e-6, 4, 300).errors;
    if (one) {
      EXPECT_EQ(one->draws, errors.draws);
    }
    one = errors;
  }
}

TEST(HalfFits, StopWhenAsked) {
  const Told t = told(30e-6, 4, 300);
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  const FittedBand fitted{t.band, t.fit.field, 0.01, 0.1, 0.0};
  EXPECT_THROW(half_fit_errors(fitted, t.points, t.noise, {}, nullptr, t.stations, kWheelRadius, progress), Error);
}

}  // namespace
}  // namespace treadmark::scans
