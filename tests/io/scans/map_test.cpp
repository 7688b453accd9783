// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <limits>
#include <numbers>

#include "scan_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

using MapParser = OffsetMap (*)(ByteBlocks&, const MapReadOptions&);

OffsetMap map_of(MapParser parser, const std::string& text, const MapReadOptions& options = {}) {
  ByteBlocks whole(text, "sample");
  const OffsetMap map = parser(whole, options);
  for (const std::size_t block : {1u, 3u, 50u}) {
    ByteBlocks blocks(text, "sample", block);
    const OffsetMap again = parser(blocks, options);
    EXPECT_EQ(again.grid, map.grid);
    EXPECT_EQ(0, std::memcmp(again.offset.data(), map.offset.data(), map.offset.size() * sizeof(float)));
  }
  return map;
}

OffsetMap matrix(const std::string& text, const MapReadOptions& options = {}) {
  return map_of(scans::parse_map_matrix, text, options);
}
OffsetMap esri(const std::string& text, const MapReadOptions& options = {}) {
  return map_of(scans::parse_esri_grid, text, options);
}

void expect_matrix_error(const std::string& text, const std::string& part, int line = 0, int column = 0,
                         const MapReadOptions& options = {}) {
  expect_at(error_thrown_by([&] { matrix(text, options); }), part, line, column);
}
void expect_esri_error(const std::string& text, const std::string& part, int line = 0, int column = 0) {
  expect_at(error_thrown_by([&] { esri(text); }), part, line, column);
}

/// x = 100, 102 along the track, y = -10, -5, 0; values 10 ix + iy [um] but one without data.
void expect_sample_map(const OffsetMap& map, double height = 1e-6) {
  EXPECT_EQ(map.name, "sample");
  ASSERT_EQ(map.grid.nx, 2);
  ASSERT_EQ(map.grid.ny, 3);
  EXPECT_NEAR(map.grid.x0, 0.1, 1e-15);
  EXPECT_NEAR(map.grid.dx, 0.002, 1e-15);
  EXPECT_NEAR(map.grid.y0, -0.01, 1e-15);
  EXPECT_NEAR(map.grid.dy, 0.005, 1e-15);
  for (int iy = 0; iy < 3; ++iy)
    for (int ix = 0; ix < 2; ++ix) {
      const float v = map.offset[map.grid.index(ix, iy)];
      if (ix == 1 && iy == 1)
        EXPECT_TRUE(std::isnan(v));
      else
        EXPECT_NEAR(v, height * (10 * ix + iy), 1e-7 * height * 20);
    }
}

TEST(DeviationMaps, Matrix) {
  MapReadOptions options;
  options.height_unit = LengthUnit::micrometre;
  for (const char* text : {",-10,-5,0\n100,0,1,2\n102,10,,12\n", "x\\y [mm];-10;-5;0\n100;0;1;2\n102;10;nan;12\n",
                           "nan -10 -5 0\n100 0 1 2\n102 10 nan 12\n", "# a\n\n  -10 -5 0\n100 0 1 2\n102 10 NaN 12",
                           "x\t-10\t-5\t0\r\n100\t0\t1\t2\r\n102\t10\t\t12\r\n",
                           ";-10,0;-5,0;0,0;\n100;0;1;2;\n102;10;;12;\n", "0,-10,-5,0\n100,0,1,2\n102,10,,12,\n"}) {
    SCOPED_TRACE(text);
    expect_sample_map(matrix(text, options));
  }
}

