// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "sample_files.hpp"
#include "treadmark/io/scans/lzf.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using scans::parse_pcd;

TEST(Pcd, TextBinaryAndCompressedGiveTheSamePoints) {
  struct Case {
    std::string bytes, format;
  };
  for (const Case& c :
       {Case{ascii_pcd(), "ASCII"}, Case{binary_pcd(), "binary"}, Case{compressed_pcd(), "binary compressed"}}) {
    const Scan scan = parse_in_all_blocks(parse_pcd, c.bytes);
    EXPECT_EQ(scan.cloud.points, kPoints);
    EXPECT_EQ(scan.cloud.normals, kNormals);
    EXPECT_EQ(scan.cloud.passes, kPasses);
    EXPECT_EQ(scan.unit, LengthUnit::millimetre);
    EXPECT_EQ(scan.format, "PCD, " + c.format + ", normals, pass from the field scan_id");
  }
}

TEST(Pcd, TheOrganisedCloudHasLostPoints) {
  const Scan scan = parse_in_all_blocks(
      parse_pcd,
      "VERSION .7\nFIELDS x y z _\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 4\nWIDTH 2\nHEIGHT 2\n"
      "VIEWPOINT 1 0 0 1 0 0 0\nPOINTS 4\nDATA ascii\n1 2 3 0 0 0 0\nnan nan nan 0 0 0 0\n\n4 5 6 0 0 0 0\n"
      "7 8 9 0 0 0 0\n");
  EXPECT_EQ(scan.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(scan.not_finite, 1u);
  EXPECT_EQ(scan.points_in_file, 4u);
  EXPECT_EQ(scan.format, "PCD, ASCII, viewpoint ignored");
}

TEST(Pcd, LzfCopiesMayOverlapAndReachFarBack) {
  std::string out(10, '\0');
  // three letters, six more from three back, one as it is
  const std::string packed = {2, 'a', 'b', 'c', static_cast<char>(4 << 5), 2, 0, 'x'};
  EXPECT_TRUE(scans::unpack_lzf(packed, out));
  EXPECT_EQ(out, "abcabcabcx");
  const std::string same(1000, 'q');
  std::string back(1000, '\0');
  EXPECT_TRUE(scans::unpack_lzf(packed_lzf(same), back));
  EXPECT_EQ(back, same);
  EXPECT_FALSE(scans::unpack_lzf(packed_lzf(same), out)) << "longer than promised";
  EXPECT_FALSE(scans::unpack_lzf(std::string("\x20\x00", 2), out)) << "a copy of nothing";
  EXPECT_FALSE(scans::unpack_lzf(packed.substr(0, 3), out)) << "cut short";
  EXPECT_FALSE(scans::unpack_lzf("", out));
}

TEST(Pcd, WhatIsWrongIsNamedWithItsPlace) {
  const std::string text = ascii_pcd(), binary = binary_pcd(), packed = compressed_pcd();
  expect_error(parse_pcd, "1 2 3\n4 5 6\n", "begins with its header (VERSION, FIELDS ...), this is '1'", 1, 1);
  expect_error(parse_pcd, replaced(text, "DATA ascii", "DATA zip"), "DATA is ascii, binary or binary_compressed", 12);
  expect_error(parse_pcd, replaced(text, "POINTS 5", "POINTS 6"), "POINTS is 6, WIDTH times HEIGHT 5", 12);
  expect_error(parse_pcd, replaced(text, " normal_x", " x"), "a coordinate is named twice", 12);
  expect_error(parse_pcd, replaced(text, " y z ", " y w "), "FIELDS does not name x, y and z", 12);
  expect_error(parse_pcd, replaced(text, "TYPE U F F", "TYPE U F X"), "one of F, U and I", 6, 10);
  expect_error(parse_pcd, replaced(text, "SIZE 4 8", "SIZE 4 9"), "1 to 8 is possible here", 5, 8);
  expect_error(parse_pcd, replaced(text, "SIZE 4 8", "SIZE 4 2"), "cannot be of type F and 2 bytes", 12);
  expect_error(parse_pcd, text + "1 2 3\n", "more lines than the 5 points", 18, 1);
  expect_error(parse_pcd, text.substr(0, text.size() - 40), "the line has", 17);
  const std::string many = replaced(replaced(binary, "WIDTH 5", "WIDTH 50000000"), "POINTS 5", "POINTS 50000000");
  expect_error(parse_pcd, many, "50000000 points are promised, more than the file can hold");
  std::string damaged = packed;
  damaged[pcd_header("binary_compressed").size() + 8] = '\x20';  // a copy of what is not there yet
  expect_error(parse_pcd, damaged, "the compressed data are damaged");
  expect_error(parse_pcd, packed.substr(0, packed.size() - 1), "compressed bytes are promised, the file holds");
  expect_error(parse_pcd, replaced(replaced(packed, "WIDTH 5", "WIDTH 6"), "POINTS 5", "POINTS 6"),
               "6 points of 48 bytes are promised");
  expect_error(parse_pcd, text.substr(0, 100), "ends with a line DATA, there is none", 4);
}

}  // namespace
}  // namespace treadmark::io
