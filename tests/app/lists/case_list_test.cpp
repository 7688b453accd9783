// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Lists of cases: the numbers of runs of few cases, row by row, with little memory and over interruptions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <future>
#include <string>
#include <thread>

#include "treadmark/app/cases/case_list.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using treadmark::testing::content_of;
using treadmark::testing::error_of;
using treadmark::testing::run_program;
using treadmark::testing::RunningProgram;
using treadmark::testing::standard_case;
using treadmark::testing::TemporaryFolder;

/// Places across a wheel, one of them (row `bad`) in the air.
std::string places(int rows, int bad = -1) {
  std::string text = "wheelset.y_mm,wheelset.yaw_deg,wheelset.vertical_force_N\n";
  for (int i = 0; i < rows; ++i)
    text += i == bad ? "900,0,80e3\n"
                     : std::to_string(-3.0 + 0.05 * (i % 120)) + ',' + std::to_string(0.02 * (i % 7)) + ",8" +
                           std::to_string(i % 10) + "e3\n";
  return text;
}

/// A wheel on a rail at places of a table.
fs::path pair_list(const TemporaryFolder& folder, const std::string& table) {
  folder.write("places.csv", table);
  return folder.write("list.toml", "cases_file = \"places.csv\"\n" + standard_case("1.5"));
}

/// Patches that are solved in no time, of as many loads.
fs::path patch_list(const TemporaryFolder& folder, int rows) {
  std::string table = "patch.normal_force_N\n";
  for (int i = 0; i < rows; ++i) table += std::to_string(900 + i % 1000) + "\n";
  folder.write("loads.csv", table);
  return folder.write("patches.toml",
                      "cases_file = \"loads.csv\"\n[patch]\nmx = 6\nmy = 6\nhertz.given = \"semi_axes\"\n"
                      "hertz.semi_axis_x_mm = 4.0\nhertz.semi_axis_y_mm = 2.0\n");
}

struct Row {
  int number;
  Status status;
  std::string message;
  std::vector<double> numbers;
  bool operator==(const Row& other) const {
    return number == other.number && status == other.status && message == other.message &&
           ranges::equal(numbers, other.numbers,
                         [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
  }
};

std::vector<Row> rows_of(const SolvedList& list) {
  std::vector<Row> out;
  list.for_each([&](const ListedResult& row) { out.push_back({row.number, row.status, row.message, row.numbers}); });
  return out;
}

std::vector<Row> solved(const fs::path& file, const ListOptions& options = {}, const Progress& progress = {}) {
  SurfaceStore store;
  return rows_of(SolvedList(io::read_listed_cases(file), store, options, progress));
}

TEST(CaseList, HasTheNumbersOfRunsOfFewCases) {
  const TemporaryFolder folder;
  const fs::path file = pair_list(folder, places(130, 17));
  const io::RunResult run = run_cases(io::read_any_case(file));
  std::vector<std::vector<Row>> lists;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    lists.push_back(solved(file));
  }
  EXPECT_EQ(lists[0], lists[1]);
  ASSERT_EQ(lists[0].size(), run.cases.size());
  SurfaceStore store;
  const std::vector<io::ListedNumber> numbers = SolvedList(io::read_listed_cases(file), store, {}, {}).numbers();
  EXPECT_GT(numbers.size(), 20u);
  for (std::size_t i = 0; i < run.cases.size(); ++i) {
    EXPECT_EQ(lists[0][i].number, run.cases[i].number);
    EXPECT_EQ(lists[0][i].status, run.cases[i].status);
    ASSERT_EQ(lists[0][i].numbers.size(), numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double expected = numbers[k].si(run.cases[i]), found = lists[0][i].numbers[k];
      EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected)))
          << numbers[k].name << " of case " << i;
    }
  }
  EXPECT_NE(lists[0][17].status, Status::ok);
  EXPECT_FALSE(lists[0][17].message.empty());
  EXPECT_EQ(ranges::count(lists[0], Status::ok, &Row::status), 129);
}

