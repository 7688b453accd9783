// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/rows.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/surface_errors.hpp"

namespace treadmark::io {

/// Values over the unrolled running band, row after row of equal a; NaN = nothing there.
struct BandMap {
  std::size_t rows = 0, columns = 0;  ///< along a (track or circumference), across s (along the section)
  double a_min = 0.0,
         a_max = 0.0;  ///< [m] u times the nominal radius of a wheel, x of a rail; ends of the first and last row
  double s_min = 0.0, s_max = 0.0;  ///< [m]
  std::vector<float> value;         ///< SI; index = row * columns + column
};

/// A curve or a heap of points in a section's plane: (y, z) in profile coordinates [m].
using SectionPoints = std::vector<Vec2>;

/// What was done to a scan, from the file to the surface, for reports. SI.
struct ImportReport {
  struct Input {
    std::string file, sha256, format;  ///< file name without folders
    std::size_t points = 0, not_finite = 0;
  };
  struct Removed {
    std::string reason;  ///< in words: "stray clusters"
    std::size_t count = 0;
    std::string why;  ///< the rule and its numbers: "farther than 4.5 standard deviations (0.14 mm) from a quadratic
                      ///< through ..."
  };
  struct Pass {
    int pass = 0;
    std::size_t points = 0;
    Vec3 shift_S = Vec3::Zero(), turn_S = Vec3::Zero();  ///< correction that was applied [m], [rad]
  };
  struct Hole {
    double u = 0.0, y = 0.0, diameter = 0.0, area = 0.0;
    bool filled = false;
    double s =
        std::numeric_limits<double>::quiet_NaN();  ///< along the section as in the maps [m]; NaN: only y is known
  };
  struct Damage {
    double u = 0.0, y = 0.0, length = 0.0, width = 0.0, depth = 0.0, volume = 0.0;
    double s = std::numeric_limits<double>::quiet_NaN();  ///< of the middle, as of a hole
  };
  struct Level {
    double knot_a = 0.0, knot_s = 0.0;
    std::size_t functions = 0, used = 0;
    int iterations = 0;
  };
  struct Output {
    std::string file, kind, sha256;  ///< file name without folders; "slices", "triangles", "offsets"
    std::size_t bytes = 0;
    std::string details;                        ///< "412 slices of 301 points"
    double height_max = 0.0, height_rms = 0.0;  ///< distance of the written surface, read back, from the fitted one [m]
  };
  /// What else than the scatter of its points leaves the surface uncertain: standard deviations of how it may lie in
  /// its own axes, and of heights, the largest, of which places so far apart are off by themselves.
  struct ErrorPart {
    std::string source;                                ///< name_of(ErrorSource)
    double lateral = 0.0, vertical = 0.0, roll = 0.0;  ///< [m], [rad]
    double heights = 0.0, length = 0.0;                ///< [m]
  };
  struct Step {
    std::string name;
    double seconds = 0.0;
  };
  /// Of signed distances, > 0 out of the material [m].
  struct Distances {
    double mean = 0.0, rms = 0.0, largest = 0.0;  ///< largest without sign
    double within_95 = 0.0, within_99 = 0.0;      ///< 95 % and 99 % of them are no farther than this from 0
  };
  /// Points for a look at the cloud, in the surface's frame: those that the fit saw or was judged by, then removed
  /// ones.
  struct CloudSample {
    std::vector<float> x, y, z;        ///< [m]
    std::vector<float> residual;       ///< measured less fitted, along the section's normal [m]; NaN: removed
    std::vector<float> distance;       ///< from the section along its normal, > 0 out of the material [m]; NaN: removed
    std::vector<float> tilt;           ///< of that normal from straight out (-z, or the radius) towards +y [rad]
    std::size_t all = 0, removed = 0;  ///< points of both kinds that these stand for
    std::size_t far = 0;               ///< removed ones too far from all others to be among these
  };
  /// Where the x axis of a rail's surface lies in the cloud at a place along it, and how it bends there.
  struct LinePlace {
    double x = 0.0;                                 ///< along the rail [m]
    Vec3 place = Vec3::Zero();                      ///< in the cloud [m]
    double curvature = 0.0, curvature_error = 0.0;  ///< to the right, with its standard error [1/m]
    double vertical = 0.0, vertical_error = 0.0;    ///< curvature down [1/m]
    double twist = 0.0, twist_error = 0.0;          ///< how the section turns about x [rad/m]
    double roll =
        0.0;  ///< of the section, right side low: from level if `up` was given, else from the first place [rad]
    double gradient = std::numeric_limits<double>::quiet_NaN();  ///< up, if `up` was given [rad]
  };
  /// The line of a rail.
  struct Line {
    bool bent = false;       ///< the surface is straightened along it; else it is straight by what the points tell
    double deviation = 0.0;  ///< farthest that it lies off a straight line [m]
    double given_largest = std::numeric_limits<double>::quiet_NaN(),
           given_rms = std::numeric_limits<double>::quiet_NaN();  ///< that it lies off the line that was given [m]
    std::vector<LinePlace> places;                                ///< by x
  };
  /// Across a track, at a place along its right rail.
  struct TrackPlace {
    double x = 0.0;                                           ///< along the right rail's surface [m]
    Vec3 place = Vec3::Zero();                                ///< between the tops of the heads, in the cloud [m]
    double gauge = std::numeric_limits<double>::quiet_NaN();  ///< 0 to 14 mm below them [m]
    double cant = std::numeric_limits<double>::quiet_NaN();   ///< left rail above the right one, if `up` was given [m]
  };
  /// The track of which this is the right rail.
  struct Track {
    double gauge_least = std::numeric_limits<double>::quiet_NaN(),
           gauge_greatest = std::numeric_limits<double>::quiet_NaN(),
           gauge_mean = std::numeric_limits<double>::quiet_NaN();  ///< of the places [m]
    std::vector<TrackPlace> places;                                ///< by x
    std::shared_ptr<const ImportReport> left;                      ///< the same report of the left rail
  };
  /// Points that scatter otherwise than usual: of a pass, at an angle to the beam, with an intensity.
  struct NoiseClass {
    std::string name;  ///< in words: "pass 2"
    std::size_t points = 0;
    double factor = 1.0;  ///< of their standard deviation over the usual one at their place
  };
  /// A scan that was laid on others before all else.
  struct Registration {
    int pass = 0;
    std::size_t points = 0;
    double overlap = 0.0;                            ///< part of its surface that others have seen, too
    double apart = 0.0;                              ///< from them where they overlap: standard deviation [m]
    Vec3 shift = Vec3::Zero(), turn = Vec3::Zero();  ///< that it was moved by, about its middle [m], [rad]
    double shift_error = 0.0, turn_error = 0.0;      ///< standard errors, of what the overlap determines [m], [rad]
    std::size_t open = 0;                            ///< directions of six that it does not determine
  };
  /// The surface against what it should be.
  struct Truth {
    std::string file;        ///< as it was named, without folders; what `treadmark scan` wrote, or a surface
    std::string surface;     ///< file of the surface
    bool from_scan = false;  ///< the truth knows where the surface lies in the cloud
    std::size_t places = 0, beside = 0;  ///< compared at so many, the truth has no surface at so many more
    Distances placed;                    ///< of the surface from the truth, frame on frame
    Distances shape;                     ///< the same after the rigid motion below
    double along = 0.0;                  ///< station of the truth at u = 0: [rad] wheel, [m] rail; a choice, no error
    bool reversed = false;               ///< a rail's x runs against the truth's
    Vec3 shift_S = Vec3::Zero(), turn_S = Vec3::Zero();  ///< lays the surface on the truth best [m], [rad]
  };

