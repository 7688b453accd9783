// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/analysis/geometry/analysis.hpp"
#include "treadmark/analysis/geometry/loaded_wheelset.hpp"
#include "treadmark/app/lists/result_list.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/settings/given_settings.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::app {

/// A wheelset on a track as commands and lists of pairs name it.
struct GeometryRequest {
  std::string label;                                ///< of a row in a list; may be empty
  std::string case_file;                            ///< empty: the profiles below
  std::string wheel, wheel_left, rail, rail_left;   ///< files or names of profiles; left ones empty: as the right ones
  std::string new_wheel, new_rail;                  ///< of both sides, for the effect of wear; empty: as they are
  std::optional<double> diameter, diameter_left;    ///< at the tape lines [m]
  std::optional<double> cant, gauge, gauge_height;  ///< [rad], [m]
  std::optional<double> rail_origins, wheel_origins;  ///< distances [m]
  double pitch = 0.0;                                 ///< of the wheels, for those that are not round [rad]
  double x = 0.0;                                     ///< along rails that vary [m]
  double scale_to_mm = 1.0;                           ///< of profile and triangle files
  std::string backend;                                ///< of all surfaces; empty: as given
  double resolution = 0.0;                            ///< [m]; 0: the backend's
  std::vector<std::string> overrides;                 ///< of the case
  std::optional<double> axle_load;                    ///< what both wheels carry [N]; none: geometry alone
  std::vector<double> gauges;                         ///< at which the conicity is wanted too [m]
  int draw = 0;                                       ///< of the errors that a surface may have; 0: none
  geometry::AnalysisSettings settings;
};

/// The settings of `treadmark geometry`. Immutable.
const io::KeyTable<GeometryRequest>& geometry_keys();
/// Marks of keys: a list of pairs may have a column of it, of files at that; results repeat it.
inline constexpr unsigned kOfPair = io::kFirstFactor, kFileOfPair = 3 * io::kFirstFactor,
                          kEchoed = 4 * io::kFirstFactor;
/// What was asked for. Errors: Error(configuration) for what are no keys and no values of them.
GeometryRequest geometry_request(const io::GivenSettings& given);

inline constexpr double kUsualDiameter = 0.92;  ///< where none is given [m]

/// Standard deviations of what noise of measured profiles, or the import of scans, leaves uncertain.
struct ConicityNoise {
  std::vector<double> of_amplitude;  ///< of the conicity at the amplitudes asked for
  double single = 0.0, at_3mm = 0.0;
};

/// Sections that have been read, so that lists of pairs read each file once. Thread-safe.
class SectionStore {
 public:
  /// That of the wheel or rail of a name, at the cant [rad]. Errors: those of readers and backends; Error(input_data)
  /// for a wheel given as a rail or the reverse.
  std::shared_ptr<const geometry::Section> get(const GeometryRequest& request, const std::string& name, Body body,
                                               double cant);
  /// How many draws there are of the errors of a wheel or rail, which was asked for before: where noise was smoothed
  /// away from its profile, or its import knows them; else 0.
  std::size_t draws_of(const std::string& name, Body body);
  /// What reading a wheel or rail changed in it, which was asked for before; empty: nothing.
  std::string note_of(const std::string& name);

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> notes_;
  using Named = std::pair<std::string, Body>;                     ///< a case names both bodies
  std::map<Named, std::size_t> draws_;                            ///< of which there are any
  std::map<Named, std::shared_ptr<const NaturalSurface>> noisy_;  ///< what they are of; scans are large: some of them
  std::map<std::string, std::shared_ptr<const geometry::Section>> sections_;
};

/// Conicity at several gauges.
struct GaugeSweep {
  std::vector<double> gauges;                             ///< [m]
  std::vector<std::vector<geometry::Conicity>> conicity;  ///< of each gauge at the amplitudes asked for
  std::vector<geometry::Conicity> at_3mm;                 ///< of each gauge
  std::vector<std::string> trouble;                       ///< of each gauge; empty: none
};

