// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_settings.hpp"

#include <cmath>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

/// Every key with a value that is not its default, as text, and whether settings have it.
struct Case {
  std::string table, name, value;
  std::function<bool(const ImportSettings&)> has;

  std::string key() const { return table + '.' + name; }
};

std::vector<Case> cases() {
  using S = ImportSettings;
  const std::vector<double> direction{0.25, -1.0, 2.0};
  return {
      {"scan", "body", "\"wheel\"", [](const S& s) { return s.scan.body == "wheel"; }},
      {"scan", "unit", "\"um\"", [](const S& s) { return s.scan.unit == "um"; }},
      {"scan", "box_from", "[0.25, -1, 2.0]", [=](const S& s) { return s.scan.box_from == direction; }},
      {"scan", "box_to", "[0.25, -1, 2.0]", [=](const S& s) { return s.scan.box_to == direction; }},
      {"scan", "station", "[0.25, -1, 2.0]", [=](const S& s) { return s.scan.station == direction; }},
      {"scan", "nearest", "0.5", [](const S& s) { return s.scan.nearest == 0.5; }},
      {"scan", "farthest", "12", [](const S& s) { return s.scan.farthest == 12.0; }},
      {"scan", "least_intensity", "0.25", [](const S& s) { return s.scan.least_intensity == 0.25; }},
      {"scan", "register_mm", "30", [](const S& s) { return s.scan.register_mm == 30.0; }},
      {"scan", "rails", "\"both\"", [](const S& s) { return s.scan.rails == "both"; }},
      {"scan", "pass_steps", "false", [](const S& s) { return !s.scan.pass_steps; }},
      {"placement", "nominal", "\"my \\\"worn\\\" wheel.prw\"",
       [](const S& s) { return s.placement.nominal == "my \"worn\" wheel.prw"; }},
      {"placement", "nominal_radius_mm", "457.5", [](const S& s) { return s.placement.nominal_radius_mm == 457.5; }},
      {"placement", "up", "[0.25, -1, 2.0]", [=](const S& s) { return s.placement.up == direction; }},
      {"placement", "forward", "[0.25, -1, 2.0]", [=](const S& s) { return s.placement.forward == direction; }},
      {"placement", "zero", "\"scan\"", [](const S& s) { return s.placement.zero == "scan"; }},
      {"placement", "zero_direction", "[0.25, -1, 2.0]",
       [=](const S& s) { return s.placement.zero_direction == direction; }},
      {"placement", "zero_deg", "-12.25", [](const S& s) { return s.placement.zero_deg == -12.25; }},
      {"placement", "zero_mm", "-1000.1", [](const S& s) { return s.placement.zero_mm == -1000.1; }},
      {"placement", "line_beside_mm", "-753.5", [](const S& s) { return s.placement.line_beside_mm == -753.5; }},
      {"placement", "line", "\"alignment.xyz\"", [](const S& s) { return s.placement.line == "alignment.xyz"; }},
      {"clean", "strays", "false", [](const S& s) { return !s.clean.strays; }},
      {"clean", "stray_distance", "6", [](const S& s) { return s.clean.stray_distance == 6.0; }},
      {"clean", "stray_cluster", "0.25", [](const S& s) { return s.clean.stray_cluster == 0.25; }},
      {"clean", "farthest_mm", "2.5", [](const S& s) { return s.clean.farthest_mm == 2.5; }},
      {"clean", "outlier_factor", "0", [](const S& s) { return s.clean.outlier_factor == 0.0; }},
      {"clean", "edge_share", "0.5", [](const S& s) { return s.clean.edge_share == 0.5; }},
      {"clean", "mixed_points", "false", [](const S& s) { return !s.clean.mixed_points; }},
      {"clean", "hole_limit_mm", "33.3", [](const S& s) { return s.clean.hole_limit_mm == 33.3; }},
      {"clean", "least_filled", "1", [](const S& s) { return s.clean.least_filled == 1.0; }},
      {"fit", "resolution_mm", "0.1", [](const S& s) { return s.fit.resolution_mm == 0.1; }},
      {"fit", "finest_mm", "1.5e0", [](const S& s) { return s.fit.finest_mm == 1.5; }},
      {"fit", "significance", "0.333333333333333", [](const S& s) { return s.fit.significance == 0.333333333333333; }},
      {"fit", "follow", "false", [](const S& s) { return !s.fit.follow; }},
      {"fit", "held_out", "0.05", [](const S& s) { return s.fit.held_out == 0.05; }},
      {"fit", "errors", "false", [](const S& s) { return !s.fit.errors; }},
      {"fit", "weights", "false", [](const S& s) { return !s.fit.weights; }},
      {"fit", "tolerance_um", "0.3", [](const S& s) { return s.fit.tolerance_um == 0.3; }},
      {"fit", "sections", "\"keep\"", [](const S& s) { return s.fit.sections == "keep"; }},
      {"fit", "sections_along", "\"interpolate\"", [](const S& s) { return s.fit.sections_along == "interpolate"; }},
      {"fit", "smoothing", "\"none\"", [](const S& s) { return s.fit.smoothing == "none"; }},
      {"fit", "smoothing_lambda_mm3", "0.25", [](const S& s) { return s.fit.smoothing_lambda_mm3 == 0.25; }},
      {"fit", "base", "\"nominal\"", [](const S& s) { return s.fit.base == "nominal"; }},
      {"fit", "mesh", "\"free\"", [](const S& s) { return s.fit.mesh == "free"; }},
      {"fit", "decimate_um", "2", [](const S& s) { return s.fit.decimate_um == 2.0; }},
      {"fit", "written_um", "3", [](const S& s) { return s.fit.written_um == 3.0; }},
      {"errors", "lateral_mm", "0.25", [](const S& s) { return s.errors.lateral_mm == 0.25; }},
      {"errors", "scanner_um", "12", [](const S& s) { return s.errors.scanner_um == 12.0; }},
      {"errors", "scanner_mm", "15.5", [](const S& s) { return s.errors.scanner_mm == 15.5; }},
      {"damage", "threshold_mm", "0.05", [](const S& s) { return s.damage.threshold_mm == 0.05; }},
      {"tiles", "use", "\"always\"", [](const S& s) { return s.tiles.use == "always"; }},
      {"tiles", "from_MB", "20.5", [](const S& s) { return s.tiles.from_MB == 20.5; }},
      {"tiles", "length_m", "16", [](const S& s) { return s.tiles.length_m == 16.0; }},
      {"tiles", "sample_points", "2e5", [](const S& s) { return s.tiles.sample_points == 2e5; }},
      {"map", "values", "\"heights\"", [](const S& s) { return s.map.values == "heights"; }},
      {"map", "across_mm", "0.8", [](const S& s) { return s.map.across_mm == 0.8; }},
      {"map", "along_mm", "2", [](const S& s) { return s.map.along_mm == 2.0; }},
      {"map", "height_unit", "\"in\"", [](const S& s) { return s.map.height_unit == "in"; }},
      {"map", "angles_deg", "true", [](const S& s) { return s.map.angles_deg; }},
  };
}

