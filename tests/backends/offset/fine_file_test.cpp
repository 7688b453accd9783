// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <filesystem>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::offset {
namespace {

namespace fs = std::filesystem;

/// Writes and reads one offset of a rail at voxels of this size.
OffsetFile through_a_file(double step, const fs::path& file) {
  const auto offsets = std::make_shared<SparseOffsets>();
  offsets->frame.du = offsets->frame.dy = step;
  Block block{};
  block[5] = 1e-5f;
  offsets->grid.insert({0, 0}, block, 0.0f);
  SurfaceSpec base;
  base.body = Body::rail;
  base.shape = StandardProfile{"60E1"};
  write_vdb(file, {offsets, base});
  return read_vdb(file);
}

TEST(OffsetFileSteps, FineOnesAreKeptAndWhatVdbCannotHoldIsRefused) {
  TREADMARK_NEEDS("openvdb");
  const testing::TemporaryFolder folder;
  const fs::path file = folder.path() / "fine.vdb";
  for (const double step : {1e-2, 1e-3, 1e-5, 3e-6}) {
    const OffsetFile back = through_a_file(step, file);
    EXPECT_EQ(back.offsets->frame.du, step);
    EXPECT_EQ(back.offsets->frame.dy, step);
    EXPECT_EQ(back.offsets->grid.value(0, 5), 1e-5f);
    EXPECT_EQ(back.offsets->grid.active_count(), 1u);
  }
  EXPECT_THROW(through_a_file(1e-7, file), Error);
}

}  // namespace
}  // namespace treadmark::offset
