// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// The measured wheel flat of the reference data (M. Maglio and J. Nielsen, Chalmers University of Technology).
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/slices/fit_slices.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::spline {
namespace {

constexpr double kFlatRadius = 0.49;

struct Deepest {
  double depth = 0.0, y = 0.0, theta = 0.0;
};

// S1002 between -26 and 32.158 mm (EN 13715) [mm].
double s1002_mm(double y) {
  const double c[] = {0.0,
                      -3.358537058e-2,
                      1.565681624e-3,
                      -2.810427944e-5,
                      5.844240864e-8,
                      -1.562379023e-8,
                      5.309217349e-15,
                      -5.957839843e-12,
                      2.646656573e-13};
  double z = 0.0;
  for (int k = 8; k >= 0; --k) z = z * y + c[k];
  return z;
}

// Deepest radial deviation from the standard profile.
Deepest deepest(const Surface& wheel) {
  Deepest worst;
  for (double theta = 0.6; theta < 0.7; theta += 5e-4)
    for (double y_mm = -20.0; y_mm <= 30.0; y_mm += 0.5) {
      const double r = height_at(wheel, {Vec3::Zero(), rotation_y(theta)}, {0.0, 1e-3 * y_mm});
      const double deviation = r - kFlatRadius - 1e-3 * s1002_mm(y_mm);
      if (deviation < worst.depth) worst = {deviation, 1e-3 * y_mm, theta};
    }
  return worst;
}

SliceSet read_flat(const std::filesystem::path& shared, double lambda_mm3) {
  io::ProfileOptions options;
  options.smoothing.strength = lambda_mm3 * 1e-9;
  return io::read_slices(shared / "data/contact_examples/S1002_flat.slcw", Body::wheel, options);
}

TEST(ReferenceFlat, HasItsPublishedSize) {
  TREADMARK_REQUIRE_SHARED();
  SliceSet slices = read_flat(*shared, 0.0);
  ASSERT_EQ(slices.u.size(), 258u);
  slices.approximate_u = false;
  EXPECT_EQ(fit_slices(slices).positions(), 300);
  const Deepest sharp = deepest(*make_slice_surface(slices, kFlatRadius));
  // The deepest measured point, on the 1 mm raster of the scan, is -1.421 mm at y = 6 mm, theta = 0.647.
  EXPECT_NEAR(sharp.depth, -1.421e-3, 0.003e-3);
  EXPECT_NEAR(sharp.y, 6e-3, 0.6e-3);
  EXPECT_NEAR(sharp.theta, 0.647, 0.001);
  // Approximation and smoothing make it a little shallower.
  SliceSet soft = read_flat(*shared, 5.0);
  EXPECT_TRUE(soft.approximate_u);
  const Deepest shallow = deepest(*make_slice_surface(soft, kFlatRadius));
  EXPECT_GT(shallow.depth, sharp.depth);
  EXPECT_LT(shallow.depth, sharp.depth + 0.03e-3);
}

TEST(ReferenceFlat, InterpolationPassesThroughTheMeasuredPoint) {
  TREADMARK_REQUIRE_SHARED();
  SliceSet slices = read_flat(*shared, 0.0);
  slices.approximate_u = false;
  const SliceNet net = fit_slices(slices);
  // The nearest slice to theta = 0.647, at its point nearest to y = 6 mm.
  std::size_t slice = 0;
  for (std::size_t i = 0; i < slices.u.size(); ++i)
    if (std::abs(slices.u[i] - 0.647) < std::abs(slices.u[slice] - 0.647)) slice = i;
  const Profile& profile = slices.profiles[slice];
  std::size_t point = 0;
  for (std::size_t i = 0; i < profile.y.size(); ++i)
    if (std::abs(profile.y[i] - 6e-3) < std::abs(profile.y[point] - 6e-3)) point = i;
  const auto place = net.find(slices.u[slice]);
  double nearest = 1.0;
  for (int cell = 0; cell < net.cells(); ++cell)
    for (double f = 0.0; f < 1.0; f += 0.01) {
      const NetPair p = net.at(place, cell, f).value;
      nearest = std::min(nearest, std::hypot(p.y - profile.y[point], p.w - profile.z[point]));
    }
  EXPECT_LT(nearest, 4e-6);  // half a sampling step of 0.005 mm, and points resampled between 1 mm points
}

// Least |r - r(theta, v)| over all v with y(theta, v) = y.
double radial_miss(const SliceNet& net, const Vec3& p) {
  const auto place = net.find(std::atan2(p.x(), p.z()));
  const double r = std::hypot(p.x(), p.z());
  double least = 1.0;
  for (int cell = 0; cell < net.cells(); ++cell) {
    double low = 0.0, high = 1.0;
    const bool rising = net.at(place, cell, 1.0).value.y > net.at(place, cell, 0.0).value.y;
    if ((net.at(place, cell, 0.0).value.y - p.y()) * (net.at(place, cell, 1.0).value.y - p.y()) > 0.0) continue;
    for (int i = 0; i < 55; ++i) {
      const double middle = 0.5 * (low + high);
      ((net.at(place, cell, middle).value.y > p.y()) == rising ? high : low) = middle;
    }
    least = std::min(least, std::abs(net.at(place, cell, low).value.w + kFlatRadius - r));
  }
  return least;
}

TEST(ReferenceFlat, HeightsOverItLieOnTheSurface) {
  TREADMARK_REQUIRE_SHARED();
  constexpr double kHeightTolerance = 1e-10;
  for (const bool approximate : {false, true}) {
    SliceSet slices = read_flat(*shared, approximate ? 5.0 : 0.0);
    slices.approximate_u = approximate;
    const SliceNet net = fit_slices(slices);
    const auto wheel = make_slice_surface(slices, kFlatRadius);
    for (const double yaw : {0.0, 0.03}) {
      const Mat3 turn = rotation_y(0.6);
      const PlaneGrid plane{{turn * Vec3(0, 0, kFlatRadius), turn * rotation({-0.3, yaw, 0.0})},
                            {-0.06, -0.05, 2.9e-3, 2.3e-3, 40, 40}};
      std::vector<double> z(plane.grid.size());
      wheel->heights(plane, {z, {}, {}});
      int hits = 0;
      for (int iy = 0; iy < plane.grid.ny; ++iy)
        for (int ix = 0; ix < plane.grid.nx; ++ix) {
          const double n = z[plane.grid.index(ix, iy)];
          if (std::isnan(n)) continue;
          ++hits;
          ASSERT_LT(radial_miss(net, plane.X_SP.apply({plane.grid.x(ix), plane.grid.y(iy), n})), kHeightTolerance);
        }
      EXPECT_GT(hits, 1000);
    }
  }
}

}  // namespace
}  // namespace treadmark::spline
