// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/backends/analytic/defects/moving_section.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

/// Levels off at x = 0.2 m from a rise of 1:10.
MovingSection nose() {
  MovingSection m;
  m.x = 0.2;
  m.y = 0.01;
  m.slope_z_before = -0.1;
  m.length_before = 0.3;
  m.length_after = 0.1;
  return m;
}

/// Moves aside by 1:10 from x = 0.05 m.
MovingSection wing() {
  MovingSection m;
  m.x = 0.05;
  m.z = 1e-3;
  m.slope_y_after = 0.1;
  m.length_before = 0.1;
  m.length_after = 0.4;
  return m;
}

SurfaceSpec moving(const MovingSection& motion) {
  const SurfaceSpec section{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  return {Body::rail, 0.0, move_section(section, motion), {}};
}

/// Triangle of second derivatives over the rounding, integrated twice by the midpoint rule.
double ramp_by_integration(double t, double r) {
  if (t <= -0.5 * r) return 0.0;
  constexpr int kSteps = 20000;
  const double from = -0.5 * r, h = (t - from) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double at = from + (i + 0.5) * h;
    sum += std::max(0.0, 2.0 / r * (1.0 - 2.0 * std::fabs(at) / r)) * (t - at) * h;
  }
  return sum;
}

TEST(MovingSection, TurnsByATriangleOfSecondDerivatives) {
  const MovingSection m = wing();
  for (const double x : {-0.02, 0.0, 0.02, 0.05, 0.07, 0.1, 0.2, 0.44}) {
    const analytic::SectionOffset o = analytic::section_offset(m, x);
    EXPECT_NEAR(o.y, 0.1 * ramp_by_integration(x - 0.05, m.rounding), 1e-9) << x;
    EXPECT_EQ(o.z, 1e-3);
  }
  // straight before and after, and at rest beyond the ends
  EXPECT_NEAR(analytic::section_offset(nose(), 0.0).z, 0.02, 1e-15);
  EXPECT_NEAR(analytic::section_offset(nose(), 0.27).z, 0.0, 1e-15);
  EXPECT_EQ(analytic::section_offset(nose(), -0.4).z, analytic::section_offset(nose(), -0.1).z);
  EXPECT_EQ(analytic::section_offset(wing(), 0.6).y, analytic::section_offset(wing(), 0.45).y);
}

TEST(MovingSection, SplinesThroughItsSlicesFollowItExactly) {
  for (const MovingSection& m : {nose(), wing()}) {
    const NaturalSurface surface = create_natural(moving(m));
    // the same section at rest, as slices
    MovingSection still;
    still.length_before = still.length_after = 1.0;
    const NaturalSurface section = create_natural(moving(still));
    for (double x = -0.3; x < 0.7; x += 0.0137) {
      const analytic::SectionOffset o = analytic::section_offset(m, x);
      for (double y = -0.034; y < 0.035; y += 0.0041)
        ASSERT_NEAR(height_at(*surface.surface, {}, {x, y + o.y}), o.z + height_at(*section.surface, {}, {x, y}), 1e-11)
            << x << ' ' << y;
    }
  }
}

TEST(MovingSection, EveryBackendButTheFormulasCanRepresentIt) {
  Region region;
  region.u_min = 0.17;
  region.u_max = 0.23;
  for (const MovingSection& m : {nose(), wing()}) {
    const NaturalSurface natural = create_natural(moving(m));
    for (const std::string backend :
         {"spline", "nurbs", "mesh", "mesh-flat", "offset", "offset-quadratic", "offset-bilinear"}) {
      SCOPED_TRACE(backend);
      const RepresentedSurface r = represent(natural, {backend, 1e-3, region});
      const SurfaceDifference d = fit_error(natural, r);
      EXPECT_GT(d.points, 1000u);
      EXPECT_LE(d.height_rms, 3e-6);
    }
  }
}

