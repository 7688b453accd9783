// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/write_slices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Slices of a cylinder whose radius tells the writings apart.
SliceSet slices_at(double z, Body body = Body::wheel) {
  SliceSet set;
  set.body = body;
  for (int i = 0; i < 5; ++i) {
    set.u.push_back(0.1 * i);
    Profile profile;
    for (int k = 0; k <= 20; ++k) {
      profile.y.push_back(1e-3 * k);
      profile.z.push_back(z + 1e-5 * k * k);
    }
    set.profiles.push_back(profile);
  }
  return set;
}

class WriteSlices : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  double z_of(const std::string& name, Body body = Body::wheel) const {
    ProfileOptions as_written;
    as_written.mirror_z = -1;
    return ranges::min(read_slices(path(name), body, as_written).profiles.front().z);
  }
  std::vector<fs::path> folders() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      if (entry.is_directory()) all.push_back(entry.path());
    return all;
  }
  testing::TemporaryFolder folder_;
};

TEST_F(WriteSlices, ANewWritingReplacesTheOldOneAsAWhole) {
  write_slices(path("x.slcw"), slices_at(0.001));
  const std::vector<fs::path> first = folders();
  ASSERT_EQ(first.size(), 1u);
  fs::create_directory(path("x.slcw-mine"));
  write_slices(path("x.slcw"), slices_at(0.002));
  EXPECT_NEAR(z_of("x.slcw"), 0.002, 1e-12);
  EXPECT_FALSE(fs::exists(first.front()));
  EXPECT_EQ(folders().size(), 2u) << "one of somebody else stays";
  write_slices(path("x.slcw"), slices_at(0.002));
  EXPECT_NEAR(z_of("x.slcw"), 0.002, 1e-12) << "the same again";
  EXPECT_EQ(folders().size(), 2u);
}

TEST_F(WriteSlices, WheelAndRailOfOneNameKeepApart) {
  write_slices(path("x.slcw"), slices_at(0.001));
  write_slices(path("x.slcs"), slices_at(0.002, Body::rail));
  EXPECT_NEAR(z_of("x.slcw"), 0.001, 1e-12);
  EXPECT_NEAR(z_of("x.slcs", Body::rail), 0.002, 1e-12);
}

TEST_F(WriteSlices, SlicesOfTwoWritingsAreRefused) {
  write_slices(path("x.slcw"), slices_at(0.001));
  write_slices(path("y.slcw"), slices_at(0.002));
  std::vector<fs::path> both = folders();
  ASSERT_EQ(both.size(), 2u);
  fs::copy_file(both[0] / "slice_00003.txt", both[1] / "slice_00003.txt", fs::copy_options::overwrite_existing);
  const std::string x = testing::error_of([&] { read_slices(path("x.slcw"), Body::wheel, {}); });
  const std::string y = testing::error_of([&] { read_slices(path("y.slcw"), Body::wheel, {}); });
  EXPECT_TRUE(x.empty() != y.empty()) << x << y;
  EXPECT_THAT(x + y, HasSubstr(".slcw:2:1: the slices are not those that this file was written with"));
  // who changes slices on purpose takes the line away
  const fs::path file = path(x.empty() ? "y.slcw" : "x.slcw");
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t line = text.find("% SHA-256");
  ASSERT_NE(line, std::string::npos);
  text.erase(line, text.find('\n', line) - line + 1);
  std::ofstream(file) << text;
  EXPECT_THAT(testing::error_of([&] { read_slices(file, Body::wheel, {}); }), IsEmpty());
}

TEST_F(WriteSlices, FoldersOfEarlierWritingsGoAfterAMove) {
  write_slices(path("x.slcw"), slices_at(0.001));
  write_slices(path("new/x.slcw"), slices_at(0.002));
  for (const auto& entry : fs::directory_iterator(path("new")))
    fs::rename(entry.path(), path(entry.path().filename().string()));
  EXPECT_EQ(folders().size(), 3u);
  remove_other_slices(path("x.slcw"));
  EXPECT_EQ(folders().size(), 2u);
  EXPECT_NEAR(z_of("x.slcw"), 0.002, 1e-12);
}

}  // namespace
}  // namespace treadmark::io
