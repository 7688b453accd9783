// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/free_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark::scans {
namespace {

constexpr double kStep = 0.5e-3;
constexpr double kNoise = 0.02e-3;  // standard deviation, of a laser scanner

struct Scan {
  std::vector<Vec3> points, outward;
};

double normal_noise(Random& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.uniform();  // Irwin-Hall: mean 0, variance 1
  return sum;
}

/// The cap of a sphere of radius R about the origin, up to 0.6 rad from the axis -z, less discs (angle to their
/// middle).
struct Disc {
  Vec3 middle;  // unit vector
  double angle;
};
constexpr double kRadius = 0.05, kCap = 0.6;

Scan cap(const std::vector<Disc>& holes, double noise) {
  Scan scan;
  Random random(5);
  const double area = 2.0 * std::numbers::pi * kRadius * kRadius * (1.0 - std::cos(kCap));
  for (int i = 0; i < static_cast<int>(area / (kStep * kStep)); ++i) {
    const double z = std::cos(kCap) + (1.0 - std::cos(kCap)) * random.uniform(),
                 turn = 2.0 * std::numbers::pi * random.uniform();
    const double flat = std::sqrt(1.0 - z * z), error = noise * normal_noise(random);
    const Vec3 n(flat * std::cos(turn), flat * std::sin(turn), -z);
    if (std::any_of(holes.begin(), holes.end(), [&](const Disc& d) { return n.dot(d.middle) > std::cos(d.angle); }))
      continue;
    scan.points.push_back((kRadius + error) * n);
    scan.outward.push_back((n + Vec3(0.3, -0.2, 0.1)).normalized());  // "roughly"
  }
  return scan;
}

Vec3 on_cap(double angle, double turn) {
  return {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), -std::cos(angle)};
}

Vec3 area_vector(const TriangleMesh& m, const std::array<std::uint32_t, 3>& t) {
  return 0.5 * (m.vertices[t[1]] - m.vertices[t[0]]).cross(m.vertices[t[2]] - m.vertices[t[0]]);
}

double total_area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) sum += area_vector(mesh, t).norm();
  return sum;
}

