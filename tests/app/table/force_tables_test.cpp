// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/table/force_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using testing::ProgramResult;
using testing::run_program;
using testing::TemporaryFolder;

const std::string kCase = R"(
title = "a wheel to tabulate"
rail.shape.standard = "60E1"
wheel.shape.standard = "S1002"
track.cant = "1:40"
[wheelset]
nominal_radius_mm = 460
vertical_force_N = 80e3
velocity_m_s = 20
rolling = "nominal"
[friction]
coefficient = 0.25
)";

std::string case_file(const TemporaryFolder& folder) {
  const auto file = folder.path() / "wheel.toml";
  std::ofstream(file) << kCase;
  return file.string();
}

/// As small as it can be.
TableRequest small_request() {
  TableRequest request = table_request({});
  request.axes.lateral_range = 2e-3, request.axes.step = 1e-3, request.axes.element_size = 1e-3;
  request.axes.relative_loads = {0.5, 1.5};
  request.axes.roll = {4e-3, 2}, request.axes.yaw = {10e-3, 1};
  request.creep = {2, 2, 2.0, 8, 6};
  request.check.points = 5;
  return request;
}

const MadeTable& small_table() {
  static const MadeTable table = [] {
    const TemporaryFolder folder;
    return make_table(case_file(folder), small_request());
  }();
  return table;
}

vehicle::WheelMotion some_motion() {
  vehicle::WheelMotion w;
  w.motion.wheelset.y = 0.7e-3, w.motion.wheelset.yaw = 3e-3;
  w.motion.wheelset_velocity.x = 20.0, w.motion.wheelset_velocity.pitch = -43.6;
  w.vertical_load = 7e4;
  return w;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ForceTables, ReadAgainTheyGiveTheSameBits) {
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  for (const char* name : {"table.h5", "table.json"}) {
    const auto file = folder.path() / name;
    write_table(file, small_table());
    MadeTable again = read_table(file);
    vehicle::ForceTable before = small_table().table;
    const vehicle::WheelForces a = before.at(some_motion()), b = again.table.at(some_motion());
    ASSERT_EQ(a.reaction.status, Status::ok) << a.reaction.message;
    for (const auto& column : columns<vehicle::WheelForces>())
      EXPECT_EQ(column.access.get(a), column.access.get(b)) << name << ' ' << column.stored;
    ASSERT_TRUE(again.table.check().has_value());
    const auto &kept = small_table().table.check()->errors, &read = again.table.check()->errors;
    ASSERT_EQ(read.size(), kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      EXPECT_EQ(read[i].number, kept[i].number);
      EXPECT_EQ(read[i].worst, kept[i].worst);
      EXPECT_EQ(read[i].rms, kept[i].rms);
    }
    const std::string bytes = text_of(file);
    write_table(file, again);
    EXPECT_EQ(text_of(file), bytes) << name;
  }
}

TEST(ForceTables, NodesAreATable) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "nodes.csv";
  write_table(file, small_table());
  const std::string text = text_of(file);
  EXPECT_THAT(text, HasSubstr("roll_rad,yaw_rad,y_m,load_N,z_m,"));
  // 3 rolls, 2 yaws, at least 5 places, 2 loads, and the heads
  EXPECT_GE(ranges::count(text, '\n'), 1 + 3 * 2 * 5 * 2);
  EXPECT_EQ(ranges::count(text, '\n'), static_cast<std::ptrdiff_t>(1 + small_table().nodes.size()));
  EXPECT_THROW(read_table(file), Error);
  EXPECT_THROW(write_table(folder.path() / "table.txt", small_table()), Error);
}

/// What read_table says against a file; empty: nothing.
std::string said_against(const std::filesystem::path& file) {
  try {
    read_table(file);
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data) << error.what();
    return error.what();
  }
}

TEST(ForceTables, TheTitleOfTheCaseIsKept) {
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  EXPECT_EQ(small_table().title, "a wheel to tabulate");
  for (const char* name : {"table.h5", "table.json"}) {
    write_table(folder.path() / name, small_table());
    EXPECT_EQ(read_table(folder.path() / name).title, small_table().title);
  }
}

