// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/io/meshes/parse_mesh.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io::testing {

/// A pyramid on a square: five vertices, one quadrilateral and four triangles [mm].
inline const double kPoints[5][3] = {{0, 0, 0}, {10, 0, 0.5}, {10, 20, 0}, {0, 20, 0}, {5, 10, -7.25}};
inline const std::vector<std::vector<int>> kFaces = {{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};

inline void expect_pyramid(const TriangleMesh& mesh, double tolerance = 1e-15) {
  ASSERT_EQ(mesh.vertices.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mesh.vertices[i][k], 1e-3 * kPoints[i][k], tolerance);
  const std::vector<std::array<std::uint32_t, 3>> expected = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1},
                                                              {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};
  EXPECT_EQ(mesh.triangles, expected);
}

template <class T>
void put(std::string& out, T value, bool big) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  out.append(raw, sizeof(T));
}

/// Properties of many types in odd order, an element to skip before and one after the faces.
inline std::string ply_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment a pyramid\nobj_info none\nelement camera 1\nproperty list uchar short views\nproperty double "
         "f\n"
         "element vertex 5\nproperty uchar red\nproperty double z\nproperty float x\nproperty int16 flags\nproperty "
         "double y\n"
         "element face 5\nproperty uchar material\nproperty list uchar int vertex_indices\nproperty list ushort float "
         "uv\n"
         "element edge 1\nproperty int a\nproperty uint b\nend_header\n";
}

inline std::string ascii_ply() {
  std::string text = ply_header("ascii") + "3 1 2 3 0.5\n";
  for (const auto& p : kPoints)
    text += "200 " + std::to_string(p[2]) + " " + std::to_string(p[0]) + " -3 " + std::to_string(p[1]) + "\n";
  for (const auto& f : kFaces) {
    text += "7 " + std::to_string(f.size());
    for (const int v : f) text.append(" ").append(std::to_string(v));
    text += " 2 0.5 0.25\n";
  }
  return text + "0 1\n";
}

inline std::string binary_ply(bool big) {
  std::string out = ply_header(big ? "binary_big_endian" : "binary_little_endian");
  put(out, std::uint8_t{3}, big);
  for (const std::int16_t v : {1, 2, 3}) put(out, v, big);
  put(out, 0.5, big);
  for (const auto& p : kPoints) {
    put(out, std::uint8_t{200}, big);
    put(out, p[2], big);
    put(out, static_cast<float>(p[0]), big);
    put(out, std::int16_t{-3}, big);
    put(out, p[1], big);
  }
  for (const auto& f : kFaces) {
    put(out, std::uint8_t{7}, big);
    put(out, static_cast<std::uint8_t>(f.size()), big);
    for (const int v : f) put(out, static_cast<std::int32_t>(v), big);
    put(out, std::uint16_t{2}, big);
    put(out, 0.5f, big);
    put(out, 0.25f, big);
  }
  put(out, std::int32_t{0}, big);
  put(out, std::uint32_t{1}, big);
  return out;
}

inline std::string obj() {
  std::string text = "# pyramid\nmtllib none.mtl\no pyramid\n";
  for (const auto& p : kPoints)
    text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + " 1.0\n";
  return text +
         "vt 0 0\nvn 0 0 1\nusemtl a\ns off\nf 1/1/1 2//1 3/1 4\nf 1 5 2\nf -4 -1 -3\nf 3 5 4 # the third\nf 4 5 1\n";
}

inline std::string off(const std::string& keyword = "OFF", const std::string& more = "") {
  std::string text = keyword + "\n# pyramid\n\n5 5 8\n";
  for (const auto& p : kPoints)
    text += std::to_string(p[0]) + " " + std::to_string(p[1]) + "\t" + std::to_string(p[2]) + more + "\n";
  for (const auto& f : kFaces) {
    text += std::to_string(f.size());
    for (const int v : f) text.append(" ").append(std::to_string(v));
    text += " 255 0 0 # red\n";
  }
  return text;
}

inline std::string binary_off() {
  std::string out = "OFF BINARY\n";
  for (const std::uint32_t n : {5u, 5u, 8u}) put(out, n, true);
  for (const auto& p : kPoints)
    for (const double c : p) put(out, static_cast<float>(c), true);
  for (const auto& f : kFaces) {
    put(out, static_cast<std::uint32_t>(f.size()), true);
    for (const int v : f) put(out, static_cast<std::uint32_t>(v), true);
    put(out, std::uint32_t{1}, true);
    put(out, 0.5f, true);
  }
  return out;
}

inline std::string ascii_stl() {
  return "solid sample\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 10 0 0.5\n   vertex 10 2e1 0\n  "
         "endloop\n endfacet\n"
         " FACET NORMAL 0 0 1\n  OUTER LOOP\n   VERTEX 10 20 0\n   VERTEX 0 20 0\n   VERTEX 0 0 0\n  ENDLOOP\n "
         "ENDFACET\nendsolid sample\n";
}

inline std::string binary_stl(const std::string& title) {
  std::string out = title;
  out.resize(80, ' ');
  put(out, std::uint32_t{2}, false);
  const float corners[2][9] = {{0, 0, 0, 10, 0, 0.5f, 10, 20, 0}, {10, 20, 0, 0, 20, 0, 0, 0, 0}};
  for (const auto& facet : corners) {
    for (int k = 0; k < 3; ++k) put(out, 0.0f, false);
    for (const float c : facet) put(out, c, false);
    put(out, std::uint16_t{0}, false);
  }
  return out;
}

inline void expect_two_facets(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.vertices.size(), 6u);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices[1], Vec3(0.01, 0.0, 0.0005));
  EXPECT_EQ(mesh.vertices[2], Vec3(0.01, 0.02, 0.0));
  EXPECT_EQ(mesh.vertices[mesh.triangles[1][1]], Vec3(0.0, 0.02, 0.0));
}

using Parser = TriangleMesh (*)(std::string_view, const std::string&, double);

inline TriangleMesh parse(Parser parser, const std::string& text) { return parser(text, "sample", 1e-3); }

/// The Error that parsing throws; a test failure when it throws none.
inline Error error_of(Parser parser, const std::string& text) {
  Error error = treadmark::testing::error_thrown_by([&] { parse(parser, text); });
  EXPECT_EQ(error.kind(), ErrorKind::input_data);
  EXPECT_EQ(error.where().file, "sample");
  return error;
}

inline void expect_error(Parser parser, const std::string& text, const std::string& part, int line = 0,
                         int column = 0) {
  const Error error = error_of(parser, text);
  EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  EXPECT_EQ(error.where().line, line) << error.what();
  EXPECT_EQ(error.where().column, column) << error.what();
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

using treadmark::testing::TemporaryFolder;

}  // namespace treadmark::io::testing
