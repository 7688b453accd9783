// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <random>

#include "mesh_files.hpp"
#include "treadmark/tests/support/mutation.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using treadmark::testing::with_other_bytes;

constexpr int kTrials = 3000;  // for each format

/// What these formats stumble over.
const std::vector<std::string> kPieces{"\n",      " ", "-", "1e308", "nan", "#", "99999999999", "\xff\xff\xff\xff",
                                       "element", "3"};

/// Every result is a sound mesh or an Error with a message that can be printed; anything else ends the test.
void survive(Parser parser, const std::string& valid) {
  std::mt19937 random(20250311);
  ASSERT_NO_THROW(parse(parser, valid));
  int accepted = 0, refused = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::string text = with_other_bytes(valid, random, kPieces);
    try {
      const TriangleMesh mesh = parse(parser, text);
      ++accepted;
      ASSERT_FALSE(mesh.triangles.empty());
      ASSERT_LE(mesh.vertices.size() + mesh.triangles.size(), text.size());
      for (const Vec3& v : mesh.vertices) ASSERT_TRUE(v.allFinite());
      for (const auto& c : mesh.triangles)
        for (const std::uint32_t v : c) ASSERT_LT(v, mesh.vertices.size());
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(error.kind(), ErrorKind::input_data);
      for (const char c : std::string(error.what())) ASSERT_TRUE(c >= ' ' && c <= '~') << error.what();
    }
  }
  EXPECT_GT(accepted, kTrials / 100);
  EXPECT_GT(refused, kTrials / 20);
}

TEST(MutatedMeshes, AsciiPly) { survive(meshes::parse_ply, ascii_ply()); }
TEST(MutatedMeshes, LittleEndianPly) { survive(meshes::parse_ply, binary_ply(false)); }
TEST(MutatedMeshes, BigEndianPly) { survive(meshes::parse_ply, binary_ply(true)); }
TEST(MutatedMeshes, Obj) { survive(meshes::parse_obj, obj()); }
TEST(MutatedMeshes, Off) { survive(meshes::parse_off, off("COFF", " 1 2 3")); }
TEST(MutatedMeshes, BinaryOff) { survive(meshes::parse_off, binary_off()); }
TEST(MutatedMeshes, AsciiStl) { survive(meshes::parse_stl, ascii_stl()); }
TEST(MutatedMeshes, BinaryStl) { survive(meshes::parse_stl, binary_stl("solid or not")); }

}  // namespace
}  // namespace treadmark::io
