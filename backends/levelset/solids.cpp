// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/levelset/block_index.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::levelset {

namespace {

using Block = DistanceGrid::Block;
using Place = BlockIndex::Place;
constexpr int kAlong = DistanceGrid::kEdge, kNodes = DistanceGrid::kNodes;
constexpr float kFar = static_cast<float>(kHalfWidth);

BlockIndex index_of(const DistanceGrid& grid) {
  BlockIndex index(grid.blocks.size());
  for (std::size_t b = 0; b < grid.blocks.size(); ++b) index.put(grid.blocks[b].first, static_cast<std::uint32_t>(b));
  return index;
}

/// Distances with a value everywhere: beyond the band kFar outside and -kFar inside.
class Filled {
 public:
  explicit Filled(DistanceGrid grid) : grid_(std::move(grid)), index_(index_of(grid_)) {
    parallel_blocks(grid_.blocks.size(), kBlocksAtOnce, [&](std::size_t from, std::size_t to) {
      for (std::size_t b = from; b < to; ++b) fill(grid_.blocks[b]);
    });
    for (std::size_t b = 0; b < grid_.blocks.size(); ++b) {
      const Place& p = grid_.blocks[b].first;
      rows_[{p[1], p[2]}][p[0]] = grid_.blocks[b].value.front();
    }
  }

  const DistanceGrid& grid() const { return grid_; }
  /// nullptr: there is none, see beyond.
  const Block* block(const Place& at) const {
    const std::int32_t found = index_.find(at);
    return found < 0 ? nullptr : &grid_.blocks[static_cast<std::size_t>(found)];
  }
  /// What all nodes of a block have that there is not: the sign of the next one along x, between which the surface is
  /// not; without one it lies outside.
  float beyond(const Place& at) const {
    const auto row = rows_.find({at[1], at[2]});
    if (row == rows_.end()) return kFar;
    const auto next = row->second.upper_bound(at[0]);
    return next == row->second.end() || next->second > 0.0f ? kFar : -kFar;
  }

 private:
  /// What is not known has the sign of what is beside it.
  static void fill(Block& block) {
    std::array<char, kNodes> seen{};
    std::vector<int> front;
    for (int n = 0; n < kNodes; ++n)
      if (block.knows(n)) seen[static_cast<std::size_t>(n)] = 1, front.push_back(n);
    for (std::size_t i = 0; i < front.size(); ++i) {
      const int n = front[i];
      for (const int step : {1, 8, 64})
        for (const int apart : {-step, step}) {
          const int along = n / step % kAlong + (apart > 0 ? 1 : -1);
          if (along < 0 || along >= kAlong) continue;
          const auto other = static_cast<std::size_t>(n + apart);
          if (seen[other] != 0) continue;
          seen[other] = 1;
          block.value[other] = std::copysign(kFar, block.value[static_cast<std::size_t>(n)]);
          front.push_back(n + apart);
        }
    }
  }

  DistanceGrid grid_;
  BlockIndex index_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::map<std::int32_t, float>> rows_;
};

float combined(Solid::Use use, float a, float b) {
  if (use == Solid::Use::join) return std::min(a, b);
  return std::max(a, use == Solid::Use::cut ? -b : b);
}

DistanceGrid combined(const Filled& a, const Filled& b, Solid::Use use) {
  std::set<Place> places;
  for (const Filled* of : {&a, &b})
    for (const Block& block : of->grid().blocks) places.insert(block.first);
  const std::vector<Place> all(places.begin(), places.end());
  std::vector<Block> blocks(all.size());
  std::vector<char> used(all.size(), 0);
  parallel_blocks(all.size(), kBlocksAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      Block& out = blocks[i];
      out.first = all[i];
      const Block *one = a.block(all[i]), *other = b.block(all[i]);
      const float far_one = one == nullptr ? a.beyond(all[i]) : 0.0f;
      const float far_other = other == nullptr ? b.beyond(all[i]) : 0.0f;
      for (int n = 0; n < kNodes; ++n) {
        const auto at = static_cast<std::size_t>(n);
        const float va = one == nullptr ? far_one : one->value[at];
        const float vb = other == nullptr ? far_other : other->value[at];
        const float value = combined(use, va, vb);
        out.value[at] = value;
        const bool first = value == va && one != nullptr && one->knows(n);
        const bool second = value == (use == Solid::Use::cut ? -vb : vb) && other != nullptr && other->knows(n);
        if ((!first && !second) || !(std::fabs(value) < kFar)) continue;
        out.known[at >> 6] |= std::uint64_t{1} << (at & 63u);
        used[i] = 1;
      }
    }
  });
  DistanceGrid out;
  out.name = a.grid().name, out.place = a.grid().place, out.voxel = a.grid().voxel;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (used[i] != 0) out.blocks.push_back(blocks[i]);
  return out;
}

