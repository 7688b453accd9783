// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <random>

#include "sample_files.hpp"
#include "treadmark/tests/support/mutation.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using treadmark::testing::with_other_bytes;

constexpr int kTrials = 4000;  // for each format

/// What these formats stumble over.
const std::vector<std::string> kPieces{"\n",
                                       " ",
                                       "-",
                                       "1e308",
                                       "nan",
                                       "#",
                                       "99999999999",
                                       "\xff\xff\xff\xff",
                                       "element",
                                       "3",
                                       ",",
                                       ";",
                                       "\t",
                                       "x",
                                       std::string(1, '\0'),
                                       "\r",
                                       "\\\n",
                                       "1e9",
                                       "\x7f\xff\xff\xff",
                                       "65536",
                                       "[mm]",
                                       "vertex 1"};

void expect_printable(const Error& error) {
  EXPECT_EQ(error.kind(), ErrorKind::input_data);
  for (const char c : std::string(error.what())) ASSERT_TRUE(c >= ' ' && c <= '~') << error.what();
}

/// What the users of a scan rely on; room for what the file can hold, at most 24 bytes of a point for 3 of the file.
void expect_sound(const Scan& scan, std::size_t size) {
  const PointCloud& cloud = scan.cloud;
  ASSERT_FALSE(cloud.points.empty());
  ASSERT_LE(cloud.points.capacity(), std::max<std::size_t>(size, 2 * 4096));
  ASSERT_TRUE(cloud.normals.empty() || cloud.normals.size() == cloud.points.size());
  ASSERT_TRUE(cloud.passes.empty() || cloud.passes.size() == cloud.points.size());
  ASSERT_EQ(scan.points_in_file, cloud.points.size() + scan.not_finite + scan.withheld);
  ASSERT_FALSE(scan.format.empty());
  for (const Vec3& p : cloud.points) ASSERT_TRUE(p.allFinite());
  for (const Eigen::Vector3f& n : cloud.normals) ASSERT_TRUE(n.isZero(0.0f) || std::abs(n.norm() - 1.0f) < 1e-4f);
}

/// Every result is a sound cloud, the same from blocks of any size, or an Error that can be printed.
void survive(Parser parser, const std::string& valid, unsigned seed = 20250311) {
  std::mt19937 random(seed);
  ASSERT_NO_THROW(parse(parser, valid));
  int accepted = 0, refused = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::string text = with_other_bytes(valid, random, kPieces);
    if (text.empty()) continue;
    const std::size_t block = 1 + random() % 100;
    std::optional<Scan> scan;
    std::string what;
    try {
      scan = parse(parser, text);
      ++accepted;
      expect_sound(*scan, text.size());
    } catch (const Error& error) {
      ++refused;
      what = error.what();
      expect_printable(error);
    }
    try {
      const Scan again = parse(parser, text, block);
      ASSERT_TRUE(scan.has_value()) << "only whole: " << what;
      expect_same(again, *scan);
    } catch (const Error& error) {
      ASSERT_EQ(error.what(), what) << "in blocks of " << block;
    }
    if (::testing::Test::HasFatalFailure()) FAIL() << "trial " << trial << ":\n" << text;
  }
  EXPECT_GT(accepted, kTrials / 100);
  EXPECT_GT(refused, kTrials / 20);
}

/// Every beginning of the file is refused or read; only the full one has all points of the others at most.
void survive_truncation(Parser parser, const std::string& valid) {
  const std::size_t all = parse(parser, valid).points_in_file;
  for (std::size_t size = 1; size < valid.size(); ++size) {
    try {
      const Scan scan = parse(parser, valid.substr(0, size), 64);
      ASSERT_LE(scan.points_in_file, all);
    } catch (const Error& error) {
      expect_printable(error);
    }
  }
}

TEST(MutatedScans, AsciiPly) { survive(scans::parse_ply, ascii_ply()); }
TEST(MutatedScans, LittleEndianPly) { survive(scans::parse_ply, binary_ply(false)); }
TEST(MutatedScans, BigEndianPly) { survive(scans::parse_ply, binary_ply(true)); }
TEST(MutatedScans, PlyRecords) { survive(scans::parse_ply, binary_ply(false, false)); }
TEST(MutatedScans, Obj) { survive(scans::parse_obj, obj()); }
TEST(MutatedScans, Off) { survive(scans::parse_off, off("CNOFF", true, " 1 2 3")); }
TEST(MutatedScans, BinaryOff) { survive(scans::parse_off, binary_off()); }
TEST(MutatedScans, AsciiStl) { survive(scans::parse_stl, ascii_stl()); }
TEST(MutatedScans, BinaryStl) { survive(scans::parse_stl, binary_stl("solid or not")); }
TEST(MutatedScans, Las) {
  for (const int format : {1, 6}) {
    LasFile las;
    las.minor = format == 6 ? 4 : 2;
    las.format = format;
    las.extra = 3;
    las.records = {{2112, "PROJCS[\"a map\"]"}};
    survive(scans::parse_las, las.bytes());
    survive_truncation(scans::parse_las, las.bytes());
  }
}
TEST(MutatedScans, Columns) {
  for (const char* text : {"# unit mm\n3\nx y z nx ny nz line\n1 2 3 0 0 1 7\n4 5 6 0 1 0 7\n7 8 nan 1 0 0 8\n",
                           "\"X [mm]\";\"Y [mm]\";\"Z [mm]\";Pass\n1,5;2,5;3;1\n4;5;6;2\n", "1,2,3\n4,5,6\n7,8,9\n",
                           "1 2 3 0 0 1\n4 5 6 0.6 0 0.8 # a\n"}) {
    survive(scans::parse_columns, text);
    survive_truncation(scans::parse_columns, text);
  }
}

