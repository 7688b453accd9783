// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/import/import_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/app/import/fill_report.hpp"
#include "treadmark/app/import/find_place.hpp"
#include "treadmark/app/import/import_steps.hpp"
#include "treadmark/app/import/import_tiles.hpp"
#include "treadmark/app/import/prepare_clouds.hpp"
#include "treadmark/app/import/read_map.hpp"
#include "treadmark/app/import/track_geometry.hpp"
#include "treadmark/app/import/truth.hpp"
#include "treadmark/app/import/write_outputs.hpp"
#include "treadmark/app/surfaces/written_surface.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/model/shape/arc_at.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/scans/cleaning/thin.hpp"
#include "treadmark/scans/fit/error_sources.hpp"
#include "treadmark/scans/fit/half_fits.hpp"
#include "treadmark/scans/fit/section_levels.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::app {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// The axis of the scan that lies across an axle: of a wheel all round the one most nearly so, and of two about equal
/// ones the first; of a part of a wheel the one, either way, that is nearest to its middle.
Vec3 scan_axis_across(const Pose& X_CS, const std::optional<double>& middle, std::string& name) {
  Vec3 best = Vec3::Zero();
  double least = 1e300;
  constexpr double kAlike = 0.05;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const double way : {1.0, -1.0}) {
      if (!middle && way < 0.0) continue;
      const Vec3 in_S = X_CS.rotation.transpose() * (way * Vec3::Unit(axis));
      double off = std::fabs(in_S.y());
      if (middle) off = std::acos(std::clamp(in_S.dot(Vec3(std::sin(*middle), 0.0, std::cos(*middle))), -1.0, 1.0));
      if (off > least - kAlike) continue;
      least = off;
      best = way * Vec3::Unit(axis);
      name = fmt::format("{}{}", way < 0.0 ? "-" : "", "xyz"[axis]);
    }
  return best;
}

}  // namespace

double zero_of(const PlacedScan& scan, const scans::Band& band, const std::vector<scans::Damage>& damage,
               const io::ImportSettings& settings, io::ImportReport& report) {
  const bool wheel = scan.body == Body::wheel, part = wheel && !band.closed;
  const double wanted = wheel ? kDegree * settings.placement.zero_deg : 1e-3 * settings.placement.zero_mm;
  const std::string at = wheel ? fmt::format("theta = {:g} degrees", settings.placement.zero_deg)
                               : fmt::format("x = {:g} mm", settings.placement.zero_mm);
  std::string zero = settings.placement.zero;
  const double middle = 0.5 * (band.a_min + band.a_max) / band.radius;
  // files hold angles from -180 to 180 degrees: the part as a whole, if it may be anywhere
  const auto fits = [&](double u_zero) {
    return std::fabs(wrap_angle(middle - u_zero)) + 0.5 * band.length() / band.radius <= std::numbers::pi;
  };
  if (zero == "defect" && !damage.empty()) {
    const double u_zero = (band.a_min + damage.front().a) / band.radius - wanted;
    if (!part || fits(u_zero)) {
      report.zero = fmt::format("the middle of the largest defect is at {}", at);
      return u_zero;
    }
  }
  if (zero == "defect" && part) {
    report.zero = fmt::format("the middle of the scanned part is at {}", at);
    return middle - wanted;
  }
  if (zero == "defect") {
    report.warnings.push_back("no damage stands out; positions along the " + std::string(wheel ? "wheel" : "rail") +
                              " are counted from the axes of the scan");
    zero = "scan";
  }
  const Pose& X_CS = scan.placement.X_CS;
  if (!wheel) {
    if (zero == "direction")
      throw Error(ErrorKind::configuration, "a rail has no angular zero", {}, "say placement.zero=scan or defect");
    report.zero = fmt::format("the place nearest the origin of the scan is at {}", at);
    return X_CS.apply_inverse(straightened(scan, Vec3::Zero())).x() - wanted;
  }
  Vec3 direction;
  if (zero == "direction") {
    const auto& list = settings.placement.zero_direction;
    if (list.size() != 3)
      throw Error(ErrorKind::configuration, "placement.zero=direction needs placement.zero_direction", {},
                  "give a list of three numbers in the scan's frame");
    direction = {list[0], list[1], list[2]};
    report.zero = fmt::format("the direction ({:g}, {:g}, {:g}) of the scan is at {}", list[0], list[1], list[2], at);
  } else {
    std::string name;
    direction = scan_axis_across(X_CS, part ? std::optional(middle) : std::nullopt, name);
    report.zero = fmt::format("the {} axis of the scan is at {}", name, at);
  }
  const Vec3 in_S = X_CS.rotation.transpose() * direction.normalized();
  if (std::hypot(in_S.x(), in_S.z()) < 0.1)
    throw Error(ErrorKind::configuration, "the direction for the angular zero runs along the axle", {},
                "choose one across it");
  const double u_zero = std::atan2(in_S.x(), in_S.z()) - wanted;
  // the turn that has the part about zero
  return part ? middle - wrap_angle(middle - u_zero) : u_zero;
}

