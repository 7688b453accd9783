// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "sample_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using scans::parse_columns;
using scans::parse_ptx;

TEST(Ptx, StationsArePutWhereTheirMatricesSay) {
  const Scan scan = parse_in_all_blocks(parse_ptx, ptx());
  EXPECT_EQ(scan.cloud.points, kPtxPoints);
  EXPECT_EQ(scan.cloud.passes, (std::vector<std::uint16_t>{1, 1, 1, 2, 2}));
  EXPECT_EQ(scan.points_in_file, 6u);
  EXPECT_EQ(scan.not_finite, 1u) << "0 0 0 is a place without a point";
  EXPECT_FALSE(scan.unit);
  EXPECT_EQ(scan.format, "PTX, 2 stations, pass from the station");
  EXPECT_EQ(scan.cloud.intensities, (std::vector<float>{0.5f, 0.25f, 1.0f, 0.5f, 0.5f}));
  ASSERT_EQ(scan.cloud.stations.size(), 2u);
  EXPECT_EQ(scan.cloud.stations.at(1), Vec3(0, 0, 0));
  EXPECT_EQ(scan.cloud.stations.at(2), Vec3(10, 20, 30));
  EXPECT_EQ(*station_of(scan.cloud, 4), Vec3(10, 20, 30));
}

TEST(Ptx, RangesCountFromTheStation) {
  ScanReadOptions options;
  options.ranges = ScanRanges{2.0, 9.0};
  const Scan scan = parse(parse_ptx, ptx(), ByteBlocks::kBlock, options);
  // 1, 10.01 and 22.7 from the first station, 3.7 and 8.8 from the second
  EXPECT_EQ(scan.cloud.points, (std::vector<Vec3>{kPtxPoints[3], kPtxPoints[4]}));
  EXPECT_EQ(scan.outside, 3u);
  EXPECT_TRUE(scan.cloud.passes.empty());
  ASSERT_NE(station_of(scan.cloud, 0), nullptr);
  EXPECT_EQ(*station_of(scan.cloud, 0), Vec3(10, 20, 30)) << "of the only one that is left";
  EXPECT_EQ(scan.points_in_file, scan.cloud.points.size() + scan.outside + scan.not_finite);
  options.ranges = ScanRanges{};
  options.ranges->least_intensity = 0.5;
  const Scan strong = parse(parse_ptx, ptx(), ByteBlocks::kBlock, options);
  EXPECT_EQ(strong.cloud.points.size(), 4u);
  EXPECT_EQ(strong.outside, 1u);
}

TEST(Ptx, AStationThatIsAskedForCounts) {
  ScanReadOptions options;
  options.station = Vec3(100, 0, 0);
  const Scan scan = parse(parse_ptx, ptx(), ByteBlocks::kBlock, options);
  EXPECT_EQ(scan.cloud.stations.size(), 1u);
  EXPECT_EQ(*station_of(scan.cloud, 0), Vec3(100, 0, 0));
}

TEST(Ptx, OneStationIsOnePass) {
  const std::string one = ptx().substr(0, ptx().find("\n1\n2\n") + 1);
  const Scan scan = parse_in_all_blocks(parse_ptx, one);
  EXPECT_EQ(*station_of(scan.cloud, 2), Vec3(0, 0, 0));
  EXPECT_EQ(scan.cloud.points.size(), 3u);
  EXPECT_TRUE(scan.cloud.passes.empty());
  EXPECT_EQ(scan.format, "PTX, 1 station");
}

TEST(Ptx, AMatrixThatStretchesIsNamed) {
  const Scan scan = parse(parse_ptx, replaced(ptx(), "0 0 1 0\n0 0 0 1", "0 0 2 0\n0 0 0 1"));
  EXPECT_EQ(scan.cloud.points[1], Vec3(10, 0, 1));
  EXPECT_NE(scan.format.find("the matrix of station 1 stretches by 1 to 2"), std::string::npos) << scan.format;
}

TEST(Ptx, WhatIsWrongIsNamedWithItsPlace) {
  const std::string text = ptx();
  expect_error(parse_ptx, "1.5\n2\n", "a number of columns or rows of points is expected", 1, 1);
  expect_error(parse_ptx, replaced(text, "1 2 3\n1 0 0\n", "1 0 0\n"), "an axis of the scanner has at most 3 numbers",
               6, 7);
  expect_error(parse_ptx, replaced(text, "0 0 0 1", "0 0 0 2"), "the last column of the matrix must be 0 0 0 1", 10, 7);
  expect_error(parse_ptx, replaced(text, "0 0 1 0\n0 0 0 1", "0 0 0 0\n0 0 0 1"), "makes all points a plane", 10, 1);
  expect_error(parse_ptx, replaced(text, "1\n2\n10 20 30", "900000000\n900000000\n10 20 30"),
               "810000000000000000 points are promised, more than the file can hold", 24);
  expect_error(parse_ptx, text.substr(0, text.size() - 20), "the file ends before a point", 25);
  expect_error(parse_ptx, replaced(text, "10 0 0.5", "10 a 0.5"), "a number is expected, this is 'a'", 12, 4);
}

TEST(Pts, CountsIntensitiesAndColours) {
  const Scan scan =
      parse_in_all_blocks(parse_columns, "2\n1 2 3 -1613 52 70 64\n4 5 6 -1998 58 76 67\n1\n7 8 9 5 1 2 3\n");
  EXPECT_EQ(scan.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_TRUE(scan.cloud.passes.empty());
  const Scan more = parse_in_all_blocks(parse_columns, "2\n1 2 3\n4 5 6\n7 8 9\n");
  EXPECT_EQ(more.cloud.points.size(), 3u);
  EXPECT_NE(more.format.find("2 points promised and 3 found"), std::string::npos) << more.format;
  expect_error(parse_columns, "3\n1 2 3\n4 5 6\n", "3 points are promised, the file ends after 2", 3);
}

}  // namespace
}  // namespace treadmark::io