std::filesystem::path written(const std::string& text) {
  static const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "settings.toml";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

ImportSettings from_text(const std::string& text) {
  ImportSettings settings;
  read_import_settings(written(text), settings);
  return settings;
}

void expect_error(const std::string& text, int line, int column, const std::string& message,
                  const std::string& advice = {}) {
  SCOPED_TRACE(text);
  const auto file = written(text);
  ImportSettings settings;
  try {
    read_import_settings(file, settings);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_EQ(error.where().file, file.string());
    EXPECT_EQ(error.where().line, line);
    EXPECT_EQ(error.where().column, column);
    EXPECT_NE(error.message().find(message), std::string::npos) << error.message();
    EXPECT_NE(error.advice().find(advice), std::string::npos) << error.advice();
    const std::string place = file.string() + ':' + std::to_string(line) + ':' + std::to_string(column) + ": ";
    EXPECT_EQ(std::string(error.what()).rfind(place, 0), 0u) << error.what();
  }
}

void expect_refused(const std::string& assignment, const std::string& message, const std::string& advice = {}) {
  SCOPED_TRACE(assignment);
  ImportSettings settings;
  try {
    set_import_setting(settings, assignment);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_NE(error.message().find(message), std::string::npos) << error.message();
    EXPECT_NE(error.advice().find(advice), std::string::npos) << error.advice();
  }
  EXPECT_EQ(import_settings_toml(settings), import_settings_toml({})) << "nothing was set";
}

TEST(ImportSettings, TheListHasEveryKeyOnceWithAComment) {
  std::multiset<std::string> wanted, found;
  for (const Case& c : cases()) wanted.insert(c.key());
  std::istringstream in(import_settings_toml({}));
  std::string table;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '[') {
      table = line.substr(1, line.find(']') - 1);
      continue;
    }
    found.insert(table + '.' + line.substr(0, line.find(' ')));
    ASSERT_NE(line.find("  # "), std::string::npos) << line;
    EXPECT_GT(line.size(), line.find("  # ") + 8) << line;
  }
  EXPECT_EQ(found, wanted);
}

