// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/surface_errors.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

struct Head {
  const char *name, *start, *sign, *rest;
};
constexpr Head kHeads[] = {{"a.slcw", "", "% ", "\n 0.0 0.001\n"},
                           {"a.slcs", "", "%", "\n 0.0 1.0\n"},
                           {"a.ply", "ply\nformat ascii 1.0\n", "comment ", "element vertex 0\nend_header\n"},
                           {"a.obj", "\n", "# ", "v 0 0 0\n"},
                           {"a.off", "OFF\n", "# ", "0 0 0\n"}};
constexpr const char* kErrors = "surface-errors 1 2 1 0 0 1 0 250.5 3 -4";

TEST(ErrorsInFiles, AreFoundInTheHeadOnly) {
  const testing::TemporaryFolder folder;
  for (const Head& head : kHeads) {
    const auto read = [&](const std::string& text) { return read_surface_errors(folder.write(head.name, text)); };
    const std::string start = head.start + std::string(head.sign) + "other words\n",
                      line = head.sign + std::string(kErrors) + '\n';
    const auto errors = read(start + line + head.rest);
    ASSERT_NE(errors, nullptr) << head.name;
    EXPECT_EQ(errors->u.front(), 250.5) << "a rail's stations may lie anywhere along it";
    EXPECT_DOUBLE_EQ(errors->draws.front().back(), -4e-8);
    EXPECT_EQ(read(start + head.rest + line), nullptr) << head.name;
    EXPECT_THROW(read(start + line + line + head.rest), Error) << head.name;
  }
  EXPECT_EQ(read_surface_errors(folder.write("a.stl", "# " + std::string(kErrors) + '\n')), nullptr);
  EXPECT_EQ(read_surface_errors(folder.path() / "none.ply"), nullptr);
}

TEST(ErrorsInFiles, SoAreTheDoubtsOfImports) {
  const testing::TemporaryFolder folder;
  const std::vector<SurfaceDoubt> doubts{{"no_flange", "not scanned"}};
  for (const Head& head : kHeads) {
    const std::string line = head.sign + to_lines(doubts).front() + '\n',
                      more = head.sign + std::string(kErrors) + '\n';
    const auto file = folder.write(head.name, head.start + more + line + head.rest);
    EXPECT_EQ(read_surface_doubts(file), doubts) << head.name;
    EXPECT_NE(read_surface_errors(file), nullptr) << head.name;
    EXPECT_TRUE(read_surface_doubts(folder.write(head.name, head.start + more + head.rest + line)).empty());
  }
  std::string stl = "binary STL, millimetres; " + names_line(doubts);
  stl.resize(80, ' ');
  const std::vector<SurfaceDoubt> named = read_surface_doubts(folder.write("a.stl", stl + std::string(4, '\0')));
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named.front().name, "no_flange");
  for (const char* other : {"none.stl", "none.ply", "none.prr"})
    EXPECT_TRUE(read_surface_doubts(folder.path() / other).empty());
}

TEST(ErrorsInFiles, LongCommentsOfOthersHideNone) {
  const testing::TemporaryFolder folder;
  for (const std::size_t length : {4093u, 4094u, 4095u, 4096u, 9000u})
    for (const Head& head : kHeads) {
      const std::string text = head.start + std::string(head.sign) + std::string(length, 'x') + '\n' + head.sign +
                               kErrors + '\n' + head.rest;
      EXPECT_NE(read_surface_errors(folder.write(head.name, text)), nullptr) << head.name << ' ' << length;
    }
}

}  // namespace
}  // namespace treadmark::io
