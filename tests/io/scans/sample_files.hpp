// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <fmt/format.h>

#include <cmath>

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
  std::vector<std::pair<int, std::string>> records, late;  ///< number and content, of the user LASF_Projection

  /// Variable records, or (1.4, behind the points) extended ones.
  static std::string record_bytes(const std::vector<std::pair<int, std::string>>& list, bool extended) {
    std::string out;
    for (const auto& [number, content] : list) {
      std::string head(extended ? 60 : 54, '\0');
      std::memcpy(head.data() + 2, "LASF_Projection", 15);
      set_bytes(head, 18, static_cast<std::uint16_t>(number));
      if (extended)
        set_bytes(head, 20, static_cast<std::uint64_t>(content.size()));
      else
        set_bytes(head, 20, static_cast<std::uint16_t>(content.size()));
      out += head + content;
    }
    return out;
  }

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
    const std::string early = record_bytes(records, false);
    set_bytes(out, 96, static_cast<std::uint32_t>(header_size() + early.size() + gap));
    set_bytes(out, 100, static_cast<std::uint32_t>(records.size()));
    if (minor == 4 && !late.empty()) {
      set_bytes(out, 235, static_cast<std::uint64_t>(header_size() + early.size() + gap + points.size() * record()));
      set_bytes(out, 243, static_cast<std::uint32_t>(late.size()));
    }
    out[104] = static_cast<char>(format);
    set_bytes(out, 105, static_cast<std::uint16_t>(record()));
    if (legacy_count) set_bytes(out, 107, static_cast<std::uint32_t>(points.size()));
    if (minor == 4) set_bytes(out, 247, static_cast<std::uint64_t>(points.size()));
    const double scale[] = {0.001, 0.01, 0.5}, offset[] = {100.0, 0.0, -3.0};
    for (std::size_t k = 0; k < 3; ++k) {
      set_bytes(out, 131 + 8 * k, scale[k]);
      set_bytes(out, 155 + 8 * k, offset[k]);
    }
    out += early;
    out.append(gap, '\x55');
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::string r(record(), '\x11');
      for (std::size_t k = 0; k < 3; ++k) set_bytes(r, 4 * k, points[i][k]);
      r[15] = static_cast<char>(withheld[i] ? (format >= 6 ? 0x04 : 0x80) : 0x00);
      set_bytes(r, format >= 6 ? 20 : 18, sources[i]);
      out += r;
    }
    return out + record_bytes(late, true);
  }
  Vec3 expected(std::size_t i) const {
    return {points[i][0] * 0.001 + 100.0, points[i][1] * 0.01, points[i][2] * 0.5 - 3.0};
  }
};

/// PCD with padding, colours and several values of one name; `data`: ascii, binary or binary_compressed.
inline std::string pcd_header(const std::string& data, const std::string& more = "") {
  return "# .PCD v0.7 - Point Cloud Data file format\n# units: mm\nVERSION 0.7\n"
         "FIELDS rgb x normal_x hist normal_y y z normal_z scan_id\nSIZE 4 8 4 2 4 8 8 4 2\nTYPE U F F I F F F F U\n"
         "COUNT 1 1 1 3 1 1 1 1 1\nWIDTH 5\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 5\n" +
         more + "DATA " + data + "\n";
}

inline std::string ascii_pcd() {
  std::string text = pcd_header("ascii");
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    const Vec3& p = kPoints[i];
    const Eigen::Vector3f& n = kNormals[i];
    text += fmt::format("4278190335 {} {} 1 -2 3 {} {} {} {} {}\n", p[0], n[0], n[1], p[1], p[2], n[2], kPasses[i]);
  }
  return text;
}

/// The bytes of each field of each point: [field][point].
inline std::vector<std::vector<std::string>> pcd_values() {
  std::vector<std::vector<std::string>> out(9, std::vector<std::string>(kPoints.size()));
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    const Vec3& p = kPoints[i];
    const Eigen::Vector3f& n = kNormals[i];
    put_bytes(out[0][i], std::uint32_t{4278190335u});
    put_bytes(out[1][i], p[0]);
    put_bytes(out[2][i], n[0]);
    for (const int h : {1, -2, 3}) put_bytes(out[3][i], static_cast<std::int16_t>(h));
    put_bytes(out[4][i], n[1]);
    put_bytes(out[5][i], p[1]);
    put_bytes(out[6][i], p[2]);
    put_bytes(out[7][i], n[2]);
    put_bytes(out[8][i], kPasses[i]);
  }
  return out;
}

inline std::string binary_pcd() {
  std::string out = pcd_header("binary");
  const auto values = pcd_values();
  for (std::size_t i = 0; i < kPoints.size(); ++i)
    for (const auto& field : values) out += field[i];
  return out;
}

