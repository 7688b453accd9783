// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Sections cut and hit by kernels: generic against AVX2, and against every cell taken by the careful raster.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "treadmark/backends/spline/grid_lines.hpp"
#include "treadmark/backends/spline/slices/fit_slices.hpp"
#include "treadmark/backends/spline/slices/slice_section.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/tests/backends/spline/test_planes.hpp"
#include "treadmark/tests/backends/spline/test_shapes.hpp"

namespace treadmark::spline {
namespace {

using testing::kRadius;

struct LineHits {
  std::vector<double> n, v, u, along, across;
  int careful_cells = 0;
};

SliceNet with_radius(SliceNet net) {
  for (int span = 0; span < net.spans(); ++span)
    for (int line = 0; line < net.lines(); ++line) {
      SliceNet::LineCubic cubic = net.line(span, line);
      cubic.power[0].w += kRadius;
      net.set_line(span, line, cubic);
    }
  return net;
}

// All cells, without regard to where they lie.
template <class Geometry>
std::vector<LineHits> lines_of(const SliceNet& net, const SliceHulls& hulls, const Pose& X, const SliceKernel& kernels,
                               bool careful_only) {
  const bool along_y = Geometry::lines_along_y(X.rotation);
  const Geometry geometry(kRadius);
  SectionWorkspace workspace;
  SliceSection<Geometry> section(net, hulls, geometry, X.rotation.col(along_y ? 0 : 1), X.rotation.col(along_y ? 1 : 0),
                                 X.rotation.col(2), X.origin, workspace, kernels);
  const Samples samples{-0.0413, 0.00037, 233};
  std::vector<LineHits> lines;
  for (int line = 0; line < 12; ++line) {
    ColumnHits hits(samples.count, Geometry::kTurns ? Facing::down : Facing::up);
    hits.clear_places();
    section.start_cut(-0.011 + 0.00193 * line);
    section.cut(0, net.cells());
    LineHits& result = lines.emplace_back();
    SectionRaster<SliceSection<Geometry>, ColumnHits> raster(section, samples, hits, hits.queue);
    const auto careful = [&](int k) {
      ++result.careful_cells;
      raster.cell(k, k + 1.0, section.start_of(k), k + 2.0, section.end_of(k));
    };
    const HitArrays arrays{hits.sign(), hits.n.data(), hits.cell.data(), hits.v.data(), hits.u.data()};
    if (careful_only)
      for (int k = 0; k < net.cells(); ++k) careful(k);
    else
      section.hit(0, net.cells(), {samples.first, samples.step, samples.count, kEdgeSlack}, arrays, careful);
    raster.finish();
    result.n = hits.n, result.v = hits.v, result.u = hits.u;
    result.along.resize(hits.u.size()), result.across.resize(hits.u.size());
    section.slopes_of(arrays, samples.count, {result.along.data(), result.across.data()});
    if (!careful_only) continue;
    for (std::size_t i = 0; i < hits.n.size(); ++i) {
      if (std::isnan(hits.n[i])) continue;
      const auto slopes = section.slopes(hits.cell[i], hits.v[i], hits.u[i]);
      result.along[i] = slopes.along, result.across[i] = slopes.across;
    }
  }
  return lines;
}

struct Compared {
  int hits = 0, cells = 0, careful_cells = 0;
};

template <class Geometry>
Compared compare(const SliceNet& net, const std::vector<Pose>& planes) {
  constexpr double kSameKernel = 1e-13, kSamePath = 1e-12;  // [m], per steepness
  constexpr double kSlope = 1e-9;
  const SliceHulls hulls(net);
  Compared compared;
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    const auto generic = lines_of<Geometry>(net, hulls, planes[plane], SliceKernel::generic, false);
    const auto careful = lines_of<Geometry>(net, hulls, planes[plane], SliceKernel::generic, true);
    const auto fast = lines_of<Geometry>(net, hulls, planes[plane], fastest_kernel<SliceKernel>(), false);
    for (std::size_t line = 0; line < generic.size(); ++line) {
      const LineHits &a = generic[line], &b = fast[line], &c = careful[line];
      compared.cells += net.cells(), compared.careful_cells += a.careful_cells;
      for (std::size_t i = 0; i < a.n.size(); ++i) {
        const std::string where =
            "plane " + std::to_string(plane) + " line " + std::to_string(line) + " sample " + std::to_string(i);
        EXPECT_EQ(std::isnan(a.n[i]), std::isnan(b.n[i])) << where;
        EXPECT_EQ(std::isnan(a.n[i]), std::isnan(c.n[i])) << where;
        EXPECT_EQ(std::isnan(a.n[i]), std::isnan(a.along[i])) << where;
        if (std::isnan(a.n[i]) || ::testing::Test::HasFailure()) continue;
        ++compared.hits;
        const double slope = std::hypot(c.along[i], c.across[i]), steep = 1.0 + slope;
        EXPECT_NEAR(a.n[i], b.n[i], kSameKernel * steep) << where;
        EXPECT_NEAR(a.n[i], c.n[i], kSamePath * steep) << where;
        const double tolerance = kSlope * (1.0 + slope * slope) * steep;
        EXPECT_NEAR(a.along[i], b.along[i], tolerance) << where;
        EXPECT_NEAR(a.across[i], b.across[i], tolerance) << where;
        EXPECT_NEAR(a.along[i], c.along[i], 1e2 * tolerance) << where;  // places agree to 1e-9 of a cell and better
        EXPECT_NEAR(a.across[i], c.across[i], 1e2 * tolerance) << where;
      }
    }
  }
  return compared;
}

TEST(SliceKernel, BendingRailEqualsTheCarefulPath) {
  const Compared all = compare<RailGeometry>(fit_slices(testing::bending_rail()), treadmark::testing::rail_planes());
  EXPECT_GT(all.hits, 5000);
  EXPECT_LT(all.careful_cells, all.cells);
}

TEST(SliceKernel, DentedWheelEqualsTheCarefulPath) {
  const Compared all = compare<WheelGeometry>(with_radius(fit_slices(testing::dented_wheel(1e-3, 0.02))),
                                              treadmark::testing::wheel_planes(kRadius));
  EXPECT_GT(all.hits, 8000);
  EXPECT_LT(all.careful_cells, all.cells);
}

TEST(SliceKernel, PlanesOverTheSeamOfAWheel) {
  const Pose X{{kRadius * std::sin(3.14), 0.0, kRadius * std::cos(3.14)},
               rotation_y(3.14) * rotation({0.03, 0.02, 0.01})};
  EXPECT_GT(compare<WheelGeometry>(with_radius(fit_slices(testing::dented_wheel(1e-3, 3.14))), {X}).hits, 1000);
}

TEST(SliceKernel, MissingPartsEqualTheCarefulPath) {
  SliceSet set;
  set.body = Body::rail;
  set.name = "flat with a part that ends";
  for (int i = 0; i < 40; ++i) {
    const double x = -0.04 + 2e-3 * i;
    set.u.push_back(x);
    set.profiles.push_back(
        testing::graph_profile(Body::rail, -30e-3, 30e-3, 61, [x](double y) { return 0.1 * x + y * y / 0.6; }));
    set.features.push_back({0.0, 35e-3, x < 1e-3 ? 1e3 : std::numeric_limits<double>::quiet_NaN()});
  }
  const SliceNet net = fit_slices(set);
  EXPECT_TRUE(std::isnan(net.line(net.spans() - 1, net.lines() - 1).power[0].w));
  EXPECT_GT(compare<RailGeometry>(
                net, {{Vec3::Zero(), rotation({0.02, 0.0, 0.01})}, {Vec3::Zero(), rotation({0.02, 0.3, 0.01})}})
                .hits,
            1000);
}

// Points on (u, y) joined by straight lines across, missing where height() says NaN.
template <class Height>
SliceNet straight_net(Body body, double u_step, const Height& height) {
  constexpr double kApart = 0.9973e-3;  // no sample at an edge, where either slope is right
  SliceSet stations;
  stations.body = body;
  std::vector<std::vector<NetPair>> rows;
  for (int i = 0; i < 90; ++i) {
    const double u = u_step * (i - 45);
    stations.u.push_back(u);
    auto& row = rows.emplace_back();
    for (int k = 0; k <= 60; ++k) {
      const double y = (body == Body::wheel ? -kApart : kApart) * (k - 30), w = height(u, y);
      row.push_back({std::isnan(w) ? w : y, w});
    }
  }
  stations.profiles.resize(stations.u.size());
  return join_straight(stations, rows);
}

TEST(SliceKernel, StraightCellsEqualTheCarefulPath) {
  const SliceNet rail =
      straight_net(Body::rail, 1e-3, [](double x, double y) { return y * y / 0.6 + 2e-5 * std::sin(400.0 * x); });
  EXPECT_GT(compare<RailGeometry>(rail, treadmark::testing::rail_planes()).hits, 5000);
  const SliceNet wheel = with_radius(straight_net(
      Body::wheel, 3e-3, [](double u, double y) { return -y * y / 0.8 + 1e-5 * std::cos(500.0 * u + 40.0 * y); }));
  EXPECT_GT(compare<WheelGeometry>(wheel, treadmark::testing::wheel_planes(kRadius)).hits, 5000);
}

TEST(SliceKernel, MissingStraightCellsEqualTheCarefulPath) {
  const SliceNet rail = straight_net(Body::rail, 1e-3, [](double x, double y) {
    const bool missing = (x > 0.0 && y > 11.5e-3) || (x < 3e-3 && std::abs(y + 8e-3) < 0.4e-3);
    return missing ? std::numeric_limits<double>::quiet_NaN() : y * y / 0.6 + 0.1 * x;
  });
  EXPECT_GT(compare<RailGeometry>(
                rail, {{Vec3::Zero(), rotation({0.02, 0.0, 0.01})}, {Vec3::Zero(), rotation({0.02, 0.3, 0.01})}})
                .hits,
            1000);
}

}  // namespace
}  // namespace treadmark::spline
