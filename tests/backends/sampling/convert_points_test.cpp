// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/convert_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/sampling/sample_points.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::sampling {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PointGrid flat_rail(std::size_t nu, std::size_t ny) {
  PointGrid grid;
  for (std::size_t i = 0; i < nu; ++i) grid.u.push_back(1e-3 * static_cast<double>(i));
  for (std::size_t i = 0; i < ny; ++i) grid.y.push_back(1e-3 * static_cast<double>(i));
  grid.h.assign(nu * ny, 0.01);
  return grid;
}

/// How often each directed edge occurs.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++count[{t[static_cast<std::size_t>(k)], t[static_cast<std::size_t>((k + 1) % 3)]}];
  return count;
}

TEST(ToMesh, TrianglesFaceOutOfARail) {
  const TriangleMesh mesh = to_mesh(flat_rail(4, 5), "rail");
  ASSERT_EQ(mesh.triangles.size(), 2u * 3u * 4u);
  for (const auto& t : mesh.triangles) {
    const Vec3 n = (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    EXPECT_LT(n.z(), 0.0);
  }
}

TEST(ToMesh, AWholeWheelHasOnlyItsTwoRims) {
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46);
  const PointGrid grid = sample_points(*wheel, Body::wheel, 0.46, {10e-3, 0.0, {}});
  const TriangleMesh mesh = to_mesh(grid, "wheel");
  std::size_t open = 0;
  const auto all = edges(mesh);
  for (const auto& [edge, n] : all) {
    ASSERT_EQ(n, 1);
    open += all.contains({edge.second, edge.first}) ? 0u : 1u;
  }
  EXPECT_EQ(open, 2 * grid.u.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 n = (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    const Vec3 middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    EXPECT_GT(n.dot(Vec3(middle.x(), 0.0, middle.z())), 0.0);
  }
}

TEST(ToMesh, LeavesHolesWherePointsAreMissing) {
  PointGrid grid = flat_rail(5, 5);
  grid.h[grid.index(2, 2)] = kNaN;
  const TriangleMesh mesh = to_mesh(grid, "rail");
  // each of the four cells round the missing point keeps the triangle of its other three corners
  EXPECT_EQ(mesh.triangles.size(), 2u * 16u - 4u);
  EXPECT_EQ(mesh.vertices.size(), 24u);
}

TEST(ToSlices, KeepsThePointsAndClosesAWheel) {
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46);
  const PointGrid grid = sample_points(*wheel, Body::wheel, 0.46, {20e-3, 0.0, {}});
  const SliceSet slices = to_slices(grid, 0.46, "wheel");
  ASSERT_EQ(slices.u.size(), grid.u.size() + 1);
  EXPECT_NEAR(slices.u.back() - slices.u.front(), 2.0 * std::acos(-1.0), 1e-12);
  const Profile& p = slices.profiles[3];
  ASSERT_EQ(p.y.size(), grid.y.size());
  EXPECT_GT(p.y.front(), p.y.back());  // wheels run with decreasing y
  EXPECT_DOUBLE_EQ(p.z.front(), grid.h[grid.index(3, grid.y.size() - 1)] - 0.46);
}

TEST(ToSlices, RefusesGapsAndTooFewPoints) {
  PointGrid gap = flat_rail(5, 6);
  gap.h[gap.index(1, 3)] = kNaN;
  EXPECT_THROW(to_slices(gap, 0.0, "rail"), Error);
  PointGrid narrow = flat_rail(5, 6);
  for (std::size_t iy = 0; iy < 3; ++iy) narrow.h[narrow.index(4, iy)] = kNaN;
  EXPECT_THROW(to_slices(narrow, 0.0, "rail"), Error);
}

TEST(MedianSection, IsTheUndamagedShape) {
  WheelFlat flat;
  flat.length = 0.1;
  flat.depth = 1e-3;
  const auto round = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46);
  const auto flatted = analytic::make_standard_surface({"S1002"}, Body::wheel, 0.46, {flat});
  const SampleSettings settings{5e-3, 0.0, {}};
  const Profile section = median_section(sample_points(*flatted, Body::wheel, 0.46, settings), 0.46, "wheel");
  for (std::size_t i = 1; i + 1 < section.y.size(); ++i) {
    const double r = height_at(*round, Pose{}, {0.0, section.y[i]});
    EXPECT_NEAR(section.z[i] + 0.46, r, 1e-12) << section.y[i];
  }
}

}  // namespace
}  // namespace treadmark::sampling
