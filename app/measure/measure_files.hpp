// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/app/lists/result_list.hpp"
#include "treadmark/app/measure/limits.hpp"
#include "treadmark/app/measure/numbers.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/settings/given_settings.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::app {

/// What is measured, and how.
struct MeasureRequest {
  Body body = Body::wheel;
  std::string nominal;                               ///< name of the profile library or a profile file; empty: none
  double nominal_radius = 0.0;                       ///< of wheels [m]; 0: what the file says
  double scale_to_mm = 1.0;                          ///< of profile and triangle files
  std::optional<measures::RailAlignment> alignment;  ///< nothing: by the unworn parts for profiles, else as it lies
  bool as_in_file = false;                           ///< y = 0 of a wheel's file is the tape line
  bool mirror_y = false;                             ///< negate y of a profile's file
  double line = 0.0;                                 ///< y of the line along a rail that roughness is taken from [m]
  double line_step = 1e-3;                           ///< [m]
  int stations = 36;                                 ///< sections along or round a surface
  Limits limits;
  std::vector<std::string> overrides;  ///< of a case
  std::string mate;  ///< profile of the other wheel of the axle, in the same axes (y from the middle); empty: none
};

/// The settings of `treadmark measure`. Immutable.
const io::KeyTable<MeasureRequest>& measure_keys();
/// What was asked for. Errors: Error(configuration) for what are no keys and no values of them, and for what belongs to
/// the other body; those of read_limits.
MeasureRequest measure_request(Body body, const io::GivenSettings& given);

/// One section of a rail or wheel that has several.
template <class Numbers>
struct MeasuredStation {
  double u = 0.0;  ///< x of a rail [m], theta of a wheel [rad]
  Numbers numbers;
};

/// What was measured of one file.
struct MeasuredFile {
  std::string file;
  std::string kind;   ///< "profile", "library profile", "surface", "scan"
  std::string error;  ///< why nothing was measured; empty: it was
  std::vector<std::string> notes;
  bool doubtful = false;                                  ///< among the notes are doubts about what the points mean
  std::vector<std::pair<std::string, std::string>> said;  ///< by the file itself
  double noise = measures::kUnknown;                      ///< of its points [m]
  std::variant<WheelNumbers, RailNumbers> numbers;
  std::vector<MeasuredStation<WheelNumbers>> round;  ///< sections, where there are several
  std::vector<MeasuredStation<RailNumbers>> along;
  std::optional<measures::RoundMeasures> revolution;                  ///< at the tape line
  std::vector<std::pair<double, measures::Measure>> further_runouts;  ///< y from the tape line [m], run-out
  std::optional<measures::RoughnessMeasures> roughness;
  std::vector<LimitResult> limits;

  // for pictures
  std::vector<Vec2> section, nominal;      ///< points laid upon each other (y, z) [m]; of several sections a middle one
  std::vector<double> theta, tape_radius;  ///< of the revolution at the tape line [rad], [m]

  /// The worst of the limits; Verdict::no_limits where there are none.
  Verdict verdict() const;
  /// Of the worst limit: how far out, else how near, over the width of what is allowed; NaN: there are no limits.
  double badness() const;
};

/// Files that are named, those in folders that are named (which have a known extension), and those that lists ("@FILE",
/// a name a line, relative to the list) name; in order. Errors: Error(input_data) for what does not exist.
std::vector<std::string> measured_names(const std::vector<std::string>& given, Body body);

/// Measures one: a profile of any kind, slices, triangles, offsets, a case, a scan, or a name of the profile library.
/// Errors: those of the readers and of measures; Error(configuration) for a nominal profile that does not exist.
MeasuredFile measure_file(const std::string& name, const MeasureRequest& request);

/// Measures many, in the order of the names; what fails has its error and does not stop the rest. Finished rows are
/// kept in a file while that goes on (make_rows). Each row's document is an entry of "files" in the JSON file.
ResultList measure_files(const std::vector<std::string>& names, const MeasureRequest& request,
                         const std::filesystem::path& kept = {}, const Progress& progress = {});

/// A list of one.
ResultList list_of(const MeasuredFile& file, const MeasureRequest& request);

// Documents by this JSON Schema.
std::string measure_schema();
std::string measure_json(const MeasuredFile& file, const MeasureRequest& request);
std::string measure_json(const ResultList& files, const MeasureRequest& request);
std::string file_document(const MeasuredFile& file);                                ///< an entry of "files"
std::string measure_text(const MeasuredFile& file, const MeasureRequest& request);  ///< for a terminal
report::Page measure_page(const MeasuredFile& file, const MeasureRequest& request);

}  // namespace treadmark::app
