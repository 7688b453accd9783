// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "scan_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

Scan columns(const std::string& text) { return parse_in_all_blocks(scans::parse_columns, text); }

void expect_columns_error(const std::string& text, const std::string& part, int line = 0, int column = 0) {
  testing::expect_error(scans::parse_columns, text, part, line, column);
}

const std::vector<Vec3> kTwo = {{1.5, 2, -3}, {4, 5e-1, 6.25}};

TEST(Columns, Separators) {
  for (const char* text : {"1.5 2 -3\n4 5e-1 6.25\n", " 1.5\t2  -3 \r\n\t4 5e-1 6.25\r\n", "1.5\t2\t-3\n4\t5e-1\t6.25",
                           "1.5,2,-3\n4,5e-1,6.25\n", "1.5, 2, -3\n4, 5e-1, 6.25\n", "1.5,\t2,\t-3\n4,\t5e-1,\t6.25\n",
                           "1.5;2;-3;\n4;5e-1;6.25;\n", "1.5 ; 2 ; -3\n4;5E-1;+6.25\n", "1.5 2 -3\r4 5d-1 6.25\r",
                           "\xEF\xBB\xBF"
                           "1.5 2 -3\n\n  \n4 .5 6.25\n"}) {
    SCOPED_TRACE(text);
    const Scan scan = columns(text);
    EXPECT_EQ(scan.cloud.points, kTwo);
    EXPECT_EQ(scan.points_in_file, 2u);
    EXPECT_EQ(scan.format.substr(0, 33), "columns x y z (assumed: no names)");
  }
  EXPECT_EQ(columns("1.5,2,-3\n4,5e-1,6.25\n").format, "columns x y z (assumed: no names), separated by ','");
  EXPECT_EQ(columns("1.5\t2\t-3\n").format, "columns x y z (assumed: no names), separated by tabs");
}

TEST(Columns, DecimalCommas) {
  for (const char* text : {"1,5;2;-3\n4;5e-1;6,25\n", "1,5\t2,0\t-3,0\n4\t0,5\t6,25\n", "1,5 2 -3\n4 5e-1 6,25\n",
                           "1,5 2,0 -3,0\n4,0 0,5 6,25\n"}) {
    SCOPED_TRACE(text);
    const Scan scan = columns(text);
    EXPECT_EQ(scan.cloud.points, kTwo);
    EXPECT_NE(scan.format.find("decimal comma"), std::string::npos) << scan.format;
  }
  // with points, or without a blank, commas separate
  EXPECT_EQ(columns("1,5,2\n").cloud.points, (std::vector<Vec3>{{1, 5, 2}}));
  EXPECT_EQ(columns("1, 5, 2\n").cloud.points, (std::vector<Vec3>{{1, 5, 2}}));
  expect_columns_error("1.5;2,5;3\n1;2;3\n", "this is '2,5' (write decimal points", 1, 5);
  expect_columns_error("1,2 3,4 5.0,6\n", "", 1, 3);
}

TEST(Columns, NamesInAHeader) {
  for (const char* text :
       {"z,y,x\n-3,2,1.5\n6.25,0.5,4\n", "Intensity;Z [mm];\"Y [mm]\";X [mm]\n9;-3;2;1.5\n9;6.25;0.5;4\n",
        "// Z Y X\n-3 2 1.5\n6.25 .5 4\n",
        "# made by a scanner\n# z_mm y_mm x_mm # note\n# z (mm) y (mm) x (mm)\n-3 2 1.5\n6.25 .5 4\n",
        "Exported today\nZ [mm]  Y [mm]  X [mm]\n-3 2 1.5\n6.25 .5 4\n", "#z,y,x\n-3 2 1.5\n6.25 .5 4\n",
        "\"Points:2\",\"Points:1\",\"Points:0\",\"label\"\n-3,2,1.5,a\n6.25,0.5,4,b c\n"}) {
    SCOPED_TRACE(text);
    const Scan scan = columns(text);
    EXPECT_EQ(scan.cloud.points, kTwo);
    EXPECT_EQ(scan.format.find("assumed"), std::string::npos) << scan.format;
    EXPECT_EQ(scan.unit.has_value(), std::string(text).find("mm") != std::string::npos);
    if (scan.unit) {
      EXPECT_EQ(*scan.unit, LengthUnit::millimetre);
    }
  }
  const Scan all = columns("Line ID,x,y,z,nx,ny,nz,pass\n1,1.5,2,-3,0,0,1,3\n2,4,0.5,6.25,0,-1,0,4\n");
  EXPECT_EQ(all.cloud.points, kTwo);
  EXPECT_EQ(all.cloud.normals, (std::vector<Eigen::Vector3f>{{0, 0, 1}, {0, -1, 0}}));
  EXPECT_EQ(all.cloud.passes, (std::vector<std::uint16_t>{3, 4}));
  EXPECT_EQ(all.format, "columns x y z nx ny nz pass and 1 ignored, separated by ','");
}