/// Looks for the distances of a level set at any place near it.
class Resampler {
 public:
  explicit Resampler(const DistanceGrid& given) : given_(given), index_(index_of(given)), field_(given) {}

  /// The distance of a place of the lattice from the zero of the spline; false: it lies too far off. A line is sent
  /// along the normal of what it met last, until it is the normal of what it meets.
  bool distance(DistanceField::Reader& reader, std::vector<DistanceField::Candidate>& candidates, const Vec3& place,
                double& value) const {
    constexpr double kFarthest = 5.0, kBehind = 1.0, kSame = 1e-9;
    constexpr int kMost = 8;
    Vec3 normal = Vec3::Zero();
    double near = 0.0;
    if (!estimate(place, near, normal) || std::fabs(near) > kFarthest) return false;
    const double side = near < 0.0 ? -1.0 : 1.0;
    constexpr Rectangle kLine{0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < kMost; ++i) {
      LatticeView view(given_, given_.place, Facing::up);
      view.origin = place;
      view.rotation = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), -side * normal).toRotationMatrix();
      field_.candidates(view, kLine, candidates);
      const Crossing hit = field_.first_crossing(reader, view, candidates, 0.0, 0.0, -kBehind);
      if (!hit.found() || hit.depth > kFarthest) return false;
      const double before = value;
      value = side * hit.depth;
      const Vec3 xi = view.at(0.0, 0.0, hit.depth) - field_.node(hit.block, hit.cell);
      normal = cell_gradient(reader.distances(hit.block, hit.cell), xi).normalized();
      if (i > 0 && std::fabs(value - before) < kSame) break;
    }
    return true;
  }

  const DistanceField& field() const { return field_; }

 private:
  bool known(const Place& at, double& value) const {
    Place block{};
    int node = 0;
    for (std::size_t k = 0; k < 3; ++k)
      block[k] = at[k] - (at[k] & (kAlong - 1)), node = kAlong * node + (at[k] & (kAlong - 1));
    const std::int32_t found = index_.find(block);
    if (found < 0 || !given_.blocks[static_cast<std::size_t>(found)].knows(node)) return false;
    value = given_.blocks[static_cast<std::size_t>(found)].value[static_cast<std::size_t>(node)];
    return true;
  }

  /// By the nearest node that is known.
  bool estimate(const Vec3& place, double& value, Vec3& normal) const {
    constexpr int kReach = 2;
    Place middle{}, nearest{};
    for (int axis = 0; axis < 3; ++axis)
      middle[static_cast<std::size_t>(axis)] = to_whole<std::int32_t>(std::floor(place[axis] + 0.5));
    double best = std::numeric_limits<double>::infinity(), there = 0.0;
    if (known(middle, there)) best = 0.0, nearest = middle;  // none is nearer
    for (int i = -kReach; i <= kReach && best > 0.0; ++i)
      for (int j = -kReach; j <= kReach; ++j)
        for (int k = -kReach; k <= kReach; ++k) {
          const Place at{middle[0] + i, middle[1] + j, middle[2] + k};
          const double away = (Vec3(at[0], at[1], at[2]) - place).squaredNorm();
          double here = 0.0;
          if (away < best && known(at, here)) best = away, nearest = at, there = here;
        }
    if (!std::isfinite(best)) return false;
    for (int axis = 0; axis < 3; ++axis) {
      Place below = nearest, above = nearest;
      --below[static_cast<std::size_t>(axis)], ++above[static_cast<std::size_t>(axis)];
      double low = there, high = there;
      const int steps = (known(below, low) ? 1 : 0) + (known(above, high) ? 1 : 0);
      normal[axis] = steps == 0 ? 0.0 : (high - low) / steps;
    }
    if (!(normal.norm() > 0.0)) return false;
    value = there + normal.dot(place - Vec3(nearest[0], nearest[1], nearest[2]));
    normal.normalize();
    return true;
  }

  const DistanceGrid& given_;
  BlockIndex index_;
  DistanceField field_;
};

