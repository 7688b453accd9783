// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/band_surface.hpp"

#include <gtest/gtest.h>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/scans/placement/band_frame.hpp"
#include "treadmark/tests/scans/fit/level_samples.hpp"

namespace treadmark::scans {
namespace {

using tests::kWheelRadius;

Section real_section(Body body) {
  auto points = tests::nominal_points(body == Body::wheel ? "S1002" : "60E1", body);
  std::erase_if(points, [&](const Vec2& p) { return std::fabs(p.x()) > (body == Body::wheel ? 50e-3 : 30e-3); });
  if (body == Body::wheel)
    for (Vec2& p : points) p.y() += kWheelRadius;
  return Section(points);
}

Band wheel_band() {
  return {Body::wheel, kWheelRadius, real_section(Body::wheel), -kPi * kWheelRadius, kPi * kWheelRadius, true};
}
Band rail_band() { return {Body::rail, 1.0, real_section(Body::rail), 0.3, 0.9, false}; }

/// A coarse wave all along and a bump of 12 mm at bump_a in a fine level.
SplineField waves(const Band& band, double bump_a, double bump_height = 0.4e-3) {
  const double length = band.length(), width = band.section.length();
  SplineField field(length, width, band.closed);
  const auto coarse_along = static_cast<std::size_t>(4 * std::lround(length / 0.2));
  SplineLevel coarse = tests::level_of(length, width, coarse_along, 2, band.closed),
              fine = tests::level_of(length, width, 8 * coarse_along, 16, band.closed);
  tests::sample_into(coarse,
                     [&](double a, double s) { return 0.2e-3 * std::cos(4.0 * kPi * a / length) * (1.0 - s / width); });
  tests::sample_into(fine, [&](double a, double s) {
    const double off = band.closed ? a - bump_a - length * std::round((a - bump_a) / length) : a - bump_a;
    const double square = (off * off + (s - 0.5 * width) * (s - 0.5 * width)) / (12e-3 * 12e-3);
    return square < 9.0 ? -bump_height * std::exp(-0.5 * square) : 0.0;
  });
  field.add(std::move(coarse));
  field.add(std::move(fine));
  return field;
}

double nearest(const std::vector<Vec2>& nodes, const Vec2& p, const Band& band) {
  double least = 1e9;
  for (const Vec2& n : nodes) {
    double a = n.x() - p.x();
    if (band.closed) a -= band.length() * std::round(a / band.length());
    least = std::min(least, std::hypot(a, n.y() - p.y()));
  }
  return least;
}

/// Greatest difference of the surface made from the slices and the field.
double worst(const FittedBand& fitted, const SliceSet& slices, double a_min, double a_max) {
  const Body body = fitted.band.body;
  const auto surface = create_surface({body, body == Body::wheel ? kWheelRadius : 0.0, slices, {}});
  Random random(3);
  double most = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double a = a_min + (a_max - a_min) * random.uniform();
    const double s = fitted.s_min + 1.5e-3 + (fitted.s_max - fitted.s_min - 3e-3) * random.uniform();
    const Vec2 p = fitted.across(a, s);
    std::vector<double> y{p.x()}, h(1), slope(1);
    HeightsOut heights;
    heights.z = h;
    heights.dzdy = slope;
    const double u = body == Body::wheel ? wrap_angle(fitted.u_at(a)) : fitted.u_at(a);
    section_heights(*surface, body, u, y, heights);
    EXPECT_FALSE(std::isnan(h[0])) << "a " << a << " s " << s;
    const double off = (body == Body::wheel ? h[0] - p.y() : -h[0] - p.y()) / std::hypot(1.0, slope[0]);
    most = std::max(most, std::fabs(off));
  }
  return most;
}

TEST(BandSurface, PlacesAreOnTheMovedSection) {
  for (const bool wheel : {true, false}) {
    const Band band = wheel ? wheel_band() : rail_band();
    const SplineField field = waves(band, 0.1);
    const FittedBand fitted{band, field, 2e-3, band.section.length() - 2e-3, wheel ? 0.7 : 0.5};
    Random random(1);
    for (int k = 0; k < 200; ++k) {
      const double a = band.length() * random.uniform(), s = band.section.length() * random.uniform();
      const Vec2 p = fitted.across(a, s);
      const Section::Point at = band.section.at(s);
      EXPECT_NEAR((p - at.position).dot(at.normal), field.value(a, s), 1e-15);
      EXPECT_NEAR((p - at.position).norm(), std::fabs(field.value(a, s)), 1e-15);
      const Vec3 q = fitted.point(a, s);
      const double u = (band.a_min + a) / band.radius - fitted.u_zero;
      EXPECT_LT((q - (wheel ? Vec3(p.y() * std::sin(u), p.x(), p.y() * std::cos(u)) : Vec3(u, p.x(), -p.y()))).norm(),
                1e-14);
    }
  }
}

TEST(BandSurface, SlicesOfAWheelGiveTheField) {
  const Band band = wheel_band();
  for (const double u_zero : {0.0, 1.234}) {
    // the bump lies at -pi of the slices in the first case
    const SplineField field = waves(band, u_zero == 0.0 ? 2e-3 : 0.8);
    const FittedBand fitted{band, field, 2e-3, band.section.length() - 2e-3, u_zero};
    const SliceSet slices = to_slices(fitted, 0.5e-3, 0.05e-6, "test");
    EXPECT_EQ(slices.name, "test");
    EXPECT_EQ(slices.u.front(), -kPi);
    EXPECT_EQ(slices.u.back(), kPi);
    EXPECT_EQ(slices.profiles.front().y, slices.profiles.back().y);
    EXPECT_EQ(slices.profiles.front().z, slices.profiles.back().z);
    ASSERT_EQ(slices.u.size(), slices.profiles.size());
    for (std::size_t k = 1; k < slices.u.size(); ++k) {
      EXPECT_GT(slices.u[k], slices.u[k - 1]);
      EXPECT_LT(kWheelRadius * (slices.u[k] - slices.u[k - 1]), 34e-3 + 3e-3);
    }
    for (const Profile& p : slices.profiles) {
      EXPECT_EQ(p.body, Body::wheel);
      for (std::size_t k = 1; k < p.y.size(); ++k) EXPECT_LT(p.y[k], p.y[k - 1]);
    }
    const double most = worst(fitted, slices, 0.0, band.length());
    RecordProperty("most_um_" + std::to_string(u_zero == 0.0), std::to_string(1e6 * most));
    EXPECT_LT(most, 2e-6);
  }
}

TEST(BandSurface, SlicesOfARailGiveTheField) {
  const Band band = rail_band();
  const SplineField field = waves(band, 0.25);
  const FittedBand fitted{band, field, 2e-3, band.section.length() - 2e-3, 0.5};
  const SliceSet slices = to_slices(fitted, 0.5e-3, 0.05e-6, "rail");
  EXPECT_NEAR(slices.u.front(), 0.3 - 0.5, 1e-12);
  EXPECT_NEAR(slices.u.back(), 0.9 - 0.5, 1e-12);
  for (const Profile& p : slices.profiles)
    for (std::size_t k = 1; k < p.y.size(); ++k) EXPECT_GT(p.y[k], p.y[k - 1]);
  const double most = worst(fitted, slices, 0.0, band.length());
  RecordProperty("most_um", std::to_string(1e6 * most));
  EXPECT_LT(most, 2e-6);
}

TEST(BandSurface, ToleranceThinsStations) {
  const Band band = wheel_band();
  const double bump = 1.0, small = 1e-6;
  const SplineField field = waves(band, bump, small);
  const FittedBand fitted{band, field, 2e-3, band.section.length() - 2e-3, 0.0};
  const double knot = field.levels()[1].knot_a;
  const SliceSet close = to_slices(fitted, 0.5e-3, 1e-9, "close"),
                 loose = to_slices(fitted, 0.5e-3, 2.0 * small, "loose");
  EXPECT_GT(close.u.size(), loose.u.size() + 5);
  const auto around = [&](const SliceSet& slices, double reach) {
    return std::count_if(slices.u.begin(), slices.u.end(),
                         [&](double u) { return std::fabs(kWheelRadius * u - band.a_min - bump) < reach; });
  };
  // every knot where the bump is
  EXPECT_GE(around(close, 4.0 * knot), 7);
  EXPECT_LT(around(loose, 4.0 * knot), 5);
  // as few away from it
  const auto far = [&](const SliceSet& slices) {
    return std::count_if(slices.u.begin(), slices.u.end(),
                         [&](double u) { return std::fabs(kWheelRadius * u - band.a_min - bump) > 0.1; });
  };
  EXPECT_NEAR(static_cast<double>(far(close)), static_cast<double>(far(loose)), 3.0);
  EXPECT_LT(worst(fitted, loose, 0.0, band.length()), 3e-6 + 2.0 * small);
}

TEST(BandSurface, SectionAsAProfile) {
  for (const bool wheel : {true, false}) {
    const Band band = wheel ? wheel_band() : rail_band();
    const SplineField field(band.length(), band.section.length(), band.closed);
    const FittedBand fitted{band, field, 5e-3, band.section.length() - 7e-3, 0.0};
    const Profile p = section_profile(fitted, 0.45, 1e-3, "name");
    EXPECT_EQ(p.name, "name");
    EXPECT_EQ(p.body, band.body);
    ASSERT_EQ(p.y.size(), p.z.size());
    const double first = band.section.at(5e-3).position.x(),
                 last = band.section.at(band.section.length() - 7e-3).position.x();
    EXPECT_NEAR(wheel ? p.y.back() : p.y.front(), first, 1e-12);
    EXPECT_NEAR(wheel ? p.y.front() : p.y.back(), last, 1e-12);
    for (std::size_t k = 0; k < p.y.size(); ++k) {
      EXPECT_NEAR(p.z[k], wheel ? band.section.v_at(p.y[k]) - 0.45 : -band.section.v_at(p.y[k]), 1e-9);
      if (k == 0) continue;
      EXPECT_LE(std::hypot(p.y[k] - p.y[k - 1], p.z[k] - p.z[k - 1]), 1.0001e-3);
      EXPECT_TRUE(wheel ? p.y[k] < p.y[k - 1] : p.y[k] > p.y[k - 1]);
    }
  }
}

TEST(BandSurface, NodesOfTrianglesAreEven) {
  for (const bool closed : {false, true}) {
    const Band band = tests::straight_band(0.3, 0.05, closed);
    const SplineField field(0.3, 0.05, closed);
    const FittedBand fitted{band, field, 3e-3, 45e-3, 0.0};
    constexpr double kSpacing = 4e-3;
    const auto nodes = triangle_nodes(fitted, {}, {}, kSpacing);
    // the circle through the corners of a triangle with sides of spacing has this radius; rows may lie closer
    const double reach = kSpacing / std::sqrt(3.0);
    Random random(1);
    for (int k = 0; k < 2000; ++k)
      EXPECT_LT(nearest(nodes, {0.3 * random.uniform(), 3e-3 + 42e-3 * random.uniform()}, band), reach);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      EXPECT_GE(nodes[k].x(), 0.0);
      EXPECT_LE(nodes[k].x(), 0.3 + 1e-12);
      EXPECT_GE(nodes[k].y(), 3e-3);
      EXPECT_LE(nodes[k].y(), 45e-3 + 1e-12);
      std::vector<Vec2> others = nodes;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      const double apart = nearest(others, nodes[k], band);
      EXPECT_GT(apart, 0.4 * kSpacing);
      EXPECT_LE(apart, kSpacing);
    }
    // corners of an open band belong to it
    if (!closed) {
      for (const Vec2& corner : {Vec2(0.0, 3e-3), Vec2(0.3, 3e-3), Vec2(0.0, 45e-3), Vec2(0.3, 45e-3)})
        EXPECT_LT(nearest(nodes, corner, band), 1e-12);
    }

    // open cells: exactly their nodes are missing
    const BandPoints points = tests::sorted(band, 100, 25, {});
    std::vector<std::uint8_t> open(2500, 0);
    const auto hole = [](std::size_t row, std::size_t column) {
      return (row >= 30 && row < 45 && column >= 8 && column < 16) || (row >= 97 && column < 12);
    };
    for (std::size_t r = 0; r < 100; ++r)
      for (std::size_t c = 0; c < 25; ++c) open[r * 25 + c] = hole(r, c) ? 1 : 0;
    std::vector<Vec2> wanted;
    for (const Vec2& n : nodes)
      if (!hole(std::min<std::size_t>(99, static_cast<std::size_t>(n.x() / points.cell_a)),
                std::min<std::size_t>(24, static_cast<std::size_t>(n.y() / points.cell_s))))
        wanted.push_back(n);
    EXPECT_LT(wanted.size(), nodes.size());
    EXPECT_EQ(triangle_nodes(fitted, points, open, kSpacing), wanted);
  }
}

