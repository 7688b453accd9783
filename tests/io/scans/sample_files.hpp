// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <fmt/format.h>

#include "scan_files.hpp"

namespace treadmark::io::testing {

/// Properties of many types in odd order, elements with lists before and after the vertices, a list within them.
inline std::string ply_header(const std::string& format, bool list_in_vertex) {
  return "ply\nformat " + format +
         " 1.0\ncomment a scan\ncomment units: um\nobj_info none\nelement camera 2\nproperty list uchar short "
         "views\nproperty double f\n"
         "element empty 0\nelement vertex 5\nproperty uchar red\nproperty double z\nproperty float nz\nproperty float "
         "x\n" +
         std::string(list_in_vertex ? "property list uint16 int16 tags\n" : "") +
         "property ushort scan_id\nproperty double y\nproperty float nx\nproperty float ny\nproperty int flags\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ascii_ply(bool list_in_vertex = true) {
  std::string text = ply_header("ascii", list_in_vertex) + "3 1 2 3 0.5\n\n0 0.25\n";
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    const Vec3& p = kPoints[i];
    const Eigen::Vector3f& n = kNormals[i];
    text += fmt::format("200 {} {} {} {}{} {} {} {} -3\n", p[2], n[2], p[0],
                        list_in_vertex ? (i % 2 != 0 ? "2 7 7 " : "0 ") : "", kPasses[i], p[1], n[0], n[1]);
  }
  return text + "3 0 1 2\n";
}

inline std::string binary_ply(bool big, bool list_in_vertex = true) {
  std::string out = ply_header(big ? "binary_big_endian" : "binary_little_endian", list_in_vertex);
  put_bytes(out, std::uint8_t{3});
  for (const std::int16_t v : {1, 2, 3}) put_bytes(out, v, big);
  put_bytes(out, 0.5, big);
  put_bytes(out, std::uint8_t{0});
  put_bytes(out, 0.25, big);
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    put_bytes(out, std::uint8_t{200});
    put_bytes(out, kPoints[i][2], big);
    put_bytes(out, kNormals[i][2], big);
    put_bytes(out, static_cast<float>(kPoints[i][0]), big);
    if (list_in_vertex) {
      put_bytes(out, static_cast<std::uint16_t>(i % 2 != 0 ? 2 : 0), big);
      if (i % 2 != 0)
        for (int k = 0; k < 2; ++k) put_bytes(out, std::int16_t{7}, big);
    }
    put_bytes(out, kPasses[i], big);
    put_bytes(out, kPoints[i][1], big);
    put_bytes(out, kNormals[i][0], big);
    put_bytes(out, kNormals[i][1], big);
    put_bytes(out, std::int32_t{-3}, big);
  }
  put_bytes(out, std::uint8_t{3});
  for (const std::int32_t v : {0, 1, 2}) put_bytes(out, v, big);
  return out;
}

/// Two triangles with a common edge: four different corners.
inline const float kFacets[2][9] = {{0, 0, 0, 10, 0, 0.5f, 10, 20, 0}, {10, 20, 0, 0, 20, 0, 0, 0, 0}};
inline const std::vector<Vec3> kCorners = {{0, 0, 0}, {10, 0, 0.5}, {10, 20, 0}, {0, 20, 0}};

inline std::string binary_stl(const std::string& title) {
  std::string out = title;
  out.resize(80, ' ');
  put_bytes(out, std::uint32_t{2});
  for (const auto& facet : kFacets) {
    for (int k = 0; k < 3; ++k) put_bytes(out, 0.0f);
    for (const float c : facet) put_bytes(out, c);
    put_bytes(out, std::uint16_t{0});
  }
  return out;
}

inline std::string ascii_stl() {
  return "solid sample units=mm\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 10 0 0.5\n   vertex 10 "
         "2e1 0\n  endloop\n"
         " endfacet\n FACET NORMAL 0 0 1\n  OUTER LOOP\n   VERTEX 10 20 0\n   VERTEX 0 20 0\n   VERTEX 0 0 0\n  "
         "ENDLOOP\n ENDFACET\n"
         "endsolid sample\n";
}

