// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/virtual/holes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans::scanner {
namespace {

constexpr double kLeastSize = 0.5, kGreatestSize = 1.5;  // diameter / mean diameter
constexpr double kLeastAspect = 0.5;                     // short axis / long axis
constexpr double kMostHoles = 2e5;
constexpr double kGoodEnough = 0.02;                 // of the wanted area, may be missing
constexpr double kCircle = 0.25 * std::numbers::pi;  // area / diameter^2

}  // namespace

bool Holes::Hole::contains(const Vec3& p) const {
  const Vec3 d = p - middle;
  const double a = d.dot(axis_1), b = d.dot(axis_2);
  return a * a + b * b < 1.0 && std::fabs(d.dot(normal)) < depth;
}

std::uint64_t Holes::cell(const Vec3& p) const {
  // far cells may share a number: what lies in a hole is decided by its equation
  const auto index = [&](double x) {
    return static_cast<std::uint64_t>(to_whole<std::int64_t>(std::floor(x / cell_size_))) & 0x1fffffu;
  };
  return index(p.x()) << 42 | index(p.y()) << 21 | index(p.z());
}

std::vector<std::uint64_t> Holes::cells(const Hole& hole) const {
  // a ball is not wider than two cells
  std::vector<std::uint64_t> found;
  for (const double dx : {-1.0, 0.0, 1.0})
    for (const double dy : {-1.0, 0.0, 1.0})
      for (const double dz : {-1.0, 0.0, 1.0}) found.push_back(cell(hole.middle + hole.radius * Vec3(dx, dy, dz)));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool Holes::contains(const Vec3& position_S) const {
  if (holes_.empty()) return false;
  const auto found = holes_near_.find(cell(position_S));
  if (found == holes_near_.end()) return false;
  return std::any_of(found->second.begin(), found->second.end(),
                     [&](std::uint32_t i) { return holes_[i].contains(position_S); });
}

Holes::Hole Holes::draw(const Patch& patch, Body body, double size, double largest_area, Draws& draws) const {
  const double diameter = size * draws.uniform(kLeastSize, kGreatestSize), aspect = draws.uniform(kLeastAspect, 1.0);
  const double shrink = std::min(1.0, std::sqrt(largest_area / (kCircle * diameter * diameter)));
  const double a = 0.5 * shrink * diameter / std::sqrt(aspect), b = a * aspect,
               angle = draws.uniform(0.0, std::numbers::pi);
  const Vec3 along = natural_plane(body, patch.u).rotation.col(0), across = patch.normal_S.cross(along);
  constexpr double kLeastAcross = 1e-6;
  const Vec3 v = across.norm() > kLeastAcross ? across.normalized() : patch.normal_S.unitOrthogonal(),
             u = v.cross(patch.normal_S);
  Hole hole;
  hole.middle = patch.position_S + draws.uniform(-0.5, 0.5) * patch.area / patch.length * u +
                draws.uniform(-0.5, 0.5) * patch.length * v;
  hole.axis_1 = (std::cos(angle) * u + std::sin(angle) * v) / a;
  hole.axis_2 = (std::cos(angle) * v - std::sin(angle) * u) / b;
  hole.normal = patch.normal_S;
  hole.depth = std::max(a, 0.25 * cell_size_);
  hole.radius = std::hypot(a, hole.depth);
  return hole;
}

Holes::Holes(const FirstLook& part, Body body, double share, double size, std::uint64_t seed) {
  const double wanted = share * part.area;
  if (wanted > kMostHoles * kCircle * size * size)
    throw Error(
        ErrorKind::configuration,
        fmt::format("holes of {:.3g} mm are too small to cover {:.3g} % of this surface", 1e3 * size, 1e2 * share), {},
        "ask for larger holes");
  // no ball round a hole is wider than two cells
  cell_size_ = 0.5 * kGreatestSize * size / std::sqrt(kLeastAspect) * std::numbers::sqrt2;

  Cells patches_in;
  std::vector<double> up_to(part.patches.size());  // a hole may be anywhere with the same chance
  double sum = 0.0;
  for (std::size_t i = 0; i < up_to.size(); ++i) {
    patches_in[cell(part.patches[i].position_S)].push_back(static_cast<std::uint32_t>(i));
    up_to[i] = sum += part.patches[i].area;
  }
  std::vector<bool> covered(part.patches.size(), false);
  double missing = wanted;
  Draws draws(seed, Purpose::holes);
  while (missing > kGoodEnough * wanted) {
    const double at = draws.uniform(0.0, sum);
    const auto which = static_cast<std::size_t>(std::upper_bound(up_to.begin(), up_to.end(), at) - up_to.begin());
    const Hole hole = draw(part.patches[std::min(which, up_to.size() - 1)], body, size, missing, draws);
    for (const std::uint64_t c : cells(hole)) {
      holes_near_[c].push_back(static_cast<std::uint32_t>(holes_.size()));
      const auto near = patches_in.find(c);
      if (near == patches_in.end()) continue;
      for (const std::uint32_t i : near->second)
        if (!covered[i] && hole.contains(part.patches[i].position_S)) {
          covered[i] = true;
          missing -= part.patches[i].area;
        }
    }
    holes_.push_back(hole);
  }
}

}  // namespace treadmark::scans::scanner