TEST(Columns, IntensitiesAndRanges) {
  const std::string text = "x,y,z,Intensity\n1,0,0,20\n2,0,0,-\n3,0,0,40\n";
  const Scan scan = columns(text);
  EXPECT_EQ(scan.format, "columns x y z intensity, separated by ','");
  ASSERT_EQ(scan.cloud.intensities.size(), 3u);
  EXPECT_EQ(scan.cloud.intensities[0], 20.0f);
  EXPECT_TRUE(std::isnan(scan.cloud.intensities[1]));
  ScanReadOptions options;
  options.station = Vec3(0, 0, 0);
  options.ranges = ScanRanges{1.5, 10.0};
  options.ranges->least_intensity = 30.0;
  const Scan some = parse(scans::parse_columns, text, ByteBlocks::kBlock, options);
  EXPECT_EQ(some.cloud.points.size(), 2u) << "what is not known is no reason to leave a point out";
  EXPECT_EQ(some.outside, 1u);
  const auto refused = [&](const std::string& bytes, const std::string& part) {
    try {
      parse(scans::parse_columns, bytes, ByteBlocks::kBlock, options);
      ADD_FAILURE() << part;
    } catch (const Error& error) {
      EXPECT_NE(error.message().find(part), std::string::npos) << error.message();
    }
  };
  refused("x,y,z\n1,0,0\n2,0,0\n", "the file has no intensities");
  options.station.reset();
  refused(text, "does not say where the scanner stood");
}

TEST(Columns, UnitsOfNamesAndComments) {
  EXPECT_EQ(columns("# unit: um\n1 2 3\n").unit, LengthUnit::micrometre);
  EXPECT_EQ(columns("# unit: um\nx[in] y[in] z[in]\n1 2 3\n").unit, LengthUnit::inch);
  EXPECT_EQ(columns("x_m,y_m,z_m\n1,2,3\n").unit, LengthUnit::metre);
  EXPECT_EQ(columns("X (\xB5m);Y;Z\n1;2;3\n").unit, LengthUnit::micrometre);
  EXPECT_FALSE(columns("x,y,z,d [mm]\n1,2,3,4\n").unit);
  expect_columns_error("x [mm],y [mm],z [um]\n1,2,3\n", "different units", 1, 0);
}

TEST(Columns, LinesThatCannotBePasses) {
  const Scan lines = columns("x y z line\n1.5 2 -3 1\n4 .5 6.25 70000\n");
  EXPECT_EQ(lines.cloud.points, kTwo);
  EXPECT_TRUE(lines.cloud.passes.empty());
  EXPECT_NE(lines.format.find("the pass of line 3 is none"), std::string::npos) << lines.format;
  EXPECT_EQ(columns("x y z line\n1.5 2 -3 1\n4 .5 6.25 2\n").cloud.passes, (std::vector<std::uint16_t>{1, 2}));
  expect_columns_error("x y z pass\n1.5 2 -3 1\n4 .5 6.25 70000\n",
                       "the pass 70000 is not a whole number from 0 to 65535", 3, 0);
  expect_columns_error("x y z pass\n1.5 2 -3 1.5\n", "the pass 1.5 is not", 2, 0);
  expect_columns_error("x,y,z,scan\n1.5,2,-3,\n", "the pass nan is not a whole number", 2, 0);
}

TEST(Columns, NumberOfColumns) {
  EXPECT_EQ(columns("1.5 2 -3 77\n4 .5 6.25 77\n").format,
            "columns x y z and 1 ignored (assumed: no names), separated by blanks");
  const Scan normals = columns("1.5 2 -3 0 0 -1\n4 .5 6.25 0.6 0 0.8\n4 5 6 0 0 0\n");
  EXPECT_EQ(normals.cloud.normals, (std::vector<Eigen::Vector3f>{{0, 0, -1}, {0.6f, 0, 0.8f}, {0, 0, 0}}));
  EXPECT_EQ(normals.format, "columns x y z nx ny nz (assumed: no names, unit vectors), separated by blanks");
  const Scan colours = columns("1.5 2 -3 255 0 0\n4 .5 6.25 0 0 1\n");
  EXPECT_EQ(colours.cloud.points, kTwo);
  EXPECT_TRUE(colours.cloud.normals.empty());
  EXPECT_EQ(colours.format, "columns x y z and 3 ignored (assumed: no names), separated by blanks");
  EXPECT_EQ(columns("1.5 2 -3 -100 255 0 0\n4 .5 6.25 1 0 0 1\n").cloud.points, kTwo);
}