/// An E57 file from its content: with the check sums made after the mutation, so that what is behind them is reached.
Scan parse_e57_content(ByteBlocks& bytes, const ScanReadOptions& options) {
  const auto size = static_cast<std::size_t>(bytes.size());
  const std::string file = E57File::paged({bytes.need(size), size});
  ByteBlocks pages(file, bytes.file(), 100);
  return scans::parse_e57(pages, options);
}

TEST(MutatedScans, Pcd) {
  for (const std::string& valid : {ascii_pcd(), binary_pcd(), compressed_pcd()}) {
    survive(scans::parse_pcd, valid);
    survive_truncation(scans::parse_pcd, valid);
  }
}
TEST(MutatedScans, Ptx) {
  survive(scans::parse_ptx, ptx());
  survive_truncation(scans::parse_ptx, ptx());
}
TEST(MutatedScans, E57) {
  TREADMARK_NEEDS("expat");
  survive(parse_e57_content, e57().content());
  survive_truncation(parse_e57_content, e57().content());
  const std::string whole = e57().bytes();
  for (std::size_t size = 1; size < whole.size(); size += 7)
    EXPECT_THROW(parse(scans::parse_e57, whole.substr(0, size)), Error) << size;
}

TEST(MutatedScans, Truncated) {
  survive_truncation(scans::parse_ply, ascii_ply());
  survive_truncation(scans::parse_ply, binary_ply(true));
  survive_truncation(scans::parse_obj, obj());
  survive_truncation(scans::parse_off, off());
  survive_truncation(scans::parse_stl, binary_stl("x"));
  survive_truncation(scans::parse_stl, ascii_stl());
}

TEST(MutatedMaps, MatrixAndGrid) {
  const std::string matrix =
      "# unit mm, deviations in um\nx\\y;-10;-5;0;5\n100;0;1;2;3\n102;10;;12;-3,5\n104;1;nan;3;4\n";
  const std::string grid =
      "ncols 3\nnrows 2\nxllcorner 1\nyllcenter 2\ncellsize 0.5\nNODATA_value -9\n1 2 3\n4 -9 nan\n";
  std::mt19937 random(5);
  for (const bool is_grid : {false, true}) {
    int accepted = 0, refused = 0, same_kind = 0;
    for (int trial = 0; trial < 4 * kTrials; ++trial) {
      const std::string text = with_other_bytes(is_grid ? grid : matrix, random, kPieces);
      if (text.empty()) continue;
      try {
        ByteBlocks bytes(text, "sample", 1 + random() % 100);
        MapReadOptions options;
        if (trial % 2 == 0) {
          options.body = Body::wheel;
          options.nominal_radius = 0.5;
        }
        same_kind += scans::sniff_map(bytes) != scans::MapKind::none;
        const OffsetMap map =
            is_grid ? scans::parse_esri_grid(bytes, options) : scans::parse_map_matrix(bytes, options);
        ++accepted;
        ASSERT_EQ(map.offset.size(), map.grid.size());
        ASSERT_GE(map.grid.nx, 2);
        ASSERT_GE(map.grid.ny, 2);
        ASSERT_TRUE(map.grid.dx > 0.0 && map.grid.dy > 0.0 && std::isfinite(map.grid.x(map.grid.nx)) &&
                    std::isfinite(map.grid.y(map.grid.ny)))
            << text;
        ASSERT_LE(map.offset.size(), text.size());
        for (const float v : map.offset) ASSERT_TRUE(std::isnan(v) || std::abs(v) <= 0.0501f);
      } catch (const Error& error) {
        ++refused;
        expect_printable(error);
      }
    }
    EXPECT_GT(accepted, kTrials / 25);
    EXPECT_GT(refused, kTrials / 5);
    EXPECT_GT(same_kind, kTrials);
  }
}

}  // namespace
}  // namespace treadmark::io