/// LZF by the shortest way: runs of a repeated byte become copies of the byte before, all else stays as it is.
inline std::string packed_lzf(const std::string& data) {
  std::string out, kept;
  const auto put_kept = [&] {
    if (!kept.empty()) out += static_cast<char>(kept.size() - 1) + kept;
    kept.clear();
  };
  for (std::size_t i = 0; i < data.size();) {
    std::size_t run = 0;
    while (i > 0 && run < 264 && i + run < data.size() && data[i + run] == data[i - 1]) ++run;
    if (run >= 3) {
      put_kept();
      const std::size_t length = run - 2;
      out += static_cast<char>((length < 7 ? length : 7) << 5);
      if (length >= 7) out += static_cast<char>(length - 7);
      out += '\0';  // one byte back
      i += run;
      continue;
    }
    kept += data[i++];
    if (kept.size() == 32) put_kept();
  }
  put_kept();
  return out;
}

inline std::string compressed_pcd() {
  std::string data;
  for (const auto& field : pcd_values())
    for (const std::string& value : field) data += value;
  const std::string packed = packed_lzf(data);
  std::string out = pcd_header("binary_compressed");
  put_bytes(out, static_cast<std::uint32_t>(packed.size()));
  put_bytes(out, static_cast<std::uint32_t>(data.size()));
  return out + packed;
}

/// Two stations: three points as they are with a lost one, two that are turned by 90 degrees about z and shifted.
inline std::string ptx() {
  return "2\n2\n1 2 3\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
         "0 0 1 0.5\n10 0 0.5 0.25\n0 0 0 0.5\n10.25 20 -3 1\n"
         "1\n2\n10 20 30\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n"
         "1 2 3 0.5 255 0 0\n4 5 6 0.5 0 255 0\n";
}
inline const std::vector<Vec3> kPtxPoints = {{0, 0, 1}, {10, 0, 0.5}, {10.25, 20, -3}, {8, 21, 33}, {5, 24, 36}};

/// E57 by the tables of ASTM E2807, written out here once more.
struct E57File {
  struct Field {
    std::string name, attributes;
    unsigned bits;
    std::vector<std::uint64_t> raw;  ///< of each record
  };
  struct Scan {
    std::string pose;
    std::vector<Field> fields;
  };
  std::vector<Scan> scans;
  std::string more;         ///< XML behind the scans
  std::size_t packets = 3;  ///< for each scan

  static std::uint64_t physical(std::size_t logical) { return logical / 1020 * 1024 + logical % 1020; }

  static std::string packed(const Field& field) {
    std::string out((field.raw.size() * field.bits + 7) / 8, '\0');
    std::size_t at = 0;
    for (const std::uint64_t raw : field.raw)
      for (unsigned k = 0; k < field.bits; ++k, ++at)
        if ((raw >> k & 1u) != 0)
          out[at / 8] = static_cast<char>(static_cast<unsigned char>(out[at / 8]) | 1u << at % 8);
    return out;
  }

  /// The section of a scan that begins at this byte: packets with uneven parts, an empty one and an index between.
  std::string section(const Scan& scan, std::size_t start) const {
    std::vector<std::string> streams;
    for (const Field& field : scan.fields) streams.push_back(packed(field));
    std::string body;
    for (std::size_t p = 0; p < packets; ++p) {
      std::string lengths, bytes;
      for (std::string& stream : streams) {
        const std::size_t count =
            p + 1 == packets ? stream.size() : std::min(stream.size(), stream.size() / packets + p);
        put_bytes(lengths, static_cast<std::uint16_t>(count));
        bytes += stream.substr(0, count);
        stream.erase(0, count);
      }
      std::size_t size = 6 + lengths.size() + bytes.size();
      while (size % 4 != 0) ++size, bytes += '\0';
      put_bytes(body, std::uint8_t{1});
      put_bytes(body, std::uint8_t{0});
      put_bytes(body, static_cast<std::uint16_t>(size - 1));
      put_bytes(body, static_cast<std::uint16_t>(streams.size()));
      body += lengths + bytes;
      for (const std::uint8_t type : {std::uint8_t{2}, std::uint8_t{0}}) {
        put_bytes(body, type);
        put_bytes(body, std::uint8_t{0});
        put_bytes(body, std::uint16_t{15});
        body += std::string(12, '\0');
      }
    }
    std::string out;
    put_bytes(out, std::uint64_t{1});
    put_bytes(out, static_cast<std::uint64_t>(32 + body.size()));
    put_bytes(out, physical(start + 32));
    put_bytes(out, std::uint64_t{0});
    return out + body;
  }