TEST(ImportSettings, DefaultsSurviveARoundTrip) {
  const ImportSettings defaults;
  for (const Case& c : cases()) EXPECT_FALSE(c.has(defaults)) << c.key();
  const ImportSettings read = from_text(import_settings_toml(defaults));
  EXPECT_EQ(import_settings_toml(read), import_settings_toml(defaults));
  for (const Case& c : cases()) EXPECT_FALSE(c.has(read)) << c.key();
  EXPECT_EQ(read.scan.unit, "auto");
  EXPECT_EQ(read.clean.farthest_mm, 8.0);
  EXPECT_EQ(read.fit.held_out, 0.02);
  EXPECT_TRUE(read.placement.up.empty());
}

TEST(ImportSettings, EveryKeyByFile) {
  for (const Case& c : cases()) {
    const ImportSettings settings = from_text("[" + c.table + "]\n" + c.name + " = " + c.value + "\n");
    for (const Case& other : cases())
      EXPECT_EQ(other.has(settings), other.key() == c.key()) << c.key() << " sets " << other.key();
  }
}

TEST(ImportSettings, EveryKeyByAssignment) {
  for (const Case& c : cases()) {
    ImportSettings settings;
    set_import_setting(settings, c.key() + '=' + c.value);
    for (const Case& other : cases())
      EXPECT_EQ(other.has(settings), other.key() == c.key()) << c.key() << " sets " << other.key();
  }
  // texts without quotes too
  ImportSettings settings;
  set_import_setting(settings, "scan.body=rail");
  set_import_setting(settings, "placement.nominal=a=b c.prr");
  EXPECT_EQ(settings.scan.body, "rail");
  EXPECT_EQ(settings.placement.nominal, "a=b c.prr");
}

TEST(ImportSettings, ChangedValuesSurviveARoundTrip) {
  ImportSettings settings;
  for (const Case& c : cases()) set_import_setting(settings, c.key() + '=' + c.value);
  settings.clean.stray_distance = 1.0 / 3.0;
  const ImportSettings read = from_text(import_settings_toml(settings));
  EXPECT_EQ(read.clean.stray_distance, 1.0 / 3.0);
  for (const Case& c : cases())
    if (c.name != "stray_distance") {
      EXPECT_TRUE(c.has(read)) << c.key();
    }
  EXPECT_EQ(import_settings_toml(read), import_settings_toml(settings));
}

TEST(ImportSettings, ZeroHasNoSign) {
  const ImportSettings read = from_text("[placement]\nup = [0, -0e-3, 1]\nzero_mm = -0.0\n");
  EXPECT_EQ(import_settings_toml(from_text(import_settings_toml(read))), import_settings_toml(read));
  EXPECT_FALSE(std::signbit(read.placement.up.at(1)));
}

TEST(ImportSettings, TextsOfAnyKindSurviveARoundTrip) {
  for (const std::string text :
       {"C:\\wheels\\new.prw", "it's \"it\"", "Räder/größe.prw", "tab\there", "# no comment"}) {
    ImportSettings settings;
    settings.placement.nominal = text;
    EXPECT_EQ(from_text(import_settings_toml(settings)).placement.nominal, text);
  }
}

TEST(ImportSettings, AFileChangesOnlyWhatItNames) {
  ImportSettings settings;
  settings.fit.held_out = 0.1;
  read_import_settings(written("# nothing but a comment\n[fit]\nfinest_mm = 2\n"), settings);
  EXPECT_EQ(settings.fit.held_out, 0.1);
  EXPECT_EQ(settings.fit.finest_mm, 2.0);
  const std::string before = import_settings_toml(settings);
  read_import_settings(written(""), settings);
  EXPECT_EQ(import_settings_toml(settings), before);
}

TEST(ImportSettings, UnknownKeysSuggest) {
  expect_error("[clean]\nhole_limt_mm = 3\n", 2, 16, "clean.hole_limt_mm", "clean.hole_limit_mm");
  expect_error("[fitt]\nfollow = true\n", 2, 10, "fitt.follow", "fit.follow");
  expect_error("[scan]\n\n  something_else = 1\n", 3, 20, "scan.something_else", "--list-settings");
  expect_error("unit = \"mm\"\n", 1, 8, "unit");
  expect_refused("scan.units=mm", "scan.units", "scan.unit");
  expect_refused("qqqq.wwwwww=1", "qqqq.wwwwww", "--list-settings");
}

