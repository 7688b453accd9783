// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/write_json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/shared_data.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using nlohmann::json;

// The file keeps 12 digits; the reading program's own conversion of units adds a rounding.
constexpr double kJsonDigits = 1e-11;

json parse_sample() { return json::parse(io::to_json(testing::sample_run())); }

TEST(WriteJson, ConvertsToTheUnitsInTheNames) {
  const json document = parse_sample();
  const json& first = document["cases"][0];
  EXPECT_EQ(first["case"], 1);
  EXPECT_EQ(first["status"], "ok");
  EXPECT_EQ(first["wheelset"]["s_mm"], 160.0);
  EXPECT_EQ(first["wheelset"]["z_mm"], 0.3729);  // exact: no tail of nines
  EXPECT_EQ(first["wheelset"]["pitch_rad"], -0.4363);
  EXPECT_EQ(first["wheelset_velocity"]["vx_mm_s"], 2000.0);
  EXPECT_EQ(first["force_on_rail"]["fz_tr_N"], 125000.0);
  EXPECT_EQ(first["force_on_rail"]["fx_ws_N"], 7498.0);
  EXPECT_EQ(first["force_on_rail"]["my_r_Nmm"], 2000.0);
  EXPECT_EQ(first["force_on_rail"]["mz_w_Nmm"], 6000.0);
  EXPECT_EQ(first["timing"]["total_s"], 0.5);
  EXPECT_EQ(first["force_iterations"], json::parse("[[0.2646, 0.0], [0.3729, 125000.0]]"));
  EXPECT_EQ(first["npatch"], 2);

  const json& patch = first["patches"][0];
  EXPECT_EQ(patch["reference"]["y_tr_mm"], 759.3304);
  EXPECT_EQ(patch["kinematics"]["velocity_mm_s"], 1999.58);
  EXPECT_EQ(patch["kinematics"]["phi"], 2.796e-5);
  EXPECT_EQ(patch["mn_Nmm"], -7458.0);
  EXPECT_EQ(patch["approach_mm"], 0.108244);
  EXPECT_NEAR(patch["fn_over_g_mm2"].get<double>(), patch["fn_N"].get<double>() / 82e3, 1e-9);  // G = 82000 N/mm2
  EXPECT_EQ(patch["elements"]["npot"], 480);
  EXPECT_EQ(patch["grid"]["mx"], 24);
  EXPECT_EQ(patch["grid"]["ds_mm"], 0.5);
  EXPECT_EQ(patch["grid"]["s0_mm"], -4.75);
  EXPECT_FALSE(patch.contains("frictional_work_J"));
}

TEST(WriteJson, ShiftCasesGiveLengthsAndWork) {
  const json document = parse_sample();
  const json& item = document["cases"][1];
  EXPECT_EQ(item["status"], "not_converged");
  EXPECT_FALSE(item.contains("wheelset"));
  EXPECT_FALSE(item.contains("force_on_rail"));
  const json& patch = item["patches"][0];
  EXPECT_FALSE(patch.contains("reference"));
  EXPECT_FALSE(patch["kinematics"].contains("dq_mm"));
  EXPECT_EQ(patch["xi"], 0.008155);
  EXPECT_EQ(patch["kinematics"]["eta"], -0.001);
  EXPECT_EQ(patch["kinematics"]["phi"], 0.003);
  EXPECT_EQ(patch["frictional_work_J"], -2.75e-6);
}

TEST(WriteJson, TemperaturesAppearWhereTheyWereComputed) {
  io::RunResult run = testing::sample_run();
  run.doubts = {"wheel profile w.csv: flange_side: the flange is on the side of great y"};
  run.cases[0].patches[1].max_temperature_1 = 166.8;
  run.cases[0].patches[1].max_temperature_2 = 90.85;
  const json document = json::parse(io::to_json(run));
  EXPECT_FALSE(document["cases"][0]["patches"][0].contains("max_temperature_1_C"));
  EXPECT_EQ(document["cases"][0]["patches"][1]["max_temperature_1_C"], 166.8);
  EXPECT_EQ(document["cases"][0]["patches"][1]["max_temperature_2_C"], 90.85);
  const json schema = json::parse(io::result_schema());
  EXPECT_EQ(testing::first_violation(document, schema, schema), "");
}