  std::string version;
  Body body = Body::rail;
  bool from_map = false;  ///< a gridded map of deviations: no placement, no points
  std::vector<Input> inputs;
  std::string unit, unit_from;  ///< "mm"; "given", "the file", "the size of the wheel"
  std::size_t points_read = 0, points_used = 0;
  std::vector<Removed> removed;  ///< in the order of the steps
  std::vector<std::string> warnings;

  // placement
  std::string nominal;                                           ///< name of the nominal profile or "none"
  Pose X_CS;                                                     ///< surface frame in the cloud's [m]
  double nominal_radius = 0.0, radius_error = 0.0;               ///< of a wheel, with its standard error [m]
  double axis_position_error = 0.0, axis_direction_error = 0.0;  ///< standard errors [m], [rad]
  double scatter = 0.0, undamaged = 0.0;  ///< of the points about the section [m]; part of them that fixed the axis
  double match_residual = 0.0, match_agreeing = 0.0;  ///< of the section with the nominal profile [m]; part of it
  bool turned = false;                                ///< the section ran the other way than the nominal one
  std::string zero;                                   ///< what is at u = 0, in words
  std::optional<Line> line;                           ///< of a rail; older files have none
  std::vector<Pass> passes;
  double pass_before = 0.0, pass_after = 0.0;  ///< rms distance of passes where they overlap [m]

  std::optional<Track> track;  ///< only of the right rail of two
  std::vector<Registration> registrations;