  /// The file without its check sums.
  std::string content() const {
    std::string out = "ASTM-E57";
    put_bytes(out, std::uint32_t{1});
    out.resize(48, '\0');
    set_bytes(out, 40, std::uint64_t{1024});
    std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
        "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\">\n<data3D type=\"Vector\">\n";
    for (const Scan& scan : scans) {
      xml += fmt::format(
          "<vectorChild type=\"Structure\"><name type=\"String\"><![CDATA[a]]></name>{}\n"
          "<points type=\"CompressedVector\" fileOffset=\"{}\" recordCount=\"{}\">"
          "<prototype type=\"Structure\">\n",
          scan.pose, physical(out.size()), scan.fields.front().raw.size());
      for (const Field& field : scan.fields) xml += fmt::format("<{} {}/>\n", field.name, field.attributes);
      xml += "</prototype><codecs type=\"Vector\"/></points></vectorChild>\n";
      out += section(scan, out.size());
    }
    xml += "</data3D>" + more + "</e57Root>\n";
    set_bytes(out, 24, physical(out.size()));
    set_bytes(out, 32, static_cast<std::uint64_t>(xml.size()));
    return out + xml;
  }

  /// With its check sums, bit by bit, and its length.
  static std::string paged(std::string content) {
    content.resize((content.size() + 1019) / 1020 * 1020, ' ');
    if (content.size() >= 48) set_bytes(content, 16, static_cast<std::uint64_t>(content.size() / 1020 * 1024));
    std::string out;
    for (std::size_t at = 0; at < content.size(); at += 1020) {
      std::uint32_t crc = 0xffffffff;
      for (std::size_t k = at; k < at + 1020; ++k) {
        crc ^= static_cast<unsigned char>(content[k]);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0x82f63b78u : 0u);
      }
      out += content.substr(at, 1020);
      put_bytes(out, ~crc, true);
    }
    return out;
  }
  std::string bytes() const { return paged(content()); }
};

inline std::uint64_t bits_of(double value) {
  std::uint64_t out = 0;
  std::memcpy(&out, &value, sizeof out);
  return out;
}
inline std::uint64_t bits_of(float value) {
  std::uint32_t out = 0;
  std::memcpy(&out, &value, sizeof out);
  return out;
}

/// Two scans: doubles, floats and scaled integers of 19 bits with a state of 2 bits; the second one turned and shifted.
inline E57File e57() {
  const std::string kPose =
      "<pose type=\"Structure\"><rotation type=\"Structure\"><w type=\"Float\">0.7071067811865476</w><x "
      "type=\"Float\"/>"
      "<y type=\"Float\">0</y><z type=\"Float\">0.7071067811865476</z></rotation><translation type=\"Structure\">"
      "<x type=\"Float\">10</x><y type=\"Float\">20</y><z type=\"Float\">3e1</z></translation></pose>";
  E57File file;
  E57File::Scan first, second;
  first.fields = {{"cartesianX", "type=\"Float\"", 64, {}},
                  {"colorRed", "type=\"Integer\" minimum=\"0\" maximum=\"255\"", 8, {}},
                  {"cartesianY", "type=\"Float\" precision=\"single\"", 32, {}},
                  {"cartesianInvalidState", "type=\"Integer\" minimum=\"0\" maximum=\"2\"", 2, {}},
                  {"cartesianZ",
                   "type=\"ScaledInteger\" minimum=\"-200000\" maximum=\"200000\" scale=\"0.0001\" offset=\"1\"",
                   19,
                   {}}};
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    const Vec3& p = kPoints[i];
    const std::uint64_t raw[] = {bits_of(p[0]), 10 * i, bits_of(static_cast<float>(p[1])),
                                 i == 1 ? std::uint64_t{2} : std::uint64_t{0},
                                 static_cast<std::uint64_t>(std::llround((p[2] - 1.0) / 0.0001) + 200000)};
    for (std::size_t k = 0; k < 5; ++k) first.fields[k].raw.push_back(raw[k]);
  }
  second.pose = kPose;
  second.fields = {{"cartesianX", "type=\"Float\"", 64, {bits_of(1.0), bits_of(4.0)}},
                   {"cartesianY", "type=\"Float\"", 64, {bits_of(2.0), bits_of(5.0)}},
                   {"cartesianZ", "type=\"Float\"", 64, {bits_of(3.0), bits_of(6.0)}},
                   {"intensity", "type=\"Integer\" minimum=\"7\" maximum=\"7\"", 0, {0, 0}}};
  file.scans = {first, second};
  return file;
}

}  // namespace treadmark::io::testing