TEST(Columns, Comments) {
  EXPECT_EQ(columns("# a\n! b\n% c\n// d\n; e f\n1.5 2 -3 # here\n#\n4 .5 6.25 // 7\n").cloud.points, kTwo);
}

TEST(Columns, CountsBeforeThePoints) {
  EXPECT_EQ(columns("2\n1.5 2 -3 1 2 3 4\n4 .5 6.25 1 2 3 4\n").cloud.points, kTwo);
  EXPECT_EQ(columns("x y z\n1\n1.5 2 -3\n1\n4 .5 6.25\n").cloud.points, kTwo);
  EXPECT_EQ(columns("1\n1.5,2,-3\n4,.5,6.25\n").cloud.points, kTwo);  // fewer promised than there are
  expect_columns_error("3\n1.5 2 -3\n4 .5 6.25\n", "3 points are promised, the file ends after 2", 3, 0);
  expect_columns_error("1000\n1.5 2 -3\n4 .5 6.25\n", "1000 points are promised, more than the file can hold", 1, 0);
}

TEST(Columns, LostPoints) {
  const Scan scan = columns("nan nan nan\n1.5 2 -3\n1 NaN 2\n4 .5 6.25\ninf 0 0\n1e999 0 0\n1.#QNAN 0 0\n");
  EXPECT_EQ(scan.cloud.points, kTwo);
  EXPECT_EQ(scan.not_finite, 5u);
  EXPECT_EQ(scan.points_in_file, 7u);
  EXPECT_EQ(columns("1.#QNAN 1.#QNAN 1.#QNAN\n1.5 2 -3\n4 .5 6.25\n").cloud.points, kTwo);
  const Scan empty = columns("1.5,2,-3\n,,1\n1,,3\n4,.5,6.25\n");
  EXPECT_EQ(empty.cloud.points, kTwo);
  EXPECT_EQ(empty.not_finite, 2u);
  EXPECT_EQ(columns("1.5 2 -3\n1e-999 0 -0.0\n").cloud.points[1], Vec3(0, 0, 0));
}

TEST(Columns, Errors) {
  expect_columns_error("# nothing\n", "the file holds no points");
  expect_columns_error("this is a letter\nto somebody\n", "numbers are expected, this is 'this is a letter'", 1, 1);
  expect_columns_error("1 2\n3 4\n", "at least three columns, the line has 2", 1, 1);
  expect_columns_error("# a\n1 2 3\n4 5\n", "the line has 2 columns, those before have 3", 3, 0);
  expect_columns_error("1 2 3\n4 5 6 7\n", "more than the 3 columns of the lines before (do two lines run together?)",
                       2, 7);
  expect_columns_error("1 2 3\n4 five 6\n", "a number is expected, this is 'five'", 2, 3);
  expect_columns_error("1 2 3\nfour 5 6\n", "a number is expected, this is 'four 5 6' (put a #", 2, 1);
  expect_columns_error("1,2,3\n4,5,0x10\n", "this is '0x10'", 2, 5);
  expect_columns_error("a b c\n1 2 3\n", "neither numbers nor 3 names of columns", 1, 1);
  expect_columns_error("x y z\n1 2 3 4\n", "neither numbers nor 4 names of columns", 1, 1);
  expect_columns_error("x x y z\n1 2 3 4\n", "a coordinate is named twice", 1, 0);
  expect_columns_error(std::string("1 2 3\n4 5\0 6\n", 13), "NUL byte", 2, 4);
  expect_columns_error(std::string("\xFF\xFE"
                                   "1\0 \0",
                                   6),
                       "UTF-16", 1, 1);
  ScanReadOptions few;
  few.most_points = 2;
  testing::expect_error(scans::parse_columns, "1 2 3\n4 5 6\n7 8 9\n", "more than the 2 points allowed", 3, 0, few);
}

}  // namespace
}  // namespace treadmark::io
