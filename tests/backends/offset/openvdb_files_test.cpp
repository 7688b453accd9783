// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Files of offsets that OpenVDB's own writer has written again, as other programs leave them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using openvdb::FloatGrid;
using openvdb::GridBase;
using ::testing::HasSubstr;

constexpr std::uint32_t kMask = openvdb::io::COMPRESS_ACTIVE_MASK, kZip = openvdb::io::COMPRESS_ZIP,
                        kBlosc = openvdb::io::COMPRESS_BLOSC;

class OpenVdbFiles : public ::testing::Test {
 protected:
  OpenVdbFiles() : path_(folder_.path() / "offsets.vdb") {
    openvdb::initialize();
    std::vector<float> values(31 * 41);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1e-4f * std::sin(0.1f * static_cast<float>(i % 977));
    const OffsetMap map{"map", {-0.1, -0.02, 0.01, 0.001, 31, 41}, values};
    given_ = offset::offsets_from_map(map, Body::rail, 1e-9).offsets;
    offset::write_vdb(path_, {given_, {Body::rail, 0.0, StandardProfile{"60E1"}, {}}});
    openvdb::io::File in(path_.string());
    in.open(/*delayLoad=*/false);
    grid_ = openvdb::gridPtrCast<FloatGrid>(in.readGrid("treadmark_offsets"));
  }

  void write(const openvdb::GridPtrVec& grids, std::uint32_t compression = kMask | kBlosc) const {
    openvdb::io::File out(path_.string());
    out.setCompression(compression);
    out.write(grids);
    out.close();
  }
  std::string refusal() const {
    try {
      offset::read_vdb(path_);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_data);
      return error.what();
    }
    return "";
  }
  void expect_the_same(bool half = false) const {
    constexpr float kDigits = 1.0f / 2048.0f, kLeast = 3e-8f;  // of half precision; [m] half of its smallest number
    const offset::OffsetFile read = offset::read_vdb(path_);
    EXPECT_EQ(read.remark, "");
    EXPECT_EQ(read.offsets->grid.active_count(), given_->grid.active_count());
    for (int i = 0; i < 31; ++i)
      for (int j = 0; j < 41; ++j)
        EXPECT_NEAR(read.offsets->grid.value(i, j), given_->grid.value(i, j),
                    half ? kDigits * std::fabs(given_->grid.value(i, j)) + kLeast : 0.0f);
  }

  const TemporaryFolder folder_;
  const std::filesystem::path path_;
  std::shared_ptr<const offset::SparseOffsets> given_;
  FloatGrid::Ptr grid_;
};

TEST_F(OpenVdbFiles, AreReadHoweverTheirValuesArePacked) {
  for (const std::uint32_t packed : {0u, kMask, kZip, kBlosc, kZip | kMask, kBlosc | kMask})
    for (const bool half : {false, true}) {
      SCOPED_TRACE(packed);
      grid_->setSaveFloatAsHalf(half);
      write({grid_}, packed);
      expect_the_same(half);
    }
}

TEST_F(OpenVdbFiles, AreFoundUnderAnyNameAndBesideOtherGrids) {
  const GridBase::Ptr density = FloatGrid::create(0.0f), mask = openvdb::BoolGrid::create(false);
  density->setName("density");
  mask->setName("mask");
  for (const char* name : {"worn rail", "", "treadmark_offsets"}) {
    grid_->setName(name);
    for (const openvdb::GridPtrVec& grids :
         {openvdb::GridPtrVec{grid_}, {density, grid_}, {grid_, mask}, {mask, grid_, density}}) {
      write(grids);
      expect_the_same();
    }
  }
}

TEST_F(OpenVdbFiles, MayBeStreamsShareTheirTreesAndHoldDoubles) {
  const openvdb::DoubleGrid::Ptr doubles(new openvdb::DoubleGrid(*grid_));
  write({doubles});
  expect_the_same();
  const GridBase::Ptr shared = grid_->copyGrid();  // of the same tree
  shared->removeMeta("format");
  shared->setName("another name for it");
  for (const openvdb::GridPtrVec& grids : {openvdb::GridPtrVec{grid_, shared}, {shared, grid_}}) {
    write(grids);
    expect_the_same();
  }
  std::ofstream to(path_, std::ios::binary);
  openvdb::io::Stream(to).write(openvdb::GridPtrVec{shared, grid_});  // says nowhere where a grid begins
  to.close();
  expect_the_same();
}

TEST_F(OpenVdbFiles, LieWhereTheirTransformSays) {
  grid_->setTransform(grid_->transform().copy());
  grid_->transform().postTranslate({0.005, -0.002, 0.0});
  write({grid_});
  const offset::OffsetFile moved = offset::read_vdb(path_);
  EXPECT_NEAR(moved.offsets->frame.u0, given_->frame.u0 + 0.005, 1e-15);
  EXPECT_NEAR(moved.offsets->frame.y0, given_->frame.y0 - 0.002, 1e-15);
  EXPECT_THAT(moved.remark, HasSubstr("moved by 5 mm along and -2 mm across"));
  grid_->transform().preScale(openvdb::Vec3d(1.5, 1.0, 1.0));
  write({grid_});
  EXPECT_NEAR(offset::read_vdb(path_).offsets->frame.du, 1.5 * given_->frame.du, 1e-15);
  grid_->transform().postScale(1000.0);
  write({grid_});
  EXPECT_THAT(refusal(), HasSubstr("scaled"));
  grid_->transform().postScale(0.001);
  grid_->transform().postRotate(0.1, openvdb::math::Z_AXIS);
  write({grid_});
  EXPECT_THAT(refusal(), HasSubstr("rotate"));
}

TEST_F(OpenVdbFiles, OfOtherKindsAreNamed) {
  const auto sphere = openvdb::tools::createLevelSetSphere<FloatGrid>(1.0f, openvdb::Vec3f(0.0f), 0.2f);
  write({sphere});
  EXPECT_THAT(refusal(), HasSubstr("a level set"));
  grid_->setGridClass(openvdb::GRID_FOG_VOLUME);
  write({grid_});
  EXPECT_THAT(refusal(), HasSubstr("a fog volume"));
  const FloatGrid::Ptr plain = FloatGrid::create(0.0f);
  plain->setName("mine");
  write({plain});
  EXPECT_THAT(refusal(), HasSubstr("'mine' without the entries that say over which base"));
  grid_->setGridClass(openvdb::GRID_UNKNOWN);
  const auto whole = openvdb::Int32Grid::create(0);
  whole->setName("treadmark_offsets");
  write({whole});
  EXPECT_THAT(refusal(), HasSubstr("single, half or double precision numbers, not Tree_int32_5_4_3"));
  write({grid_, grid_->deepCopyGrid()});
  EXPECT_THAT(refusal(), HasSubstr("several grids of offsets"));
  write({});
  EXPECT_THAT(refusal(), HasSubstr("no grid"));
}

}  // namespace
}  // namespace treadmark::testing
