// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "sample_files.hpp"
#include "treadmark/io/scans/e57_pages.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using scans::parse_e57;

TEST(E57, ScansWithTheirPosesAndAnyNumberOfBits) {
  TREADMARK_NEEDS("expat");
  for (const std::size_t packets : {1u, 2u, 3u, 7u}) {
    E57File file = e57();
    file.packets = packets;
    const Scan scan = parse_in_all_blocks(parse_e57, file.bytes());
    ASSERT_EQ(scan.cloud.points.size(), 6u);
    EXPECT_EQ(scan.not_finite, 1u) << "the second point is marked as invalid";
    EXPECT_EQ(scan.points_in_file, 7u);
    std::size_t at = 0;
    for (std::size_t i = 0; i < kPoints.size(); ++i) {
      if (i == 1) continue;
      EXPECT_NEAR((scan.cloud.points[at] - kPoints[i]).norm(), 0.0, 1e-12) << i;
      ++at;
    }
    // turned by 90 degrees about z, then shifted
    EXPECT_NEAR((scan.cloud.points[4] - Vec3(8, 21, 33)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((scan.cloud.points[5] - Vec3(5, 24, 36)).norm(), 0.0, 1e-12);
    EXPECT_EQ(scan.cloud.passes, (std::vector<std::uint16_t>{1, 1, 1, 1, 2, 2}));
    EXPECT_EQ(scan.unit, LengthUnit::metre);
    EXPECT_EQ(scan.reference, "");
    EXPECT_EQ(scan.format, "E57, 2 scans, pass from the scan");
    EXPECT_TRUE(scan.cloud.stations.empty()) << "nobody says where the first one was taken from";
    EXPECT_TRUE(scan.cloud.intensities.empty()) << "the same everywhere they say nothing";
  }
}

TEST(E57, PosesSayWhereTheScannerStood) {
  TREADMARK_NEEDS("expat");
  E57File file = e57();
  file.scans[0].pose = file.scans[1].pose;
  const Scan scan = parse_in_all_blocks(parse_e57, file.bytes());
  ASSERT_EQ(scan.cloud.stations.size(), 2u);
  EXPECT_EQ(scan.cloud.stations.at(1), Vec3(10, 20, 30));
  EXPECT_EQ(scan.cloud.stations.at(2), Vec3(10, 20, 30));
}

TEST(E57, SphericalCoordinatesAndNormals) {
  TREADMARK_NEEDS("expat");
  E57File file = e57();
  file.scans.erase(file.scans.begin());
  E57File::Scan& scan = file.scans.front();
  scan.pose.clear();
  scan.fields[0].name = "sphericalRange";
  scan.fields[1].name = "sphericalAzimuth";
  scan.fields[2].name = "sphericalElevation";
  const auto normal = [](const char* name, double value) {
    return E57File::Field{name, "type=\"Float\"", 64, {bits_of(value), bits_of(value)}};
  };
  scan.fields.push_back(normal("nor:normalX", 0.0));
  scan.fields.push_back(normal("nor:normalY", 0.6));
  scan.fields.push_back(normal("nor:normalZ", -0.8));
  const Scan read = parse_in_all_blocks(parse_e57, file.bytes());
  ASSERT_EQ(read.cloud.points.size(), 2u);
  EXPECT_EQ(*station_of(read.cloud, 0), Vec3(0, 0, 0));
  const Vec3 expected = 4.0 * Vec3(std::cos(6.0) * std::cos(5.0), std::cos(6.0) * std::sin(5.0), std::sin(6.0));
  EXPECT_NEAR((read.cloud.points[1] - expected).norm(), 0.0, 1e-14);
  ASSERT_EQ(read.cloud.normals.size(), 2u);
  EXPECT_EQ(read.cloud.normals[0], Eigen::Vector3f(0.0f, 0.6f, -0.8f));
  EXPECT_EQ(read.format, "E57, 1 scan, normals");
}

TEST(E57, TheCheckSumIsThatOfThePolynomialOfCastagnoli) {
  TREADMARK_NEEDS("expat");
  EXPECT_EQ(scans::crc32c("123456789"), 0xe3069283u);  // RFC 3720, B.4
  EXPECT_EQ(scans::crc32c(std::string(32, '\0')), 0x8a9136aau);
  EXPECT_EQ(scans::crc32c(std::string(32, '\xff')), 0x62a8ab43u);
}

TEST(E57, EveryBitThatFlipsIsFound) {
  TREADMARK_NEEDS("expat");
  const std::string sound = e57().bytes();
  for (std::size_t at = 0; at < sound.size(); at += 37) {
    std::string damaged = sound;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    EXPECT_THROW(parse(parse_e57, damaged), Error) << at;
  }
  std::string damaged = sound;
  damaged[1500] = static_cast<char>(damaged[1500] ^ 1);
  expect_error(parse_e57, damaged, "page 1 is damaged: its check sum is wrong");
}

TEST(E57, WhatIsWrongIsNamed) {
  TREADMARK_NEEDS("expat");
  const auto with = [](const std::string& what, const std::string& by) {
    std::string content = replaced(e57().content(), what, by);
    // the length of the XML
    const auto xml = content.find("<?xml");
    set_bytes(content, 32, static_cast<std::uint64_t>(content.size() - xml));
    return E57File::paged(content);
  };
  expect_error(parse_e57, "ASTM-E58" + std::string(2000, ' '), "an E57 file begins with ASTM-E57");
  expect_error(parse_e57, e57().bytes().substr(0, 1024), "it has 1024");
  expect_error(parse_e57, with("recordCount=\"5\"", "recordCount=\"5000000000\""), "5000000000 points are promised");
  expect_error(parse_e57, with("recordCount=\"5\"", "recordCount=\"-1\""), "a whole number is expected");
  expect_error(parse_e57, with("<cartesianY ", "<cartesianV "),
               "scan 1: its records have neither cartesianX, Y and Z nor spherical");
  expect_error(parse_e57, with(">0.7071067811865476</w>", ">7</w>"), "the quaternion of its pose has the length");
  expect_error(parse_e57, with("</prototype>", "</prototyp>"), "mismatched tag");
  expect_error(parse_e57, with("<e57Root", "<!DOCTYPE a [<!ENTITY b \"c\">]><e57Root"), "a document type is declared");
  expect_error(parse_e57, with("<codecs type=\"Vector\"/>", "<codecs><vectorChild><zipCodec/></vectorChild></codecs>"),
               "packed with 'zipCodec'");
  E57File beyond = e57();
  beyond.scans[0].fields[3].raw[0] = 3;
  expect_error(parse_e57, beyond.bytes(), "a value of 'cartesianInvalidState' lies beyond its maximum");
  expect_error(parse_e57, E57File{}.bytes(), "the file holds no points");
}

TEST(E57, ACoordinateSystemOfTheEarthIsNamed) {
  TREADMARK_NEEDS("expat");
  E57File file = e57();
  file.more = "<coordinateMetadata type=\"String\"><![CDATA[EPSG:25832]]></coordinateMetadata>";
  EXPECT_EQ(parse(parse_e57, file.bytes()).reference, "EPSG:25832");
}

}  // namespace
}  // namespace treadmark::io
