// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>

#include "treadmark/app/lists/result_list.hpp"
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using treadmark::testing::content_of;
using treadmark::testing::run_program;
using treadmark::testing::TemporaryFolder;

/// Lengths of texts in files, and how often one was looked at.
struct Lengths {
  explicit Lengths(const fs::path& folder, int count) {
    for (int i = 0; i < count; ++i) {
      files.push_back((folder / ("text" + std::to_string(i) + ".txt")).string());
      write_file(files.back(), std::string(static_cast<std::size_t>(i), 'x'));
    }
  }

  ResultList make(const fs::path& kept, const Progress& progress = {}) {
    ResultList list{"Lengths", "texts", "bytes", {"file"}, {{"length", true}, {"half_mm"}}};
    ListWork work;
    work.count = files.size();
    work.name = [&](std::size_t i) { return "row " + std::to_string(i); };
    work.sources = [&](std::size_t i) { return std::vector<std::string>{files[i]}; };
    work.make = [&](std::size_t i) {
      ++looked;
      const auto size = static_cast<double>(content_of(files[i]).size());
      if (size == 2.0) throw Error(ErrorKind::input_data, "two, \"or so\"", {files[i]});
      return ListRow{work.name(i), "ok", {}, {files[i]}, {size, size == 3.0 ? kNaN : 0.1 * size}, size, "{}"};
    };
    make_rows(list, work, kept, progress);
    return list;
  }

  std::vector<std::string> files;
  std::atomic<int> looked{0};
};

TEST(ResultList, GoesOnWhereItWasInterrupted) {
  const TemporaryFolder folder;
  Lengths lengths(folder.path(), 40);
  const std::string whole = list_csv(lengths.make({}));
  EXPECT_EQ(lengths.looked, 40);
  const fs::path kept = folder.path() / "kept";
  const ThreadLimit one(1);
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t finished, std::size_t, const std::string&) { stop = finished == 15; };
  lengths.looked = 0;
  EXPECT_THROW(lengths.make(kept, progress), Cancelled);
  const int before = lengths.looked;
  EXPECT_GE(before, 15);
  EXPECT_LT(before, 40);
  ASSERT_TRUE(fs::exists(kept));
  EXPECT_EQ(list_csv(lengths.make(kept)), whole);
  EXPECT_EQ(lengths.looked, 40 + 1);  // the row that failed is tried again
}

TEST(ResultList, MakesAnewWhatHasChanged) {
  const TemporaryFolder folder;
  Lengths lengths(folder.path(), 10);
  const fs::path kept = folder.path() / "kept";
  Progress progress;
  std::atomic<bool> stop{false};
  progress.stop = &stop;
  progress.report = [&](std::size_t finished, std::size_t, const std::string&) { stop = finished == 9; };
  const ThreadLimit one(1);
  EXPECT_THROW(lengths.make(kept, progress), Cancelled);
  write_file(lengths.files[4], "12345678901");
  const ResultList list = lengths.make(kept);
  EXPECT_EQ(list.rows[4].numbers[0], 11.0);
  EXPECT_EQ(list.rows[5].numbers[0], 5.0);
}

TEST(ResultList, MakesAnewWhatNamesOtherFiles) {
  const TemporaryFolder folder;
  Lengths lengths(folder.path(), 6);
  lengths.files[4] = (folder.path() / "CASE.TOML").string();
  lengths.files[5] = (folder.path() / "rail.Slcs").string();
  for (const int i : {4, 5}) write_file(lengths.files[static_cast<std::size_t>(i)], std::string(7, 'x'));
  const fs::path kept = folder.path() / "kept";
  const ThreadLimit one(1);
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  // the last one asks and stops, when all others are finished
  progress.report = [&](std::size_t finished, std::size_t, const std::string&) { stop = finished == 5; };
  EXPECT_THROW(lengths.make(kept, progress), Cancelled);
  lengths.looked = 0;
  lengths.make(kept);
  EXPECT_GE(lengths.looked, 3);  // these two, and the row that failed
}

TEST(ResultList, LeavesFilesOfOthersAlone) {
  const TemporaryFolder folder;
  Lengths lengths(folder.path(), 3);
  for (const char* foreign : {"my notes\n", "{\"format\": \"something else\", \"rows\": []}\n"}) {
    const fs::path kept = folder.path() / "kept";
    write_file(kept, foreign);
    EXPECT_THROW(lengths.make(kept), Error);
    EXPECT_EQ(content_of(kept), foreign);
  }
}

TEST(ResultList, TablesBeginWithTheWorst) {
  const TemporaryFolder folder;
  const ResultList list = Lengths(folder.path(), 5).make({});
  EXPECT_EQ(list.failed(), 1u);
  std::vector<std::string> names;
  for (const ListRow* row : list.worst_first()) names.push_back(row->name);
  EXPECT_THAT(names, ElementsAre("row 2", "row 4", "row 3", "row 1", "row 0"));
  EXPECT_THAT(list_csv(list), HasSubstr("name,file,status,error,length,half_mm\nrow 0,"));
  EXPECT_THAT(list_csv(list), HasSubstr(",ok,,3,\n"));
  EXPECT_THAT(list_csv(list), HasSubstr("two, \"\"or so\"\""));
  const std::string text = list_text(list);
  EXPECT_LT(text.find("row 4"), text.find("row 0"));
  EXPECT_THAT(text, HasSubstr("row 2: failed: "));
  EXPECT_EQ(text.find("half_mm"), std::string::npos);
  EXPECT_THAT(text, HasSubstr("5 texts, 1 failed"));
  const report::Page page = list_page(list);
  const auto& table = std::get<report::Table>(page.sections.at(1).blocks.at(0));
  EXPECT_EQ(std::get<std::string>(table.rows.at(1).cells.at(0)), "row 4");
}

