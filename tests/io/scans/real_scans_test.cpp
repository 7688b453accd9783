// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <set>

#include "scan_files.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

const Vec3 kAny = Vec3::Zero();
constexpr double kWritten = 1.5e-6;  // decimals of the files

/// Files of others: either how many points they have and where the first and last of them lie, or what the refusal
/// says.
struct RealFile {
  const char* file;
  std::size_t points = 0, lost = 0;
  Vec3 first = kAny, last = kAny;
  const char* says = "";  ///< part of the format, or of the error
};

const RealFile kRefused[] = {
    {"points/ZeroPoints.e57", 0, 0, kAny, kAny, "the file holds no points"},
    {"points/bad-crc.e57", 0, 0, kAny, kAny, "page 0 is damaged: its check sum is wrong"},
    {"points/missingheader.pcd", 0, 0, kAny, kAny, "rename the file to .xyz"},
    {"las/no-points.las", 0, 0, kAny, kAny, "the coordinates are longitudes and latitudes (EPSG 4269)"},
    {"las/plane.laz", 0, 0, kAny, kAny, "'laszip -i plane.laz -o plane.las'"},
    {"las/simple.laz", 0, 0, kAny, kAny, "'pdal translate simple.laz simple.las'"}};

const RealFile kRead[] = {
    {"points/1.2-with-color.ptx", 1065, 0, {637012.24, 849028.31, 431.66}, {637342.85, 853240.32, 423.92}, "1 station"},
    {"points/multiple-and-transform.ptx",
     8,
     0,
     {637012.24, 849028.31, 431.66},
     {636699.38, 848991.01, 425.39},
     "2 stations, the matrix of station 1 stretches by 1 to 2, pass from the station"},
    {"points/complex-transform.ptx",
     4,
     8,
     {-3.034407381, -3.173781036, -1.823750042},
     {-3.034359790, -3.171403932, -1.822068350},
     "1 station"},
    {"points/no-color.ptx", 15, 0, {637012.24, 849028.31, 431.66}, {635795.24, 849310.43, 426.61}, "1 station"},
    {"points/autzen.pts",
     10,
     0,
     {636110.300003, 849345.050003, 512.139999},
     {636125.879990, 848971.060013, 428.050003},
     "4 ignored"},
    {"points/bunny_8.pts",
     9,
     0,
     {-0.037829, 0.12794, 0.004474},
     {-0.025508, 0.112568, 0.036676},
     "8 points promised and 9 found"},
    {"points/test.pts", 19, 0, {3.980972, -2.006119, -0.010086}, kAny, "4 ignored"},
    {"points/autzen-utm.pcd", 1065, 0, kAny, kAny, "PCD, binary"},
    {"points/rail.pcd", 100000, 0, {73.930847, 62.005657, 105.48886}, kAny, "PCD, ASCII"},
    {"points/wheel.pcd", 100000, 0, {32.251484, 30, 72.260567}, kAny, "PCD, ASCII"},
    {"points/utm17_comma.pcd", 10, 0, {289814.15, 4320978.61, 170.76}, {289818.50, 4320980.59, 170.58}, "PCD, ASCII"},
    {"points/utm17_space.pcd", 10, 0, {289814.15, 4320978.61, 170.76}, {289818.50, 4320980.59, 170.58}, "PCD, ASCII"},
    {"points/utm17_tab.pcd", 10, 0, {289814.15, 4320978.61, 170.76}, {289818.50, 4320980.59, 170.58}, "PCD, ASCII"},
    {"points/ColouredCubeFloat.e57", 7680, 0, kAny, kAny, "E57, 1 scan"},
    {"points/axle_tof.ply", 14205, 0, {3.55747, -0.375571, 0.406373}, kAny, "PLY, ASCII, normals"},
    {"points/result_ball.ply", 170362, 0, kAny, kAny, "PLY, binary little endian"},
    {"las/1_4_w_evlr.las", 1000, 0, kAny, kAny, "coordinate system NAD83(HARN) / New Mexico Central (ftUS)"},
    {"las/test1_4.las", 1000, 0, kAny, kAny, "coordinate system NAD83(HARN) / New Mexico Central (ftUS)"},
    {"las/bad_vlr_count.las",
     10,
     0,
     {289814.15, 4320978.61, 170.76},
     {289818.50, 4320980.59, 170.58},
     "coordinate system WGS 84 / UTM zone 17N"},
    {"las/extrabytes.las", 1065, 0, {637012.24, 849028.31, 431.66}, {637342.85, 853240.32, 423.92}, "LAS 1.4"},
    {"las/gps-time-nan.las", 1, 0, kAny, kAny, "LAS 1.2"},
    {"las/lots_of_vlr.las", 1, 0, {715001.346, 839349.171, 17.275}, kAny, "coordinate system without a name"},
    {"las/simple1_3.las", 999, 0, kAny, kAny, "LAS 1.3"}};