namespace {

/// The nominal profile where there is one, as wide as the scan of a wheel; of a rail with its flanks, which no look
/// from above would find. Else what the placement found.
scans::Section start_section(const PlacedScan& scan) {
  if (scan.nominal.empty()) return scan.placement.section;
  const bool wheel = scan.body == Body::wheel;
  std::vector<Vec2> points;
  for (const Vec2& p : scan.nominal)
    if (!wheel || (p.x() >= scan.placement.section.y_min() && p.x() <= scan.placement.section.y_max()))
      points.emplace_back(p.x(), wheel ? p.y() + scan.placement.nominal_radius : -p.y());
  constexpr std::size_t kFewest = 20;
  return points.size() < kFewest ? scan.placement.section : scans::Section(points);
}

/// The sections in which the points lie, if they are to be kept. Errors: Error(configuration) if they shall be and are
/// not there.
std::optional<scans::MeasuredSections> sections_to_keep(const PlacedScan& scan, const io::ImportSettings& settings) {
  if (settings.fit.sections == "fit" || scan.points.empty()) return std::nullopt;
  std::optional<scans::MeasuredSections> found =
      scans::find_sections(scan.points, scan.keep, scan.placement.X_CS, scan.body, scan.placement.nominal_radius);
  if (settings.fit.sections == "keep" && !found)
    throw Error(ErrorKind::configuration, "the points do not lie in cross-sections that could be kept", {},
                "say fit.sections=fit");
  if (settings.fit.sections == "auto" && found && !found->regular) return std::nullopt;
  return found;
}

/// Moves the points of sections onto the curves that they stand for, and says by how much (rms) [m]; nothing where all
/// are exact.
std::optional<double> smooth_sections(SliceSet& slices) {
  parallel_for(slices.profiles.size(), [&](std::size_t k) {
    Profile smooth = measured::smoothed_by_noise(slices.profiles[k]);
    if (measured::has_errors(smooth)) slices.profiles[k] = std::move(smooth);
  });
  double squares = 0.0;
  for (const Profile& profile : slices.profiles)
    if (measured::is_smoothed(profile)) squares += std::pow(profile.scatter->removed, 2);
  if (squares == 0.0) return std::nullopt;
  return std::sqrt(squares / static_cast<double>(slices.profiles.size()));
}

/// What noise, or the distance of exact points, leaves uncertain of sections, in the mean over those that a contact
/// patch near a station touches.
std::optional<SurfaceErrors> errors_of_sections(const SliceSet& slices, const scans::FittedBand& fitted,
                                                const std::vector<double>& stations) {
  constexpr double kPlaces = 0.5e-3, kHalfPatch = 6e-3;  // across, along [m]
  const bool wheel = slices.body == Body::wheel;
  const double radius = wheel ? fitted.band.radius : 1.0;
  SurfaceErrors out;
  const Profile section = scans::section_profile(fitted, wheel ? radius : 0.0, kPlaces, slices.name);
  out.y = section.y;
  out.z = section.z;
  for (const double a : stations) {
    const double u = fitted.u_at(a);
    const auto distance = [&](std::size_t k) {
      const double off = slices.u[k] - u;
      return radius * std::fabs(wheel ? wrap_angle(off) : off);
    };
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < slices.u.size(); ++k)
      if (distance(k) < distance(nearest)) nearest = k;
    // as much as a Hertzian patch carries there
    std::vector<std::pair<std::size_t, double>> parts;
    double sum = 0.0;
    for (std::size_t k = 0; k < slices.u.size(); ++k)
      if (const double share = 1.0 - std::pow(distance(k) / kHalfPatch, 2); share > 0.0)
        parts.emplace_back(k, share), sum += share;
    if (parts.size() < 2) {
      // amid others as a control point of a cubic spline, one, four and one sixths of which count
      parts = {{nearest, slices.approximate_u ? std::sqrt(18.0) / 6.0 : 1.0}}, sum = 1.0;
    }
    std::vector<double> draw(out.y.size(), 0.0);
    bool known = false;
    for (const auto& [k, share] : parts) {
      const Profile& profile = slices.profiles[k];
      if (!measured::has_errors(profile)) continue;
      known = true;
      const measured::ErrorDraws draws(profile);
      for (std::size_t i = 0; i < draw.size(); ++i)
        draw[i] += share / sum *
                   draws.at(k % draws.size(), arc_at(profile.scatter->s, profile.y, profile.z, {out.y[i], out.z[i]}));
    }
    if (known) out.u.push_back(u), out.draws.push_back(std::move(draw));
  }
  return out.draws.empty() ? std::nullopt : std::optional(std::move(out));
}

}  // namespace