/// The same level set on another lattice. Blocks that its voxels, so much finer, would take are counted before they are
/// made.
DistanceGrid on_lattice(const DistanceGrid& given, const Pose& place, double voxel) {
  constexpr double kFinest = 1.0 + 1e-9, kFarthest = 1 << 29;  // of nodes from the origin of their lattice
  constexpr std::size_t kMostPlaces = std::size_t{1} << 21;
  if (voxel > kFinest * given.voxel)
    throw Error(ErrorKind::input_data,
                fmt::format("the level set '{}' has voxels of {:.4g} mm: its band is too narrow for those of {:.4g} mm",
                            given.name, 1e3 * given.voxel, 1e3 * voxel),
                {}, "choose voxels that are not greater (voxel_mm)");
  const Resampler resampler(given);
  const double ratio = voxel / given.voxel;
  const Pose to_old = given.place.inverse() * place, to_new = place.inverse() * given.place;
  std::set<Place> places;
  for (const Block& block : given.blocks) {
    const Vec3 middle = Vec3(block.first[0], block.first[1], block.first[2]) + Vec3::Constant(0.5 * (kAlong - 1));
    const Vec3 centre = to_new.origin / voxel + to_new.rotation * middle / ratio;
    const Vec3 half = to_new.rotation.cwiseAbs() * Vec3::Constant(0.5 * kAlong + 1.0) / ratio;
    if (!((centre.cwiseAbs() + half).maxCoeff() < kFarthest))
      throw Error(ErrorKind::input_data,
                  fmt::format("the level set '{}' lies too far from the others for voxels of {:.4g} mm", given.name,
                              1e3 * voxel));
    std::array<std::int32_t, 3> low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      low[k] = to_whole<std::int32_t>(std::floor((centre[axis] - half[axis]) / kAlong));
      high[k] = to_whole<std::int32_t>(std::floor((centre[axis] + half[axis]) / kAlong));
    }
    for (std::int32_t i = low[0]; i <= high[0]; ++i)
      for (std::int32_t j = low[1]; j <= high[1]; ++j)
        for (std::int32_t k = low[2]; k <= high[2]; ++k) {
          places.insert({kAlong * i, kAlong * j, kAlong * k});
          if (places.size() > kMostPlaces)
            throw Error(ErrorKind::configuration,
                        fmt::format("the level set '{}' is too large for voxels of {:.4g} mm, its own are {:.4g} mm",
                                    given.name, 1e3 * voxel, 1e3 * given.voxel),
                        {}, "choose greater voxels (voxel_mm)");
        }
  }
  const std::vector<Place> all(places.begin(), places.end());
  std::vector<Block> blocks(all.size());
  std::vector<char> used(all.size(), 0);
  parallel_blocks(all.size(), kBlocksAtOnce, [&](std::size_t from, std::size_t to) {
    DistanceField::Reader reader(resampler.field());
    std::vector<DistanceField::Candidate> candidates;
    for (std::size_t b = from; b < to; ++b) {
      Block& out = blocks[b];
      out.first = all[b];
      for (int n = 0; n < kNodes; ++n) {
        const Vec3 node(out.first[0] + (n >> 6), out.first[1] + (n >> 3 & 7), out.first[2] + (n & 7));
        const Vec3 old = to_old.origin / given.voxel + ratio * (to_old.rotation * node);
        double value = 0.0;
        if (!resampler.distance(reader, candidates, old, value) || std::fabs(value) > ratio * kHalfWidth) continue;
        const auto at = static_cast<std::size_t>(n);
        out.value[at] = static_cast<float>(value / ratio);
        out.known[at >> 6] |= std::uint64_t{1} << (at & 63u);
        used[b] = 1;
      }
    }
  });
  DistanceGrid out;
  out.name = given.name, out.place = place, out.voxel = voxel;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (used[i] != 0) out.blocks.push_back(blocks[i]);
  return out;
}