TEST(ImportSettings, WrongTypesAndRangesAreRefusedAtTheirPlace) {
  expect_error("[fit]\nheld_out = 0.6\n", 2, 12, "between 0 and 0.5");
  expect_error("[fit]\nheld_out = -0.1\n", 2, 12, "between 0 and 0.5");
  expect_error("[clean]\noutlier_factor = -1\n", 2, 18, "at least 0");
  expect_error("[clean]\nfarthest_mm = \"8\"\n", 2, 15, "number");
  expect_error("[clean]\nfarthest_mm = nan\n", 2, 15, "number");
  expect_error("[clean]\nhole_limit_mm = inf\n", 2, 17, "number");
  expect_error("[clean]\nhole_limit_mm = true\n", 2, 17, "number");
  expect_error("[fit]\nfollow = 1\n", 2, 10, "true or false");
  expect_error("[scan]\nbody = \"sleeper\"\n", 2, 8, "sleeper", "auto, wheel, rail");
  expect_error("[scan]\nbody = 3\n", 2, 8, "text");
  expect_error("[placement]\nnominal = \"\"\n", 2, 11, "text");
  expect_error("[placement]\nup = [1.0, 2.0]\n", 2, 6, "three numbers");
  expect_error("[placement]\nup = 1.0\n", 2, 6, "three numbers");
  expect_error("[placement]\nup = [0, 0.0, 0]\n", 2, 6, "zero");
  expect_error("[placement]\nup = [1.0, \"x\", 2.0]\n", 2, 6, "number");
  for (const char* value : {"0.6", "abc", "", "[1]", "nan", "1 2"})
    expect_refused(std::string("fit.held_out=") + value, "fit.held_out");
  expect_refused("scan.body=sleeper", "sleeper", "auto, wheel, rail");
  expect_refused("scan.body=", "text");
  expect_refused("fit.follow=yes", "fit.follow");
  expect_refused("placement.up=[0,0,0]", "zero");
}

TEST(ImportSettings, LimitsThemselvesAreAllowed) {
  for (const char* assignment : {"fit.held_out=0", "fit.held_out=0.5", "clean.farthest_mm=0.01", "clean.farthest_mm=50",
                                 "fit.significance=20", "placement.zero_deg=-360", "placement.up=[]"}) {
    ImportSettings settings;
    EXPECT_NO_THROW(set_import_setting(settings, assignment)) << assignment;
  }
}

TEST(ImportSettings, BrokenAssignmentsAreRefused) {
  for (const char* assignment : {"", "=", "fit", "fit=1", "held_out=0.1", "x=a.b"})
    expect_refused(assignment, "no setting", "table.key=value");
  expect_refused(".=", "no setting");
  // one value a time
  expect_refused("fit.held_out=0.1\nother = 3", "fit.held_out");
}

TEST(ImportSettings, BrokenFilesAreRefusedAtTheirPlace) {
  for (const auto& [text, line] :
       std::vector<std::pair<std::string, int>>{{"[fit]\nheld_out = \n", 2},
                                                {"[fit\nfollow = true\n", 1},
                                                {"[fit]\nfollow = true\nfollow = false\n", 3},
                                                {"[fit]\n\nfollow true\n", 3}}) {
    SCOPED_TRACE(text);
    ImportSettings settings;
    const auto file = written(text);
    try {
      read_import_settings(file, settings);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::configuration);
      EXPECT_EQ(error.where().file, file.string());
      EXPECT_EQ(error.where().line, line);
      EXPECT_GT(error.where().column, 0);
    }
  }
  ImportSettings settings;
  EXPECT_THROW(read_import_settings("no_such_settings.toml", settings), Error);
}

TEST(ImportSettings, TheSchemaHasEveryKeyWithItsDefault) {
  const nlohmann::json schema = nlohmann::json::parse(import_settings_schema());
  EXPECT_EQ(schema.at("additionalProperties"), false);
  std::size_t count = 0;
  for (const auto& [name, table] : schema.at("properties").items()) {
    EXPECT_EQ(table.at("additionalProperties"), false) << name;
    count += table.at("properties").size();
  }
  EXPECT_EQ(count, cases().size());
  const ImportSettings defaults;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.key());
    const nlohmann::json& key = schema.at("properties").at(c.table).at("properties").at(c.name);
    ImportSettings settings;
    set_import_setting(settings, c.key() + '=' + key.at("default").dump());
    EXPECT_EQ(import_settings_toml(settings), import_settings_toml(defaults));
  }
  const nlohmann::json& fit = schema.at("properties").at("fit").at("properties");
  EXPECT_EQ(fit.at("held_out").at("maximum"), 0.5);
  EXPECT_EQ(fit.at("sections").at("enum"), nlohmann::json({"auto", "keep", "fit"}));
  EXPECT_EQ(schema.at("properties").at("placement").at("properties").at("up").at("maxItems"), 3);
}

TEST(ImportSettings, TableOfKeysIsUpToDate) {
  treadmark::testing::expect_in_document("scans.md", import_settings_table());
}

}  // namespace
}  // namespace treadmark::io
