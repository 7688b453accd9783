// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <limits>

#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/tests/backends/mesh/mesh_shapes.hpp"

namespace treadmark::mesh {
namespace {

using namespace testing;

TriangleMesh small_rail() { return rail_net(0.0, 0.02, 5, 7, arc_section(0.3, 0.05)); }
TriangleMesh small_wheel() { return wheel_net(-0.03, 0.03, 7, 0.1, 9, barrel(0.46, 0.5)); }

MeshRepair repair_of(const TriangleMesh& mesh, Body body) {
  MeshRepair repair;
  make_mesh_surface(mesh, body, {}, &repair);
  return repair;
}

void expect_refused(const TriangleMesh& mesh, Body body, const std::string& part) {
  for (const auto make : {make_mesh_surface, make_mesh_oracle}) {
    try {
      make(mesh, body, {}, nullptr);
      ADD_FAILURE() << "not refused: " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_data);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(mesh.name), std::string::npos) << error.what();
    }
  }
}

/// Every triangle with vertices of its own, as in an .stl file.
TriangleMesh exploded(const TriangleMesh& mesh, double noise) {
  TriangleMesh soup;
  soup.name = mesh.name;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-noise, noise);
  for (const auto& c : mesh.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : c)
      soup.vertices.push_back(mesh.vertices[v] + Vec3(unit(random), unit(random), unit(random)));
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  return soup;
}

TEST(PrepareMesh, ASoundMeshStaysAsItIs) {
  const TriangleMesh wheel = wheel_net(-0.03, 0.03, 7, kPi, 60, barrel(0.46, 0.5));
  const MeshRepair repair = repair_of(wheel, Body::wheel);
  EXPECT_EQ(repair.merged_vertices + repair.degenerate + repair.duplicates + repair.unused_vertices, 0u);
  EXPECT_EQ(repair.parts, 1u);
  EXPECT_EQ(repair.boundary_loops, 2u);
}

TEST(PrepareMesh, MergesTheVerticesOfASoup) {
  const TriangleMesh rail = small_rail();
  const TriangleMesh soup = exploded(rail, 1e-12);
  const MeshRepair repair = repair_of(soup, Body::rail);
  EXPECT_EQ(repair.merged_vertices, soup.vertices.size() - rail.vertices.size());
  EXPECT_EQ(repair.parts, 1u);
  EXPECT_EQ(repair.boundary_loops, 1u);
}

TEST(PrepareMesh, MergesAtWorldCoordinates) {
  TriangleMesh rail = exploded(small_rail(), 0.0);
  shift(rail, {100.0, -3.0, 0.2});
  EXPECT_EQ(repair_of(rail, Body::rail).boundary_loops, 1u);
}

TEST(PrepareMesh, KeepsDistantVerticesApart) {
  // 1e-6 m is a thousand times the tolerance of this mesh
  const TriangleMesh soup = exploded(small_rail(), 1e-6);
  EXPECT_EQ(repair_of(soup, Body::rail).merged_vertices, 0u);
  EXPECT_EQ(repair_of(soup, Body::rail).parts, soup.triangles.size());
}

/// As documented, point by point.
std::vector<std::uint32_t> merged_one_by_one(const std::vector<Vec3>& points, double tolerance) {
  std::vector<std::uint32_t> same(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    same[i] = i;
    for (std::uint32_t j = 0; j < i && same[i] == i; ++j)
      if (same[j] == j && (points[i] - points[j]).norm() <= tolerance) same[i] = j;
  }
  return same;
}

TEST(PrepareMesh, MergesChainsAndCrowdsAsOneByOne) {
  constexpr double kTolerance = 1e-3;
  for (const double size : {0.003, 0.03, 0.3}) {
    Random random(11);
    std::vector<Vec3> points;
    for (int i = 0; i < 1500; ++i) {
      points.emplace_back(size * random.uniform(), size * random.uniform(), 0.2 * size * random.uniform());
      if (i % 5 == 0) points.push_back(points[static_cast<std::size_t>(random.uniform() * i)]);  // at the place
      if (i % 7 == 0) points.emplace_back(points.back() + Vec3(0.7 * kTolerance, 0.0, 0.0));     // chains
      if (i % 7 == 0) points.emplace_back(points.back() + Vec3(0.7 * kTolerance, 1e-5 * size, 0.0));
    }
    EXPECT_EQ(merge_close(points, kTolerance), merged_one_by_one(points, kTolerance)) << size;
  }
}

TEST(PrepareMesh, CountsWhatItDrops) {
  TriangleMesh rail = small_rail();
  rail.triangles.push_back(rail.triangles[3]);
  rail.triangles.push_back({rail.triangles[4][2], rail.triangles[4][0], rail.triangles[4][1]});
  rail.triangles.push_back({0, 0, 1});
  const auto n = static_cast<std::uint32_t>(rail.vertices.size());
  rail.vertices.push_back(0.5 * (rail.vertices[0] + rail.vertices[1]));
  rail.triangles.push_back({0, 1, n});
  rail.vertices.push_back(Vec3(0.0, 0.0, 0.001));
  const MeshRepair repair = repair_of(rail, Body::rail);
  EXPECT_EQ(repair.duplicates, 2u);
  EXPECT_EQ(repair.degenerate, 2u);
  EXPECT_EQ(repair.unused_vertices, 2u);
  EXPECT_EQ(repair.boundary_loops, 1u);
}

