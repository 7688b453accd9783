// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/spline_gaps.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::io {
namespace {

constexpr double kNanometre = 1e-9;

/// A crowned rail with a dent, a wheel with waves and a dent.
sampling::PointGrid bent_grid(Body body, bool closed) {
  sampling::PointGrid out;
  out.body = body;
  out.closed = closed;
  const int nu = closed ? 400 : 90, ny = 60;
  const double length = body == Body::rail ? 0.42 : closed ? 2.0 * std::numbers::pi : 1.2;
  for (int i = 0; i < nu; ++i) out.u.push_back(-0.5 * length + length * i / (closed ? nu : nu - 1));
  for (int j = 0; j < ny; ++j) out.y.push_back(-0.042 + 0.084 * j / (ny - 1));
  for (const double u : out.u)
    for (const double y : out.y)
      out.h.push_back(body == Body::rail ? 3.0 * y * y + 3e-4 * std::exp(-4e3 * ((u - 0.05) * (u - 0.05) + y * y))
                                         : 0.46 - 2.0 * y * y + 2e-4 * std::sin(5.0 * u) * std::cos(60.0 * y) +
                                               3e-4 * std::exp(-400.0 * (u * u + 5.0 * y * y)));
  return out;
}

double greatest_difference_seen(const Surface& a, const Surface& b, double turned) {
  double most = 0.0;
  int found = 0;
  for (double x = -0.2; x < 0.2; x += 0.0071)
    for (double y = -0.04; y < 0.04; y += 0.0037) {
      const std::vector<Vec2> at{Vec2(x, y)};
      std::vector<double> za(1), zb(1);
      HeightsOut out_a, out_b;
      out_a.z = za, out_b.z = zb;
      const Pose plane{Vec3::Zero(), rotation_y(turned)};
      a.heights_at(plane, at, out_a);
      b.heights_at(plane, at, out_b);
      EXPECT_EQ(std::isnan(za[0]), std::isnan(zb[0])) << x << ' ' << y;
      if (std::isnan(za[0])) continue;
      ++found;
      most = std::max(most, std::abs(za[0] - zb[0]));
    }
  EXPECT_GT(found, 1000);
  return most;
}

TEST(SplineRoundTrip, HeightsAreTheSameWithinANanometre) {
  TREADMARK_NEEDS("expat");
  const OutputFolder folder(std::filesystem::temp_directory_path(), OutputFolder::Old::kept);
  const std::filesystem::path file = folder.path() / "surface.xml";
  for (const auto& [body, closed] : {std::pair{Body::rail, false}, {Body::wheel, false}, {Body::wheel, true}})
    for (const int degree : {0, 2, 3}) {
      const sampling::PointGrid points = bent_grid(body, closed);
      std::string note;
      const auto own =
          degree == 0 ? spline::make_nurbs_surface(points) : spline::make_thb_surface(points, degree, note);
      const SplineSurface told = degree == 0 ? spline::tell_nurbs(points) : spline::tell_thb(points, degree, note);
      write_splines(file, std::vector<SplineSurface>{told});
      const SplineFile read = read_splines(file);
      ASSERT_EQ(read.surfaces.size(), 1u);
      EXPECT_EQ(read.surfaces[0].hierarchical, degree > 0);
      EXPECT_EQ(spline::spline_gaps(read.surfaces, read.interfaces), "");
      const auto again = spline::make_given_surface(read.surfaces[0], body);
      EXPECT_EQ(again->backend(), own->backend());
      EXPECT_LT(greatest_difference_seen(*own, *again, 0.0), kNanometre);
      if (closed) {
        EXPECT_LT(greatest_difference_seen(*own, *again, std::numbers::pi), kNanometre) << "at the seam";
      }
    }
}

TEST(SplineRoundTrip, ArcsStayExact) {
  TREADMARK_NEEDS("expat");
  const OutputFolder folder(std::filesystem::temp_directory_path(), OutputFolder::Old::kept);
  const std::filesystem::path file = folder.path() / "arcs.xml";
  const ArcChain chain{-0.045, 0.0, -0.3, {{0.03, 10.0}, {0.03, 0.0}, {0.03, 10.0}}};
  for (const Body body : {Body::rail, Body::wheel}) {
    write_splines(file, std::vector<SplineSurface>{spline::tell_nurbs(chain, body, 0.46, -0.25, 0.25)});
    const SplineFile read = read_splines(file);
    EXPECT_FALSE(read.surfaces[0].weights.empty());
    EXPECT_LT(greatest_difference_seen(*spline::make_nurbs_surface(chain, body, 0.46, -0.25, 0.25),
                                       *spline::make_given_surface(read.surfaces[0], body), 0.0),
              kNanometre);
  }
}

}  // namespace
}  // namespace treadmark::io