TEST(RealScans, AreReadRightlyOrRefusedWithAWayOut) {
  TREADMARK_REQUIRE_SHARED();
  std::set<std::string> all;
  for (const RealFile& real : kRefused) {
    all.insert(real.file);
    if (!has_part("expat") && std::string(real.file).ends_with(".e57")) continue;
    const Error error = error_thrown_by([&] { read_scan(*shared / "data/real" / real.file); });
    EXPECT_EQ(error.kind(), ErrorKind::input_data) << real.file;
    EXPECT_NE(std::string(error.what()).find(real.says), std::string::npos) << real.file << ": " << error.what();
    EXPECT_FALSE(error.advice().empty()) << real.file;
  }
  for (const RealFile& real : kRead) {
    SCOPED_TRACE(real.file);
    all.insert(real.file);
    if (!has_part("expat") && std::string(real.file).ends_with(".e57")) continue;
    const Scan scan = read_scan(*shared / "data/real" / real.file);
    EXPECT_EQ(scan.cloud.points.size() + scan.withheld, real.points);
    EXPECT_EQ(scan.not_finite, real.lost);
    EXPECT_NE(scan.format.find(real.says), std::string::npos) << scan.format;
    const auto expect_near = [](const Vec3& found, const Vec3& expected) {
      if (expected != kAny) {
        EXPECT_LT((found - expected).norm(), kWritten) << found.transpose();
      }
    };
    expect_near(scan.cloud.points.front(), real.first);
    expect_near(scan.cloud.points.back(), real.last);
  }
  for (const char* folder : {"points", "las"})
    for (const auto& entry : std::filesystem::directory_iterator(*shared / "data/real" / folder))
      EXPECT_TRUE(all.contains(std::string(folder) + "/" + entry.path().filename().string())) << entry.path();
}

TEST(RealScans, TheCubeIsACubeAndItsColoursAreNoPlaces) {
  TREADMARK_REQUIRE_SHARED();
  if (!has_part("expat")) GTEST_SKIP();
  const Scan scan = read_scan(*shared / "data/real/points/ColouredCubeFloat.e57");
  // every point lies on a face
  for (const Vec3& p : scan.cloud.points) ASSERT_NEAR(p.cwiseAbs().maxCoeff(), 0.5, 1e-6);
}

/// The same points of the same survey in two formats.
TEST(RealScans, TheSamePointsInTwoFormatsAreTheSame) {
  TREADMARK_REQUIRE_SHARED();
  const auto folder = *shared / "data/real";
  const Scan las = read_scan(folder / "las/extrabytes.las"), ptx = read_scan(folder / "points/1.2-with-color.ptx");
  ASSERT_EQ(las.cloud.points.size(), ptx.cloud.points.size());
  for (std::size_t i = 0; i < las.cloud.points.size(); ++i)
    ASSERT_LT((las.cloud.points[i] - ptx.cloud.points[i]).norm(), 1e-6) << i;
}

}  // namespace
}  // namespace treadmark::io