  // points
  double spacing = 0.0, gap_a = 0.0, gap_s = 0.0;  ///< mean distance of points; usual distances along and across [m]
  double noise = 0.0;                              ///< standard deviation of the points [m]
  std::vector<NoiseClass> noise_classes;           ///< where it differs enough to count
  double area = 0.0, hole_area = 0.0, hole_limit = 0.0;
  std::vector<Hole> holes;  ///< largest first
  // points in cross-sections that became slices; the fit below then serves pictures, damage and zero alone
  struct Sections {
    std::size_t count = 0, fewest_points = 0, most_points = 0;
    double least_gap = 0.0, widest_gap = 0.0, spread = 0.0;  ///< between them; of their points along the band [m]
    double smoothing = 0.0;          ///< lambda, of triangles and offsets made of sections not smoothed by noise [m^3]
    std::optional<double> smoothed;  ///< by noise: root mean square of what points were moved by [m]
  };
  std::optional<Sections> sections;
  // fit
  std::vector<Level> levels;
  std::size_t fitted_points = 0, held_out_points = 0;
  double residual_rms = 0.0, residual_max = 0.0, held_out_rms = 0.0, held_out_error = 0.0;
  std::optional<ErrorSize> errors;  ///< of the surface, by fits of halves of the points or by the noise of sections
  std::vector<ErrorPart> error_parts;
  std::vector<Damage> damage;  ///< largest first
  double damage_threshold = 0.0;
  double y_min = 0.0, y_max = 0.0, u_min = 0.0, u_max = 0.0;
  bool closed = false;  ///< a whole wheel
  std::optional<Truth> truth;
  std::vector<Output> outputs;
  std::vector<Step> steps;    ///< not part of what is the same each time
  std::string settings_toml;  ///< all settings as they were used

  // pictures
  SectionPoints raw_section;      ///< some thousand of all points read, seen along the axis: (y, z), wheel: z = r - R
  SectionPoints removed_section;  ///< some thousand of those removed
  SectionPoints section,
      nominal_section;  ///< curves; the section from s_min to s_max of the maps, both in the direction of s
  BandMap density;      ///< points per m^2 before cleaning, those on the band
  BandMap removed_map;  ///< removed points per m^2, those on the band
  BandMap fitted;  ///< distance of the fitted surface from the section [m], > 0 out of the material; NaN in open holes
  BandMap residual;                             ///< mean of measured less fitted [m]
  BandMap noise_map;                            ///< standard deviation [m]
  BandMap error_map;                            ///< standard deviation of the surface [m]
  BandMap truth_map;                            ///< the surface less the truth after the rigid motion [m]
  std::vector<std::size_t> residual_histogram;  ///< counts in equal bins from -residual_range to +residual_range
  double residual_range = 0.0;                  ///< [m]
  /// Of all points used, held out or not, and how many of them lie outside the histogram.
  struct Residuals {
    Distances distances;
    std::size_t below = 0, above = 0;
  };
  std::optional<Residuals> residuals;  ///< older files have none
  CloudSample cloud;
};

/// What was removed, one entry a reason: counts of reasons that come twice are added.
std::vector<ImportReport::Removed> removed_by_reason(const ImportReport& report);

/// The whole audit but steps (whose times differ) as JSON text; all lengths in mm or um as the names say.
std::string import_json(const ImportReport& report, bool with_seconds);
/// JSON Schema of it.
std::string import_report_schema();
/// {"steps": [{"step", "seconds"}]}.
std::string import_times_json(const ImportReport& report);
/// What these texts say of a report, from files. Errors: Error(input_data) for files that are missing, broken or lack
/// keys.
ImportReport read_import_json(const std::filesystem::path& file);
void read_import_times(const std::filesystem::path& file, ImportReport& report);
/// A page of text for people: what was read, removed, placed, fitted, written; warnings first.
std::string import_summary(const ImportReport& report);

/// The report in the folder of an import: report.json and, where they are there, times.json and maps.h5; pictures and
/// sections are empty. Errors: as read_import_json; for broken files. Not to be called from two threads at once (HDF5).
ImportReport read_import_report(const std::filesystem::path& folder);

}  // namespace treadmark::io

namespace treadmark {

// Of holes and damage what does not depend on the body, which has angles or lengths along it.
template <>
std::span<const Column<io::ImportReport::Input>> columns();
template <>
std::span<const Column<io::ImportReport::Pass>> columns();
template <>
std::span<const Column<io::ImportReport::Hole>> columns();
template <>
std::span<const Column<io::ImportReport::Damage>> columns();
template <>
std::span<const Column<io::ImportReport::Level>> columns();
template <>
std::span<const Column<io::ImportReport::Output>> columns();
template <>
std::span<const Column<io::ImportReport::Step>> columns();
template <>
std::span<const Column<io::ImportReport::Distances>> columns();
template <>
std::span<const Column<io::ImportReport::Sections>> columns();
template <>
std::span<const Column<io::ImportReport::Line>> columns();
template <>
std::span<const Column<io::ImportReport::LinePlace>> columns();
template <>
std::span<const Column<io::ImportReport::Track>> columns();
template <>
std::span<const Column<io::ImportReport::TrackPlace>> columns();
template <>
std::span<const Column<io::ImportReport::NoiseClass>> columns();
template <>
std::span<const Column<io::ImportReport::Registration>> columns();
template <>
std::span<const Column<ErrorSize>> columns();
template <>
std::span<const Column<io::ImportReport::ErrorPart>> columns();

}  // namespace treadmark