TEST(ResultList, StoresColumns) {
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  const ResultList list = Lengths(folder.path(), 5).make({});
  write_list_store(folder.path() / "list.h5", list);
  const io::Hdf5Reader file(folder.path() / "list.h5");
  EXPECT_EQ(file.root().text("title"), "Lengths");
  EXPECT_THAT(file.root().strings("status"), ElementsAre("ok", "ok", "failed", "ok", "ok"));
  const std::vector<double> lengths = file.root().numbers("length");
  ASSERT_EQ(lengths.size(), 5u);
  EXPECT_TRUE(std::isnan(lengths[2]));
  EXPECT_EQ(lengths[4], 4.0);
  EXPECT_EQ(file.root().text_of("half_mm", "unit"), "mm");
}

/// Wheels of straight lines, 1:20, with flanges of different heights.
std::vector<std::string> wheels(const fs::path& folder, int count) {
  fs::create_directories(folder);
  std::vector<std::string> out;
  for (int k = 0; k < count; ++k) {
    const double tip = 26.0 + 0.05 * k;
    std::string text = "y_mm;z_mm\n";
    const double corners[][2] = {{-70, 0}, {-70, 20}, {-62, tip}, {-50, tip}, {-35, 0.75}, {60, -4}};
    for (int i = 0; i + 1 < 6; ++i)
      for (int j = i == 0 ? 0 : 1; j <= 400; ++j) {
        const double t = j / 400.0;
        text += std::to_string(corners[i][0] + (corners[i + 1][0] - corners[i][0]) * t) + ";" +
                std::to_string(corners[i][1] + (corners[i + 1][1] - corners[i][1]) * t) + "\n";
      }
    out.push_back((folder / ("wheel" + std::to_string(100 + k) + ".csv")).string());
    write_file(out.back(), text);
  }
  return out;
}

TEST(ResultList, AFleetIsMeasuredFurtherAfterItsEnd) {
  const TemporaryFolder folder;
  const fs::path fleet = folder.path() / "fleet";
  wheels(fleet, 60);
  write_file(fleet / "bad.csv", "nothing\n");
  write_file(folder.path() / "limits.toml", "[wheel]\nflange_height_mm = { max = 28 }\n");
  const auto command = [&](const std::string& csv) {
    return std::vector<std::string>{"measure",
                                    "wheel",
                                    fleet.string(),
                                    "--nominal",
                                    "S1002",
                                    "--limits",
                                    (folder.path() / "limits.toml").string(),
                                    "--csv",
                                    (folder.path() / csv).string()};
  };
  const auto whole = run_program(command("whole.csv"));
  EXPECT_EQ(whole.status, 3);
  EXPECT_THAT(whole.err, HasSubstr("1 of 61 files failed"));
  // what stopped early, in the library as the program does
  MeasureRequest request;
  request.nominal = "S1002";
  request.limits = read_limits(folder.path() / "limits.toml");
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t finished, std::size_t, const std::string&) { stop = finished >= 20; };
  const fs::path kept = folder.path() / "again.csv.unfinished";
  EXPECT_THROW(measure_files(measured_names({fleet.string()}, Body::wheel), request, kept, progress), Cancelled);
  ASSERT_TRUE(fs::exists(kept));
  const auto again = run_program(command("again.csv"));
  EXPECT_EQ(again.status, 3);
  EXPECT_EQ(content_of(folder.path() / "again.csv"), content_of(folder.path() / "whole.csv"));
  EXPECT_FALSE(fs::exists(kept));
  // the highest flange first, after what failed
  EXPECT_LT(again.out.find("bad.csv"), again.out.find("wheel159.csv"));
  EXPECT_LT(again.out.find("wheel159.csv"), again.out.find("wheel100.csv"));
  EXPECT_THAT(again.out, HasSubstr("outside"));
}

TEST(ResultList, ReportsOfOneAndOfMany) {
  TREADMARK_NEEDS("report");
  const TemporaryFolder folder;
  wheels(folder.path() / "fleet", 3);
  const std::string one = (folder.path() / "one.html").string(), many = (folder.path() / "many.html").string();
  ASSERT_EQ(run_program({"measure", "wheel", "S1002", "--nominal", "S1002", "--report", one}).status, 0);
  EXPECT_THAT(content_of(one), HasSubstr("flange_height_mm"));
  ASSERT_EQ(run_program({"measure", "wheel", (folder.path() / "fleet").string(), "--report", many}).status, 0);
  const std::string page = content_of(many);
  EXPECT_THAT(page, HasSubstr("the worst first"));
  EXPECT_THAT(page, HasSubstr("wheel102.csv"));
}

}  // namespace
}  // namespace treadmark::app
