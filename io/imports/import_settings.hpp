// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace treadmark::io {

/// Everything that can be set for `treadmark import`, as it stands in its TOML file: table.key; docs/scans.md has the
/// list.
struct ImportSettings {
  struct {
    std::string body = "auto";  ///< wheel, rail; auto: by the extension of the surface file
    std::string unit = "auto";  ///< m, mm, um, in; auto: the file's word or the size of the wheel or rail
    bool pass_steps = true;     ///< align the passes of the scanner to each other
  } scan;
  struct {
    std::string nominal = "auto";          ///< standard profile, profile file, none; auto: S1002 or 60E1
    double nominal_radius_mm = 0.0;        ///< 0 = from the scan
    std::vector<double> up, forward;       ///< directions in the scan's frame; empty = found
    std::string zero = "defect";           ///< what is at u = 0: defect, scan, direction
    std::vector<double> zero_direction;    ///< for direction: in the scan's frame
    double zero_deg = 0.0, zero_mm = 0.0;  ///< u that it gets: wheel, rail
  } placement;
  struct {
    bool strays = true;  ///< outliers and small clusters among thinned points (CGAL)
    double stray_distance =
        0.0;  ///< mean distance to neighbours, over the size to which points are thinned; 0 = 4 times the usual one
    double stray_cluster = 0.01;  ///< part of the largest cluster below which others are stray
    double farthest_mm = 8.0;     ///< from the section
    double outlier_factor = 4.5;  ///< standard deviations; 0 = keep all
    double edge_share = 0.2;      ///< where more of the surroundings would be outliers they stay
    double hole_limit_mm = 0.0;   ///< holes up to this diameter are filled; 0 = from the data
    double least_filled = 0.6;    ///< part of the length that must be covered for a lateral position to count
  } clean;
  struct {
    double resolution_mm = 0.5;  ///< of the surface's points
    double finest_mm = 0.0;      ///< smallest distance of knots; 0 = from the data
    double significance = 1.0;   ///< > 1 smooths more
    bool follow = true;          ///< lower the significance while points held out are met better
    double held_out = 0.02;      ///< part of the points that judge the fit
    double tolerance_um =
        0.0;  ///< changes along the band below this need no slice of their own; 0 = by the noise, at most 0.5
    std::string sections =
        "auto";  ///< points in cross-sections: keep (they become the slices), fit; auto: keep those that were resampled
    std::string sections_along = "approximate";  ///< kept sections: approximate or interpolate
    double smoothing_lambda_mm3 = 5.0;           ///< of kept sections before triangles or offsets are made of them
    std::string base = "fitted";                 ///< of offsets: fitted or nominal section
    std::string mesh = "band";  ///< band: Delaunay over the band; free: advancing front through the points
    double decimate_um = 0.0;   ///< leave out nodes of triangles that are not needed to this tolerance; 0 = keep all
  } fit;
  struct {
    double threshold_mm = 0.0;  ///< depth from which damage is listed; 0 = from the noise
  } damage;
  struct {
    std::string height_unit = "auto";  ///< of the deviations; auto: as scan.unit
    bool angles_deg = false;           ///< positions round the wheel are degrees
  } map;
};

/// Reads a settings file (TOML) over the given settings. Errors: Error(configuration) with file:line:column: broken
/// TOML, unknown keys (with a suggestion), wrong types, values out of range.
void read_import_settings(const std::filesystem::path& file, ImportSettings& settings);

/// "table.key=value" (TOML value or bare word). Errors: Error(configuration).
void set_import_setting(ImportSettings& settings, const std::string& assignment);

/// All settings as a TOML file that reads back the same, with a comment for each.
std::string import_settings_toml(const ImportSettings& settings);

}  // namespace treadmark::io