std::vector<std::string> summary_lines(const io::ImportReport& report) {
  std::vector<std::string> out;
  out.push_back(fmt::format("scanned {}, imported by Treadmark {}", body_name(report.body), report.version));
  for (const auto& input : report.inputs) out.push_back(fmt::format("from {} (SHA-256 {})", input.file, input.sha256));
  out.push_back(fmt::format("unit of the scan: {} (from {}); this file: millimetres", report.unit, report.unit_from));
  out.push_back(fmt::format("points: {} read, {} used; noise {:.3g} um; error of the surface {}", report.points_read,
                            report.points_used, 1e6 * report.noise, io::surface_error_text(report)));
  if (report.sections)
    out.push_back(fmt::format("the {} sections are the scan's own points{}", report.sections->count,
                              report.sections->smoothed
                                  ? ", smoothed by their noise"
                                  : ": smooth them where they are used (smoothing_lambda_mm3, SMOOTH)"));
  if (report.body == Body::wheel) out.push_back(fmt::format("nominal radius: {:.4f} mm", 1e3 * report.nominal_radius));
  if (report.line && report.line->bent) out.push_back(io::line_text(report));
  out.push_back(fmt::format("{}; holes up to {:.1f} mm filled", report.zero, 1e3 * report.hole_limit));
  for (std::string& line : out)
    for (char& c : line)
      if (c == '\n' || c == '\r') c = ' ';
  return out;
}

std::shared_ptr<const SurfaceErrors> with_sources(SurfaceErrors errors, const PlacedScan& scan,
                                                  const io::ImportSettings& settings, io::ImportReport& report) {
  constexpr double kPassesAlike = 20e-3;  // passes that are not rigid differ from place to place [m]
  const auto everywhere = [&](ErrorSource source, double length, double sigma) {
    if (sigma > 0.0) errors.fields.push_back({source, length, {std::vector<double>(errors.y.size(), sigma)}});
  };
  errors.motions = scan.placement.errors;
  if (const double lateral = 1e-3 * settings.errors.lateral_mm; lateral > 0.0)
    errors.motions.push_back({ErrorSource::scanner, lateral, 0.0, 0.0});
  everywhere(ErrorSource::registration, kPassesAlike, scan.pass_error);
  everywhere(ErrorSource::scanner, 1e-3 * settings.errors.scanner_mm, 1e-6 * settings.errors.scanner_um);
  report.errors = size_of(errors);
  for (const SurfaceErrors::Motion& motion : errors.motions)
    report.error_parts.push_back({std::string(name_of(motion.source)), motion.y, motion.z, motion.roll, 0.0, 0.0});
  for (const SurfaceErrors::Field& field : errors.fields) {
    double largest = 0.0;
    for (const std::vector<double>& sigma : field.sigma) largest = std::max(largest, *ranges::max_element(sigma));
    report.error_parts.push_back({std::string(name_of(field.source)), 0.0, 0.0, 0.0, largest, field.length});
  }
  return std::make_shared<const SurfaceErrors>(std::move(errors));
}

