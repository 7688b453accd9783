// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/fit_field.hpp"

#include <cmath>
#include <iostream>
#include <numbers>

#include <gtest/gtest.h>

#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(FitField, FlatOnAWheel) {
  const double radius = 0.46;
  const auto wheel = create_surface({Body::wheel, radius, StandardProfile{"S1002"}, {.flats = {{.length = 0.16, .depth = 1.4e-3, .theta_center = 0.7}}}});
  const double noise_in = 30e-6;
  const int stations = std::getenv("STATIONS") != nullptr ? std::atoi(std::getenv("STATIONS")) : 2000;
  const auto cloud = tests::simple_cloud(*wheel, Body::wheel, -kPi, kPi, -60e-3, 60e-3, stations, 400, noise_in, 0.01, Pose{}, 1);
  auto nominal = tests::nominal_points("S1002", Body::wheel);
  std::erase_if(nominal, [](const Vec2& p) { return p.x() < -60e-3 || p.x() > 60e-3; });
  for (Vec2& p : nominal) p.y() += radius;
  Projection projection = project(cloud.points_S, {}, Pose{}, Section(nominal), {Body::wheel, radius});
  std::cout << projection.points.size() << " of " << cloud.points_S.size() << " rows " << projection.points.rows << " columns " << projection.points.columns << " closed " << projection.band.closed << '\n';
  const LocalNoise noise = find_noise(projection.points, projection.band, {.most_flagged = std::getenv("MF") != nullptr ? std::atof(std::getenv("MF")) : 0.2});
  std::cout << "noise " << noise.typical << " outliers " << noise.outliers << " spared " << noise.spared << " window " << noise.window << '\n';
  const FitResult fit = fit_field(projection.points, projection.band, noise, {});
  for (const auto& level : fit.levels) std::cout << level.knot_a << " x " << level.knot_s << ": " << level.used << " of " << level.functions << " in " << level.iterations << '\n';
  std::cout << "rms " << fit.residual_rms << " held " << fit.held_out_rms << " error " << fit.held_out_error << '\n';
  {
    const double a = 1.02497, s = 0.0750502;
    for (const auto& level : fit.field.levels()) {
      SplineField one(fit.field.length_a(), fit.field.length_s(), true);
      one.add(level);
      std::cout << "DBG " << level.knot_a << " " << level.knot_s << " " << one.value(a, s) << '\n';
    }
    std::size_t row = a / projection.points.cell_a;
    for (std::size_t r = row - 6; r < row + 7; ++r) std::cout << "DBG row " << r << " " << projection.points.begin[(r + 1) * projection.points.columns] - projection.points.begin[r * projection.points.columns] << '\n';
  }
  // truth
  double sum = 0.0, most = 0.0, count = 0.0, flat = 0.0, flats = 0.0;
  Random random(7);
  for (int k = 0; k < 20000; ++k) {
    const double a = projection.band.length() * random.uniform(), s = projection.band.section.length() * (0.01 + 0.98 * random.uniform());
    const double u = (projection.band.a_min + a) / radius;
    const auto at = projection.band.section.at(s);
    const double d = fit.field.value(a, s);
    const Vec2 p = at.position + d * at.normal;
    std::vector<double> y{p.x()}, h(1), slope(1);
    HeightsOut heights;
    heights.z = h;
    heights.dzdy = slope;
    sampling::section_heights(*wheel, Body::wheel, u, y, heights);
    const double error = (p.y() - h[0]) / std::hypot(1.0, slope[0]);
    if (std::isnan(error)) continue;
    sum += error * error;
    count += 1.0;
    if (std::fabs(error) > 1e-4) std::cout << a << ' ' << s << ' ' << error << '\n';
    most = std::max(most, std::fabs(error));
    if (std::fabs(u - 0.7) < 0.2) {
      flat += error * error;
      flats += 1.0;
    }
  }
  std::cout << "true rms " << std::sqrt(sum / count) << " in the flat " << std::sqrt(flat / flats) << " max " << most << '\n';
  EXPECT_LT(std::sqrt(sum / count), 0.1 * noise_in);
  EXPECT_LT(most, noise_in);
}

}  // namespace
}  // namespace treadmark::scans