/// No directed edge twice (which a manifold that is turned one way has not); returns the number of closed rims.
std::size_t rims(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(++edges[std::pair(t[i], t[(i + 1) % 3])], 1);
  std::map<std::uint32_t, std::uint32_t> next;  // along the rims
  for (const auto& [edge, count] : edges)
    if (!edges.contains({edge.second, edge.first})) {
      EXPECT_TRUE(next.emplace(edge.second, edge.first).second);
    }
  std::size_t cycles = 0;
  while (!next.empty()) {
    ++cycles;
    for (auto at = next.begin(); at != next.end();) {
      const std::uint32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return cycles;
}

TEST(FreeMesh, OfASphereLiesOnItAndFacesOut) {
  const Scan scan = cap({}, kNoise);
  FreeMeshReport report;
  const TriangleMesh mesh = mesh_points(scan.points, scan.outward, {}, &report);
  EXPECT_EQ(rims(mesh), 1U);
  EXPECT_EQ(report.holes, 0U);
  double worst = 0.0, square = 0.0;
  for (const Vec3& v : mesh.vertices) {
    worst = std::max(worst, std::abs(v.norm() - kRadius));
    square += std::pow(v.norm() - kRadius, 2);
  }
  EXPECT_LT(worst, 2.5 * kNoise);
  EXPECT_LT(std::sqrt(square / static_cast<double>(mesh.vertices.size())), 0.6 * kNoise);  // smoothing helps
  for (const auto& t : mesh.triangles) EXPECT_GT(area_vector(mesh, t).dot(mesh.vertices[t[0]]), 0.0);
  const double truth = 2.0 * std::numbers::pi * kRadius * kRadius * (1.0 - std::cos(kCap));
  EXPECT_NEAR(total_area(mesh), truth, 0.04 * truth);  // half a triangle is missing all round the rim
  EXPECT_LT(mesh.vertices.size(), scan.points.size() / 2);
  EXPECT_LE(mesh.vertices.size(), report.thinned);
}

TEST(FreeMesh, FillsHolesUpToTheirLimit) {
  // Diameters 6, 10 and 16 mm, beside 60 mm of the cap.
  const Scan scan = cap({{on_cap(0.3, 0.0), 0.06}, {on_cap(0.35, 2.0), 0.1}, {on_cap(0.3, 4.0), 0.16}}, kNoise);
  const std::array<std::pair<double, std::size_t>, 4> cases{{{0.0, 0}, {8e-3, 1}, {13e-3, 2}, {25e-3, 3}}};
  for (const auto& [limit, filled] : cases) {
    FreeMeshReport report;
    const TriangleMesh mesh = mesh_points(scan.points, scan.outward, {.hole_limit = limit}, &report);
    EXPECT_EQ(report.holes, 3U);
    EXPECT_EQ(report.filled, filled);
    EXPECT_EQ(rims(mesh), 1U + 3U - filled);
    EXPECT_NEAR(report.largest_hole, filled < 3 ? 16e-3 : 0.0, filled < 3 ? 3.0 * kStep : 0.0);
    double worst = 0.0;
    for (const Vec3& v : mesh.vertices) worst = std::max(worst, std::abs(v.norm() - kRadius));
    // A flat lid over the largest hole would be 0.65 mm off its middle.
    EXPECT_LT(worst, 0.15e-3) << limit;
    for (const auto& t : mesh.triangles) EXPECT_GT(area_vector(mesh, t).dot(mesh.vertices[t[0]]), 0.0);
    const double truth = 2.0 * std::numbers::pi * kRadius * kRadius * (1.0 - std::cos(kCap));
    if (filled == 3) {
      EXPECT_NEAR(total_area(mesh), truth, 0.04 * truth);
    }
  }
}

TEST(FreeMesh, OfATubeHasTwoRimsAndNoHole) {
  Scan scan;
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const double turn = 2.0 * std::numbers::pi * random.uniform(), y = 0.03 * random.uniform();
    const Vec3 n(std::cos(turn), 0.0, std::sin(turn));
    scan.points.push_back(0.02 * n + Vec3(0.0, y, 0.0));
    scan.outward.push_back(-n);  // the bore of a tube: the material is outside
  }
  FreeMeshReport report;
  const TriangleMesh mesh = mesh_points(scan.points, scan.outward, {.hole_limit = 1.0}, &report);
  EXPECT_EQ(rims(mesh), 2U);
  EXPECT_EQ(report.holes, 0U);
  for (const Vec3& v : mesh.vertices) EXPECT_NEAR(std::hypot(v.x(), v.z()), 0.02, 0.02e-3);
  for (const auto& t : mesh.triangles)
    EXPECT_LT(area_vector(mesh, t).dot(Vec3(1, 0, 1).cwiseProduct(mesh.vertices[t[0]])), 0.0);
}

TEST(FreeMesh, OfAnOverhangingStepKeepsItsEdges) {
  // Upper face z = 0 for x < 0, a wall that leans back under it (no height over x, y), lower face z = 4 mm.
  Scan scan;
  Random random(9);
  const Vec3 foot(-2e-3, 0.0, 4e-3), wall_normal = Vec3(4.0, 0.0, 2.0).normalized();  // z down: up is -z
  const auto add = [&](const Vec3& p, const Vec3& n) {
    scan.points.push_back(p + 0.25 * kNoise * normal_noise(random) * n);
    scan.outward.push_back(n);
  };
  for (int i = 0; i < 9000; ++i) add({-0.03 * random.uniform(), 0.06 * random.uniform(), 0.0}, -Vec3::UnitZ());
  for (int i = 0; i < 1350; ++i) add(random.uniform() * foot + Vec3(0.0, 0.06 * random.uniform(), 0.0), wall_normal);
  for (int i = 0; i < 9000; ++i)
    add(foot + Vec3(0.03 * random.uniform(), 0.06 * random.uniform(), 0.0), -Vec3::UnitZ());
  const TriangleMesh mesh = mesh_points(scan.points, scan.outward, {}, nullptr);
  EXPECT_EQ(rims(mesh), 1U);
  const auto distance = [&](const Vec3& p) {
    const double along = std::clamp(Vec3(p.x(), 0.0, p.z()).dot(foot) / foot.squaredNorm(), 0.0, 1.0);
    const double wall = Vec3(p.x() - along * foot.x(), 0.0, p.z() - along * foot.z()).norm();
    const double up = std::hypot(std::max(0.0, p.x()), p.z()),
                 low = std::hypot(std::max(0.0, foot.x() - p.x()), p.z() - foot.z());
    return std::min({wall, up, low});
  };
  double worst = 0.0, square = 0.0;
  for (const Vec3& v : mesh.vertices) {
    worst = std::max(worst, distance(v));
    square += std::pow(distance(v), 2);
  }
  EXPECT_LT(worst, 0.4e-3);  // an edge is rounded off by less than a spacing of 1 mm
  EXPECT_LT(std::sqrt(square / static_cast<double>(mesh.vertices.size())), 0.05e-3);
  double under = 0.0;  // area that faces downwards: the wall
  for (const auto& t : mesh.triangles) {
    const Vec3 a = area_vector(mesh, t);
    if (a.dot(wall_normal) > 0.8 * a.norm()) under += a.norm();
  }
  const double wall = 0.06 * foot.norm();
  EXPECT_NEAR(under, wall, 0.3 * wall);
}

TEST(FreeMesh, IsTheSameForAnyOrderAndNumberOfThreads) {
  const Scan scan = cap({{on_cap(0.3, 0.0), 0.06}}, kNoise);
  const FreeMeshSettings settings{.hole_limit = 8e-3};
  const TriangleMesh expected = mesh_points(scan.points, scan.outward, settings);
  std::vector<std::size_t> order(scan.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(3);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  Scan shuffled;
  for (const std::size_t i : order) {
    shuffled.points.push_back(scan.points[i]);
    shuffled.outward.push_back(scan.outward[i]);
  }
  const ThreadLimit one(1);
  const TriangleMesh mesh = mesh_points(shuffled.points, shuffled.outward, settings);
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.triangles, expected.triangles);
}

TEST(FreeMesh, OfARegularPlaneGridIsWhole) {
  // All plane and full of ties.
  Scan scan;
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 40; ++j) scan.points.emplace_back(i * kStep, j * kStep, 0.0);
  scan.outward.assign(scan.points.size(), -Vec3::UnitZ());
  const TriangleMesh mesh = mesh_points(scan.points, scan.outward, {.spacing = kStep});
  EXPECT_EQ(mesh.vertices.size(), scan.points.size());
  EXPECT_EQ(mesh.triangles.size(), 2U * 60U * 40U);
  EXPECT_NEAR(total_area(mesh), 2400.0 * kStep * kStep, 1e-9);
  EXPECT_EQ(rims(mesh), 1U);
}

