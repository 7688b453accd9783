// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "mesh_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using meshes::parse_obj;
using meshes::parse_off;
using meshes::parse_ply;
using meshes::parse_stl;

TEST(ReadMesh, Ply) {
  expect_pyramid(parse(parse_ply, ascii_ply()));
  expect_pyramid(parse(parse_ply, binary_ply(false)));
  expect_pyramid(parse(parse_ply, binary_ply(true)));
  // other line ends
  std::string text = ascii_ply();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  expect_pyramid(parse(parse_ply, text));
  expect_pyramid(parse(parse_ply, replaced(binary_ply(true), "vertex_indices", "vertex_index")));
}

TEST(ReadMesh, Obj) { expect_pyramid(parse(parse_obj, obj())); }

TEST(ReadMesh, Off) {
  expect_pyramid(parse(parse_off, off()));
  expect_pyramid(parse(parse_off, off("NOFF", " 0 0 1")));
  expect_pyramid(parse(parse_off, off("COFF", " 255 0 0 255")));
  expect_pyramid(parse(parse_off, off("STCNOFF", " 1 2 3")));
  expect_pyramid(parse(parse_off, replaced(off(), "OFF\n", "")));
  expect_pyramid(parse(parse_off, replaced(off(), "OFF\n# pyramid\n\n5 5 8", "OFF 5 5 8")));
  expect_pyramid(parse(parse_off, binary_off()));
}

TEST(ReadMesh, Stl) {
  expect_two_facets(parse(parse_stl, ascii_stl()));
  expect_two_facets(parse(parse_stl, binary_stl("made by a program")));
  // the word solid does not make it text
  expect_two_facets(parse(parse_stl, binary_stl("solid part 7")));
  // bytes behind the last facet do no harm
  expect_two_facets(parse(parse_stl, binary_stl(std::string("solid\0", 6)) + "trailing"));
}

TEST(ReadMesh, PlyRefusals) {
  expect_error(parse_ply, "", "begins with the word ply", 1, 1);
  expect_error(parse_ply, "ply\nformat ascii 1.0\n", "end_header");
  expect_error(parse_ply, replaced(ascii_ply(), "ascii", "utf8"), "unknown format 'utf8'", 2, 8);
  expect_error(parse_ply, replaced(ascii_ply(), "1.0", "2.0"), "unknown version", 2, 14);
  expect_error(parse_ply, replaced(ascii_ply(), "float x", "half x"), "unknown type 'half'", 11, 10);
  expect_error(parse_ply, replaced(ascii_ply(), "element vertex 5", "element vertex -5"), "number of elements", 8, 16);
  expect_error(parse_ply, replaced(ascii_ply(), "property float x", "property float w"), "lack one of x, y, z");
  expect_error(parse_ply, replaced(ascii_ply(), "vertex_indices", "strips"), "lack the list vertex_indices");
  expect_error(parse_ply, replaced(ascii_ply(), "element face 5", "element faces 5"), "names the element face 0 times");
  expect_error(parse_ply, replaced(ascii_ply(), "element vertex 5", "element vertex 900000000"),
               "more than the file holds");
  expect_error(parse_ply, replaced(binary_ply(false), "element face 5", "element face 900000000"),
               "more than the file holds");
  expect_error(parse_ply, replaced(ascii_ply(), "7 4 0 1 2 3", "7 4 0 1 2 5"), "names the vertex 5, there are 5", 28,
               11);
  expect_error(parse_ply, replaced(ascii_ply(), "7 4 0 1 2 3", "7 4 0 1 2 -1"), "names the vertex -1", 28, 11);
  expect_error(parse_ply, replaced(ascii_ply(), "7 3 0 4 1", "7 2 0 4"), "a face of 2 corners", 29, 9);
  expect_error(parse_ply, replaced(ascii_ply(), "-7.250000", "nan"), "not finite", 27, 5);
  expect_error(parse_ply, replaced(ascii_ply(), "-7.250000", "1e999"), "out of range", 27, 5);
  expect_error(parse_ply, replaced(ascii_ply(), "7 4 0 1 2 3", "7 200 0 1 2 3"), "more than the file holds", 28, 3);
  const std::string text = ascii_ply(), binary = binary_ply(true);
  expect_error(parse_ply, text.substr(0, text.size() - 4), "ends before all elements are read", 32);
  const Error truncated = error_of(parse_ply, binary.substr(0, binary.size() - 9));
  EXPECT_NE(std::string(truncated.what()).find("at byte"), std::string::npos) << truncated.what();
  std::string nan =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (int k = 0; k < 9; ++k) put(nan, k == 4 ? std::numeric_limits<float>::quiet_NaN() : 1.0f, false);
  put(nan, std::uint8_t{3}, false);
  for (int k = 0; k < 3; ++k) put(nan, k, false);
  expect_error(parse_ply, nan, "a coordinate of vertex 1 is not finite");
}

