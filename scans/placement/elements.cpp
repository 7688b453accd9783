// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/elements.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/scans/placement/voxels.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kFewestPoints = 100;
constexpr double kWantedPerVoxel = 30.0;
constexpr double kFewestPerVoxel = 1.5;  // 27 cubes of which a plane meets 9 or more
constexpr std::size_t kMostVoxels = 250'000;
constexpr std::size_t kFewestInSurroundings = 8;
constexpr double kFlatElement = 0.03;  // least to middle eigenvalue
constexpr double kBroad = 0.05;        // middle to greatest eigenvalue: no line
constexpr double kEnoughFlat = 0.85;
constexpr double kMostlyFlat = 0.5;
constexpr double kLeastFlat = 0.25;
constexpr double kClearGain = 0.08;
constexpr std::size_t kFewestElements = 20;

struct Extent {
  Vec3 centre;
  double radius;
};

/// Box of the middle 98 % of the points in each axis.
Extent extent_of(std::span<const Vec3> points, std::span<const std::uint8_t> keep) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 200'000);
  Vec3 centre = Vec3::Zero(), half = Vec3::Zero();
  parallel_for(3, [&](std::size_t k) {
    const auto axis = static_cast<Eigen::Index>(k);
    std::vector<double> values;
    values.reserve(points.size() / stride + 1);
    for (std::size_t i = 0; i < points.size(); i += stride)
      if (keep.empty() || keep[i] != 0) values.push_back(points[i][axis]);
    if (values.empty()) return;
    const std::size_t low = values.size() / 100, high = values.size() - 1 - low;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(low), values.end());
    const double least = values[low];
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(high), values.end());
    centre[axis] = 0.5 * (least + values[high]);
    half[axis] = 0.5 * (values[high] - least);
  });
  return {centre, half.norm()};
}

struct Moments {
  double count = 0.0;
  Vec3 sum = Vec3::Zero();
  Mat3 square = Mat3::Zero();
};

SurfaceElements elements_of(std::span<const Vec3> points, const Voxels& voxels, const Extent& extent) {
  constexpr std::size_t kBlock = 256;  // voxels
  const auto for_all = [&](const auto& body) {
    parallel_blocks(voxels.count(), kBlock, [&](std::size_t from, std::size_t to) {
      for (std::size_t v = from; v < to; ++v) body(v);
    });
  };
  std::vector<Moments> moments(voxels.count());
  for_all([&](std::size_t v) {
    Moments& m = moments[v];
    for (const std::uint32_t i : voxels.points_of(v)) {
      const Vec3 p = points[i] - extent.centre;
      m.count += 1.0;
      m.sum += p;
      m.square += p * p.transpose();
    }
  });
  SurfaceElements out;
  out.size = voxels.size();
  out.centre = extent.centre;
  out.radius = extent.radius;
  std::vector<Vec3> normal(voxels.count());
  std::vector<float> weight(voxels.count(), 0.0f);
  for_all([&](std::size_t v) {
    Moments around;
    voxels.neighbours(v, [&](std::size_t other) {
      around.count += moments[other].count;
      around.sum += moments[other].sum;
      around.square += moments[other].square;
    });
    if (around.count < kFewestInSurroundings) return;
    const Vec3 mean = around.sum / around.count;
    Eigen::SelfAdjointEigenSolver<Mat3> eigen(around.square / around.count - mean * mean.transpose());
    const Vec3 values = eigen.eigenvalues().cwiseMax(0.0);
    if (!(values[1] > kBroad * values[2]) || !(values[0] < kFlatElement * values[1])) return;
    normal[v] = eigen.eigenvectors().col(0);
    weight[v] = static_cast<float>(1.0 - values[0] / (kFlatElement * values[1]));
  });
  double all = 0.0, flat = 0.0;
  for (std::size_t v = 0; v < voxels.count(); ++v) {
    all += moments[v].count;
    if (!(weight[v] > 0.0f)) continue;
    flat += moments[v].count;
    out.position.emplace_back(extent.centre + moments[v].sum / moments[v].count);
    out.normal.push_back(normal[v]);
    out.weight.push_back(weight[v]);
  }
  out.flat_part = all > 0.0 ? flat / all : 0.0;
  // a plane cuts about 1.5 cubes for each face area of a cube
  constexpr double kCubesPerFace = 1.5;
  if (out.flat_part >= kLeastFlat)
    out.spacing = voxels.size() * std::sqrt(static_cast<double>(out.position.size()) / kCubesPerFace / flat);
  else if (all > 0.0)
    out.spacing = voxels.size() * std::sqrt(static_cast<double>(voxels.count()) / kCubesPerFace / all);
  return out;
}

}  // namespace