TEST(CaseList, GoesOnWhereItWasInterrupted) {
  const TemporaryFolder folder;
  const fs::path file = pair_list(folder, places(400));
  const std::vector<Row> whole = solved(file);
  ListOptions options;
  options.kept = folder.path() / "kept.rows";
  const ThreadLimit two(2);
  std::atomic<bool> stop{false};
  std::size_t told = 0, found = 0;
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t finished, std::size_t, const std::string& what) {
    if (what.empty()) found = finished;
    told = finished;
    stop = finished >= 130;
  };
  EXPECT_THROW(solved(file, options, progress), Cancelled);
  EXPECT_GE(told, 130u);
  EXPECT_LT(told, 400u);
  stop = false;
  progress.report = [&](std::size_t finished, std::size_t, const std::string& what) {
    if (what.empty()) found = finished;
  };
  EXPECT_EQ(solved(file, options, progress), whole);
  EXPECT_GE(found, 130u);
  // another list is not taken for it
  options.numbers = {"fn_N"};
  EXPECT_THAT(error_of([&] { solved(file, options, progress); }), HasSubstr("something else"));
  // nor the same one with another row
  options.numbers = {};
  EXPECT_EQ(solved(file, options, progress), whole);
  folder.write("places.csv", places(400, 399));
  EXPECT_THAT(error_of([&] { solved(file, options, progress); }), HasSubstr("something else"));
}

TEST(CaseList, NoticesATableThatChangesMeanwhile) {
  const TemporaryFolder folder;
  const fs::path file = pair_list(folder, places(10));
  SurfaceStore store;
  io::ListedCases given = io::read_listed_cases(file);
  folder.write("places.csv", places(10, 9));
  EXPECT_THAT(error_of([&] { SolvedList(std::move(given), store, {}, {}); }), HasSubstr("changed while it was read"));
}

TEST(CaseList, LosesNoCaseOfAPartThatIsNotThrough) {
  const TemporaryFolder folder;
  constexpr int kRows = 60;  // one part
  folder.write("places.csv", places(kRows));
  const fs::path file = folder.write("list.toml", "cases_file = \"places.csv\"\n" + standard_case("0.7"));
  const std::vector<Row> whole = solved(file);
  ListOptions options;
  options.kept = folder.path() / "kept.rows";
  const ThreadLimit one(1);
  std::size_t found = 0, times_within = 0;
  for (std::chrono::milliseconds pause = 20ms;; pause += 20ms) {
    std::atomic<bool> stop{false};
    const auto timer = std::async(std::launch::async, [&] {
      std::this_thread::sleep_for(pause);
      stop = true;
    });
    Progress progress;
    progress.stop = &stop;
    progress.report = [&](std::size_t finished, std::size_t, const std::string& what) {
      if (!what.empty()) return;
      EXPECT_GE(finished, found);
      found = finished;
      if (found > 0 && found < kRows) ++times_within;
    };
    try {
      EXPECT_EQ(solved(file, options, progress), whole);
      break;
    } catch (const Cancelled&) {  // what was finished by then is found by the next try
    }
  }
  EXPECT_GT(times_within, 0u);
}

TEST(CaseList, TakesNoMoreMemoryForMoreRows) {
  const TemporaryFolder folder;
  const auto most_in_use = [&](int rows) {
    const fs::path file = patch_list(folder, rows);
    std::size_t most = 0;
    const auto look = [&] {
      const struct mallinfo2 info = mallinfo2();
      most = std::max(most, info.uordblks + info.hblkhd);
    };
    Progress progress;
    progress.report = [&](std::size_t, std::size_t, const std::string&) { look(); };
    SurfaceStore store;
    const SolvedList list(io::read_listed_cases(file), store, {}, progress);
    std::vector<std::string> notes;
    std::size_t row = 0;
    list.for_each([&](const ListedResult&) {
      if (++row % 100 == 0) look();
    });
    write_list(list, folder.path() / "out", {}, notes);
    look();
    return static_cast<double>(most);
  };
  const ThreadLimit two(2);
  most_in_use(500);  // what is made once
  constexpr int kFew = 1000, kMany = 9000;
  constexpr double kBytesPerRow = 16.0;  // places of parts, see SolvedList
  const double few = most_in_use(kFew), many = most_in_use(kMany);
  EXPECT_LT(many - few, kBytesPerRow * (kMany - kFew) + 1e5);
}

