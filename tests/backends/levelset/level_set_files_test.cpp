// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Level sets that OpenVDB's own tools made and wrote, as other programs leave them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "treadmark/backends/levelset/make.hpp"
#include "treadmark/backends/levelset/read_level_set.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using openvdb::FloatGrid;
using ::testing::HasSubstr;

constexpr double kVoxel = 0.5, kRadius = 12.0;  // [mm], the unit of the files

class LevelSetFiles : public ::testing::Test {
 protected:
  LevelSetFiles() : path_(folder_.path() / "ball.vdb") {
    openvdb::initialize();
    ball_ = openvdb::tools::createLevelSetSphere<FloatGrid>(
        static_cast<float>(kRadius), openvdb::Vec3f(1.0f, 2.0f, 3.0f), static_cast<float>(kVoxel));
    ball_->setName("ball");
  }

  void write(const openvdb::GridPtrVec& grids,
             std::uint32_t compression = openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_BLOSC) const {
    openvdb::io::File out(path_.string());
    out.setCompression(compression);
    out.write(grids);
    out.close();
  }
  std::string refusal(const std::string& name = {}) const {
    return refusal_of([&] { levelset::read_level_set(path_, 1e-3, name); }, ErrorKind::input_data);
  }
  /// Of the ball's surface from its centre [m], in voxels.
  void expect_ball(const Vec3& centre, double radius, double tolerance, const std::string& name = {}) const {
    SolidShape shape;
    shape.solids = {{Solid::Use::join, levelset::read_level_set(path_, 1e-3, name), Vec3::Zero()}};
    const auto rail = levelset::make_level_set_surface(shape, Body::rail, 0.0, "level-set");
    double worst = 0.0;
    for (const double roll : {0.0, 0.9, 2.2, 3.1})
      for (const double x : {-0.5, -0.1, 0.0, 0.3}) {
        const Pose X{centre, rotation({roll, 0.3, 0.1})};
        const Vec2 at(x * radius, 0.37 * radius);
        const double z = height_at(*rail, X, at);
        worst = std::max(worst, std::fabs(std::hypot(at.x(), at.y(), z) - radius));
      }
    EXPECT_LT(worst, tolerance);
  }

  const TemporaryFolder folder_;
  const std::filesystem::path path_;
  FloatGrid::Ptr ball_;
};

constexpr double kTenth = 0.1 * kVoxel * 1e-3, kClose = 2e-3 * kVoxel * 1e-3;  // of a voxel [m]

TEST_F(LevelSetFiles, AreReadHoweverTheirValuesArePacked) {
  using namespace openvdb::io;  // NOLINT(google-build-using-namespace)
  for (const std::uint32_t packed :
       {0u, static_cast<std::uint32_t>(COMPRESS_ACTIVE_MASK), static_cast<std::uint32_t>(COMPRESS_ZIP),
        static_cast<std::uint32_t>(COMPRESS_BLOSC | COMPRESS_ACTIVE_MASK)})
    for (const bool half : {false, true}) {
      SCOPED_TRACE(packed);
      ball_->setSaveFloatAsHalf(half);
      write({ball_}, packed);
      expect_ball({1e-3, 2e-3, 3e-3}, 1e-3 * kRadius, half ? kTenth : kClose);
    }
}

TEST_F(LevelSetFiles, MayHoldDoubles) {
  write({openvdb::DoubleGrid::Ptr(new openvdb::DoubleGrid(*ball_))});
  expect_ball({1e-3, 2e-3, 3e-3}, 1e-3 * kRadius, kClose);
}

TEST_F(LevelSetFiles, LieWhereTheirTransformSays) {
  ball_->transform().postScale(0.5);
  ball_->transform().postRotate(0.4, openvdb::math::X_AXIS);
  ball_->transform().postTranslate({10.0, -4.0, 2.0});
  write({ball_});
  const openvdb::Vec3d centre = ball_->transform().indexToWorld(openvdb::Vec3d(1.0, 2.0, 3.0) / kVoxel);
  SolidShape shape;
  shape.solids = {{Solid::Use::join, levelset::read_level_set(path_, 1e-3), Vec3::Zero()}};
  const auto rail = levelset::make_level_set_surface(shape, Body::rail, 0.0, "level-set");
  const Box3 box = rail->bounds();
  const Vec3 middle = 0.5 * (box.min + box.max);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(middle[axis], 1e-3 * centre[axis], 1e-3 * kVoxel);
}