TEST(FreeMesh, BadInputIsAnError) {
  Scan scan = cap({}, 0.0);
  const auto kind = [&](const FreeMeshSettings& settings) {
    try {
      mesh_points(scan.points, scan.outward, settings);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::numerical;
  };
  EXPECT_EQ(kind({.spacing = -1.0}), ErrorKind::configuration);
  EXPECT_EQ(kind({.smoothing_rounds = -1}), ErrorKind::configuration);
  EXPECT_EQ(kind({.sharpness_deg = 90.0}), ErrorKind::configuration);
  EXPECT_EQ(kind({.hole_limit = -1.0}), ErrorKind::configuration);
  EXPECT_EQ(kind({.spacing = 1.0}), ErrorKind::input_data);  // one point is left
  scan.outward[3] = Vec3::Zero();
  EXPECT_EQ(kind({}), ErrorKind::input_data);
  scan.outward[3] = Vec3::UnitX();
  scan.points[4].z() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(kind({}), ErrorKind::input_data);
  scan.points[4].z() = 0.0;
  scan.outward.pop_back();
  EXPECT_EQ(kind({}), ErrorKind::input_data);
  scan.points.clear();
  for (int i = 0; i < 300; ++i) scan.points.emplace_back(i * 1e-3, i * 2e-3, i * 3e-3);
  scan.outward.assign(300, Vec3::UnitZ());
  EXPECT_EQ(kind({}), ErrorKind::input_data);  // a line
  scan.points.assign(300, Vec3::UnitX());
  EXPECT_EQ(kind({}), ErrorKind::input_data);
  scan.points.resize(99);
  scan.outward.resize(99);
  EXPECT_EQ(kind({}), ErrorKind::input_data);
}

}  // namespace
}  // namespace treadmark::scans
