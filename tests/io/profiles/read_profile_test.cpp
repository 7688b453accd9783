// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/read_profile.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {
namespace {

using testing::columns;
using testing::rail_points;
using testing::simpack;
using testing::TemporaryFolder;
using testing::wheel_points;

TEST(ReadProfile, ChoosesTheFormatByExtension) {
  EXPECT_EQ(profile_format("a.prr"), ProfileFormat::simpack);
  EXPECT_EQ(profile_format("a.PrW"), ProfileFormat::simpack);
  EXPECT_EQ(profile_format("x.prr/a.ban"), ProfileFormat::miniprof);
  EXPECT_EQ(profile_format("a.WHL"), ProfileFormat::miniprof);
  EXPECT_EQ(profile_format("a.txt"), ProfileFormat::two_column);
  EXPECT_EQ(profile_format("prr"), ProfileFormat::two_column);
}

TEST(ReadProfile, ReadsEveryFormatFromFiles) {
  const TemporaryFolder folder;
  const std::size_t rail = rail_points().size(), wheel = wheel_points().size();
  EXPECT_EQ(read_profile(folder.write("a.PRR", simpack(Body::rail, rail_points())), Body::rail, {}).y.size(), rail);
  EXPECT_EQ(read_profile(folder.write("a.prw", simpack(Body::wheel, wheel_points())), Body::wheel, {}).y.size(), wheel);
  EXPECT_EQ(read_profile(folder.write("a.ban", "A=1\n" + columns(rail_points())), Body::rail, {}).y.size(), rail);
  EXPECT_EQ(read_profile(folder.write("a.whl", "A=1\n" + columns(wheel_points())), Body::wheel, {}).y.size(), wheel);
  EXPECT_EQ(read_profile(folder.write("a", columns(rail_points())), Body::rail, {}).y.size(), rail);
}

TEST(ReadProfile, AcceptsBackslashesInNames) {
  const TemporaryFolder folder;
  folder.write("sub/a.txt", columns(rail_points()));
  EXPECT_NO_THROW(read_profile(folder.path().string() + "\\sub\\a.txt", Body::rail, {}));
}

TEST(ReadProfile, MissingFileNamesItselfAndItsReference) {
  const SourcePosition reference{"case.inp", 12, 3};
  const Error error = testing::error_thrown_by([&] { (void)read_profile("no/such.prr", Body::rail, {}, reference); });
  EXPECT_EQ(error.kind(), ErrorKind::input_data);
  const std::string what = error.what();
  EXPECT_EQ(what.rfind("case.inp:12:3: the profile file 'no/such.prr' does not exist", 0), 0u) << what;
  TREADMARK_EXPECT_ERROR(read_profile("no/such.prr", Body::rail, {}), "no/such.prr: the profile file", 0, 0);
}

TEST(ReadProfile, RefusesFoldersAndHugeFiles) {
  const TemporaryFolder folder;
  TREADMARK_EXPECT_ERROR(read_profile(folder.path(), Body::rail, {}), "is not a regular file", 0, 0);
  const auto huge = folder.write("huge.txt", "");
  std::filesystem::resize_file(huge, profiles::kMaxBytes + 1);  // sparse
  TREADMARK_EXPECT_ERROR(read_profile(huge, Body::rail, {}), "is larger than 1 GB", 0, 0);
}

TEST(ReadProfile, RefusesTheExtensionOfTheOtherBodyAndSlices) {
  const SourcePosition reference{"case.inp", 5, 1};
  for (const auto& [name, body] : {std::pair{"a.prr", Body::wheel}, std::pair{"a.PRW", Body::rail},
                                   std::pair{"a.ban", Body::wheel}, std::pair{"a.whl", Body::rail}}) {
    const Error error = testing::error_thrown_by([&, n = name, b = body] { (void)read_profile(n, b, {}, reference); });
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_NE(error.message().find("the extension of"), std::string::npos);
    EXPECT_EQ(error.where().line, 5);
  }
  const Error error = testing::error_thrown_by([&] { (void)read_profile("a.slcs", Body::rail, {}, reference); });
  EXPECT_NE(error.message().find("is a set of slices"), std::string::npos);
}

TEST(ReadProfile, ErrorsInsideAFileNameThatFile) {
  const TemporaryFolder folder;
  const auto file = folder.write("bad.txt", "0 0\n5 x\n");
  const Error error = testing::error_thrown_by([&] { (void)read_profile(file, Body::rail, {}, {"case.inp", 1, 1}); });
  EXPECT_EQ(error.where().to_string(), file.string() + ":2:3");
}

}  // namespace
}  // namespace treadmark::io