TEST(CaseList, LongFilesOfCasesAreLists) {
  const TemporaryFolder folder;
  std::string forces;
  for (int i = 0; i < 1200; ++i) forces += std::to_string(900 + i % 50) + ", ";
  const fs::path file = folder.write(
      "long.toml",
      "[patch]\nmx = 6\nmy = 6\nhertz.given = \"semi_axes\"\nhertz.semi_axis_x_mm = 4.0\nhertz.semi_axis_y_mm = 2.0\n"
      "[[cases]]\npatch.normal_force_N = [" +
          forces + "]\n");
  const std::string json = (folder.path() / "a.json").string(), other = (folder.path() / "b.json").string();
  EXPECT_EQ(run_program({"run", file.string(), "--json", json, "--quiet"}).status, 0);
  EXPECT_EQ(run_program({"run", file.string(), "--json", other, "--quiet", "--fields"}).status, 0);
  // all but times is the same text
  const auto without_times = [](const std::string& text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size() - 1);
      const std::string line = text.substr(at, end - at + 1);
      if (line.find("seconds\"") == std::string::npos && line.find("_s\"") == std::string::npos) out += line;
      at = end + 1;
    }
    return out;
  };
  EXPECT_EQ(without_times(content_of(json)), without_times(content_of(other)));
  EXPECT_FALSE(fs::exists(json + ".unfinished"));
}

TEST(CaseList, IsWrittenAsTables) {
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  const fs::path file = pair_list(folder, places(70, 3)), out = folder.path() / "out";
  const io::RunResult run = run_cases(io::read_any_case(file));
  const std::string bad(io::status_word(run.cases[3]));
  ASSERT_NE(bad, "ok");
  folder.write("out/fields.h5", "of another run");
  const auto result = run_program(
      {"run", file.string(), "-o", out.string(), "--numbers", "wheelset.z_mm,npatch,pmax_MPa,patch_2.fn_N"});
  EXPECT_EQ(result.status, run_program({"run", file.string(), "--fields"}).status) << result.err;
  EXPECT_THAT(result.out, HasSubstr("70 cases: 69 ok, 1 " + bad));
  EXPECT_THAT(result.out, HasSubstr("case 4: " + bad + ": "));
  const std::string csv = content_of(out / "cases.csv");
  EXPECT_TRUE(
      csv.starts_with("case,status,wheelset.y_mm,wheelset.yaw_deg,wheelset.vertical_force_N,wheelset.z_mm,npatch,"
                      "pmax_MPa,patch_2.fn_N,remarks,message\n"))
      << csv.substr(0, 200);
  EXPECT_EQ(ranges::count(csv, '\n'), 71);
  EXPECT_THAT(csv, HasSubstr("\n4," + bad + ",900,0,80000,"));
  const io::Hdf5Reader store(out / "cases.h5");
  const std::vector<double> pmax = store.root().numbers("pmax", {70}), y = store.root().numbers("wheelset.y", {70}),
                            force = store.root().numbers("wheelset.vertical_force", {70});
  for (std::size_t i = 0; i < 70; ++i) {
    EXPECT_NEAR(y[i], run.cases[i].y, 1e-12);
    EXPECT_GE(force[i], 80e3);
    const double expected = io::listed_number("pmax_MPa").si(run.cases[i]);
    EXPECT_TRUE(pmax[i] == expected || (std::isnan(pmax[i]) && std::isnan(expected))) << i;
  }
  EXPECT_NE(store.root().bytes("status").at(3), 0);
  EXPECT_EQ(store.root().numbers("message_case"), std::vector<double>{4.0});
  EXPECT_EQ(store.root().text("format"), "treadmark-cases-1");
  EXPECT_THAT(content_of(out / "cases.json"), HasSubstr("\"" + bad + "\": 1"));
  EXPECT_FALSE(fs::exists(out / "unfinished.rows"));
  EXPECT_FALSE(fs::exists(out / "fields.h5"));
}

TEST(CaseList, HasFieldsWhereTheyAreShown) {
  const TemporaryFolder folder;
  const fs::path file = pair_list(folder, places(2)), out = folder.path() / "out";
  for (const std::string option : {"--vtk", "--fields", "--verbose"}) {
    EXPECT_EQ(run_program({"run", file.string(), "-o", out.string(), option}).status, 0) << option;
    EXPECT_TRUE(fs::exists(out / "result.json") && !fs::exists(out / "cases.csv")) << option;
    fs::remove_all(out);
  }
}

