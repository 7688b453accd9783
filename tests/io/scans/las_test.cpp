// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <limits>

#include "sample_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using scans::parse_las;

TEST(Las, AllVersionsAndFormats) {
  for (int minor = 0; minor <= 4; ++minor)
    for (int format = 0; format <= 10; ++format)
      for (const std::size_t extra : {0u, 5u}) {
        LasFile las;
        las.minor = minor;
        las.format = format;
        las.extra = extra;
        las.gap = 100 * extra;
        const Scan scan = parse_in_all_blocks(parse_las, las.bytes());
        ASSERT_EQ(scan.cloud.points.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(scan.cloud.points[i], las.expected(i));
        // version 1.0 has other things in these two bytes
        EXPECT_EQ(scan.cloud.passes, minor == 0 ? std::vector<std::uint16_t>() : las.sources);
        EXPECT_FALSE(scan.unit);
        EXPECT_EQ(scan.format, fmt::format("LAS 1.{}, point data format {}{}", minor, format,
                                           minor == 0 ? "" : ", pass from the point source ID"));
      }
}

/// Keys of GeoTIFF: four numbers each.
std::string geo_keys(const std::vector<std::array<std::uint16_t, 4>>& keys) {
  std::string out;
  for (const std::size_t n : {std::size_t{1}, std::size_t{1}, std::size_t{0}, keys.size()})
    put_bytes(out, static_cast<std::uint16_t>(n));
  for (const auto& key : keys)
    for (const std::uint16_t n : key) put_bytes(out, n);
  return out;
}

TEST(Las, CoordinateSystemsOfTheEarthAreNamed) {
  const std::string utm = geo_keys({{1024, 0, 1, 1}, {1026, 34737, 22, 0}, {3072, 0, 1, 32617}});
  LasFile las;
  las.gap = 20;
  las.records = {{34735, utm}, {34737, "WGS 84 / UTM zone 17N|WGS 84|"}};
  Scan scan = parse_in_all_blocks(parse_las, las.bytes());
  EXPECT_EQ(scan.reference, "WGS 84 / UTM zone 17N");
  EXPECT_EQ(scan.usual_unit, LengthUnit::metre);
  EXPECT_FALSE(scan.unit);
  EXPECT_EQ(scan.cloud.points.size(), 3u);
  EXPECT_EQ(scan.cloud.points[1], las.expected(1));
  EXPECT_NE(scan.format.find("coordinate system WGS 84 / UTM zone 17N"), std::string::npos) << scan.format;

  las.records = {{34735, geo_keys({{1024, 0, 1, 1}, {3072, 0, 1, 25832}})}};
  EXPECT_EQ(parse(parse_las, las.bytes()).reference, "EPSG 25832");
  las.records = {{2112, "PROJCS[\"NAD83 / Texas\",GEOGCS[\"NAD83\"]]"}};
  EXPECT_EQ(parse(parse_las, las.bytes()).reference, "NAD83 / Texas");
  las.records = {{2112, "LOCAL_CS[\"a machine\"]"}, {34735, geo_keys({{1025, 0, 1, 1}})}};
  EXPECT_EQ(parse(parse_las, las.bytes()).reference, "");
  las.records = {};
  EXPECT_EQ(parse(parse_las, las.bytes()).reference, "");

  las.minor = 4;
  las.format = 6;
  las.late = {{2112, std::string("COMPD_CS[\"both\"]") + '\0'}};
  scan = parse_in_all_blocks(parse_las, las.bytes());
  EXPECT_EQ(scan.reference, "both");
  EXPECT_EQ(scan.cloud.points[1], las.expected(1));
}

TEST(Las, LongitudesAndLatitudesAreRefused) {
  LasFile las;
  las.records = {{34735, geo_keys({{1024, 0, 1, 2}, {2048, 0, 1, 4326}})}};
  expect_error(parse_las, las.bytes(), "the coordinates are longitudes and latitudes (EPSG 4326)");
  las.records = {{2112, "GEOGCS[\"WGS 84\"]"}};
  expect_error(parse_las, las.bytes(), "longitudes and latitudes (WGS 84)");
}

TEST(Las, BrokenRecordsAboutTheCoordinateSystemDoNotMatter) {
  LasFile las;
  las.records = {{34735, "abc"}, {34737, ""}, {2112, "\"["}};
  std::string bytes = las.bytes();
  EXPECT_EQ(parse_in_all_blocks(parse_las, bytes).cloud.points.size(), 3u);
  set_bytes(bytes, 100, std::uint32_t{4'000'000'000});
  EXPECT_EQ(parse_in_all_blocks(parse_las, bytes).cloud.points.size(), 3u);
  set_bytes(bytes, 227 + 20, std::uint16_t{65535});
  EXPECT_EQ(parse_in_all_blocks(parse_las, bytes).cloud.points.size(), 3u);
}

TEST(Las, EqualSourcesAreNoPasses) {
  LasFile las;
  las.sources = {7, 7, 7};
  EXPECT_TRUE(parse(parse_las, las.bytes()).cloud.passes.empty());
}

TEST(Las, WithheldPointsAreLeftOut) {
  for (const int format : {3, 7}) {
    LasFile las;
    las.minor = 4;
    las.format = format;
    las.withheld[1] = true;
    const Scan scan = parse(parse_las, las.bytes());
    EXPECT_EQ(scan.withheld, 1u);
    EXPECT_EQ(scan.points_in_file, 3u);
    ASSERT_EQ(scan.cloud.points.size(), 2u);
    EXPECT_EQ(scan.cloud.points[1], las.expected(2));
    EXPECT_EQ(scan.cloud.passes, (std::vector<std::uint16_t>{7, 9}));
  }
}

TEST(Las, CountOf64Bits) {
  LasFile las;
  las.minor = 4;
  las.format = 6;
  las.legacy_count = false;
  EXPECT_EQ(parse(parse_las, las.bytes()).cloud.points.size(), 3u);
  std::string only_legacy = las.bytes();
  set_bytes(only_legacy, 247, std::uint64_t{0});
  set_bytes(only_legacy, 107, std::uint32_t{2});
  EXPECT_EQ(parse(parse_las, only_legacy).cloud.points.size(), 2u);
  std::string huge = las.bytes();
  set_bytes(huge, 247, std::numeric_limits<std::uint64_t>::max());
  expect_error(parse_las, huge, "at byte 107: 18446744073709551615 points are promised, the file holds 3");
}

TEST(Las, Errors) {
  const std::string bytes = LasFile().bytes();
  const auto with = [&](std::size_t at, auto value) {
    std::string changed = bytes;
    set_bytes(changed, at, value);
    return changed;
  };
  expect_error(parse_las, "LASS" + bytes.substr(4), "at byte 0: a LAS file begins with LASF");
  expect_error(parse_las, bytes.substr(0, 200), "at byte 200: the file ends within its header of 227 bytes");
  expect_error(parse_las, with(24, std::uint8_t{2}), "at byte 24: LAS version 2.2 is not known");
  expect_error(parse_las, with(25, std::uint8_t{5}), "at byte 24: LAS version 1.5 is not known");
  expect_error(parse_las, with(25, std::uint8_t{4}), "at byte 94: a header of 227 bytes, version 1.4 has at least 375");
  expect_error(parse_las, with(94, std::uint16_t{100}), "at byte 94: a header of 100 bytes");
  expect_error(parse_las, with(104, std::uint8_t{0x80}), "(decompress the file first: 'laszip -i in.laz -o out.las'");
  expect_error(parse_las, with(104, std::uint8_t{0x43}), "at byte 104: the points are compressed");
  expect_error(parse_las, with(104, std::uint8_t{11}), "at byte 104: the point data format 11 is not known");
  expect_error(parse_las, with(105, std::uint16_t{19}),
               "at byte 105: records of 19 bytes, point data format 0 has at least 20");
  expect_error(parse_las, with(105, std::uint16_t{21}), "at byte 107: 3 points are promised, the file holds 2");
  expect_error(parse_las, with(107, std::uint32_t{4}), "at byte 107: 4 points are promised, the file holds 3");
  expect_error(parse_las, with(107, std::uint32_t{0}), "the file holds no points");
  expect_error(parse_las, with(96, std::uint32_t{226}), "at byte 96: the points would begin at byte 226");
  expect_error(parse_las, with(96, std::uint32_t{4000000000}), "the file holds 0");
  expect_error(parse_las, with(139, 0.0), "at byte 139: a scale of 0");
  expect_error(parse_las, with(147, std::numeric_limits<double>::quiet_NaN()), "at byte 147: a scale of nan");
  expect_error(parse_las, with(163, std::numeric_limits<double>::infinity()), "at byte 163: an offset of inf");
  LasFile las14;
  las14.minor = 4;
  expect_error(parse_las, las14.bytes().substr(0, 300), "at byte 300: the file ends within its header of 375 bytes");
  ScanReadOptions few;
  few.most_points = 2;
  expect_error(parse_las, bytes, "at byte 227: 3 points, more than the 2 allowed", 0, 0, few);
}

}  // namespace
}  // namespace treadmark::io