TEST(BandSurface, SagittaHasTheCurvatureOfTheSurface) {
  // a crown of radius 0.3 round a wheel of radius 0.46
  constexpr double kCrown = 0.3;
  std::vector<Vec2> arc;
  for (int k = -60; k <= 60; ++k)
    arc.emplace_back(kCrown * std::sin(k * 2e-3), kWheelRadius - kCrown * (1.0 - std::cos(k * 2e-3)));
  const Band wheel{Body::wheel, kWheelRadius, Section(arc), -kPi * kWheelRadius, kPi * kWheelRadius, true};
  const Band rail{Body::rail, 1.0, Section(arc), 0.0, 1.0, false};
  for (const Band& band : {wheel, rail}) {
    const SplineField none(band.length(), band.section.length(), band.closed), field = waves(band, 0.4);
    const FittedBand bare{band, none, 2e-3, band.section.length() - 2e-3, 0.0},
        fitted{band, field, 2e-3, band.section.length() - 2e-3, 0.0};
    constexpr double kStep = 1e-3;
    for (const double a : {0.1, 0.4, 0.77})
      for (const double s : {10e-3, 33.3e-3, 60e-3}) {
        const std::vector<Vec2> nodes{{a - kStep, s}, {a, s}, {a + kStep, s}, {a, s - kStep}, {a, s + kStep}};
        const std::vector<double> h = sagitta(bare, nodes), with = sagitta(fitted, nodes);
        EXPECT_NEAR((h[0] - 2.0 * h[1] + h[2]) / (kStep * kStep), band.body == Body::wheel ? -1.0 / kWheelRadius : 0.0,
                    1e-6);
        EXPECT_NEAR((h[3] - 2.0 * h[1] + h[4]) / (kStep * kStep), -1.0 / kCrown, 2e-3);
        for (std::size_t k = 0; k < nodes.size(); ++k)
          EXPECT_NEAR(with[k] - h[k], field.value(nodes[k].x(), nodes[k].y()), 1e-12);
      }
  }
}

}  // namespace
}  // namespace treadmark::scans
