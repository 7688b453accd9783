// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/read_level_set.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/LU>

#include "treadmark/backends/offset/vdb_tree_reader.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::levelset {

namespace {

namespace fs = std::filesystem;
constexpr const char* kKind = "level set";

class LevelSetReader final : public offset::VdbTreeReader {
 public:
  LevelSetReader(std::string_view data, const fs::path& file, double scale)
      : VdbTreeReader(data, file, "the distances",
                      "write a narrow band of single precision distances, 3 voxels to both sides"),
        scale_(scale) {
    out_.name = file.filename().string();
  }

  DistanceGrid read(const std::string& name) {
    std::optional<Descriptor> chosen;
    const std::vector<Descriptor> all = grids();
    std::string titles;
    for (const Descriptor& grid : all) {
      titles += (titles.empty() ? "" : ", ") + grid.title();
      if (name.empty() ? grid.kind() != kKind : grid.name != name) continue;
      if (chosen)
        refuse(fmt::format("the VDB file holds several level sets: {} and {}", chosen->title(), grid.title()),
               "say which one by its name");
      chosen = grid;
    }
    if (!chosen && !name.empty())
      refuse(fmt::format("the VDB file holds no grid '{}', but {}", offset::short_name(name), titles));
    if (!chosen) refuse(fmt::format("the VDB file holds no level set, but {}", what_is(all.front())));
    if (chosen->kind() != kKind)
      refuse(fmt::format("the VDB file holds no level set of that name, but {}", what_is(*chosen)));
    read_grid(*chosen);
    if (out_.blocks.empty()) refuse(fmt::format("the level set {} of the VDB file is empty", chosen->title()));
    return std::move(out_);
  }

 private:
  void take_transform(const Transform& t) override {
    constexpr double kSame = 1e-6, kLeast = 1e-6, kMost = 0.1, kFarthestAway = 1e6;
    Mat3 axes;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        axes(column, row) = t.matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    const Vec3 shift(t.shift[0], t.shift[1], t.shift[2]);
    if (!axes.allFinite() || !shift.allFinite()) refuse("the transform of the distances is not finite");
    world_ = axes.col(0).norm();
    out_.voxel = scale_ * world_;
    if (!(out_.voxel >= kLeast && out_.voxel <= kMost))
      refuse(fmt::format("the voxels of the level set are {:.3g} mm large", kMilli * out_.voxel),
             "is the factor from the units of the file to mm right? (scale_to_mm; 1000 for a file in metres)");
    if (!(shift.cwiseAbs().maxCoeff() < kFarthestAway * world_)) refuse_far();
    const Mat3 turn = axes / world_;
    if (!(turn.transpose() * turn).isApprox(Mat3::Identity(), kSame))
      refuse("the voxels of the level set are no cubes: its transform stretches or shears", "resample it");
    if (turn.determinant() < 0.0) refuse("the transform of the level set mirrors it", "resample it");
    out_.place = {scale_ * shift, turn};
  }

  void take_background(float background) override {
    if (!(background > 0.0f) || !std::isfinite(background))
      refuse("the background of the level set, its distance far outside, is not positive");
  }

  void take_leaf(const Leaf& leaf) override {
    constexpr double kMostVoxels = 1e6;
    DistanceGrid::Block block;
    block.first = leaf.origin;
    std::size_t next = 0;
    bool any = false;
    for_each_on(leaf.active, [&](unsigned n) {
      const float value = leaf.values[leaf.all ? n : next++];
      if (!(std::fabs(value) < kMostVoxels * world_))
        refuse("a distance of the level set is not a number, or far beyond any narrow band");
      block.value[n] = static_cast<float>(value / world_);
      block.known[n >> 6] |= std::uint64_t{1} << (n & 63u);
      any = true;
    });
    for (const std::int32_t x : leaf.origin)
      if (x < -kFarthest || x > kFarthest) refuse_far();
    if (any) out_.blocks.push_back(block);
  }

  double scale_, world_ = 1.0;  ///< world_: edge of a voxel in the unit of the file
  DistanceGrid out_;
};

}  // namespace

DistanceGrid read_level_set(const fs::path& file, double scale, const std::string& grid) {
  const std::vector<char> data = offset::vdb_bytes(file);
  return LevelSetReader({data.data(), data.size()}, file, scale).read(grid);
}

}  // namespace treadmark::levelset