/// alone: of a single body, which open triangles need.
TriangleDistances on_lattice(const Solid& solid, const Pose& place, double voxel, std::optional<Body> alone = {}) {
  const auto* given = std::get_if<DistanceGrid>(&solid.shape);
  if (given == nullptr) {
    TriangleMesh mesh = std::get<TriangleMesh>(solid.shape);
    for (Vec3& v : mesh.vertices) v = place.apply_inverse(v + solid.offset);
    TriangleDistances out = distances_of(mesh, voxel, alone);
    out.grid.place = place;
    return out;
  }
  DistanceGrid moved = *given;
  moved.place.origin += solid.offset;
  const bool same = std::fabs(voxel - moved.voxel) <= 1e-12 * voxel &&
                    (moved.place.origin - place.origin).norm() <= 1e-9 * voxel &&
                    (moved.place.rotation - place.rotation).norm() <= 1e-12;
  return {same ? std::move(moved) : on_lattice(moved, place, voxel), {}, true};
}

}  // namespace

TriangleDistances distances_of(const SolidShape& shape, double default_voxel, std::optional<Body> body) {
  if (shape.solids.empty()) throw Error(ErrorKind::configuration, "a shape of solids needs at least one");
  if (shape.solids.front().use != Solid::Use::join)
    throw Error(ErrorKind::configuration,
                "the first of several solids must be joined: there is nothing yet to cut from");
  Pose place;
  double voxel = shape.voxel;
  for (const Solid& solid : shape.solids)
    if (const auto* grid = std::get_if<DistanceGrid>(&solid.shape);
        grid != nullptr && (voxel == 0.0 || voxel == grid->voxel)) {
      voxel = grid->voxel, place = grid->place;
      place.origin += solid.offset;
      break;
    }
  if (voxel == 0.0) voxel = default_voxel;
  if (!(voxel > 0.0) || !std::isfinite(voxel))
    throw Error(ErrorKind::configuration, "the voxel of a shape of solids must be positive");
  TriangleDistances all =
      on_lattice(shape.solids.front(), place, voxel, shape.solids.size() == 1 ? body : std::nullopt);
  const auto require_closed = [](const TriangleDistances& one) {
    if (!one.closed)
      throw Error(ErrorKind::configuration,
                  fmt::format("the triangles of '{}' are open: only closed bodies have an inside", one.grid.name), {},
                  "close them in a mesh program, or give the surface alone");
  };
  if (shape.solids.size() > 1) require_closed(all);
  for (std::size_t i = 1; i < shape.solids.size(); ++i) {
    TriangleDistances next = on_lattice(shape.solids[i], place, voxel);
    require_closed(next);
    const std::string first = all.grid.name, last = next.grid.name;
    all.grid = combined(Filled(std::move(all.grid)), Filled(std::move(next.grid)), shape.solids[i].use);
    if (all.grid.blocks.empty())
      throw Error(ErrorKind::input_data, fmt::format("nothing is left of '{}' after '{}'", first, last));
  }
  if (!shape.name.empty()) all.grid.name = shape.name;
  return all;
}

}  // namespace treadmark::levelset
