// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/sampled_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::app {
namespace {

constexpr double kFlatRadius = 0.46, kFlat = 60e-3;

struct Wanted {
  std::string side = "right", wheel{}, rail{}, more = "cant = \"1:40\"\n", cases = "wheelset.pitch_deg = [0.5]";
};

/// S1002 on 60E1; runs it and samples its surfaces.
io::RunResult run(const Wanted& wanted) {
  const treadmark::testing::SampleInput input;
  input.write(
      "case.toml",
      "[case]\nside = \"" + wanted.side +
          "\"\nregime = \"none\"\n[wheel]\n"
          "shape.standard = \"S1002\"\n" +
          wanted.wheel + "[rail]\nshape.standard = \"60E1\"\n" + wanted.rail +
          "[track]\ngauge_mm = 1435.0\ngauge_height_mm = 14.0\n" + wanted.more +
          "[wheelset]\nflange_back_distance_mm = 1360.0\nflange_back_position_mm = -70.0\nnominal_radius_mm = 460.0\n"
          "vertical_force_N = 80e3\n[material]\nshear_modulus_GPa = 82.0\npoisson_ratio = 0.28\n"
          "[friction]\ncoefficient = 0.3\n"
          "[discretisation]\ndx_mm = 1.0\nds_mm = 1.0\nangle_separation_deg = 90.0\n"
          "separation_mm = 8.0\ncombination_mm = 4.0\n"
          "[[cases]]\n" +
          wanted.cases + "\n");
  const io::CaseFile file = io::read_any_case(input.folder() / "case.toml", {});
  SurfaceStore store;
  io::RunResult result = run_cases(file, store);
  EXPECT_TRUE(result.sampled.empty());
  add_surfaces(result, file, store);
  return result;
}

const char* kChord = "[[wheel.flats]]\nshape = \"fresh\"\nlength_mm = 60.0\ntheta_center_deg = 0.0\n";

const io::SampledSurface& surface(const io::RunResult& result, const std::string& name) {
  const int index = io::surface_index(result.sampled, name);
  EXPECT_GE(index, 0) << name;
  return result.sampled.at(static_cast<std::size_t>(index));
}

/// Value over y in a station, between its points.
std::optional<double> between(const io::SampledSurface& s, int iu, double y, const auto& value) {
  for (int k = 1; k < s.nv; ++k) {
    const std::size_t a = s.index(iu, k - 1), b = s.index(iu, k);
    if (!(s.y[a] <= y && y <= s.y[b])) continue;
    const double share = (y - s.y[a]) / (s.y[b] - s.y[a]);
    return (1.0 - share) * value(a) + share * value(b);
  }
  return {};
}

int nearest_station(const io::SampledSurface& s, double u) {
  const auto at = ranges::min_element(s.u, {}, [&](double one) { return std::fabs(one - u); });
  return static_cast<int>(at - s.u.begin());
}

double wheel_radius(const io::SampledSurface& s, std::size_t i) { return std::hypot(s.x[i], s.z[i]); }

/// The contact references of the results lie on the sampled rail and, but for the approach, on the sampled wheel.
void expect_contacts_on_surfaces(const io::RunResult& result) {
  int patches = 0;
  for (const io::CaseResult& c : result.cases) {
    ASSERT_TRUE(c.bodies);
    const io::SampledSurface &wheel = surface(result, c.wheel_surface), &rail = surface(result, c.rail_surface);
    for (const io::PatchResult& p : c.patches) {
      SCOPED_TRACE("case " + std::to_string(c.number));
      ++patches;
      const Vec3 reference(p.x_tr, p.y_tr, p.z_tr);
      const Vec3 on_wheel = c.bodies->X_TA.apply_inverse(reference), on_rail = c.bodies->X_TS.apply_inverse(reference);
      const int station = nearest_station(wheel, std::atan2(on_wheel.x(), on_wheel.z()));
      const double theta = std::atan2(on_wheel.x(), on_wheel.z());
      EXPECT_NEAR(wheel.u[static_cast<std::size_t>(station)], theta, 0.6e-3 / kFlatRadius) << "dense at contacts";
      const auto radius = between(wheel, station, on_wheel.y(), [&](std::size_t i) { return wheel_radius(wheel, i); });
      ASSERT_TRUE(radius);
      EXPECT_NEAR(*radius, std::hypot(on_wheel.x(), on_wheel.z()), p.approach + 15e-6);
      if (rail.closed) continue;
      EXPECT_LE(rail.u.front(), on_rail.x() - 0.149);
      EXPECT_GE(rail.u.back(), on_rail.x() + 0.149);
      const auto height =
          between(rail, nearest_station(rail, on_rail.x()), on_rail.y(), [&](std::size_t i) { return rail.z[i]; });
      ASSERT_TRUE(height);
      EXPECT_NEAR(*height, on_rail.z(), 15e-6);
    }
  }
  EXPECT_GT(patches, 0);
}

TEST(SampledSurfaces, AFreshFlatIsAsDeepAsItsChord) {
  const io::RunResult result = run({.wheel = kChord, .cases = "wheelset.pitch_deg = [0.5, 2, 120]"});
  const io::SampledSurface& wheel = surface(result, "wheel_1");
  EXPECT_EQ(wheel.body, "wheel");
  EXPECT_TRUE(wheel.closed);
  EXPECT_GE(wheel.nv, 100);
  EXPECT_LE(wheel.nu * wheel.nv, 60000);
  ASSERT_EQ(wheel.deviation.size(), wheel.x.size());
  const double inner = std::sqrt(kFlatRadius * kFlatRadius - kFlat * kFlat / 4.0);
  double deepest = 0.0, longest = 0.0;
  for (int i = 0; i < wheel.nu; ++i) {
    const double u = wheel.u[static_cast<std::size_t>(i)],
                 depth = std::fabs(u) < 1.0 ? std::max(0.0, kFlatRadius - inner / std::cos(u)) : 0.0;
    longest = std::max(
        longest,
        (i + 1 < wheel.nu ? wheel.u[static_cast<std::size_t>(i) + 1] : wheel.u[0] + 2.0 * std::numbers::pi) - u);
    for (int k = 1; k + 1 < wheel.nv; ++k) {
      const std::size_t at = wheel.index(i, k), left = wheel.index(i, k - 1), right = wheel.index(i, k + 1);
      if (std::isnan(wheel.x[left]) || std::isnan(wheel.x[at]) || std::isnan(wheel.x[right])) continue;
      EXPECT_NEAR(wheel.x[at], wheel_radius(wheel, at) * std::sin(u), 2e-9);
      EXPECT_NEAR(wheel.z[at], wheel_radius(wheel, at) * std::cos(u), 2e-9);
      const double slope = (wheel_radius(wheel, right) - wheel_radius(wheel, left)) / (wheel.y[right] - wheel.y[left]);
      ASSERT_NEAR(wheel.deviation[at], -depth / std::hypot(1.0, slope), 1e-6) << u << " " << wheel.y[at];
      deepest = std::min(deepest, wheel.deviation[at]);
    }
    // The profile crosses the nominal radius at y = 0, where its cone is nearly straight.
    EXPECT_NEAR(between(wheel, i, 0.0, [&](std::size_t at) { return wheel_radius(wheel, at); }).value(),
                kFlatRadius - depth, 2e-6);
  }
  EXPECT_NEAR(deepest, -(kFlatRadius - inner), 3e-6);
  EXPECT_NEAR(longest, 2.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_EQ(result.cases[2].wheel_surface, "wheel_1");
  EXPECT_TRUE(surface(result, "rail_1").deviation.empty());
  EXPECT_LT(surface(result, "rail_1").nu, 20);
  expect_contacts_on_surfaces(result);
}

TEST(SampledSurfaces, LeftHandPairsAreMirrored) {
  const io::RunResult right = run({.wheel = kChord, .cases = "wheelset.yaw_rad = [0.005]"});
  const io::RunResult left = run({.side = "left", .wheel = kChord, .cases = "wheelset.yaw_rad = [-0.005]"});
  expect_contacts_on_surfaces(left);
  for (const char* name : {"wheel_1", "rail_1"}) {
    const io::SampledSurface &a = surface(right, name), &b = surface(left, name);
    ASSERT_EQ(a.nu, b.nu);
    ASSERT_EQ(a.nv, b.nv);
    for (int i = 0; i < a.nu; i += 7)
      for (int k = 0; k < a.nv; ++k) {
        const std::size_t at = a.index(i, k), other = b.index(i, b.nv - 1 - k);
        if (std::isnan(a.x[at])) continue;
        ASSERT_NEAR(a.x[at], b.x[other], 1e-9);
        ASSERT_NEAR(a.y[at], -b.y[other], 1e-9);
        ASSERT_NEAR(a.z[at], b.z[other], 1e-9);
      }
  }
}

TEST(SampledSurfaces, CorrugationIsADeviationOfTheRail) {
  const io::RunResult result =
      run({.rail = "[[rail.corrugations]]\nx_start_mm = -500.0\nx_end_mm = 500.0\nramp_mm = 50.0\n"
                   "waves = [ { wavelength_mm = 50.0, amplitude_um = 30.0 } ]\n",
           .cases = "wheelset.s_mm = [10]"});
  const io::SampledSurface& rail = surface(result, "rail_1");
  EXPECT_FALSE(rail.closed);
  EXPECT_TRUE(surface(result, "wheel_1").deviation.empty());
  ASSERT_FALSE(rail.deviation.empty());
  const int middle = rail.nv / 2;
  for (int i = 0; i < rail.nu; ++i) {
    const double u = rail.u[static_cast<std::size_t>(i)];
    const std::size_t at = rail.index(i, middle);
    EXPECT_EQ(rail.x[at], std::ldexp(std::nearbyint(std::ldexp(u, 30)), -30));
    ASSERT_NEAR(rail.deviation[at], -30e-6 * std::cos(2.0 * std::numbers::pi * (u + 0.5) / 0.05), 1e-6) << u;
  }
  expect_contacts_on_surfaces(result);
}

TEST(SampledSurfaces, ARollerIsARing) {
  const io::RunResult result = run(
      {.more = "[roller]\nnominal_radius_mm = 500.0\npitch_rate_rad_s = 20.0\n", .cases = "wheelset.y_mm = [0, 1]"});
  const io::SampledSurface& roller = surface(result, "rail_1");
  EXPECT_EQ(roller.body, "rail");
  EXPECT_TRUE(roller.closed);
  EXPECT_TRUE(roller.deviation.empty());
  const int top = nearest_station(roller, 0.0);
  for (int i = 0; i < roller.nu; ++i)
    for (int k = 0; k < roller.nv; ++k) {
      const std::size_t at = roller.index(i, k);
      if (std::isnan(roller.x[at])) continue;
      const double r = std::hypot(roller.x[at], roller.z[at] - 0.5);
      ASSERT_NEAR(r, 0.5 - roller.z[roller.index(top, k)], 1e-8);
      const double off = std::atan2(roller.x[at], 0.5 - roller.z[at]) - roller.u[static_cast<std::size_t>(i)];
      ASSERT_NEAR(std::remainder(off, 2.0 * std::numbers::pi), 0.0, 1e-8);
    }
  expect_contacts_on_surfaces(result);
}

TEST(SampledSurfaces, APartlySampledWheelIsCompletedAsGiven) {
  const std::string far_flat = "[[wheel.flats]]\nshape = \"fresh\"\nlength_mm = 60.0\ntheta_center_deg = 120.0\n";
  for (const std::string backend : {"offset", "spline", "mesh"}) {
    SCOPED_TRACE(backend);
    const io::RunResult result =
        run({.wheel = "backend = \"" + backend + "\"\nresolution_mm = 0.5\n" + kChord + far_flat});
    const io::SampledSurface& wheel = surface(result, "wheel_1");
    EXPECT_TRUE(wheel.closed);
    int middle = 0;
    while (!(wheel.y[wheel.index(0, middle)] > 0.0)) ++middle;
    for (int i = 0; i < wheel.nu; ++i) ASSERT_FALSE(std::isnan(wheel.x[wheel.index(i, middle)])) << i;
    const double depth = kFlatRadius - std::sqrt(kFlatRadius * kFlatRadius - kFlat * kFlat / 4.0);
    for (const double degrees : {0.0, 120.0}) {
      const int at_flat = nearest_station(wheel, degrees * std::numbers::pi / 180.0);
      EXPECT_NEAR(wheel.deviation[wheel.index(at_flat, middle)], -depth, 3e-6) << degrees;
    }
    expect_contacts_on_surfaces(result);
  }
}

TEST(SampledSurfaces, ThreadsDoNotChangeABit) {
  const auto with = [](int threads) {
    const ThreadLimit limit(threads);
    return run({.wheel = kChord});
  };
  const io::RunResult one = with(1), many = with(4);
  ASSERT_EQ(one.sampled.size(), many.sampled.size());
  EXPECT_EQ(surface(one, "wheel_1").deviation, surface(many, "wheel_1").deviation);
  EXPECT_EQ(surface(one, "wheel_1").z, surface(many, "wheel_1").z);
}

TEST(SampledSurfaces, CasesWithoutContactAreDrawnToo) {
  const io::RunResult result = run({.cases = "wheelset.y_mm = [300]"});
  ASSERT_EQ(result.cases.size(), 1u);
  EXPECT_TRUE(result.cases[0].patches.empty());
  if (result.cases[0].bodies) {
    EXPECT_EQ(result.cases[0].wheel_surface, "wheel_1");
  }
}

}  // namespace
}  // namespace treadmark::app
