// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <limits>
#include <sstream>

#include "sample_files.hpp"
#include "treadmark/io/files/shape_extension.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

void expect_sample(const Scan& scan, double tolerance = 0.0) {
  ASSERT_EQ(scan.cloud.points.size(), kPoints.size());
  EXPECT_EQ(scan.cloud.name, "sample");
  EXPECT_EQ(scan.points_in_file, kPoints.size());
  EXPECT_EQ(scan.not_finite, 0u);
  for (std::size_t i = 0; i < kPoints.size(); ++i)
    EXPECT_LE((scan.cloud.points[i] - kPoints[i]).norm(), tolerance) << i;
}

void expect_ply(const Scan& scan, const std::string& format) {
  expect_sample(scan);
  EXPECT_EQ(scan.cloud.normals, kNormals);
  EXPECT_EQ(scan.cloud.passes, kPasses);
  EXPECT_EQ(scan.unit, LengthUnit::micrometre);
  EXPECT_EQ(scan.format, "PLY, " + format + ", normals, pass from the property scan_id");
}

TEST(ScanFormats, PlyOfAnyOrderAndType) {
  for (const bool list : {false, true}) {
    expect_ply(parse_in_all_blocks(scans::parse_ply, ascii_ply(list)), "ASCII");
    expect_ply(parse_in_all_blocks(scans::parse_ply, binary_ply(false, list)), "binary little endian");
    expect_ply(parse_in_all_blocks(scans::parse_ply, binary_ply(true, list)), "binary big endian");
  }
}

