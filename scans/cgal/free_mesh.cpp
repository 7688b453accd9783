// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cgal/free_mesh.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <tuple>

#include "treadmark/core/error.hpp"
#include "treadmark/scans/cgal/advancing_front.hpp"
#include "treadmark/scans/cgal/mesh_holes.hpp"
#include "treadmark/scans/cgal/point_smoothing.hpp"
#include "treadmark/scans/cgal/point_thinning.hpp"
#include "treadmark/scans/strays/point_checks.hpp"
#include "treadmark/scans/strays/point_spacing.hpp"

namespace treadmark::scans {

namespace {

constexpr const char* kWhat = "free mesh";
constexpr std::size_t kLeastPoints = 100;
constexpr double kSpacing = 2.0;      // median spacings
constexpr double kLongestEdge = 3.5;  // spacings; thinned points of a closed surface lie up to 2.5 apart
constexpr double kLineWidth = 0.05;   // spacings; what is narrower is a line

void check(std::span<const Vec3> points, std::span<const Vec3> outward, const FreeMeshSettings& s) {
  const auto fail = [](const char* why) { throw Error(ErrorKind::configuration, std::string(kWhat) + ": " + why); };
  if (!(s.spacing >= 0.0) || !std::isfinite(s.spacing))
    fail("the spacing must be positive, or 0 for twice that of the data");
  if (s.smoothing_rounds < 0) fail("the number of smoothing rounds is negative");
  if (!(s.sharpness_deg > 0.0 && s.sharpness_deg < 90.0)) fail("the sharpness must lie between 0 and 90 degrees");
  if (!(s.hole_limit >= 0.0)) fail("the largest diameter of holes to fill is negative");
  check_points(points, kLeastPoints, kWhat);
  if (outward.size() != points.size())
    throw Error(ErrorKind::input_data, std::string(kWhat) + ": there must be one outward direction a point");
  for (std::size_t i = 0; i < outward.size(); ++i)
    if (!outward[i].allFinite() || outward[i].isZero(0.0))
      throw Error(ErrorKind::input_data,
                  std::string(kWhat) + ": the outward direction of point " + std::to_string(i) + " is none");
}

/// Indices of the distinct points by x, y, z: what follows does not depend on the order of the input.
std::vector<std::uint32_t> in_order(std::span<const Vec3> points, std::span<const Vec3> outward) {
  const auto key = [&](std::uint32_t i) {
    const Vec3 &p = points[i], &n = outward[i];
    return std::tuple(p.x(), p.y(), p.z(), n.x(), n.y(), n.z());
  };
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  order.erase(
      std::unique(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return points[a] == points[b]; }),
      order.end());
  return order;
}

/// Root mean square distance from the line that fits best.
double width(std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(spread / static_cast<double>(points.size()));
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[0] + eigen.eigenvalues()[1]));
}

[[noreturn]] void throw_no_surface() {
  throw Error(ErrorKind::input_data, std::string(kWhat) + ": no surface comes out of the points", {},
              "they may lie on a line, or the spacing may be too large for the part");
}

}  // namespace

TriangleMesh mesh_points(std::span<const Vec3> points, std::span<const Vec3> outward, const FreeMeshSettings& settings,
                         FreeMeshReport* report) {
  check(points, outward, settings);
  std::vector<Vec3> ordered, ordered_outward;
  for (const std::uint32_t i : in_order(points, outward)) {
    ordered.push_back(points[i]);
    ordered_outward.push_back(outward[i]);
  }
  const NormalisedPoints sized = normalise_points(ordered);
  const double spacing =
      settings.spacing > 0.0 ? settings.spacing : kSpacing * median_spacing(sized.points) * sized.unit;
  if (!(spacing > 0.0)) throw_no_surface();

  // From here on lengths are in spacings.
  const NormalisedPoints normal = normalise_points(ordered, spacing);
  std::vector<Vec3> thinned, thinned_outward;
  for (const std::uint32_t i : thin_points(normal.points, 1.0)) {
    thinned.push_back(normal.points[i]);
    thinned_outward.push_back(ordered_outward[i].normalized());
  }
  if (thinned.size() < 4 || width(thinned) < kLineWidth) throw_no_surface();
  smooth_points(thinned, thinned_outward, settings.sharpness_deg, settings.smoothing_rounds);

  TriangleMesh mesh;
  mesh.triangles = advance_front(thinned, kLongestEdge);
  if (mesh.triangles.empty()) throw_no_surface();
  mesh.vertices = thinned;
  const HoleReport holes = close_holes(mesh, thinned_outward, kLongestEdge, settings.hole_limit / spacing);
  for (Vec3& v : mesh.vertices) v = normal.corner + spacing * v;
  if (report != nullptr) *report = {thinned.size(), holes.holes, holes.filled, holes.largest_left * spacing};
  return mesh;
}

}  // namespace treadmark::scans