TEST(MovingSection, OffsetsOfAWingThatMovesFarAsideFollowIt) {
  const NaturalSurface natural = create_natural(moving(wing()));
  Region region;
  region.u_min = 0.0;
  region.u_max = 0.4;  // 35 mm aside, half of the section's width
  for (const std::string backend : {"offset", "offset-quadratic", "offset-bilinear"}) {
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(natural, {backend, 0.5e-3, region});
    double worst = 0.0, worst_tilted = 0.0;
    for (double x = 0.0; x <= 0.4; x += 0.00331) {
      const analytic::SectionOffset o = analytic::section_offset(wing(), x);
      // as far as the gauge corner stands at 70 degrees
      for (double y = -0.0352; y < 0.0353; y += 0.37e-3) {
        const double z = height_at(*r.surface, {}, {x, y + o.y});
        ASSERT_FALSE(std::isnan(z)) << x << ' ' << y;
        worst = std::max(worst, std::fabs(z - height_at(*natural.surface, {}, {x, y + o.y})));
      }
    }
    EXPECT_LE(worst, 3e-6);
    // tilted views, as those of a contact: the same surface
    const Pose tilted{{0.2, 0.02, 0.0}, Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix()};
    for (double x = -0.05; x < 0.05; x += 0.0097)
      for (double y = -0.02; y < 0.02; y += 0.0041)
        worst_tilted = std::max(worst_tilted, std::fabs(height_at(*r.surface, tilted, {x, y}) -
                                                        height_at(*natural.surface, tilted, {x, y})));
    EXPECT_LE(worst_tilted, 3e-6);
  }
}

/// Distance of a surface from the section of 60E1 where it lies at x, normal to that, from end to end; NaN: it is
/// missing.
double farthest_off(const Surface& moved, const Surface& section, const analytic::SectionOffset& at, double x) {
  double most = 0.0;
  for (double y = -0.03704; y < 0.03705; y += 0.13e-3) {
    const double h = 1e-7, z = height_at(section, {}, {0.0, y});
    const double slope = (height_at(section, {}, {0.0, y + h}) - height_at(section, {}, {0.0, y - h})) / (2.0 * h);
    const double off = std::fabs(height_at(moved, {}, {x, y + at.y}) - at.z - z) / std::hypot(1.0, slope);
    if (!(off <= most)) most = off;  // NaN stays
    if (std::isnan(most)) return most;
  }
  return most;
}

TEST(MovingSection, OffsetsOfAWingReachDownItsSides) {
  const NaturalSurface natural = create_natural(moving(wing()));
  const NaturalSurface section = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  Region region;
  region.u_min = 0.0;
  region.u_max = 0.5;
  for (const std::string backend : {"offset", "offset-quadratic", "offset-bilinear"}) {
    SCOPED_TRACE(backend);
    const RepresentedSurface r = represent(natural, {backend, 0.5e-3, region});
    for (double x = 0.0; x <= 0.5; x += 0.00331) {
      // its sides stand at 1:20 down to 35 mm; at x = 0.45 m its motion ends in a kink
      const bool kink = std::fabs(x - 0.45) < 0.02;
      const double off = farthest_off(*r.surface, *section.surface, analytic::section_offset(wing(), x), x);
      EXPECT_LE(off, kink ? 15e-6 : 0.3e-6) << x;
    }
  }
}

