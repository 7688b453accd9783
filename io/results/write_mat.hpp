// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/core/friction.hpp"
#include "treadmark/core/material.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// What the head of a `.mat` text file says beyond the patch itself. The digits are those of CONTACT's control words;
/// SI units.
struct MatFileHead {
  double time = 0.0;                                   ///< [s]
  double s_ws = 0.0, pitch_ws = 0.0;                   ///< wheelset along the track [m], pitch angle [rad]
  double rail_y = 0.0, rail_z = 0.0, rail_roll = 0.0;  ///< rail marker in track axes [m], [rad]
  double roller_radius = 0.0;                          ///< [m], 0 = track
  double wheel_x = 0.0, wheel_y = 0.0, wheel_z = 0.0;  ///< wheel marker in track axes [m]
  double wheel_roll = 0.0, wheel_yaw = 0.0;            ///< [rad]
  double wheel_radius = 0.0;                           ///< nominal [m]
  double spin_x = 0.0, spin_y = 0.0;                   ///< spin centre in the grid's axes [m]
  int configuration = 0, discretisation = 0;           ///< C1, D
  int tangential = 0, material_model = 0;              ///< T, M
  int friction_law = 0, heat = 0;                      ///< L, H
  int case_number = 1, patches = 1, patch = 1;         ///< number of the case, of its patches, and of this one
  Material material;
  double layer_shear_modulus = 0.0, layer_thickness = 0.0;  ///< M = 4: G3 [Pa], h3 [m]
  FrictionLaw friction;
  int format = 2510;  ///< version of the layout, as year and release: 25.10
};

/// A patch as the text file that the plotting tools of CONTACT load: six lines of head, each below a line of names that
/// begins with a percent sign, then a line an element, rows with growing s. All lines have as many columns as an
/// element, filled up with zeros; the last column of the first line is the format. Units mm, N/mm^2, mm/s, rad, s, deg
/// C; slip is relative (shift: mm). Numbers have 13 significant digits. all_elements: also those outside the contact,
/// NaN where a surface is missing. Thread-safe. Errors: Error(configuration) for fields that do not match their grid.
std::string patch_to_mat(const MatFileHead& head, const PatchResult& patch, bool all_elements);

/// Writes the text to a file that appears only when complete. Errors: as above, and when the file cannot be written.
void write_mat(const std::filesystem::path& path, const MatFileHead& head, const PatchResult& patch, bool all_elements);

/// "<stem>.0001a.mat" for case 1, patch 1 (a), extension "mat"; patch 0: no letter (a basic case).
/// Errors: Error(configuration) for a patch that has no letter.
std::string case_file_name(const std::string& stem, int case_number, int patch, const std::string& extension);

}  // namespace treadmark::io
