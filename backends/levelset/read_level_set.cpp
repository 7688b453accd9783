// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/read_level_set.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <Eigen/LU>

#include "treadmark/backends/offset/vdb_file.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::levelset {

namespace {

namespace fs = std::filesystem;
constexpr const char* kKind = "level set";

constexpr offset::VdbWords kWords{"the distances",
                                  "write a narrow band of single precision distances, 3 voxels to both sides"};

std::size_t chosen_grid(const offset::VdbFile& vdb, const std::string& name) {
  std::optional<std::size_t> chosen;
  std::string titles;
  const std::vector<offset::VdbGrid>& all = vdb.grids();
  for (std::size_t k = 0; k < all.size(); ++k) {
    titles += (titles.empty() ? "" : ", ") + title_of(all[k]);
    if (name.empty() ? kind_of(all[k]) != kKind : all[k].name != name) continue;
    if (chosen)
      vdb.refuse(
          fmt::format("the VDB file holds several level sets: {} and {}", title_of(all[*chosen]), title_of(all[k])),
          "say which one by its name");
    chosen = k;
  }
  if (!chosen && !name.empty())
    vdb.refuse(fmt::format("the VDB file holds no grid '{}', but {}", offset::shortened(name), titles));
  if (!chosen) vdb.refuse(fmt::format("the VDB file holds no level set, but {}", what_is(all.front())));
  if (kind_of(all[*chosen]) != kKind)
    vdb.refuse(fmt::format("the VDB file holds no level set of that name, but {}", what_is(all[*chosen])));
  return *chosen;
}

/// Returns the edge of a voxel in the unit of the file.
double take_place(const offset::VdbFile& vdb, const offset::VdbGrid& grid, double scale, DistanceGrid& out) {
  constexpr double kSame = 1e-6, kLeast = 1e-6, kMost = 0.1, kFarthestAway = 1e6;
  const std::array<double, 12>& t = grid.to_world;
  Mat3 axes;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) axes(column, row) = t[static_cast<std::size_t>(3 * row + column)];
  const Vec3 shift(t[9], t[10], t[11]);
  if (!axes.allFinite() || !shift.allFinite()) vdb.refuse("the transform of the distances is not finite");
  const double world = axes.col(0).norm();
  out.voxel = scale * world;
  if (!(out.voxel >= kLeast && out.voxel <= kMost))
    vdb.refuse(fmt::format("the voxels of the level set are {:.3g} mm large", kMilli * out.voxel),
               "is the factor from the units of the file to mm right? (scale_to_mm; 1000 for a file in metres)");
  if (!(shift.cwiseAbs().maxCoeff() < kFarthestAway * world)) vdb.refuse_far();
  const Mat3 turn = axes / world;
  if (!(turn.transpose() * turn).isApprox(Mat3::Identity(), kSame))
    vdb.refuse("the voxels of the level set are no cubes: its transform stretches or shears", "resample it");
  if (turn.determinant() < 0.0) vdb.refuse("the transform of the level set mirrors it", "resample it");
  out.place = {scale * shift, turn};
  return world;
}

}  // namespace

DistanceGrid read_level_set(offset::VdbFile vdb, const std::string& name, double scale, const std::string& grid) {
  constexpr double kMostVoxels = 1e6;
  const std::size_t number = chosen_grid(vdb, grid);
  DistanceGrid out;
  out.name = name;
  const double world = take_place(vdb, vdb.grids()[number], scale, out);
  const offset::VdbContent content = vdb.content(number);
  if (!(content.background > 0.0f) || !std::isfinite(content.background))
    vdb.refuse("the background of the level set, its distance far outside, is not positive");
  if (content.leaves.empty())
    vdb.refuse(fmt::format("the level set {} of the VDB file is empty", title_of(vdb.grids()[number])));
  for (const offset::VdbLeaf& leaf : content.leaves) {
    DistanceGrid::Block& block = out.blocks.emplace_back();
    block.first = leaf.first;
    block.known = leaf.active;
    for_each_active(leaf, [&](unsigned n) {
      if (!(std::fabs(leaf.value[n]) < kMostVoxels * world))
        vdb.refuse("a distance of the level set is not a number, or far beyond any narrow band");
      block.value[n] = static_cast<float>(leaf.value[n] / world);
    });
  }
  return out;
}

DistanceGrid read_level_set(const fs::path& file, double scale, const std::string& grid) {
  return read_level_set(offset::open_vdb(file, kWords), file.filename().string(), scale, grid);
}

}  // namespace treadmark::levelset