TEST(PrepareMesh, TurnsTrianglesToOneSideAndOutwards) {
  for (const Body body : {Body::wheel, Body::rail}) {
    const TriangleMesh sound = body == Body::wheel ? small_wheel() : small_rail();
    const Pose X = body == Body::wheel ? pose({0.0, 0.001, 0.45}) : pose({0.011, 0.001, 0.0});
    const double expected = height_at(*make_mesh_surface(sound, body), X, {0.0003, 0.0002});
    ASSERT_FALSE(std::isnan(expected));
    TriangleMesh turned = sound;
    for (auto& c : turned.triangles) std::swap(c[0], c[1]);
    const MeshRepair one = repair_of(sound, body), other = repair_of(turned, body);
    EXPECT_EQ(one.flipped, 0u);
    EXPECT_EQ(other.flipped, 0u);
    EXPECT_NE(one.turned_inside_out, other.turned_inside_out);
    EXPECT_NEAR(height_at(*make_mesh_surface(turned, body), X, {0.0003, 0.0002}), expected, 1e-15);
    for (std::size_t t = 0; t < turned.triangles.size(); t += 5)
      std::swap(turned.triangles[t][1], turned.triangles[t][2]);
    EXPECT_EQ(repair_of(turned, body).flipped, (turned.triangles.size() + 4) / 5);
    EXPECT_NEAR(height_at(*make_mesh_surface(turned, body), X, {0.0003, 0.0002}), expected, 1e-15);
  }
}

TEST(PrepareMesh, ClosedPartsEncloseMaterial) {
  // a cube on the rail's place, all faces inwards
  TriangleMesh cube;
  cube.name = "cube";
  for (int i = 0; i < 8; ++i) cube.vertices.push_back(0.05 * Vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
  cube.triangles = {{0, 1, 2}, {1, 3, 2}, {4, 6, 5}, {5, 6, 7}, {0, 4, 1}, {1, 4, 5},
                    {2, 3, 6}, {3, 7, 6}, {0, 2, 4}, {2, 6, 4}, {1, 5, 3}, {3, 5, 7}};
  MeshRepair repair;
  const auto surface = make_mesh_surface(cube, Body::rail, {}, &repair);
  EXPECT_TRUE(repair.turned_inside_out);
  EXPECT_EQ(repair.boundary_loops, 0u);
  EXPECT_NEAR(height_at(*surface, pose({0.02, 0.03, 0.0}), {0.0, 0.0}), 0.0, 1e-15);
  // seen from the other end the opposite face is the outer one
  EXPECT_NEAR(height_at(*surface, pose({0.02, 0.03, 0.0}, kPi), {0.0, 0.0}), -0.05, 1e-15);
}

TEST(PrepareMesh, RefusesWhatIsNoSurface) {
  TriangleMesh rail = small_rail();
  rail.name = "bad mesh";
  TriangleMesh m = rail;
  m.triangles.clear();
  expect_refused(m, Body::rail, "no triangles");
  m = rail;
  m.triangles[7][1] = 1000;
  expect_refused(m, Body::rail, "vertex 1000 in triangle 7");
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
    m = rail;
    m.vertices[11].y() = bad;
    expect_refused(m, Body::rail, "not finite at vertex 11");
  }
  m = rail;
  m.vertices.push_back(Vec3(0.01, 0.0, -0.01));
  m.triangles.push_back({m.triangles[20][0], m.triangles[20][1], static_cast<std::uint32_t>(m.vertices.size() - 1)});
  m.vertices.push_back(Vec3(0.01, 0.0, -0.02));
  m.triangles.push_back({m.triangles[20][0], m.triangles[20][1], static_cast<std::uint32_t>(m.vertices.size() - 1)});
  expect_refused(m, Body::rail, "triangles, from (");
  m = rail;
  for (auto& c : m.triangles) c[1] = c[0];
  expect_refused(m, Body::rail, "without area");
}

TEST(PrepareMesh, RefusesMoebiusBands) {
  TriangleMesh band = net(40, 2, [](int i, int j) {
    const double a = 2.0 * kPi * i / 40, w = j == 0 ? -0.01 : 0.01;
    const double r = 0.1 + w * std::cos(0.5 * a);
    return Vec3(r * std::cos(a), r * std::sin(a), w * std::sin(0.5 * a));
  });
  // join the ends with a half turn
  band.triangles.push_back({39, 0, 79});
  band.triangles.push_back({39, 40, 0});
  band.name = "band";
  expect_refused(band, Body::rail, "Moebius");
}

TEST(PrepareMesh, GuessesWrongUnits) {
  TriangleMesh wheel = small_wheel(), rail = small_rail();
  for (Vec3& v : wheel.vertices) v *= 1e3;
  expect_refused(wheel, Body::wheel, "is the factor from the units of the file");
  for (Vec3& v : wheel.vertices) v *= 1e-6;
  expect_refused(wheel, Body::wheel, "is the file in metres?");
  TriangleMesh tiny = rail;
  for (Vec3& v : rail.vertices) v *= 1e3;
  expect_refused(rail, Body::rail, "is the factor from the units of the file");
  for (Vec3& v : tiny.vertices) v *= 1e-3;
  expect_refused(tiny, Body::rail, "is the file in metres?");
  // positions say nothing
  rail = small_rail();
  shift(rail, {1000.0, 50.0, -20.0});
  EXPECT_NO_THROW(make_mesh_surface(rail, Body::rail));
}

TEST(PrepareMesh, RefusesAnImpossibleCreaseAngle) {
  MeshOptions options;
  options.crease_angle = kNaN;
  EXPECT_THROW(make_mesh_surface(small_rail(), Body::rail, options), Error);
}

}  // namespace
}  // namespace treadmark::mesh