TEST(WriteJson, NumbersThatAreNotFiniteBecomeNull) {
  const std::string text = io::to_json(testing::sample_run());
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
  const json document = json::parse(text);
  EXPECT_TRUE(document["cases"][3]["wheelset"]["z_mm"].is_null());
  EXPECT_TRUE(document["cases"][3]["force_on_rail"]["fz_tr_N"].is_null());
  EXPECT_TRUE(document["cases"][3]["patches"][0]["fn_over_g_mm2"].is_null());  // 0 / 0
}

TEST(WriteJson, KeepsTwelveDigits) {
  io::RunResult run = testing::sample_run();
  for (const double value : {1.0 / 3.0, 123456789.123, -2.0e-19, 7.0e17}) {
    run.cases[0].force_tr.x() = value;
    const double read = json::parse(io::to_json(run))["cases"][0]["force_on_rail"]["fx_tr_N"];
    EXPECT_NEAR(read, value, 1e-12 * std::abs(value));
  }
}

TEST(WriteJson, SaysWhereTheResultCameFromAndWhetherItIsWhole) {
  io::RunResult run = testing::sample_run();
  run.complete = false;
  run.toml = "title = 'flat'\n";
  const json document = json::parse(io::to_json(run));
  const json schema = json::parse(io::result_schema());
  EXPECT_EQ(testing::first_violation(document, schema, schema), "");
  EXPECT_EQ(document["input"]["toml"], run.toml);
  EXPECT_EQ(document["treadmark"]["version"], "0.1.0");
  EXPECT_EQ(document["treadmark"]["threads"], 2);
  EXPECT_EQ(document["input"]["file"], "flat \"one\".toml");
  EXPECT_EQ(document["input"]["geometry"][1], json::parse(R"({"file": "b.slcw", "sha256": "22"})"));
  EXPECT_EQ(document["settings"][0], "wheel.backend=spline");
  EXPECT_EQ(document["complete"], false);
  EXPECT_EQ(document["cases_total"], 4);
}

TEST(WriteJson, NamesThatAreNotUtf8DoNotSpoilTheFile) {
  io::RunResult run = testing::sample_run();
  run.input_file = "caf\xe9.inp";
  EXPECT_TRUE(json::accept(io::to_json(run)));
}

TEST(WriteJson, FitsTheSchemaAndTheSchemaBites) {
  const json schema = json::parse(io::result_schema());
  json document = parse_sample();
  EXPECT_EQ(testing::first_violation(document, schema, schema), "");

  json wrong = document;
  wrong["cases"][0]["patches"][0]["fn_N"] = "many";
  EXPECT_EQ(testing::first_violation(wrong, schema, schema), "/cases/0/patches/0/fn_N: wrong type");
  wrong = document;
  wrong["cases"][1].erase("status");
  EXPECT_EQ(testing::first_violation(wrong, schema, schema), "/cases/1/status: missing");
  wrong = document;
  wrong["cases"][0]["patches"][0]["fz_lbf"] = 1.0;
  EXPECT_EQ(testing::first_violation(wrong, schema, schema), "/cases/0/patches/0/fz_lbf: not in the schema");
  wrong = document;
  wrong["cases"][0]["status"] = "fine";
  EXPECT_EQ(testing::first_violation(wrong, schema, schema), "/cases/0/status: not one of the allowed values");
}

/// From the reference program's units to SI, by the name of the quantity.
double si(const json& object, const char* key, double unit) {
  return object.contains(key) && object[key].is_number() ? object[key].get<double>() * unit : 0.0;
}

