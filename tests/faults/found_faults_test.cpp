// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <ostream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/faults/output_rows.hpp"
#include "treadmark/tests/support/shared_data.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

// Faults that were once found, by the scripts that showed them: each prints what happens today.

namespace treadmark::testing {
namespace {

namespace fs = std::filesystem;

struct FoundFault {
  const char* name;                   ///< of the folder with run.sh
  const char* parts;                  ///< of parts(), which it needs, by blanks
  bool as_root;                       ///< makes devices or mounts
  std::vector<const char*> wanted;    ///< expressions that some line has, in this order
  std::vector<const char*> unwanted;  ///< and those that no line has
};

std::ostream& operator<<(std::ostream& out, const FoundFault& row) { return out << row.name; }

const std::vector<FoundFault> kFound{
    {"device-clobbered",
     "",
     true,
     {"^crw.* null$", "^rc=0", "^rc=0", "link -> target$", "^crw.* null$"},
     {"^-rw.* null$"}},
    {"endless-loop-huge-creepage", "", false, {"creepage_x = .* must be at most", "^rc=2", "^after TERM: rc=2"}, {}},
    {"hdf5-disk-full-segv",
     "vehicle hdf5",
     true,
     {"No space left", "^run rc=2", "No space left", "^sweep rc=2"},
     {"\\.part"}},
    {"huge-input-silent-zero",
     "",
     false,
     {"^mu 1e3: case 1: ok.* Fx +\\[N\\] +-[1-9]"},
     {"^mu 1e1[123]: case 1: ok", "^creepage .* ok"}},
    {"leftovers", "hdf5", false, {"^after a full run:", "^fields.h5", "^result.json"}, {"after.*part"}},
    {"mesh-part-race", "", false, {"^rc=0", "^rc=0"}, {"treadmark:"}},
    {"patch-touches-grid-silent", "", false, {"2 warnings.*border", "1 warning.*border", "1 warning.*border"}, {}},
    {"same-stem-overwritten", "", false, {"would both go to", "^rc=1"}, {"^case"}},
    {"slices-share-folder", "", false, {"^case 1: ok", "^convert rail rc=0", "^check rc=0", "^case 1: ok"}, {}},
    {"stdout-full-exit-0",
     "report hdf5",
     false,
     {"schema rc=1", "plot rc=1", "list-settings rc=1", "check rc=1"},
     {"rc=0"}},
    {"sweep-misleading-message", "vehicle hdf5", false, {"^rc=0"}, {"cannot write"}},
    {"toml-dotted-key-segv", "", false, {"nested deeper", "^rc=2"}, {}},
    {"unexpected-failure", "report", false, {"no such folder", "^rc=3", "^rc=0"}, {"unexpected failure"}},
    {"vdb-not-atomic",
     "openvdb",
     true,
     {"No space left", "^rc=2", "^old file: rc="},
     {"differ", "cannot be read", "damaged"}},
};

/// The lines that a script prints, on both outputs, in their order.
std::vector<std::string> lines_of(const fs::path& script, const std::vector<std::string>& settings) {
  std::vector<std::string> command{"env", "-u", "TREADMARK_SHARED", std::string("T=") + TREADMARK_PROGRAM,
                                   std::string("EXAMPLES=") + TREADMARK_SOURCE_DIR + "/examples"};
  command.insert(command.end(), settings.begin(), settings.end());
  command.insert(command.end(), {"bash", "-c", "exec bash \"$0\" 2>&1", script.string()});
  std::istringstream text(RunningProgram(command).wait().out);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

class FoundFaults : public ::testing::TestWithParam<FoundFault> {};

TEST_P(FoundFaults, AreGone) {
  TREADMARK_REQUIRE_SHARED();
  const FoundFault& row = GetParam();
  TREADMARK_NEEDS_PARTS_OF(row);
  if (row.as_root && (geteuid() != 0 || RunningProgram({"unshare", "-m", "true"}).wait().status != 0))
    GTEST_SKIP() << "only root makes devices and mounts";
  const TemporaryFolder folder;
  const fs::path scripts = folder.path() / "scripts", results = folder.path() / "results";
  fs::copy(*shared / "repro", scripts, fs::copy_options::recursive);
  for (const auto& entry : fs::recursive_directory_iterator(scripts))
    fs::permissions(entry, fs::perms::owner_write, fs::perm_options::add);
  fs::permissions(scripts, fs::perms::owner_write, fs::perm_options::add);
  const std::string case_file = (scripts / "case.toml").string();
  ASSERT_EQ(RunningProgram({"treadmark", "--quiet", "run", case_file, "-o", results.string()}).wait().status, 0);
  const std::vector<std::string> lines =
      lines_of(scripts / row.name / "run.sh",
               {"RESULT_FOLDER=" + results.string(), "STUDY_FOLDER=" + (scripts / "sweep-misleading-message").string(),
                "TMPDIR=" + folder.path().string()});
  std::string all;
  for (const std::string& line : lines) all += line + '\n';
  std::size_t at = 0;
  for (const char* wanted : row.wanted) {
    while (at < lines.size() && !std::regex_search(lines[at], std::regex(wanted))) ++at;
    EXPECT_LT(at++, lines.size()) << "no " << wanted << " in\n" << all;
  }
  for (const std::string& line : lines)
    for (const char* unwanted : row.unwanted)
      EXPECT_FALSE(std::regex_search(line, std::regex(unwanted))) << unwanted << " in\n" << all;
}

INSTANTIATE_TEST_SUITE_P(Scripts, FoundFaults, ::testing::ValuesIn(kFound), [](const auto& which) {
  std::string name = which.param.name;
  ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace treadmark::testing