/// Whatever bit of a file changes: it is refused, or it was one that says nothing, and the table is the same.
TEST(ForceTables, NoChangedBitMakesAnotherTable) {
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  constexpr std::size_t kFlips = 300;
  for (const char* name : {"table.h5", "table.json"}) {
    const auto file = folder.path() / name, again = folder.path() / (std::string("again_") + name);
    write_table(file, small_table());
    const std::string whole = text_of(file);
    std::size_t refused = 0;
    for (std::size_t i = 0; i < kFlips; ++i) {
      std::string damaged = whole;
      damaged[i * whole.size() / kFlips] ^= static_cast<char>(1 << i % 8);
      std::ofstream(file, std::ios::binary) << damaged;
      try {
        write_table(again, read_table(file));
        EXPECT_EQ(text_of(again), whole) << name << ", flip " << i;
      } catch (const Error&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, kFlips / 2) << name;
  }
}

/// Also where a file is what was written, but that makes no sense.
TEST(ForceTables, TablesWithoutMeaningAreNotRead) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "table.json";
  const auto refused = [&](auto change) {
    MadeTable made = small_table();
    change(made);
    write_table(file, made);
    EXPECT_THAT(said_against(file), HasSubstr("table of forces"));
  };
  const auto check = [](MadeTable& made, auto change) {
    vehicle::TableCheck changed = *made.table.check();
    change(changed);
    made.table.keep(changed);
  };
  refused([](MadeTable& m) { m.head.element_size = 0.0; });
  refused([](MadeTable& m) { m.head.load = -1.0; });
  refused([](MadeTable& m) { m.nodes[2].contact.slope = 1e9; });
  refused([](MadeTable& m) { m.nodes[2].part.angle = 1.6; });
  refused([](MadeTable& m) { m.nodes[2].part.log_aspect = -40.0; });
  refused([](MadeTable& m) { m.nodes.clear(); });
  refused([&](MadeTable& m) { check(m, [](auto& c) { c.errors.clear(); }); });
  refused([&](MadeTable& m) { check(m, [](auto& c) { c.errors.pop_back(); }); });
  refused([&](MadeTable& m) { check(m, [](auto& c) { c.errors[1].rms = std::nan(""); }); });
  refused([&](MadeTable& m) { check(m, [](auto& c) { c.errors[1].number = "fz"; }); });
  refused([&](MadeTable& m) { check(m, [](auto& c) { c.compared = 0; }); });
}

TEST(ForceTables, DamagedFilesAreRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "table.json";
  write_table(file, small_table());
  const nlohmann::ordered_json whole = nlohmann::ordered_json::parse(text_of(file));
  const auto refused = [&](auto change) {
    nlohmann::ordered_json damaged = whole;
    change(damaged);
    std::ofstream(file) << damaged.dump();
    const std::string said = said_against(file);
    EXPECT_FALSE(said.empty()) << "a damaged table was read";
    return said;
  };
  refused([](auto& j) { j["format"] = "something else"; });
  refused([](auto& j) { j.erase("nodes"); });
  refused([](auto& j) { j["nodes"]["z_m"].erase(0); });
  refused([](auto& j) { j["nodes"]["area_m2"][3] = -1.0; });
  refused([](auto& j) { j["nodes"]["share"][3] = -1.0; });
  refused([](auto& j) { j["nodes"]["z_m"][0] = nullptr; });
  refused([](auto& j) { j["nodes"]["load_N"][1] = 1e3; });
  refused([](auto& j) { j["nodes"]["roll_rad"][1] = 1e-3; });
  refused([](auto& j) { j["head"]["roll_intervals"] = 4; });
  refused([](auto& j) { j["head"]["roll_most_rad"] = 5e-3; });
  refused([](auto& j) { j["head"]["wheel_z_m"] = nullptr; });
  refused([](auto& j) { j["creep"]["poisson"] = -1.0; });
  refused([](auto& j) { j["creep"]["values"].erase(0); });
  refused([](auto& j) { j["case"] = "nonsense = 1"; });
  refused([](auto& j) { j.erase("sha256"); });
  // Changed within what makes sense.
  EXPECT_THAT(refused([](auto& j) { j["nodes"]["area_m2"][3] = 1e-4; }), HasSubstr("not what was written"));
  EXPECT_THAT(refused([](auto& j) { j["head"]["element_size_m"] = 2e-3; }), HasSubstr("not what was written"));
  EXPECT_THAT(refused([](auto& j) { j["check"]["errors"][0]["worst"] = 0.0; }), HasSubstr("not what was written"));
  // No other file is opened.
  EXPECT_THAT(refused([](auto& j) {
                j["case"] = "cases_file = \"no_such_rows.csv\"\n" + j["case"].template get<std::string>();
              }),
              HasSubstr("names another file"));
}