/// A wheelset on its track with the answers.
struct GeometryResult {
  GeometryRequest request;
  geometry::SideBodies right, left;
  geometry::PairPlacement placement;
  Material material;  ///< of the case, else the one that cases have by default
  geometry::Analysis analysis;
  std::optional<geometry::Analysis> with_new;     ///< the same with new profiles, where they were named
  std::optional<geometry::LoadedFunctions> load;  ///< where a load was given
  std::optional<ConicityNoise> noise;             ///< where errors of a surface are known
  std::optional<GaugeSweep> sweep;                ///< where gauges were asked for
  std::vector<std::string> notes;
};

/// Where wheels and rails of a case are.
geometry::PairPlacement placement_of(const io::WheelRailCase& input);

/// Reads what is named. Errors: those of SectionStore and of cases; Error(configuration) for what is missing or does
/// not go together; Error(input_data) for a wheel without its tape line.
GeometryResult read_geometry(const GeometryRequest& request, SectionStore& store);
/// The same with the answers; errors also those of geometry::analyse and geometry::loaded. Parallel over the gauges;
/// the result does not depend on the number of threads.
GeometryResult run_geometry(const GeometryRequest& request, SectionStore& store);

/// Reads a list of pairs: text with commas, whose first line names the columns: name, and keys that are marked kOfPair.
/// An empty cell is as in `usual`; files count from the folder of the list. Errors with the line: Error(input_data) for
/// what cannot be understood, Error(configuration) for values that make no sense.
std::vector<GeometryRequest> read_pair_list(const std::string& file, const GeometryRequest& usual);

/// All pairs; one that fails says why in its row. Finished rows are kept in a file while that goes on (make_rows).
ResultList run_pairs(const std::vector<GeometryRequest>& requests, const std::filesystem::path& kept = {},
                     const Progress& progress = {});

/// "1:40", "0.025" (as tangent), "0"; [rad]. Errors: Error(configuration).
double parse_cant(const std::string& text);
/// "3", "1,2,3", "1:7.5:0.1" (from, to, step). Errors: Error(configuration).
std::vector<double> parse_numbers(const std::string& text);

/// What is doubtful about profiles that are files. Thread-safe.
std::vector<std::string> profile_doubts(const GeometryRequest& request);

// What is written. All of them thread-safe.
std::string geometry_text(const GeometryResult& result);  ///< for a terminal
std::string geometry_json(const GeometryResult& result);
std::string geometry_schema();  ///< JSON Schema of that
std::string functions_csv(const GeometryResult& result);
std::string conicity_csv(const GeometryResult& result);
std::string sweep_csv(const GaugeSweep& sweep);
std::string geometry_charts_svg(const GeometryResult& result);  ///< differences of radii, conicity, places, angles
std::string contact_points_svg(const GeometryResult& result);   ///< both sections with lines between points in contact
std::string gauge_sweep_svg(const GaugeSweep& sweep);

/// All of it into a folder: tables, pictures and, last, geometry.json. Errors: those of core/output_file.hpp.
void write_geometry_folder(const std::filesystem::path& folder, const GeometryResult& result);

/// A row of the contact functions.
struct FunctionRow {
  const geometry::Position& position;
  const geometry::WheelsetOnTrack& wheelset;
};

/// The conicity at an amplitude, with what else is known there.
struct ConicityRow {
  const geometry::Conicity& conicity;
  const geometry::Analysis& analysis;  ///< that it belongs to
  std::optional<double> noise = {}, harmonic = {}, with_new = {};
};
/// beside: the result with all of that; nullptr: the conicity alone.
std::vector<ConicityRow> conicity_rows(const geometry::Analysis& analysis, const GeometryResult* beside);

}  // namespace treadmark::app

namespace treadmark {

/// What is one number of a result.
template <>
std::span<const Column<app::GeometryResult>> columns();
template <>
std::span<const Column<app::FunctionRow>> columns();
template <>
std::span<const Column<app::ConicityRow>> columns();
template <>
std::span<const Column<geometry::Jump>> columns();
template <>
std::span<const Column<geometry::FurtherTouch>> columns();
template <>
std::span<const Column<geometry::ShiftLimit>> columns();
/// Of the contact functions that only a load makes, and why a side has no ellipse.
template <>
std::span<const Column<geometry::LoadedPosition>> columns();
template <>
std::span<const Column<geometry::LoadedSide>> columns();
/// What is one number of a loaded wheelset.
template <>
std::span<const Column<geometry::LoadedFunctions>> columns();

}  // namespace treadmark