TEST(MovingSection, OffsetsKeepFeaturesThatEndBetweenSlices) {
  // two heads side by side; the second one ends between x = 0.1 m and 0.11 m
  SliceSet set;
  set.name = "two heads";
  for (int i = 0; i < 41; ++i) {
    Profile p;
    const double aside = 0.1 * 0.01 * i;
    const bool both = i <= 10;
    for (int k = 0; k <= (both ? 160 : 80); ++k) {
      const double s = 0.5e-3 * k;
      p.y.push_back(aside + s);
      p.z.push_back(2e-3 * (1.0 - std::cos(s / 0.0127)) + 1e-4 * std::sin(0.7 * i));
    }
    double length = 0.0, middle = 0.0;
    for (std::size_t k = 1; k < p.y.size(); ++k) {
      length += std::hypot(p.y[k] - p.y[k - 1], p.z[k] - p.z[k - 1]);
      if (k == 80) middle = length;
    }
    set.u.push_back(0.01 * i);
    set.features.push_back({0.0, middle, both ? length : NAN});
    set.profiles.push_back(std::move(p));
  }
  const NaturalSurface natural = create_natural({Body::rail, 0.0, set, {}});
  Region region;
  region.u_min = 0.02;
  region.u_max = 0.38;
  const RepresentedSurface r = represent(natural, {"offset", 0.5e-3, region});
  std::size_t compared = 0, absent = 0;
  for (double x = 0.02; x < 0.38; x += 0.0037)
    for (double s = 1e-3; s < 0.079; s += 0.71e-3) {
      const double y = 0.1 * x + s, z = height_at(*natural.surface, {}, {x, y}),
                   got = height_at(*r.surface, {}, {x, y});
      ASSERT_EQ(std::isnan(z), std::isnan(got)) << x << ' ' << s;
      if (std::isnan(z)) {
        ++absent;
        continue;
      }
      ++compared;
      ASSERT_NEAR(got, z, 5e-6) << x << ' ' << s;
    }
  EXPECT_GT(compared, 5000u);
  EXPECT_GT(absent, 2000u);
}

SurfacePart part(const MovingSection& m, const Vec3& offset, const char* backend, double resolution = 1e-3) {
  return {std::make_shared<const NaturalSurface>(create_natural(moving(m))), offset, backend, resolution};
}

TEST(Crossing, TheNoseTakesOverFromTheWing) {
  const NaturalSurface crossing =
      join_surfaces({part(nose(), {0.0, -0.02, 0.0}, ""), part(wing(), {0.0, 0.03, 0.0}, "")});
  const auto top = [&](const Surface& s, double x) {
    double least = INFINITY, at = NAN;
    for (double y = -0.07; y < 0.12; y += 0.5e-3)
      if (const double z = height_at(s, {}, {x, y}); z < least) least = z, at = y;
    return Vec2(at, least);
  };
  EXPECT_NEAR(top(*crossing.surface, 0.0).y(), 1e-3, 1e-5) << "on the wing, 1 mm low";
  EXPECT_NEAR(top(*crossing.surface, 0.0).x(), 0.03, 6e-4);
  EXPECT_NEAR(top(*crossing.surface, 0.3).y(), 0.0, 1e-5) << "on the nose";
  EXPECT_NEAR(top(*crossing.surface, 0.3).x(), -0.01, 6e-4);
  // where the straight rise reaches the wing's height
  const double meet = 0.2 - 1e-3 / 0.1;
  EXPECT_GT(top(*crossing.surface, meet - 0.03).x(), 0.0);
  EXPECT_LT(top(*crossing.surface, meet + 0.03).x(), 0.0);
  const NaturalSurface mixed =
      join_surfaces({part(nose(), {0.0, -0.02, 0.0}, "mesh"), part(wing(), {0.0, 0.03, 0.0}, "")});
  const RepresentedSurface r = represent(mixed, {"", 0.0, {0.1, 0.2, -1.0, 1.0}});
  EXPECT_EQ(r.surface->backend(), "mesh+spline");
  for (const double x : {0.11, 0.15, 0.19}) EXPECT_NEAR(top(*r.surface, x).y(), top(*crossing.surface, x).y(), 2e-6);
}

