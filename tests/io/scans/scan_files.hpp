// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/io/scans/parse_scan.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io::testing {

using treadmark::testing::content_of;
using treadmark::testing::error_thrown_by;

using scans::ByteBlocks;
using Parser = Scan (*)(ByteBlocks&, const ScanReadOptions&);

/// Sample points in the unit of a file, with unit normals and passes.
inline const std::vector<Vec3> kPoints = {{0, 0, 0}, {10, 0, 0.5}, {10.25, 20, -3}, {-0.125, 20, 1e-3}, {5, 10, -7.25}};
inline const std::vector<Eigen::Vector3f> kNormals = {
    {0, 0, -1}, {1, 0, 0}, {0, 0.6f, 0.8f}, {0, 1, 0}, {-0.8f, 0, 0.6f}};
inline const std::vector<std::uint16_t> kPasses = {1, 1, 2, 2, 65535};

template <class T>
void put_bytes(std::string& out, T value, bool big = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  out.append(raw, sizeof(T));
}

template <class T>
void set_bytes(std::string& out, std::size_t at, T value) {
  std::string bytes;
  put_bytes(bytes, value);
  std::copy(bytes.begin(), bytes.end(), out.begin() + static_cast<std::ptrdiff_t>(at));
}

/// Reads from memory; small blocks put every number across the end of a block.
inline Scan parse(Parser parser, const std::string& bytes, std::size_t block = ByteBlocks::kBlock,
                  const ScanReadOptions& options = {}) {
  ByteBlocks blocks(bytes, "sample", block);
  return parser(blocks, options);
}

inline void expect_same(const Scan& a, const Scan& b) {
  EXPECT_EQ(a.cloud.points, b.cloud.points);
  EXPECT_EQ(a.cloud.normals, b.cloud.normals);
  EXPECT_EQ(a.cloud.passes, b.cloud.passes);
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.points_in_file, b.points_in_file);
  EXPECT_EQ(a.not_finite, b.not_finite);
  EXPECT_EQ(a.withheld, b.withheld);
}

/// The same from blocks of any size.
inline Scan parse_in_all_blocks(Parser parser, const std::string& bytes) {
  const Scan whole = parse(parser, bytes);
  for (const std::size_t block : {1u, 2u, 3u, 7u, 64u, 1000u}) expect_same(parse(parser, bytes, block), whole);
  return whole;
}

inline void expect_at(const Error& error, const std::string& part, int line, int column) {
  EXPECT_EQ(error.kind(), ErrorKind::input_data) << error.what();
  EXPECT_EQ(error.where().file, "sample") << error.what();
  EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what() << "\n should say: " << part;
  EXPECT_EQ(error.where().line, line) << error.what();
  EXPECT_EQ(error.where().column, column) << error.what();
}

inline void expect_error(Parser parser, const std::string& bytes, const std::string& part, int line = 0, int column = 0,
                         const ScanReadOptions& options = {}) {
  expect_at(error_thrown_by([&] { parse(parser, bytes, ByteBlocks::kBlock, options); }), part, line, column);
  expect_at(error_thrown_by([&] { parse(parser, bytes, 5, options); }), part, line, column);
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

using treadmark::testing::TemporaryFolder;

}  // namespace treadmark::io::testing