io::PatchResult patch_from_reference(const json& in) {
  io::PatchResult patch;
  patch.shift = in.contains("frictional_work_J");
  if (in.contains("reference")) {
    const json& place = in["reference"];
    patch.has_reference = true;
    patch.x_tr = si(place, "x_tr_mm", 1e-3);
    patch.y_tr = si(place, "y_tr_mm", 1e-3);
    patch.z_tr = si(place, "z_tr_mm", 1e-3);
    patch.angle = si(place, "angle_rad", 1.0);
    patch.y_rail = si(place, "y_rail_mm", 1e-3);
    patch.z_rail = si(place, "z_rail_mm", 1e-3);
    patch.x_wheel = si(place, "x_wheel_mm", 1e-3);
    patch.y_wheel = si(place, "y_wheel_mm", 1e-3);
    patch.z_wheel = si(place, "z_wheel_mm", 1e-3);
  }
  const double length = patch.shift ? 1e-3 : 1.0;
  const json& motion = in.contains("kinematics") ? in["kinematics"] : in;
  patch.has_rolling = motion.contains("velocity_mm_s");
  patch.chi = si(motion, "chi_rad", 1.0);
  patch.dq = si(motion, "dq_mm", 1e-3);
  patch.velocity = si(motion, "velocity_mm_s", 1e-3);
  patch.xi = si(motion, "xi", length);
  patch.eta = si(motion, "eta", length);
  patch.phi = si(motion, "phi", patch.shift ? 1.0 : 1e3);
  patch.fn = si(in, "fn_N", 1.0);
  patch.fx = si(in, "fx_N", 1.0);
  patch.fs = si(in, "fs_N", 1.0);
  patch.mn = si(in, "mn_Nmm", 1e-3);
  patch.elastic_energy = si(in, "elastic_energy_J", 1.0);
  patch.frictional_power = si(in, patch.shift ? "frictional_work_J" : "frictional_power_W", 1.0);
  if (in.contains("fn_over_g_mm2")) patch.shear_modulus = patch.fn / si(in, "fn_over_g_mm2", 1e-6);
  patch.fx_relative = si(in, "fx_rel", 1.0);
  patch.fs_relative = si(in, "fs_rel", 1.0);
  patch.approach = si(in, "approach_mm", 1e-3);
  patch.pmax = si(in, "pmax_MPa", 1e6);
  if (in.contains("elements")) {
    patch.npot = in["elements"]["npot"];
    patch.ncon = in["elements"]["ncon"];
    patch.nadh = in["elements"]["nadh"];
    patch.nslip = in["elements"]["nslip"];
  }
  return patch;
}

io::CaseResult case_from_reference(const json& in) {
  io::CaseResult result;
  result.number = in["case"];
  if (in.contains("force_on_rail")) {
    const json& forces = in["force_on_rail"];
    result.has_wheelset = true;
    result.force_tr = {si(forces, "fx_tr_N", 1), si(forces, "fy_tr_N", 1), si(forces, "fz_tr_N", 1)};
    result.force_ws = {si(forces, "fx_ws_N", 1), si(forces, "fy_ws_N", 1), si(forces, "fz_ws_N", 1)};
  }
  if (in.contains("wheelset")) {
    const json& set = in["wheelset"];
    result.s = si(set, "s_mm", 1e-3);
    result.y = si(set, "y_mm", 1e-3);
    result.z = si(set, "z_mm", 1e-3);
    result.roll = si(set, "roll_rad", 1);
    result.yaw = si(set, "yaw_rad", 1);
    result.pitch = si(set, "pitch_rad", 1);
    const json& rates = in["wheelset_velocity"];
    result.vs = si(rates, "vx_mm_s", 1e-3);
    result.vy = si(rates, "vy_mm_s", 1e-3);
    result.vz = si(rates, "vz_mm_s", 1e-3);
    result.vroll = si(rates, "vroll_rad_s", 1);
    result.vyaw = si(rates, "vyaw_rad_s", 1);
    result.vpitch = si(rates, "vpitch_rad_s", 1);
  }
  for (const json& step : in["force_iterations"])
    result.force_iterations.emplace_back(step[0].get<double>() * 1e-3, step[1]);
  for (const json& patch : in["patches"]) result.patches.push_back(patch_from_reference(patch));
  return result;
}

