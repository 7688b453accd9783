// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace treadmark::io {

/// Everything that can be set for `treadmark import`, as it stands in its TOML file: table.key. What each means, its
/// limits and what 0, "auto" and an empty list stand for is said once, with its key in import_settings.cpp, from which
/// the table in docs/scans.md comes.
struct ImportSettings {
  struct Scan {
    std::string body = "auto";
    std::string unit = "auto";
    std::vector<double> box_from, box_to, station;
    double nearest = 0.0, farthest = 0.0, least_intensity = 0.0;
    double register_mm = 0.0;
    bool pass_steps = true;
    std::string rails = "one";
  } scan;
  struct Placement {
    std::string nominal = "auto";
    double nominal_radius_mm = 0.0;
    std::vector<double> up, forward;
    std::string zero = "defect";
    std::vector<double> zero_direction;
    double zero_deg = 0.0, zero_mm = 0.0;
    std::string line = "auto";
    double line_beside_mm = 0.0;
  } placement;
  struct Clean {
    bool strays = true;
    double stray_distance = 0.0;
    double stray_cluster = 0.01;
    double farthest_mm = 8.0;
    double outlier_factor = 4.5;
    double edge_share = 0.2;
    bool mixed_points = true;
    double hole_limit_mm = 0.0;
    double least_filled = 0.6;
  } clean;
  struct Fit {
    double resolution_mm = 0.5;
    double finest_mm = 0.0;
    double significance = 1.0;
    bool follow = true;
    double held_out = 0.02;
    bool errors = true;
    bool weights = true;
    double tolerance_um = 0.0;
    std::string sections = "auto";
    std::string sections_along = "approximate";
    std::string smoothing = "auto";
    double smoothing_lambda_mm3 = 5.0;
    std::string base = "fitted";
    std::string mesh = "band";
    double decimate_um = 0.0;
    double written_um = 10.0;
  } fit;
  struct Errors {
    double lateral_mm = 0.0;
    double scanner_um = 0.0, scanner_mm = 0.0;
  } errors;
  struct Damage {
    double threshold_mm = 0.0;
  } damage;
  struct Tiles {
    std::string use = "auto";
    double from_MB = 1000.0;
    double length_m = 8.0;
    double sample_points = 8e6;
  } tiles;
  struct Map {
    std::string height_unit = "auto";
    bool angles_deg = false;
    std::string values = "deviations";
    double across_mm = 0.0, along_mm = 0.0;
  } map;
};

/// Reads a settings file (TOML) over the given settings. Errors: Error(configuration) with file:line:column: broken
/// TOML, unknown keys (with a suggestion), wrong types, values out of range.
void read_import_settings(const std::filesystem::path& file, ImportSettings& settings);

/// "table.key=value" (TOML value or bare word). Errors: Error(configuration).
void set_import_setting(ImportSettings& settings, const std::string& assignment);

/// All settings as a TOML file that reads back the same, with a comment for each.
std::string import_settings_toml(const ImportSettings& settings);

/// JSON Schema (draft 2020-12) of the settings file, and its keys as Markdown tables (docs/scans.md).
std::string import_settings_schema();
std::string import_settings_table();

}  // namespace treadmark::io
