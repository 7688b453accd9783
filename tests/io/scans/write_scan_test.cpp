// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <random>

#include "sample_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

/// Points of a piece of rail [m], with normals and passes.
PointCloud sample_cloud(std::size_t count = 500) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-0.05, 0.05);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    cloud.points.push_back({20.0 + u(random), u(random), 0.1 * u(random)});
    cloud.normals.push_back(Vec3(u(random), u(random), -0.1).normalized().cast<float>());
    cloud.passes.push_back(static_cast<std::uint16_t>(random() % 3));
  }
  return cloud;
}

TEST(WriteScan, RoundTripsInEveryUnit) {
  const TemporaryFolder folder;
  const PointCloud cloud = sample_cloud();
  for (const char* name : {"a.ply", "a.xyz", "a.asc", "a.txt", "a.csv", "a.las"})
    for (const LengthUnit unit : kLengthUnits)
      for (const bool all : {true, false}) {
        SCOPED_TRACE(std::string(name) + " " + std::string(symbol(unit)));
        PointCloud written = cloud;
        if (!all) {
          written.normals.clear();
          written.passes.clear();
        }
        const auto file = folder.path() / name;
        write_scan(file, written, unit);
        const Scan scan = read_scan(file);
        EXPECT_EQ(scan.unit, unit);
        EXPECT_EQ(scan.points_in_file, cloud.points.size());
        ASSERT_EQ(scan.cloud.points.size(), cloud.points.size());
        const bool las = file.extension() == ".las";
        // doubles come back but for the rounding of the scale; LAS has steps, 1e-10 m on a cloud of 0.1 m
        const double tolerance = las ? 0.51e-10 * std::sqrt(3.0) + 1e-14 : 1e-14;
        for (std::size_t i = 0; i < cloud.points.size(); ++i)
          ASSERT_LE((metres_per(unit) * scan.cloud.points[i] - cloud.points[i]).norm(), tolerance) << i;
        if (las)
          EXPECT_TRUE(scan.cloud.normals.empty());
        else
          EXPECT_EQ(scan.cloud.normals, written.normals);
        EXPECT_EQ(scan.cloud.passes, written.passes);
        const std::string bytes = content_of(file);
        write_scan(file, written, unit);
        EXPECT_EQ(content_of(file), bytes);
      }
}

TEST(WriteScan, HeadersOfTextFiles) {
  const TemporaryFolder folder;
  PointCloud cloud;
  cloud.points = {{0.001, -0.0025, 0.000125}};
  cloud.passes = {3};
  write_scan(folder.path() / "a.csv", cloud, LengthUnit::millimetre);
  EXPECT_EQ(content_of(folder.path() / "a.csv"), "x[mm],y[mm],z[mm],pass\n1,-2.5,0.125,3\n");
  cloud.normals = {{0, 0, -1}};
  cloud.points[0][2] = 0.0;
  write_scan(folder.path() / "a.xyz", cloud, LengthUnit::micrometre);
  EXPECT_EQ(content_of(folder.path() / "a.xyz"), "# x[um] y[um] z[um] nx ny nz pass\n1000 -2500 0 0 0 -1 3\n");
}

/// The fields of the header at the places of the ASPRS tables.
TEST(WriteScan, LasHeaderIsSound) {
  const TemporaryFolder folder;
  const PointCloud cloud = sample_cloud(100);
  write_scan(folder.path() / "a.las", cloud, LengthUnit::millimetre);
  const std::string bytes = content_of(folder.path() / "a.las");
  const auto number = [&](std::size_t at, auto value) {
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  EXPECT_EQ(bytes.size(), 227u + 20u * 100u);
  EXPECT_EQ(bytes.substr(0, 4), "LASF");
  EXPECT_EQ(number(94, std::uint16_t{}), 227);
  EXPECT_EQ(number(96, std::uint32_t{}), 227u);
  EXPECT_EQ(number(100, std::uint32_t{}), 0u);
  EXPECT_EQ(number(107, std::uint32_t{}), 100u);
  EXPECT_EQ(number(111, std::uint32_t{}), 100u);
  double least = 1e300, greatest = -1e300;
  for (const Vec3& p : cloud.points) {
    least = std::min(least, 1e3 * p[0]);
    greatest = std::max(greatest, 1e3 * p[0]);
  }
  EXPECT_NEAR(number(179, double{}), greatest, 1e-9);
  EXPECT_NEAR(number(187, double{}), least, 1e-9);
  EXPECT_NEAR(number(131, double{}), 1e-7, 1e-20);  // 0.1 nm in mm
}

TEST(WriteScan, LasStepsFollowTheSize) {
  const TemporaryFolder folder;
  PointCloud cloud;
  cloud.points = {{-200, 0, 0}, {200, 0, 0}, {0.123456789, 0, 0}};
  write_scan(folder.path() / "a.las", cloud, LengthUnit::metre);
  EXPECT_NEAR(read_scan(folder.path() / "a.las").cloud.points[2][0], 0.123456789, 0.5e-7);
  cloud.points[0][0] = -300;
  const Error error = error_thrown_by([&] { write_scan(folder.path() / "a.las", cloud, LengthUnit::metre); });
  EXPECT_EQ(error.kind(), ErrorKind::configuration);
  EXPECT_NE(std::string(error.what()).find("500 m of points are too long"), std::string::npos) << error.what();
  EXPECT_EQ(read_scan(folder.path() / "a.las").cloud.points[0][0], -200.0);  // the old file is still there
}

TEST(WriteScan, Errors) {
  const TemporaryFolder folder;
  PointCloud cloud = sample_cloud(3);
  const auto expect = [&](const std::filesystem::path& file, const std::string& part) {
    const Error error = error_thrown_by([&] { write_scan(file, cloud, LengthUnit::millimetre); });
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  };
  expect(folder.path() / "a.stl", "use one of .ply .las .xyz");
  std::filesystem::create_directory(folder.path() / "dir.ply");
  expect(folder.path() / "dir.ply", "it is a folder");
  expect("/dev/null/a.ply", "cannot write");
  cloud.passes.pop_back();
  expect(folder.path() / "a.ply", "differ");
  cloud.passes.clear();
  cloud.points[1][1] = std::nan("");
  expect(folder.path() / "a.ply", "not finite");
  cloud = {};
  expect(folder.path() / "a.ply", "no points");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.ply"));
}

}  // namespace
}  // namespace treadmark::io