TEST(DeviationMaps, UnitsOfTheFileAndTheOptions) {
  const std::string text = ",-10,-5,0\n100,0,1,2\n102,10,,12\n";
  expect_sample_map(matrix("# unit mm, deviations in um\n" + text));
  expect_sample_map(matrix("# heights: unit um\n# unit mm\n" + text));
  expect_sample_map(matrix(replaced(text, ",-10,-5,0", "[mm],-10,-5,0")), 1e-3);  // heights as positions
  expect_sample_map(matrix(text), 1e-3);                                          // mm where nothing is said
  const OffsetMap inches = matrix("in,-1,0,1\n0,0,.01,0\n2,0,0,0\n");
  EXPECT_NEAR(inches.grid.dy, 0.0254, 1e-15);
  EXPECT_NEAR(inches.offset[inches.grid.index(0, 1)], 254e-6, 1e-10);
  MapReadOptions options;
  options.unit = LengthUnit::millimetre;
  EXPECT_NEAR(matrix("in,-1,0,1\n0,0,.01,0\n2,0,0,0\n", options).grid.dy, 0.001, 1e-15);
  EXPECT_NEAR(matrix("# deviations in um\nin,-1,0,1\n0,0,10,0\n2,0,0,0\n").offset[2], 10e-6, 1e-12);
}