TEST_F(LevelSetFiles, AreFoundByNameAmongOthers) {
  const FloatGrid::Ptr fog = FloatGrid::create(0.0f), other = ball_->deepCopy();
  fog->setName("smoke");
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  other->setName("other");
  write({fog, ball_});
  expect_ball({1e-3, 2e-3, 3e-3}, 1e-3 * kRadius, kClose);
  EXPECT_THAT(refusal("smoke"), HasSubstr("a fog volume 'smoke'"));
  EXPECT_THAT(refusal("nobody"), HasSubstr("no grid 'nobody', but 'smoke', 'ball'"));
  write({other, ball_});
  EXPECT_THAT(refusal(), HasSubstr("several level sets: 'other' and 'ball'"));
  expect_ball({1e-3, 2e-3, 3e-3}, 1e-3 * kRadius, kClose, "ball");
}

TEST_F(LevelSetFiles, WhatIsNoneIsNamed) {
  write({});
  EXPECT_THAT(refusal(), HasSubstr("no grid"));
  ball_->setGridClass(openvdb::GRID_UNKNOWN);
  write({ball_});
  EXPECT_THAT(refusal(), HasSubstr("no level set, but a grid 'ball'"));
  const auto whole = openvdb::Int32Grid::create(1);
  whole->setGridClass(openvdb::GRID_LEVEL_SET);
  write({whole});
  EXPECT_THAT(refusal(), HasSubstr("single, half or double precision"));
  const auto empty = FloatGrid::create(1.5f);
  empty->setGridClass(openvdb::GRID_LEVEL_SET);
  write({empty});
  EXPECT_THAT(refusal(), HasSubstr("is empty"));
  std::ofstream(path_) << "no VDB file at all";
  EXPECT_THAT(refusal(), HasSubstr("not a VDB file"));
  std::filesystem::remove(path_);
  EXPECT_THAT(refusal(), HasSubstr("ball.vdb"));
}

TEST_F(LevelSetFiles, NumbersAndTransformsThatMakeNoSense) {
  const auto with = [this](const auto& change) {
    const FloatGrid::Ptr copy = ball_->deepCopy();
    copy->setTransform(ball_->transform().copy());
    change(*copy);
    write({copy});
    return refusal();
  };
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    EXPECT_THAT(with([&](FloatGrid& g) { g.beginValueOn().setValue(bad); }), HasSubstr("not a number"));
  EXPECT_THAT(with([](FloatGrid& g) { g.transform().preScale(openvdb::Vec3d(1.0, 1.5, 1.0)); }), HasSubstr("no cubes"));
  EXPECT_THAT(with([](FloatGrid& g) { g.transform().postScale(openvdb::Vec3d(-1.0, 1.0, 1.0)); }),
              HasSubstr("mirrors"));
  EXPECT_THAT(with([](FloatGrid& g) { g.transform().postScale(1e-3); }), HasSubstr("mm large"));
  EXPECT_THAT(with([](FloatGrid& g) { g.transform().postScale(1e4); }), HasSubstr("mm large"));
  EXPECT_THAT(with([](FloatGrid& g) { g.transform().postTranslate({1e9, 0.0, 0.0}); }), HasSubstr("too far"));
  EXPECT_THAT(with([](FloatGrid& g) {
                g.fill(openvdb::CoordBBox({0, 0, 0}, {63, 63, 63}), -1.5f);
              }),
              HasSubstr("must not contain tiles"));
}

/// Every file that is cut off somewhere is refused, whatever is left of it.
TEST_F(LevelSetFiles, FilesThatAreCutOffAreRefused) {
  write({ball_});
  const auto size = std::filesystem::file_size(path_);
  std::string content(size, '\0');
  std::ifstream(path_, std::ios::binary).read(content.data(), static_cast<std::streamsize>(size));
  for (std::size_t kept = 0; kept < size; kept += 1 + size / 61) {
    std::ofstream(path_, std::ios::binary) << content.substr(0, kept);
    EXPECT_NE(refusal(), "no error") << kept;
  }
}

}  // namespace
}  // namespace treadmark::testing