TEST(CaseList, OverwritesNoInput) {
  const TemporaryFolder folder;
  const std::string table = places(3), here = folder.path().string();
  folder.write("cases.csv", table);
  const std::string file = folder.write("list.toml", "cases_file = \"cases.csv\"\n" + standard_case("1.5")).string();
  const auto refused = [&](const std::vector<std::string>& words) {
    const auto result = run_program(words);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("would overwrite"));
    EXPECT_EQ(content_of(folder.path() / "cases.csv"), table);
    EXPECT_FALSE(fs::exists(folder.path() / "unfinished.rows"));
  };
  refused({"run", file, "-o", here});
  refused({"run", file, "--json", (folder.path() / "cases.csv").string()});
  // results of few cases leave a table alone that no list has written
  EXPECT_EQ(run_program({"run", file, "--fields", "-o", here}).status, 0);
  EXPECT_EQ(content_of(folder.path() / "cases.csv"), table);
  folder.write("cases.json", "{}");
  refused({"run", file, "--fields", "-o", here});
}

TEST(CaseList, HasNumbersAsTheyAreInPlaceOfOverriddenColumns) {
  const TemporaryFolder folder;
  const fs::path file = pair_list(folder, places(2)), out = folder.path() / "out";
  const auto result = run_program({"run", file.string(), "-o", out.string(), "--set", "wheelset.y_mm=1.5"});
  EXPECT_THAT(result.err, HasSubstr("the column wheelset.y_mm of"));
  const std::string csv = content_of(out / "cases.csv");
  EXPECT_TRUE(csv.starts_with("case,status,wheelset.yaw_deg,wheelset.vertical_force_N,wheelset.y_mm,")) << csv;
  EXPECT_THAT(csv, HasSubstr("\n1,ok,0,80000,1.5,"));
  EXPECT_THAT(csv, HasSubstr("\n2,ok,0.02,81000,1.5,"));
}

/// Whether a file grows beyond a size while the program runs.
bool grows(const fs::path& file, std::uintmax_t size, RunningProgram& program) {
  for (int i = 0; i < 6000 && program.running(); ++i) {
    std::error_code none;
    if (const std::uintmax_t now = fs::file_size(file, none); !none && now > size) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(CaseList, GoesOnAfterItWasKilled) {
  const TemporaryFolder folder;
  const fs::path file = pair_list(folder, places(3000)), out = folder.path() / "out", once = folder.path() / "once";
  const auto to_folder = [&](const fs::path& to) {
    return std::vector<std::string>{"run", file.string(), "-o", to.string()};
  };
  for (const int signal : {SIGKILL, SIGINT}) {
    RunningProgram program({"treadmark", "run", file.string(), "-o", out.string()});
    std::error_code none;
    const std::uintmax_t before = fs::file_size(out / "unfinished.rows", none);
    ASSERT_TRUE(grows(out / "unfinished.rows", (none ? 0 : before) + 40000, program));
    const auto start = std::chrono::steady_clock::now();
    program.send(signal);
    const auto result = program.wait();
    EXPECT_LT(std::chrono::steady_clock::now() - start, 20s);
    EXPECT_NE(result.status, 0);
    EXPECT_FALSE(fs::exists(out / "cases.csv"));
    if (signal == SIGINT) {
      EXPECT_THAT(result.err, HasSubstr("the same command goes on"));
    }
  }
  const auto rest = run_program(to_folder(out));
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("of 3000 cases were finished before"));
  EXPECT_EQ(run_program(to_folder(once)).status, 0);
  for (const char* name : {"cases.csv", "cases.h5"})
    if (fs::exists(once / name)) {
      EXPECT_EQ(content_of(out / name), content_of(once / name)) << name;
    }
}

TEST(CaseList, AsksForWhatItNeeds) {
  const TemporaryFolder folder;
  const fs::path file = pair_list(folder, places(3));
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> command{"run", file.string()};
    command.insert(command.end(), more.begin(), more.end());
    const auto result = run_program(command);
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_THAT(refused({"--numbers", "pmax"}), HasSubstr("'pmax'"));
  EXPECT_THAT(refused({"--numbers", "npatch,pmax_MPa,npatch"}), HasSubstr("npatch stands twice"));
  EXPECT_THAT(refused({"--numbers", "npatch", "--fields"}), HasSubstr("--fields"));
  folder.write("places.csv", "wheelset.y_mm\n0\nx\n");
  EXPECT_THAT(refused({}), HasSubstr("places.csv:3"));
}

}  // namespace
}  // namespace treadmark::app