TEST(DeviationMaps, Wheels) {
  MapReadOptions options;
  options.body = Body::wheel;
  options.nominal_radius = 0.46;
  const std::string text = ",-10,-5\n0,0,1\n460,2,3\n920,4,5\n";
  const OffsetMap lengths = matrix(text, options);
  EXPECT_NEAR(lengths.grid.dx, 1.0, 1e-15);
  EXPECT_NEAR(lengths.grid.y0, -0.01, 1e-15);
  EXPECT_NEAR(lengths.offset[lengths.grid.index(2, 0)], 4e-3, 1e-9);
  options.angles_deg = true;
  options.nominal_radius = 0.0;
  const OffsetMap angles = matrix(replaced(replaced(text, "460", "90"), "920", "180"), options);
  EXPECT_NEAR(angles.grid.dx, std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(angles.grid.nx, 3);
  expect_matrix_error(text, "the map goes 2.55556 times round the wheel (are the rows' positions degrees?)", 0, 0,
                      options);
}

TEST(DeviationMaps, RoundedPositionsAreEven) {
  const OffsetMap map = matrix(",0.33,0.67,1.00\n0,1,1,1\n0.333,1,1,1\n0.667,1,1,1\n");
  EXPECT_NEAR(map.grid.dy, 0.335e-3, 1e-15);
  EXPECT_NEAR(map.grid.dx, 0.3335e-3, 1e-15);
}

TEST(DeviationMaps, MatrixErrors) {
  expect_matrix_error("# a\n", "the file holds no map", 1, 0);
  expect_matrix_error(",-10\n1,2\n2,3\n", "at least two lateral positions", 1, 2);
  expect_matrix_error(",0,1,3,4\n1,0,0,0,0\n2,0,0,0,0\n", "the lateral positions do not increase evenly", 1, 6);
  expect_matrix_error(",0,-1,-2\n1,0,0,0\n2,0,0,0\n", "the lateral positions do not increase evenly", 1, 4);
  expect_matrix_error(",0,1,b\n1,0,0,0\n2,0,0,0\n", "this is 'b'", 1, 6);
  expect_matrix_error(",0,1,2\n1,0,0,0\n2,0,0,0\n4,0,0,0\n", "the positions of the rows do not increase evenly", 4, 1);
  expect_matrix_error(",0,1,2\n1,0,0,0\n1,0,0,0\n", "the positions of the rows do not increase evenly", 3, 1);
  expect_matrix_error(",0,1,2\nnan,0,0,0\n1,0,0,0\n", "the positions of the rows do not increase evenly", 3, 1);
  expect_matrix_error(",0,1,2\n1,0,0,0\n", "at least two rows", 2, 0);
  expect_matrix_error(",0,1,2\n1,0,0,0\n2,0,0\n", "the row has 2 values, there are 3 lateral positions", 3, 0);
  expect_matrix_error(",0,1,2\n1,0,0,0\n2,0,0,0,7\n", "more values than the 3 lateral positions", 3, 9);
  expect_matrix_error(",0,1,2\n1,0,x,0\n2,0,0,0\n", "this is 'x'", 2, 5);
  expect_matrix_error(",0,1,2\n1,,,nan\n2,,,\n", "no data at all");
  expect_matrix_error(",0,1,2\n1,0,0,0\n2,0,51,0\n", "a deviation of 51 mm, more than 50 mm (is its unit right?", 3, 5);
  expect_matrix_error(",0,1,2\n1,0,0,0\n2,0,inf,0\n", "a deviation of inf mm", 3, 5);
  MapReadOptions metres;
  metres.unit = LengthUnit::metre;
  expect_matrix_error(",0,1,2\n1,0,0,0\n2,0,-0.1,0\n", "a deviation of -100 mm", 3, 5, metres);
}

const std::string kEsri =
    "ncols 2\nNROWS 3\nxllcorner 99\nyllcorner -12.5\ncellsize 2\nNODATA_value -9999\n2 12\n1 -9999\n0 10\n";

TEST(DeviationMaps, EsriGrid) {
  MapReadOptions options;
  options.height_unit = LengthUnit::micrometre;
  const OffsetMap map = esri(kEsri, options);
  ASSERT_EQ(map.grid.nx, 2);
  ASSERT_EQ(map.grid.ny, 3);
  EXPECT_NEAR(map.grid.x0, 0.1, 1e-15);
  EXPECT_NEAR(map.grid.y0, -0.0115, 1e-15);
  EXPECT_NEAR(map.grid.dx, 0.002, 1e-15);
  EXPECT_NEAR(map.grid.dy, 0.002, 1e-15);
  for (int iy = 0; iy < 3; ++iy)
    for (int ix = 0; ix < 2; ++ix) {
      const float v = map.offset[map.grid.index(ix, iy)];
      if (ix == 1 && iy == 1)
        EXPECT_TRUE(std::isnan(v));
      else
        EXPECT_NEAR(v, 1e-6 * (10 * ix + iy), 1e-11);
    }
  const OffsetMap centre =
      esri(replaced(replaced(replaced(kEsri, "xllcorner", "xllcenter"), "NODATA_value -9999\n", ""), "-12.5", "-12,5"),
           options);
  EXPECT_NEAR(centre.grid.x0, 0.099, 1e-15);
  EXPECT_NEAR(centre.grid.y0, -0.0115, 1e-15);
  EXPECT_TRUE(std::isnan(centre.offset[3]));
  EXPECT_NEAR(esri("# unit: um\n" + kEsri).grid.dx, 2e-6, 1e-15);
}

TEST(DeviationMaps, EsriErrors) {
  expect_esri_error(replaced(kEsri, "NROWS 3\n", ""), "the header lacks nrows", 6, 0);
  expect_esri_error(replaced(kEsri, "yllcorner -12.5\n", ""), "the header lacks yllcorner", 6, 0);
  expect_esri_error(replaced(kEsri, "ncols 2", "ncols 2.5"), "ncols must be a whole number of at least 2", 1, 7);
  expect_esri_error(replaced(kEsri, "cellsize 2", "cellsize 0"), "cellsize must be positive", 5, 10);
  expect_esri_error(replaced(kEsri, "cellsize 2", "cellsize"), "one value is expected behind cellsize", 5, 1);
  expect_esri_error(replaced(kEsri, "cellsize 2", "cellsize 2\ncellsize 2"), "cellsize a second time", 6, 1);
  expect_esri_error(replaced(kEsri, "cellsize 2", "cells 2"), "unknown line 'cells' in the header", 5, 1);
  expect_esri_error(replaced(kEsri, "xllcorner 99", "xllcorner inf"), "xllcorner must be finite", 3, 11);
  expect_esri_error(replaced(kEsri, "NROWS 3", "NROWS 300"),
                    "300 times 2 values are promised, more than the file can hold");
  expect_esri_error(replaced(kEsri, "0 10\n", "        "), "the file ends after 2 of 3 rows", 9, 0);
  expect_esri_error(kEsri + "1 2\n", "more than the 3 rows of the header", 10, 1);
  expect_esri_error(replaced(kEsri, "2 12", "2 "), "the row has 1 values, ncols says 2", 7, 0);
  expect_esri_error(replaced(kEsri, "2 12", "2 12 3"), "more values than the 2 of ncols", 7, 6);
  expect_esri_error(replaced(kEsri, "2 12", "2 z"), "this is 'z'", 7, 3);
  expect_esri_error(replaced(kEsri, "2 12", "2 60"), "a deviation of 60 mm", 7, 3);
  expect_esri_error(replaced(kEsri, "2 12\n1 -9999\n0 10\n", "-9999 nan\n-9999 -9999\n-9999 -9999\n"),
                    "no data at all");
}

scans::MapKind kind_of(const std::string& text) {
  ByteBlocks bytes(text, "sample", 100);
  return scans::sniff_map(bytes);
}

TEST(DeviationMaps, ToldFromListsOfPoints) {
  using enum scans::MapKind;
  EXPECT_EQ(kind_of(kEsri), esri_grid);
  for (const char* text :
       {",-10,-5,0\n100,0,1,2\n102,10,,12\n", "x\\y [mm];-10;-5;0\n100;0;1;2\n102;10;nan;12\n", "y,1,2\n1,0,0\n2,0,0\n",
        "0,-10,-5,0,5\n100,0,1,2,1\n102,10,,12,\n", "nan -10 -5 0 5\n100 0 1 2 9\n102 10 nan 12 7\n",
        "-10 -5 0 5\n100 0 1 2 9\n102 10 nan 12 7\n",
        ",0,1,3\n1,0,0,0\n2,0,0,0\n" /* uneven: for the reader to refuse */}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(kind_of(text), matrix);
  }
  for (const char* text : {"1 2 3\n2 3 4\n3 4 5\n", "x,y,z\n1,2,3\n2,3,4\n", "0 1 2 3\n1 2 3 4\n2 3 4 5\n",
                           "0,0,0,0,0,1\n1,0,0,0,0,1\n2,0,0,0,0,1\n", "# x y z\n1 2 3\n2 3 4\n3 4 5\n",
                           "3\n1 2 3\n2 3 4\n3 4 5\n", "nan 1 2\n1 2 3\n2 2 3\n",
                           "x [mm];y [mm];z [mm]\n1;2;3\n2;3;4\n", "0 0 0 0.1 0.2 0.97\n1 0 0 0 0 1\n2 0 0 0 0 1\n",
                           "0 1 2 3 4 5\n0 1 2 3 4 5\n0 2 2 3 4 5\n", "a letter\nto you\n", "1\n2\n3\n"}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(kind_of(text), none);
  }
}

TEST(DeviationMaps, Files) {
  const TemporaryFolder folder;
  const std::string text = ",-10,-5,0\n100,0,1,2\n102,10,,12\n";
  EXPECT_TRUE(is_deviation_map(folder.write("m.csv", text)));
  EXPECT_TRUE(is_deviation_map(folder.write("m.txt", text)));
  EXPECT_TRUE(is_deviation_map(folder.write("m.ASC", kEsri)));
  EXPECT_FALSE(is_deviation_map(folder.write("m.xyz", text)));
  EXPECT_FALSE(is_deviation_map(folder.write("e.csv", "")));
  EXPECT_FALSE(is_deviation_map(folder.path() / "none.csv"));
  MapReadOptions options;
  options.height_unit = LengthUnit::micrometre;
  OffsetMap map = read_deviation_map(folder.path() / "m.csv", options);
  EXPECT_EQ(map.name, (folder.path() / "m.csv").string());
  map.name = "sample";
  expect_sample_map(map);
  EXPECT_EQ(read_deviation_map(folder.path() / "m.ASC", options).grid.ny, 3);

  options.asked_by = {"case.toml", 2, 1};
  const auto expect = [&](const std::string& name, ErrorKind kind, const std::string& part) {
    const Error error = error_thrown_by([&] { read_deviation_map(folder.path() / name, options); });
    EXPECT_EQ(error.kind(), kind);
    EXPECT_EQ(error.where().to_string(), "case.toml:2:1");
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  };
  expect("none.csv", ErrorKind::input_data, "does not exist");
  expect("m.xyz", ErrorKind::input_data, "no known kind");
  options.angles_deg = true;
  expect("m.csv", ErrorKind::configuration, "degrees on a rail");
  options.angles_deg = false;
  options.body = Body::wheel;
  expect("m.csv", ErrorKind::configuration, "nominal radius");
}

}  // namespace
}  // namespace treadmark::io