TEST(MovingSection, RefusesWhatMakesNoSense) {
  const SurfaceSpec section{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  MovingSection m = nose();
  m.rounding = 0.0;
  EXPECT_THROW(move_section(section, m), Error);
  m.rounding = 0.3;  // longer than twice the line after it
  EXPECT_THROW(move_section(section, m), Error);
  m = nose();
  m.slope_z_before = -1.1;
  EXPECT_THROW(move_section(section, m), Error);
  m = nose();
  m.x = NAN;
  EXPECT_THROW(move_section(section, m), Error);
  EXPECT_THROW(move_section({Body::wheel, 0.46, StandardProfile{"S1002"}, {}}, nose()), Error);
  EXPECT_THROW(move_section(moving(nose()), wing()), Error) << "it moves already";
}

/// A roof whose ridge is a kink feature that wanders with x.
SliceSet roof(bool kink) {
  SliceSet set;
  set.name = "roof";
  for (int i = 0; i < 9; ++i) {
    Profile p;
    const double ridge = 1e-3 * std::sin(0.8 * i), slope = 0.2;
    for (int k = -80; k <= 80; ++k) {
      const double s = 0.25e-3 * k;
      p.y.push_back(ridge + s);
      p.z.push_back(slope * std::fabs(s));
    }
    set.u.push_back(0.01 * i);
    const double half = 0.02 * std::hypot(1.0, slope);
    set.features.push_back({0.0, half, 2.0 * half});
    set.profiles.push_back(std::move(p));
  }
  if (kink) set.kinks = {1};
  return set;
}

TEST(Kinks, TheSurfaceTurnsSharplyAlongThem) {
  const NaturalSurface sharp = create_natural({Body::rail, 0.0, roof(true), {}}),
                       smooth = create_natural({Body::rail, 0.0, roof(false), {}});
  EXPECT_EQ(sharp.surface->backend(), "spline");
  double worst_sharp = 0.0, worst_smooth = 0.0;
  for (int i = 1; i < 8; ++i) {
    const double x = 0.01 * i, ridge = 1e-3 * std::sin(0.8 * i);
    for (double d = -0.019; d < 0.019; d += 0.17e-3) {
      const double exact = 0.2 * std::fabs(d), z = height_at(*sharp.surface, {}, {x, ridge + d});
      ASSERT_FALSE(std::isnan(z)) << x << ' ' << d;
      worst_sharp = std::max(worst_sharp, std::fabs(z - exact));
      worst_smooth = std::max(worst_smooth, std::fabs(height_at(*smooth.surface, {}, {x, ridge + d}) - exact));
    }
    ASSERT_FALSE(std::isnan(height_at(*sharp.surface, {}, {x, ridge}))) << "no crack along the ridge";
  }
  EXPECT_LT(worst_sharp, 0.1 * worst_smooth);
  EXPECT_GT(worst_smooth, 2e-6);
}

TEST(Crossing, OffsetsShowNothingThroughTheSideOfTheWing) {
  const NaturalSurface crossing =
      join_surfaces({part(nose(), {0.0, -0.02, 0.0}, "", 0.0), part(wing(), {0.0, 0.016, 0.0}, "", 0.0)});
  Region region;
  region.u_min = -0.1;
  region.u_max = 0.3;
  const RepresentedSurface r = represent(crossing, {"offset", 0.5e-3, region});
  constexpr double kBeside = 2e-6, kEnd = 1e-3;  // [m]
  // Where the corner of 13 mm becomes the side, curvature jumps: a spline of steps h errs by h^2 / 13 of the jump, 1.5
  // um.
  constexpr double kMost = 3e-6;
  std::size_t steep = 0;
  for (double x = -0.09; x < 0.29; x += 0.0062)
    for (double y = -0.05; y < 0.06; y += 0.11e-3) {
      const auto z_at = [&](double to_right) { return height_at(*crossing.surface, {}, {x, y + to_right}); };
      const double z = z_at(0.0), left = z_at(-kBeside), right = z_at(kBeside);
      if (!(std::fabs(right - left) <= kEnd)) continue;  // here one surface ends above the other
      const double slope = (right - left) / (2.0 * kBeside);
      steep += std::fabs(slope) > 10.0 ? 1 : 0;
      EXPECT_LE(std::fabs(height_at(*r.surface, {}, {x, y}) - z) / std::hypot(1.0, slope), kMost) << x << ' ' << y;
    }
  EXPECT_GT(steep, 100u) << "between the wing's top and the nose below it";
}

}  // namespace
}  // namespace treadmark