SurfaceElements look_for_elements(std::span<const Vec3> points, std::span<const std::uint8_t> keep) {
  const auto kept =
      keep.empty() ? points.size()
                   : static_cast<std::size_t>(std::count_if(keep.begin(), keep.end(), [](auto k) { return k != 0; }));
  if (kept < kFewestPoints)
    throw Error(ErrorKind::input_data, fmt::format("{} points are too few to find a surface in them", kept), {},
                "a scan has thousands of points");
  const Extent extent = extent_of(points, keep);
  if (!(extent.radius > 0.0))
    throw Error(ErrorKind::input_data, "nearly all points of the scan lie at one place", {},
                "are the columns of the file the coordinates?");

  // points in a cube grow with its face: from one look to the wanted number
  double size = extent.radius / 100.0;
  for (int round = 0; round < 3; ++round) {
    const Voxels look(points, extent.centre, size, keep);
    std::size_t inside = 0;
    std::vector<std::size_t> counts(look.count());
    for (std::size_t v = 0; v < look.count(); ++v) inside += counts[v] = look.points_of(v).size();
    // the cube in which the median point lies
    std::sort(counts.begin(), counts.end());
    std::size_t sum = 0, typical = 1;
    for (const std::size_t c : counts) {
      sum += c;
      typical = c;
      if (2 * sum >= inside) break;
    }
    const double by_points = std::sqrt(kWantedPerVoxel / static_cast<double>(typical));
    const double by_voxels = std::sqrt(static_cast<double>(look.count()) / static_cast<double>(kMostVoxels));
    const double factor = std::clamp(std::max(by_points, by_voxels), 0.1, 10.0);
    size = std::min(size * factor, extent.radius / 5.0);
    if (factor > 0.7 && factor < 1.4) break;
  }
  SurfaceElements best;
  const auto try_size = [&](const Voxels& voxels) {
    SurfaceElements found = elements_of(points, voxels, extent);
    // another size only for a clear gain: larger cubes blur the normals, smaller ones follow the noise
    if (best.size == 0.0 || found.flat_part > best.flat_part + kClearGain) best = std::move(found);
    return best.flat_part > kEnoughFlat;
  };
  constexpr double kStep = 1.6;
  bool enough = try_size(Voxels(points, extent.centre, size, keep));
  for (double s = kStep * size; !enough && s < extent.radius / 3.0; s *= kStep)
    enough = try_size(Voxels(points, extent.centre, s, keep));
  // a surface that turns within all of these shows in smaller ones, as long as they hold points
  enough = enough || (best.flat_part >= kMostlyFlat && best.position.size() >= kFewestElements);
  for (double s = size / kStep; !enough && s > size * std::sqrt(kFewestPerVoxel / kWantedPerVoxel); s /= kStep) {
    const Voxels voxels(points, extent.centre, s, keep);
    if (voxels.count() > kMostVoxels) break;
    enough = try_size(voxels);
  }
  return best;
}

void require_surface(const SurfaceElements& elements) {
  if (elements.flat_part < kLeastFlat || elements.position.size() < kFewestElements)
    throw Error(ErrorKind::input_data,
                fmt::format("the points do not form a surface: only {:.0f} % of them lie in flat surroundings",
                            100.0 * elements.flat_part),
                {}, "is this the right file? remove everything that is not the wheel or rail");
}

SurfaceElements find_elements(std::span<const Vec3> points, std::span<const std::uint8_t> keep) {
  SurfaceElements out = look_for_elements(points, keep);
  require_surface(out);
  return out;
}

}  // namespace treadmark::scans
