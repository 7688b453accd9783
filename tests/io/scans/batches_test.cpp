// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Points that come in batches: the same as all at once, and never many at a time.
#include "sample_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

struct Batches {
  Scan scan;
  PointCloud together;
  std::size_t most = 0;
};

Batches in_batches(Parser parser, const std::string& bytes) {
  Batches out;
  ScanReadOptions options;
  options.batch = [&](PointCloud& batch) {
    out.most = std::max(out.most, batch.points.size());
    out.together.points.insert(out.together.points.end(), batch.points.begin(), batch.points.end());
    out.together.passes.insert(out.together.passes.end(), batch.passes.begin(), batch.passes.end());
  };
  out.scan = parse(parser, bytes, ByteBlocks::kBlock, options);
  return out;
}

TEST(ScanBatches, AreAllPointsInTheirOrder) {
  for (const std::string& bytes : {ascii_ply(), binary_ply(true)}) {
    const Scan whole = parse(scans::parse_ply, bytes);
    const Batches found = in_batches(scans::parse_ply, bytes);
    EXPECT_EQ(found.together.points, whole.cloud.points);
    EXPECT_EQ(found.together.passes, whole.cloud.passes);
    EXPECT_EQ(found.scan.points_in_file, whole.points_in_file);
    EXPECT_EQ(found.scan.unit, whole.unit);
    EXPECT_TRUE(found.scan.cloud.points.empty());
    EXPECT_TRUE(found.scan.several_passes);
  }
}

TEST(ScanBatches, AreSmall) {
  constexpr int kCount = 150'000;
  for (const int passes : {1, 2}) {
    std::string text = "x y z pass\n";
    for (int i = 0; i < kCount; ++i) text += fmt::format("{} {} 0.5 {}\n", i, -i, 1 + passes * i / kCount);
    const Batches found = in_batches(scans::parse_columns, text);
    EXPECT_EQ(found.most, ScanReadOptions::kBatch);
    EXPECT_EQ(found.together.points, parse(scans::parse_columns, text).cloud.points);
    // each batch alone may know of one pass only
    EXPECT_EQ(found.scan.several_passes, passes > 1);
  }
}

std::string with_a_wrong_pass(const char* column) {
  std::string text = fmt::format("x y z {}\n", column);
  for (int i = 0; i < 70'000; ++i) text += fmt::format("{} 0 0 {}\n", i, i % 3);
  return text + "1 2 3 0.5\n";
}

TEST(ScanBatches, TellAWrongPassWhereItStands) {
  const std::string text = with_a_wrong_pass("scan");
  expect_at(error_thrown_by([&] { in_batches(scans::parse_columns, text); }),
            "the pass 0.5 is not a whole number from 0 to 65535", 70'002, 0);
}

TEST(ScanBatches, OfLinesThatAreNoPassesDoNotCount) {
  const std::string text = with_a_wrong_pass("line");
  const Scan whole = parse(scans::parse_columns, text);
  EXPECT_TRUE(whole.cloud.passes.empty()) << whole.format;
  EXPECT_FALSE(in_batches(scans::parse_columns, text).scan.several_passes);
}

TEST(ScanBox, LeavesPointsOutWhileReading) {
  ScanReadOptions options;
  options.box.emplace(Vec3(0.0, 0.0, 0.0), Vec3(2.0, 1.0, 1.0));
  const Scan found =
      parse(scans::parse_columns, "0 0 0\n2 1 1\n2.1 0 0\n1 -0.1 0\nnan 0 0\n", ByteBlocks::kBlock, options);
  EXPECT_EQ(found.cloud.points, (std::vector<Vec3>{{0, 0, 0}, {2, 1, 1}}));
  EXPECT_EQ(found.outside, 2u);
  EXPECT_EQ(found.not_finite, 1u);
  EXPECT_EQ(found.points_in_file, 5u);
  expect_error(scans::parse_columns, "3 3 3\n", "none of the 1 points is finite and in use within the box", 0, 0,
               options);
  // corners of triangles, each once, some of them outside
  const std::string stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 5 5 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 5 5 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid s\n";
  EXPECT_EQ(parse(scans::parse_stl, stl, ByteBlocks::kBlock, options).cloud.points,
            (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
}

TEST(ScanBatches, OfNothingAreAnError) {
  ScanReadOptions options;
  options.batch = [](PointCloud&) { ADD_FAILURE(); };
  expect_error(scans::parse_columns, "nan nan nan\n", "none of the 1 points is finite", 0, 0, options);
}

}  // namespace
}  // namespace treadmark::io