OnSection on_its_section(PlacedScan& scan, const io::ImportSettings& settings, double finest, double cells,
                         bool halves) {
  const scans::ProjectSettings how{scan.body, scan.body == Body::wheel ? scan.placement.nominal_radius : 1.0,
                                   1e-3 * settings.clean.farthest_mm, cells};
  scan.placement.section = start_section(scan);
  OnSection out{scans::project(scan.points, scan.keep, scan.placement.X_CS, scan.placement.section, how), {}};
  // the section from all points; once more projected on it, for points are judged by their distance from it
  double moved = 0.0;
  const scans::Section section = scans::refine_section(out.projection.points, out.projection.band, finest, &moved);
  constexpr double kMatters = 1e-8;
  if (!(moved > kMatters)) return out;
  if (halves) {
    // a point that is there twice would be in both halves
    scans::drop_duplicates(out.projection.points, scan.points);
    out.halves = scans::half_sections(out.projection.points, out.projection.band, finest);
  }
  scan.placement.section = section;
  out.projection = scans::project(scan.points, scan.keep, scan.placement.X_CS, section, how);
  return out;
}

double finest_of(const io::ImportSettings& settings, double spacing) {
  constexpr double kFinest = 0.5e-3, kOfSpacing = 0.9;  // knots that are worth having [m]
  return settings.fit.finest_mm > 0.0 ? 1e-3 * settings.fit.finest_mm : std::max(kFinest, kOfSpacing * spacing);
}

scans::FitSettings fit_settings(const io::ImportSettings& settings) {
  scans::FitSettings out;
  out.finest = 1e-3 * settings.fit.finest_mm;
  out.significance = settings.fit.significance;
  out.held_out = settings.fit.held_out;
  out.follow = settings.fit.follow;
  return out;
}

double damage_threshold(const io::ImportSettings& settings, double noise) {
  constexpr double kLeastDamage = 20e-6;
  return settings.damage.threshold_mm > 0.0 ? 1e-3 * settings.damage.threshold_mm : std::max(kLeastDamage, 1.5 * noise);
}

void lay_zero(PlacedScan& scan, double u_zero) {
  if (scan.body == Body::wheel)
    scan.placement.X_CS = scan.placement.X_CS * Pose{Vec3::Zero(), rotation_y(u_zero)};
  else
    scan.placement.X_CS = scan.placement.X_CS * Pose{Vec3(u_zero, 0.0, 0.0), Mat3::Identity()};
}