TEST(ScanFormats, PlyWithoutNormalsPassAndUnit) {
  const Scan scan = parse(scans::parse_ply,
                          "ply\nformat ascii 1.0\nelement vertex 2\nproperty int x\nproperty int y\nproperty int z\n"
                          "property float nx\nproperty float pass\nend_header\r\n1 2 3 0 0\r\n4 5 6 0 0");
  EXPECT_EQ(scan.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_TRUE(scan.cloud.normals.empty());  // ny and nz are missing
  EXPECT_TRUE(scan.cloud.passes.empty());   // passes are whole numbers
  EXPECT_FALSE(scan.unit);
  EXPECT_EQ(scan.format, "PLY, ASCII");
}

TEST(ScanFormats, PointsThatAreNotFiniteAreCountedAndDropped) {
  const Scan scan = parse_in_all_blocks(
      scans::parse_ply,
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar pass\nend_header\n1 2 3 1\nnan 2 3 2\n1 -inf 3 3\n1 2 -1.#IND 4\n4 5 6 5\n");
  EXPECT_EQ(scan.cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(scan.cloud.passes, (std::vector<std::uint16_t>{1, 5}));
  EXPECT_EQ(scan.not_finite, 3u);
  EXPECT_EQ(scan.points_in_file, 5u);
}

TEST(ScanFormats, NormalsBecomeUnitVectorsOrZero) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nend_header\n1 2 3 0 -3 4\n1 2 4 0 0 0\n1 2 5 nan 0 1\n";
  const Scan scan = parse(scans::parse_ply, text);
  ASSERT_EQ(scan.cloud.normals.size(), 3u);
  EXPECT_LT((scan.cloud.normals[0] - Eigen::Vector3f(0, -0.6f, 0.8f)).norm(), 1e-7f);
  EXPECT_EQ(scan.cloud.normals[1], Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(scan.cloud.normals[2], Eigen::Vector3f(0, 0, 0));
  const Scan zero = parse(scans::parse_ply, replaced(text, "0 -3 4", "0 0 0"));
  EXPECT_TRUE(zero.cloud.normals.empty());
  EXPECT_NE(zero.format.find("all zero"), std::string::npos);
}

TEST(ScanFormats, UnitsThatAPlyCommentStates) {
  const auto unit_of = [](const std::string& comment) {
    return parse(scans::parse_ply,
                 "ply\nformat ascii 1.0\ncomment " + comment +
                     "\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n")
        .unit;
  };
  EXPECT_EQ(unit_of("millimetres"), LengthUnit::millimetre);
  EXPECT_EQ(unit_of("unit mm"), LengthUnit::millimetre);
  EXPECT_EQ(unit_of("Unit: Meters"), LengthUnit::metre);
  EXPECT_EQ(unit_of("units are in inches"), LengthUnit::inch);
  EXPECT_EQ(unit_of("unit=in"), LengthUnit::inch);
  EXPECT_EQ(unit_of("coordinates in microns"), LengthUnit::micrometre);
  EXPECT_EQ(unit_of("points [\xC2\xB5m]"), LengthUnit::micrometre);
  EXPECT_FALSE(unit_of("scanned with 5 mm spacing, made in Germany"));
  EXPECT_FALSE(unit_of("a unit of measuring"));
  EXPECT_FALSE(unit_of("unit mm\ncomment unit m"));  // which of them?
}

TEST(ScanFormats, StlCornersOnceEach) {
  for (const char* title : {"solid or not", "binary STL, millimetres"}) {
    const Scan scan = parse_in_all_blocks(scans::parse_stl, binary_stl(title));
    EXPECT_EQ(scan.cloud.points, kCorners);
    EXPECT_EQ(scan.points_in_file, 4u);
    EXPECT_EQ(scan.format, "STL, binary");
    EXPECT_EQ(scan.unit.has_value(), title[0] == 'b');
  }
  const Scan text = parse_in_all_blocks(scans::parse_stl, ascii_stl());
  EXPECT_EQ(text.cloud.points, kCorners);
  EXPECT_EQ(text.format, "STL, ASCII");
  EXPECT_EQ(text.unit, LengthUnit::millimetre);
}

TEST(ScanFormats, StlZerosOfBothSignsDifferBitByBit) {
  const Scan scan = parse(scans::parse_stl, replaced(ascii_stl(), "VERTEX 0 0 0", "VERTEX 0 -0 0"));
  EXPECT_EQ(scan.cloud.points.size(), 5u);
}

TEST(ScanFormats, StlDeduplicationOfManyCorners) {
  // every corner of a strip comes up to six times; the set of numbers has to grow often
  std::string out(80, ' ');
  constexpr int kColumns = 20'000;
  put_bytes(out, std::uint32_t{2 * kColumns});
  const auto corner = [&](int i, int j) {
    for (const int c : {i, j, (i * 7919) % 1013}) put_bytes(out, static_cast<float>(c) * 0.125f);
  };
  for (int i = 0; i < kColumns; ++i)
    for (int t = 0; t < 2; ++t) {
      out.append(12, '\0');
      corner(i, 0);
      corner(i + 1, t);
      corner(i + t * 0, 1);
      out.append(2, '\0');
    }
  const Scan scan = parse(scans::parse_stl, out, 1000);
  EXPECT_EQ(scan.cloud.points.size(), 2u * (kColumns + 1));
  EXPECT_EQ(scan.cloud.points.front(), Vec3(0, 0, 0));
}

TEST(ScanFormats, ObjWithNormalsAndContinuedLines) {
  const Scan scan = parse_in_all_blocks(scans::parse_obj, obj());
  expect_sample(scan);
  EXPECT_EQ(scan.cloud.normals, kNormals);
  EXPECT_EQ(scan.unit, LengthUnit::millimetre);
  EXPECT_EQ(scan.format, "OBJ, normals");
  EXPECT_EQ(parse(scans::parse_obj, "v 1 2 \\\n3\nv 4 \\\r\n 5 \\\r\n 6").cloud.points,
            (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
}

TEST(ScanFormats, ALoneCarriageReturnEndsALineBesideLineFeedsToo) {
  const std::vector<Vec3> both{{1, 2, 3}, {4, 5, 6}};
  for (const char* text :
       {"# a\rv 1 2 3\nv 4 5 6\n", "v 1 2 3\nv 4 5 6\r", "v 1 2 3\n# a\rv 4 5 6", "\nv 1 2 3\rv 4 5 6\r\n"})
    EXPECT_EQ(parse_in_all_blocks(scans::parse_obj, text).cloud.points, both) << text;
}

TEST(ScanFormats, ObjNormalsOnlyWhereEachVertexHasItsOwn) {
  const Scan fewer = parse(scans::parse_obj, replaced(obj(), "vn 0 0 -1\n", ""));
  EXPECT_TRUE(fewer.cloud.normals.empty());
  EXPECT_NE(fewer.format.find("normals ignored"), std::string::npos);
  // as many, but in another order
  const Scan other = parse(scans::parse_obj, replaced(obj(), "2//2 3//3", "2//3 3//2"));
  EXPECT_TRUE(other.cloud.normals.empty());
  EXPECT_EQ(other.cloud.points, kPoints);
  // the normal of a lost point goes with it
  const Scan lost = parse(scans::parse_obj, replaced(obj(), "v 10 0 0.5", "v 10 nan 0.5"));
  EXPECT_EQ(lost.not_finite, 1u);
  EXPECT_EQ(lost.cloud.normals, (std::vector<Eigen::Vector3f>{kNormals[0], kNormals[2], kNormals[3], kNormals[4]}));
}

TEST(ScanFormats, Off) {
  for (const auto& [keyword, more] :
       {std::pair<std::string, std::string>{"OFF", ""}, {"COFF", " 255 0 0 255"}, {"STOFF", " 0 1"}}) {
    const Scan scan = parse_in_all_blocks(scans::parse_off, off(keyword, false, more));
    expect_sample(scan);
    EXPECT_TRUE(scan.cloud.normals.empty());
    EXPECT_EQ(scan.unit, LengthUnit::inch);
    EXPECT_EQ(scan.format, "OFF");
  }
  const Scan normals = parse_in_all_blocks(scans::parse_off, off("CNOFF", true, " 9 9 9"));
  expect_sample(normals);
  EXPECT_EQ(normals.cloud.normals, kNormals);
  expect_sample(parse(scans::parse_off, replaced(off(), "OFF\n# unit in\n\n5", "5")));
  expect_sample(parse(scans::parse_off, replaced(off(), "OFF\n# unit in\n\n5", "OFF 5")));
  const Scan binary = parse_in_all_blocks(scans::parse_off, binary_off());
  expect_sample(binary, 1e-9);  // 1e-3 as a float
  EXPECT_EQ(binary.format, "OFF, binary");
}

TEST(ScanFormats, ByExtension) {
  for (const char* name : {"a.ply", "a.STL", "a.obj", "a.off", "a.xyz", "a.asc", "a.TXT", "a.csv", "a.Las"})
    EXPECT_TRUE(is_scan_file(name)) << name;
  for (const char* name : {"a.laz", "a.toml", "ply", "a.ply.gz", ""}) EXPECT_FALSE(is_scan_file(name)) << name;
  std::string known;  // the table of all shapes names the same extensions as the parsers
  for (const ShapeExtension& row : kShapeExtensions) {
    const std::string name = "a" + std::string(row.extension);
    EXPECT_EQ(is_scan_file(name), row.read && (row.kinds & kPointFile) != 0) << name;
    known += std::string(row.extension) + ' ';
  }
  std::istringstream extensions(scan_extensions());
  for (std::string one; extensions >> one;) EXPECT_NE(known.find(one + ' '), std::string::npos) << one;
  const TemporaryFolder folder;
  const Scan scan = read_scan(folder.write("a.PLY", binary_ply(false)));
  EXPECT_EQ(scan.cloud.points, kPoints);
  EXPECT_EQ(scan.cloud.name, (folder.path() / "a.PLY").string());
  EXPECT_EQ(read_scan(folder.write("b.stl", binary_stl(""))).cloud.points, kCorners);
  EXPECT_EQ(read_scan(folder.write("b.obj", obj())).cloud.points, kPoints);
  EXPECT_EQ(read_scan(folder.write("b.off", off())).cloud.points, kPoints);
  EXPECT_EQ(read_scan(folder.write("b.las", LasFile().bytes())).cloud.points.size(), 3u);
  EXPECT_EQ(read_scan(folder.write("b.asc", "1 2 3\n4 5 6\n")).cloud.points.size(), 2u);
}

}  // namespace
}  // namespace treadmark::io
