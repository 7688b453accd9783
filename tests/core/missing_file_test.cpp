// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/missing_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

TEST(EditDistance, CountsSlipsOfTheFinger) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("wheel", "wheel"), 0U);
  EXPECT_EQ(edit_distance("Wheel", "wHEEL"), 0U);
  EXPECT_EQ(edit_distance("whele", "wheel"), 1U);
  EXPECT_EQ(edit_distance("whel", "wheel"), 1U);
  EXPECT_EQ(edit_distance("rail", "wheel"), 4U);
}

TEST(NearestName, IsNoneWhereNothingIsNear) {
  const std::vector<std::string> names{"gauge_mm", "cant", "cant_deg"};
  EXPECT_EQ(nearest_name("gauge_m", names), "gauge_mm");
  EXPECT_EQ(nearest_name("CANT", names), "cant");
  EXPECT_EQ(nearest_name("xy", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name("something_else", names), "");
  EXPECT_EQ(advice_on_name("CANT", names), "did you mean 'cant'?");
  EXPECT_EQ(advice_on_name("xy", names, "see the list"), "see the list");
  EXPECT_THAT(advice_on_name("xy", names), ::testing::StartsWith("choose " + names.front() + ", "));
}

TEST(MissingFile, IsLookedForBesideItsName) {
  const testing::TemporaryFolder folder;
  const std::string at = folder.path().string() + '/';
  folder.write("my.toml", "");
  folder.write("data/wheel.csv", "");
  const std::vector<std::pair<std::string, std::string>> rows{
      {"MY.toml", "did you mean " + at + "my.toml?"},
      {"my.tml", "did you mean " + at + "my.toml?"},
      {"my", "did you mean " + at + "my.toml?"},
      {"my.inp", "did you mean " + at + "my.toml?"},
      {"data/wheels.csv", "did you mean " + at + "data/wheel.csv?"},
      {"Data/wheel.csv", "did you mean " + at + "data?"},
      {"data\\wheel.csv", "did you mean " + at + "data/wheel.csv?"},
      {"nothing_here.csv", "check its name and folder"},
      {"a/b/c.csv", "there is no folder " + at + "a/b"},
      {"~/my.toml", "'~' is not replaced here: write the folder"},
      {"$HOME/my.toml", "'$HOME' is not replaced here: write the folder"}};
  for (const auto& [name, advice] : rows) {
    EXPECT_EQ(advice_on_missing(at + name), advice) << name;
    try {
      require_file(at + name, "case file", ErrorKind::configuration);
      ADD_FAILURE() << name;
    } catch (const MissingFile& missing) {
      EXPECT_EQ(missing.message(), "the case file does not exist");
      EXPECT_EQ(missing.where().file, at + name);
      EXPECT_EQ(missing.advice(), advice);
    }
  }
  EXPECT_EQ(advice_on_missing(at + "nothing_here.csv", "another way"), "another way");
  EXPECT_NO_THROW(require_file(at + "my.toml", "case file", ErrorKind::configuration));
  try {
    require_file(at + "data", "case file", ErrorKind::input_data, {"a.toml", 3, 7});
    ADD_FAILURE();
  } catch (const Error& folder_error) {
    EXPECT_EQ(folder_error.kind(), ErrorKind::input_data);
    EXPECT_EQ(std::string(folder_error.what()),
              "a.toml:3:7: a case file is expected, '" + at + "data' is a folder (name a file in it)");
  }
}

}  // namespace
}  // namespace treadmark