TEST(ReadMesh, ALoneCarriageReturnEndsALineBesideLineFeedsToo) {
  const std::string text = obj();
  for (const char* mixed : {"# made elsewhere\r", "# made\r\r\n# elsewhere\r"})
    expect_pyramid(parse(parse_obj, mixed + text));
  std::string ends = text;
  for (std::size_t i = 0, k = 0; i < ends.size(); ++i)
    if (ends[i] == '\n' && ++k % 2 == 0) ends[i] = '\r';
  expect_pyramid(parse(parse_obj, ends));
}

TEST(ReadMesh, ObjRefusals) {
  expect_error(parse_obj, "", "no triangles");
  expect_error(parse_obj, "v 0 0 0\n", "no triangles");
  expect_error(parse_obj, replaced(obj(), "f 1 5 2", "f 1 6 2"), "names the vertex 6, so far there are 5", 14, 5);
  expect_error(parse_obj, replaced(obj(), "f 1 5 2", "f 1 0 2"), "names the vertex 0", 14, 5);
  expect_error(parse_obj, replaced(obj(), "f -4 -1 -3", "f -4 -1 -6"), "names the vertex -6", 15, 9);
  expect_error(parse_obj, replaced(obj(), "f 1 5 2", "f 1 x 2"), "vertex number", 14, 5);
  expect_error(parse_obj, replaced(obj(), "f 1 5 2", "f 1 5"), "a face of 2 corners", 14);
  expect_error(parse_obj, replaced(obj(), "f 1 5 2", "f 1 5 \\"), "continued lines", 14);
  expect_error(parse_obj, replaced(obj(), "v 0.000000", "v inf"), "not finite", 4, 3);
  expect_error(parse_obj, "v 1 2\n", "three coordinates", 1);
}

TEST(ReadMesh, OffRefusals) {
  expect_error(parse_off, "", "ends before");
  expect_error(parse_off, off("4OFF", " 1"), "begins with the word OFF", 1, 1);
  expect_error(parse_off, off("nOFF"), "begins with the word OFF", 1, 1);
  expect_error(parse_off, replaced(binary_off(), "OFF", "COFF"), "binary OFF files", 1, 1);
  expect_error(parse_off, replaced(off(), "5 5 8", "500 5 8"), "more than the file holds");
  expect_error(parse_off, replaced(off(), "5 5 8", "5 -5 8"), "negative", 4, 3);
  expect_error(parse_off, replaced(off(), "5 5 8", "5 6 8"), "ends before all elements", 14);
  expect_error(parse_off, replaced(off(), "3 0 4 1", "3 0 5 1"), "names the vertex 5", 11);
  expect_error(parse_off, replaced(off(), "3 0 4 1", "3 0 nan 1"), "whole number", 11, 5);
  expect_error(parse_off, replaced(off(), "-7.250000", "NaN"), "not finite", 9, 20);
  std::string huge = "OFF BINARY\n";
  for (const std::uint32_t n : {0xfffffff0u, 5u, 8u}) put(huge, n, true);
  expect_error(parse_off, huge, "more than the file holds");
  std::string corners = binary_off();
  corners[11 + 12 + 60] = '\x7f';
  expect_error(parse_off, corners, "more than the file holds");
}

TEST(ReadMesh, StlRefusals) {
  expect_error(parse_stl, "", "at byte");
  expect_error(parse_stl, "solid\n", "ends within a solid", 1);
  expect_error(parse_stl, "solid\nendsolid\n", "no triangles");
  expect_error(parse_stl, replaced(ascii_stl(), "0.5", "x"), "a number is expected", 5, 16);
  expect_error(parse_stl, replaced(ascii_stl(), "vertex 10 0 0.5\n", "vertex 10 0\n"), "three coordinates", 5);
  expect_error(parse_stl, replaced(ascii_stl(), "outer loop\n   vertex 0", "vertex 0"), "outside of a loop", 3, 3);
  expect_error(parse_stl, replaced(ascii_stl(), "facet", "fact"), "unknown line 'fact'", 2, 2);
  const std::string binary = binary_stl("x");
  expect_error(parse_stl, binary.substr(0, binary.size() - 1), "2 triangles are promised, the file holds 1");
  std::string huge = binary;
  huge[83] = '\x7f';
  expect_error(parse_stl, huge, "too many");
  std::string nan = binary;
  const float bad = std::numeric_limits<float>::infinity();
  std::memcpy(nan.data() + 84 + 12, &bad, sizeof bad);
  expect_error(parse_stl, nan, "a coordinate of vertex 0 is not finite");
}

}  // namespace
}  // namespace treadmark::io