inline std::string obj() {
  std::string text = "# a scan in millimetres\nmtllib none.mtl\no scan\n";
  for (const Vec3& p : kPoints) text += fmt::format("v {} {} {} 0.5 0.5 0.5\n", p[0], p[1], p[2]);
  for (const Eigen::Vector3f& n : kNormals) text += fmt::format("vn {} {} {}\n", n[0], n[1], n[2]);
  return text + "vt 0 0\nusemtl a\ns off\nf 1/1/1 2//2 3//3 # a face\nf -4//-4 -3//-3 \\\n -1//-1\nl 1 2\n";
}

inline std::string off(const std::string& keyword = "OFF", bool normals = false, const std::string& more = "") {
  std::string text = keyword + "\n# unit in\n\n5 1 0\n";
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    text += fmt::format("{} {}\t{}", kPoints[i][0], kPoints[i][1], kPoints[i][2]);
    if (normals) text += fmt::format(" {} {} {}", kNormals[i][0], kNormals[i][1], kNormals[i][2]);
    text += more + "\n";
  }
  return text + "3 0 1 2 255 0 0\n";
}

inline std::string binary_off() {
  std::string out = "OFF BINARY\n";
  for (const std::uint32_t n : {5u, 1u, 0u}) put_bytes(out, n, true);
  for (const Vec3& p : kPoints)
    for (int k = 0; k < 3; ++k) put_bytes(out, static_cast<float>(p[k]), true);
  for (const std::uint32_t n : {3u, 0u, 1u, 2u, 0u}) put_bytes(out, n, true);
  return out;
}

/// LAS of any version and format; the header by the tables of the ASPRS specification, written out here once more.
struct LasFile {
  int minor = 2, format = 0;
  std::size_t extra = 0;     ///< bytes behind each record
  std::size_t gap = 0;       ///< bytes (variable records) between header and points
  bool legacy_count = true;  ///< else in the 64-bit field of version 1.4 only
  std::vector<std::array<std::int32_t, 3>> points = {{0, 0, 0}, {1000, -2000, 3000}, {2147483647, -2147483647 - 1, 5}};
  std::vector<std::uint16_t> sources = {7, 7, 9};
  std::vector<bool> withheld = {false, false, false};

  std::size_t header_size() const { return minor == 4 ? 375 : minor == 3 ? 235 : 227; }
  std::size_t record() const {
    const std::size_t lengths[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    return lengths[format] + extra;
  }
  std::string bytes() const {
    std::string out(header_size(), '\0');
    std::memcpy(out.data(), "LASF", 4);
    out[24] = 1;
    out[25] = static_cast<char>(minor);
    std::memcpy(out.data() + 26, "SCANNER X", 9);
    set_bytes(out, 94, static_cast<std::uint16_t>(header_size()));
    set_bytes(out, 96, static_cast<std::uint32_t>(header_size() + gap));
    out[104] = static_cast<char>(format);
    set_bytes(out, 105, static_cast<std::uint16_t>(record()));
    if (legacy_count) set_bytes(out, 107, static_cast<std::uint32_t>(points.size()));
    if (minor == 4) set_bytes(out, 247, static_cast<std::uint64_t>(points.size()));
    const double scale[] = {0.001, 0.01, 0.5}, offset[] = {100.0, 0.0, -3.0};
    for (std::size_t k = 0; k < 3; ++k) {
      set_bytes(out, 131 + 8 * k, scale[k]);
      set_bytes(out, 155 + 8 * k, offset[k]);
    }
    out.append(gap, '\x55');
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::string r(record(), '\x11');
      for (std::size_t k = 0; k < 3; ++k) set_bytes(r, 4 * k, points[i][k]);
      r[15] = static_cast<char>(withheld[i] ? (format >= 6 ? 0x04 : 0x80) : 0x00);
      set_bytes(r, format >= 6 ? 20 : 18, sources[i]);
      out += r;
    }
    return out;
  }
  Vec3 expected(std::size_t i) const {
    return {points[i][0] * 0.001 + 100.0, points[i][1] * 0.01, points[i][2] * 0.5 - 3.0};
  }
};

}  // namespace treadmark::io::testing