namespace {

void note_removed(const scans::Projection& projection, std::size_t duplicates, const scans::LocalNoise& noise,
                  const io::ImportSettings& settings, io::ImportReport& report) {
  report.removed.push_back({"beside the section", projection.beyond_section,
                            "past its ends, or where it is too steep to be seen from outside"});
  report.removed.push_back({"far from the section", projection.far_off,
                            fmt::format("farther than {:g} mm from it", settings.clean.farthest_mm)});
  report.removed.push_back({"past the ends", projection.beyond_length, "where hardly any points are"});
  report.removed.push_back({"duplicates", duplicates, "at the very place of another point"});
  report.removed.push_back({"isolated", noise.isolated, "hardly any others around them"});
  report.removed.push_back(
      {"outliers", noise.outliers,
       fmt::format(
           "farther than {:g} local standard deviations (usually {:.3g} mm) from a quadratic through the points around",
           settings.clean.outlier_factor, 1e3 * settings.clean.outlier_factor * noise.typical)});
}

/// One rail of a track, which is imported as a scan of its own.
struct RailOfTrack {
  Clouds cloud;
  io::ImportReport read;  ///< what reading has told
  StagedOutputs& staged;
  std::optional<TrackSide> side = {};  ///< told
};

io::ImportReport import_checked(const ImportRequest& request, const Progress& progress, RailOfTrack* rail = nullptr) {
  const io::ImportSettings& settings = request.settings;
  io::ImportReport report;
  if (rail != nullptr) report = std::move(rail->read);
  report.version = version();
  report.settings_toml = io::import_settings_toml(settings);
  const bool map = rail == nullptr && request.scans.size() == 1 && settings.map.values == "deviations" &&
                   settings.scan.box_from.empty() && io::is_deviation_map(request.scans.front());
  constexpr std::size_t kSteps = 6, kOfPlacing = 2;  // a map has neither stray points nor a placement
  StepClock clock(
      report, progress,
      (map ? kSteps : kSteps + kOfPlacing) + (settings.fit.errors ? 1 : 0) + (request.truth.empty() ? 0 : 1));
  const CancellationScope scope(progress.stop);
  clock.begin("reading");
  std::optional<Truth> truth;
  if (!request.truth.empty())
    truth = read_truth(request.truth, body_of(request), 1e-3 * settings.placement.nominal_radius_mm);
  PlacedScan scan;
  if (map) {
    scan = read_map(request, report);
  } else {
    Clouds clouds = rail != nullptr ? std::move(rail->cloud) : read_points(request, report, progress);
    if (truth) check_points(*truth, report.points_read);
    scan = find_place(std::move(clouds), request, report, clock);
  }

  const std::optional<scans::MeasuredSections> sections = sections_to_keep(scan, settings);
  clock.begin("noise and outliers");
  const bool errors_of_fit = settings.fit.errors && !sections;
  const double finest = finest_of(settings, report.spacing);
  OnSection found = on_its_section(scan, settings, finest, finest, errors_of_fit);
  scans::Projection& projection = found.projection;
  const std::size_t duplicates = scans::drop_duplicates(projection.points, scan.points);
  scans::NoiseSettings how_noise;
  how_noise.outlier_factor = sections ? 0.0 : settings.clean.outlier_factor;
  how_noise.most_flagged = settings.clean.edge_share;
  how_noise.residuals =
      !sections && settings.fit.weights && !(scan.passes.empty() && scan.stations.empty() && scan.intensities.empty());
  scans::LocalNoise noise = scans::find_noise(projection.points, projection.band, how_noise);
  if (how_noise.residuals) weigh_points(scan, projection, how_noise, noise, report);
  if (!sections) note_removed(projection, duplicates, noise, settings, report);

  clock.begin("holes");
  const scans::Coverage coverage = scans::find_coverage(
      projection.points, projection.band, {1e-3 * settings.clean.hole_limit_mm, settings.clean.least_filled});
  if (coverage.last_column <= coverage.first_column + 8)
    throw Error(ErrorKind::input_data, "no part of the running band is covered by points along enough of its length",
                {request.scans.front().string()}, "lower clean.least_filled, or scan more of it");

  clock.begin("fit");
  const scans::FitSettings how_fit = fit_settings(settings);
  Progress inner;
  inner.stop = progress.stop;
  const scans::FitResult fit = scans::fit_field(projection.points, projection.band, noise, how_fit, inner);

  clock.begin("damage");
  const double s_min = projection.points.cell_s * static_cast<double>(coverage.first_column),
               s_max = projection.points.cell_s * static_cast<double>(coverage.last_column);
  report.damage_threshold = damage_threshold(settings, noise.typical);
  const std::vector<scans::Damage> damage =
      scans::find_damage(projection.band, fit.field, s_min, s_max, report.damage_threshold);
  const double u_zero = zero_of(scan, projection.band, damage, settings, report);
  const scans::FittedBand fitted{projection.band, fit.field, s_min, s_max, u_zero};
  lay_zero(scan, u_zero);  // of the surface's own frame
  std::optional<SurfaceErrors> known_errors;
  if (settings.fit.errors) clock.begin("errors");
  const std::vector<double> stations = scans::error_stations(projection.band, damage, coverage.holes);
  if (errors_of_fit) {
    known_errors =
        scans::half_fit_errors(fitted, projection.points, noise, how_fit, found.halves ? &*found.halves : nullptr,
                               stations, scan.placement.nominal_radius, inner);
    scans::add_error_sources({fitted, projection.points, noise, fit, coverage, damage},
                             scans::shared_scatter(projection.points, noise, fit.residual), stations, *known_errors);
  }
  fill_line(scan, settings, report);
  const ImportFindings findings{scan, projection, noise,  coverage,
                                fit,  fitted,     damage, sections ? &*sections : nullptr};
  fill_report(findings, report);

  std::optional<SliceSet> kept;
  if (sections) {
    report.sections->smoothing = 1e-9 * settings.fit.smoothing_lambda_mm3;
    scans::MeasuredSections from_zero = *sections;
    for (double& u : from_zero.u) u -= u_zero;
    kept = scans::sections_to_slices(from_zero, scan.points, scan.placement.X_CS, scan.body,
                                     scan.placement.nominal_radius, settings.fit.sections_along == "approximate",
                                     scan.body == Body::wheel ? "measured wheel" : "measured rail");
    if (settings.fit.smoothing == "auto") report.sections->smoothed = smooth_sections(*kept);
    if (settings.fit.errors && settings.fit.smoothing == "auto")
      known_errors = errors_of_sections(*kept, fitted, stations);
  }
  std::shared_ptr<const SurfaceErrors> errors;
  if (known_errors) {
    errors = with_sources(std::move(*known_errors), scan, settings, report);
    fill_error_map(findings, *errors, report);
  } else if (settings.errors.lateral_mm > 0.0 || settings.errors.scanner_um > 0.0) {
    report.warnings.emplace_back(
        "what [errors] says does not go with the surface: of sections that noise did not smooth no errors are known");
  }
  const FittedScan whole{scan, fitted, projection.points, coverage, noise.typical, kept ? &*kept : nullptr, errors};
  for (const auto& file : request.outputs) check_holes(file, whole);
  if (truth) {
    clock.begin("truth");
    compare_with_truth(*truth, whole, report);
  }
  clock.begin("writing");
  const std::vector<std::string> summary = summary_lines(report);
  StagedOutputs own;
  StagedOutputs& staged = rail != nullptr ? rail->staged : own;
  for (const auto& file : request.outputs) {
    clock.tell(file.filename().string());
    if (errors && io::extension_of(file) == ".stl")
      report.warnings.push_back(fmt::format(
          "{} cannot hold how well the surface is known, and results that use it will not say so: write .ply",
          file.filename().string()));
    report.outputs.push_back(write_output(file, staged.place(file), whole, settings, summary));
  }
  if (rail == nullptr) staged.commit();
  clock.end();
  if (rail != nullptr) {
    PlacedScan placed;
    placed.line = scan.line;
    placed.placement.X_CS = scan.placement.X_CS;
    rail->side.emplace(
        TrackSide{std::move(placed), projection.band, fit.field, s_min, s_max, u_zero, report.u_min, report.u_max});
  }
  return report;
}

/// "NAME-left.slcs" for "NAME.slcs".
std::filesystem::path named_after(const std::filesystem::path& file, const char* rail) {
  return file.parent_path() / fmt::format("{}-{}{}", file.stem().string(), rail, file.extension().string());
}

/// Both rails of a track: the report is that of the right one, and has the left one's.
io::ImportReport import_both(const ImportRequest& request, const Progress& progress) {
  const io::ImportSettings& settings = request.settings;
  io::ImportReport read;
  SeparateRails rails;
  std::size_t points = 0;
  {
    constexpr std::size_t kSteps = 2;
    StepClock clock(read, progress, kSteps);
    const CancellationScope scope(progress.stop);
    clock.begin("reading");
    Clouds both = read_points(request, read, progress);
    points = both.cloud.points.size();
    clock.begin("both rails");
    rails = separate_rails(std::move(both), settings, read);
    clock.end();
  }
  StagedOutputs staged;
  std::array<io::ImportReport, 2> reports;
  std::array<std::optional<TrackSide>, 2> sides;
  for (const std::size_t side : {0u, 1u}) {
    ImportRequest of_rail = request;
    for (auto& file : of_rail.outputs) file = named_after(file, side == 0 ? "left" : "right");
    check_outputs(of_rail);
    auto& placement = of_rail.settings.placement;
    placement.forward = {rails.forward[side].x(), rails.forward[side].y(), rails.forward[side].z()};
    if (side == 0) placement.line_beside_mm = -placement.line_beside_mm;
    RailOfTrack rail{std::move(rails.clouds[side]), read, staged};
    rail.read.removed.push_back({"of no rail, or the other one", points - rail.cloud.cloud.points.size(),
                                 "farther than 250 mm from the middle of this rail's head"});
    try {
      reports[side] = import_checked(of_rail, progress, &rail);
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("the {} rail: {}", side == 0 ? "left" : "right", error.message()),
                  error.where(), error.advice());
    }
    reports[side].settings_toml = io::import_settings_toml(settings);
    sides[side] = std::move(rail.side);
  }
  io::ImportReport& out = reports[1];
  std::optional<Vec3> up;
  if (const auto& list = settings.placement.up; list.size() == 3) up = Vec3(list[0], list[1], list[2]).normalized();
  out.track = measure_track(*sides[0], *sides[1], up);
  if (out.track->places.empty())
    out.warnings.emplace_back(
        "track_gauge: nowhere do both rails lie beside each other: there is neither gauge nor cant");
  else if (std::isnan(out.track->gauge_mean))
    out.warnings.emplace_back(
        "track_gauge: nowhere are both gauge faces in the scan down to 14 mm below the heads: there is no gauge");
  out.track->left = std::make_shared<const io::ImportReport>(std::move(reports[0]));
  staged.commit();
  return std::move(out);
}

