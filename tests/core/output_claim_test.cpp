// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

namespace fs = std::filesystem;

TEST(OutputClaim, RefusesToReadWhatItWouldReplace) {
  const testing::TemporaryFolder folder;
  const fs::path a = folder.write("a", "old"), b = folder.write("b", "input"), link = folder.path() / "link";
  fs::create_symlink(a, link);
  {
    const OutputClaim claim({a.string(), (folder.path() / "new").string(), "-", "", "/dev/null", "/dev/null"});
    EXPECT_NO_THROW(refuse_output_as_input(b));
    EXPECT_NO_THROW(require_file(b, "file", ErrorKind::input_data));
    EXPECT_NO_THROW(write_file(a, "written"));
    EXPECT_NO_THROW(refuse_output_as_input(a)) << "what was written is read again";
  }
  {
    const OutputClaim claim({a.string()});
    EXPECT_THROW(refuse_output_as_input(link), Error);
    EXPECT_THROW(require_file(a, "file", ErrorKind::input_data), Error);
    EXPECT_THROW(write_file(a, "x"), Error) << "also where the first error was no end";
    EXPECT_THROW(write_file(link, "x"), Error);
    {
      const OutputClaim more({b.string()});
      EXPECT_THROW(refuse_output_as_input(b), Error);
      EXPECT_THROW(refuse_output_as_input(a), Error);
    }
    EXPECT_NO_THROW(refuse_output_as_input(b)) << "of one within another, too";
    EXPECT_THROW(refuse_output_as_input(a), Error);
  }
  EXPECT_NO_THROW(refuse_output_as_input(a)) << "a claim ends";
  EXPECT_NO_THROW(write_file(a, "x"));
}

TEST(OutputClaim, TakesNoNameTwice) {
  const testing::TemporaryFolder folder;
  const std::string name = (folder.path() / "a").string(), again = (folder.path() / "." / "a").string();
  EXPECT_THROW(OutputClaim({name, again}), Error);
  EXPECT_NO_THROW(OutputClaim({name, name + "b"}));
}

}  // namespace
}  // namespace treadmark