/// Counts the numbers of the reference that the result file has too, and reports the others.
int compare_numbers(const json& reference, const json& ours, const std::string& place) {
  if (reference.is_number()) {
    EXPECT_TRUE(ours.is_number()) << place;
    if (!ours.is_number()) return 0;
    const double expected = reference;
    EXPECT_NEAR(ours.get<double>(), expected, kJsonDigits * std::abs(expected)) << place;
    return 1;
  }
  int count = 0;
  if (reference.is_object())
    for (const auto& [key, value] : reference.items()) {
      // Quantities outside the result model: heat, normal force in curved contact, time step of a basic case.
      if (key == "max(t1,t2)" || key == "fn_tilde_N" || key == "dt") continue;
      EXPECT_TRUE(ours.contains(key)) << place << "/" << key;
      if (ours.contains(key)) count += compare_numbers(value, ours[key], place + "/" + key);
    }
  if (reference.is_array()) {
    EXPECT_EQ(reference.size(), ours.size()) << place;
    for (std::size_t i = 0; i < std::min(reference.size(), ours.size()); ++i)
      count += compare_numbers(reference[i], ours[i], place + "/" + std::to_string(i));
  }
  return count;
}

TEST(WriteJson, HasEveryQuantityOfTheReferenceResultsUnderItsName) {
  TREADMARK_REQUIRE_SHARED();
  int files = 0, numbers = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*shared / "reference")) {
    if (entry.path().extension() != ".json") continue;
    json reference = json::parse(std::ifstream(entry.path()));
    if (reference.is_object()) reference = reference["cases"];
    io::RunResult run;
    for (const json& item : reference) run.cases.push_back(case_from_reference(item));
    numbers += compare_numbers(reference, json::parse(io::to_json(run))["cases"], entry.path().filename());
    ++files;
  }
  EXPECT_GE(files, 25);
  EXPECT_GE(numbers, 10000);
}

TEST(WriteJson, WritesTheFileWholeOrNotAtAll) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "new" / "result.json";
  io::write_json(path, testing::sample_run());
  EXPECT_EQ(testing::read_text(path), io::to_json(testing::sample_run()));
  io::write_json(path, io::RunResult{});  // replaces
  EXPECT_EQ(testing::read_text(path), io::to_json(io::RunResult{}));
  EXPECT_EQ(folder.count_files(), 2u);  // the folder "new" and the file: nothing temporary is left
}

TEST(WriteJson, SaysWhichFileCannotBeWritten) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  std::filesystem::create_directory(folder.path() / "folder");
  for (const char* name : {"file/result.json", "folder"}) {
    try {
      io::write_json(folder.path() / name, testing::sample_run());
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::configuration);
      EXPECT_NE(error.message().find(name), std::string::npos) << error.message();
    }
  }
  EXPECT_EQ(folder.count_files(), 2u);
}

TEST(WriteJson, PieceByPieceIsTheSame) {
  io::RunResult run = testing::sample_run();
  const std::string whole = io::to_json(run);
  std::string pieces;
  for (const io::CaseResult& c : run.cases)
    pieces += (pieces.empty() ? "" : std::string(io::kBetweenCases)) + io::case_text(c);
  run.cases.clear();
  EXPECT_EQ(io::text_before_cases(run) + pieces + std::string(io::kBehindCases), whole);
}

}  // namespace
}  // namespace treadmark