[[noreturn]] void refuse(const std::string& key, const std::string& why) {
  throw Error(ErrorKind::configuration, key + " would be ignored: " + why, {}, "leave it out");
}

}  // namespace

io::ImportReport import_scan(const ImportRequest& request, const Progress& progress) {
  if (request.scans.empty()) throw Error(ErrorKind::configuration, "there is no scan to read");
  check_outputs(request);
  check_settings(request.settings, body_of(request));
  try {
    if (request.settings.scan.rails == "both") {
      if (!request.truth.empty()) refuse("--truth", "it is that of one rail, and scan.rails is both");
      if (request.scans.size() == 1 && io::is_deviation_map(request.scans.front()))
        refuse("scan.rails", "a map or matrix is that of one rail");
      if (request.settings.tiles.use == "always") refuse("tiles.use", "both rails of a track are told apart in memory");
      return import_both(request, progress);
    }
    return goes_by_tiles(request) ? import_tiles(request, progress) : import_checked(request, progress);
  } catch (const Error& error) {
    // what works on points knows nothing of files
    if (!error.where().file.empty()) throw;
    throw Error(error.kind(), error.message(), {request.scans.front().string()}, error.advice());
  }
}

void check_settings(const io::ImportSettings& settings, Body body) {
  const auto& placement = settings.placement;
  if (body == Body::wheel) {
    if (!placement.up.empty()) refuse("placement.up", "it is that of a rail's head, and this is a wheel");
    if (placement.line_beside_mm != 0.0)
      refuse("placement.line_beside_mm", "it is that of a rail, and this is a wheel");
    if (placement.line != "auto") refuse("placement.line", "it is that of a rail, and this is a wheel");
    if (settings.scan.rails != "one") refuse("scan.rails", "this is a wheel");
    if (placement.zero_mm != 0.0) refuse("placement.zero_mm", "it is that of a rail, and this is a wheel (zero_deg)");
  } else {
    if (placement.zero_deg != 0.0) refuse("placement.zero_deg", "it is that of a wheel, and this is a rail (zero_mm)");
    if (placement.nominal_radius_mm > 0.0) refuse("placement.nominal_radius_mm", "a rail has none");
    if (settings.map.angles_deg) refuse("map.angles_deg", "a rail has none");
  }
  if (settings.scan.box_from.empty() != settings.scan.box_to.empty())
    refuse("scan.box_from", "scan.box_to belongs to it");
  if (placement.line_beside_mm != 0.0 && io::extension_of(placement.line) != ".toml")
    refuse("placement.line_beside_mm", "placement.line names no layout");
  const auto& errors = settings.errors;
  if (errors.scanner_um > 0.0 && !(errors.scanner_mm > 0.0))
    throw Error(ErrorKind::configuration, "errors.scanner_um needs to know how far points share it", {},
                "say errors.scanner_mm");
  if (errors.scanner_mm > 0.0 && !(errors.scanner_um > 0.0))
    refuse("errors.scanner_mm", "errors.scanner_um says of no errors");
  if (!settings.fit.errors && (errors.scanner_um > 0.0 || errors.lateral_mm > 0.0))
    refuse(errors.lateral_mm > 0.0 ? "errors.lateral_mm" : "errors.scanner_um", "fit.errors is false");
  if (!placement.zero_direction.empty() && placement.zero != "direction")
    refuse("placement.zero_direction", "placement.zero is " + placement.zero);
  if (settings.fit.mesh == "free" && settings.fit.decimate_um > 0.0)
    refuse("fit.decimate_um", "triangles of an advancing front (fit.mesh = free) are not decimated");
}

}  // namespace treadmark::app