TEST(ForceTables, WhatTablesAreNotForIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "case.toml";
  const auto refused = [&](const std::string& text, const TableRequest& request, const char* why) {
    std::ofstream(file) << text;
    try {
      make_table(file, request);
      ADD_FAILURE() << why;
    } catch (const Error& error) {
      EXPECT_THAT(std::string(error.what()), HasSubstr(why));
    }
  };
  TableRequest request = small_request();
  refused("wheel.flats = [{ length_mm = 40.0, depth_mm = 1.0 }]\n" + kCase, request, "round");
  refused(std::string(kCase).replace(kCase.find("vertical_force_N = 80e3"), 23, "z_mm = 0.1"), request, "load_kN");
  refused("[patch]\nmx = 4\nmy = 4\n", request, "");
  refused("track.curvature_per_m = 0.003\n" + kCase, request, "leave the curve");
  refused(kCase + "[[friction.along_track]]\ns_mm = 0\ncoefficient = 0.3\n", request, "knows no place");
  // Before minutes are spent on nodes.
  const auto refused_at_once = [&](auto change, const char* why) {
    TableRequest wrong = small_request();
    change(wrong);
    std::ofstream(file) << kCase;
    const Progress progress{[](std::size_t, std::size_t, const std::string&) { ADD_FAILURE() << "solved first"; }, {}};
    try {
      make_table(file, wrong, nullptr, progress);
      ADD_FAILURE() << why;
    } catch (const Error& error) {
      EXPECT_THAT(std::string(error.what()), HasSubstr(why));
    }
  };
  refused_at_once([](TableRequest& r) { r.axes.relative_loads = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}; },
                  "eight loads");
  refused_at_once([](TableRequest& r) { r.check.points = 0; }, "1 to 1000000 points");
  refused_at_once([](TableRequest& r) { r.check.creepage = 0.7; }, "creepages up to 0.5");
  EXPECT_THROW(table_request(io::given_settings(std::vector<std::string>{"roll_intervals=1"})), Error);
  EXPECT_THROW(table_request(io::given_settings(std::vector<std::string>{"yaw_mrad=0"})), Error);
  EXPECT_THROW(table_request(io::given_settings(std::vector<std::string>{"nonsense=0"})), Error);
}

TEST(ForceTables, TheProgramWritesThem) {
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  const std::string file = case_file(folder), table = (folder.path() / "t.h5").string(),
                    json = (folder.path() / "t.json").string();
  const ProgramResult made =
      run_program({"table", file, "-o", table, "--lateral-range-mm", "2", "--step-mm", "1", "--element-mm", "1",
                   "--roll-intervals", "0", "--yaw-intervals", "0", "--creep-forces", "linear", "--check-points", "4"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("errors against the exact theory"));
  EXPECT_THAT(made.out, HasSubstr("normal_force"));
  const ProgramResult told = run_program({"table", table, "-o", json, "--json", "-"});
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_EQ(nlohmann::json::parse(told.out)["check"]["compared"], 4);
  EXPECT_EQ(read_table(json).head.creep_forces, "linear");
  EXPECT_EQ(run_program({"table", table, "--step-mm", "1"}).status, 2);
  EXPECT_THAT(run_program({"table", (folder.path() / "none.toml").string(), "-o", "t.txt"}).err, HasSubstr(".csv"))
      << "before the case is looked at";
}

}  // namespace
}  // namespace treadmark::app
