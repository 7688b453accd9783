// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <numbers>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/import/scan_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::cli {
namespace {

struct ScanOptions {
  std::string surface, cloud;  ///< geometry or case file; file of points
  std::string truth_file;      ///< "-" = stdout, empty = none
  std::string body;            ///< "wheel", "rail" or empty
  std::string line;            ///< file of a track layout or empty
  std::size_t points = 1'000'000;
  double spacing_mm = 0.0;  ///< 0 = by the number of points
  double noise_mm = 0.0, noise_lateral_mm = 0.0;
  double outliers = 0.0, holes = 0.0, hole_size_mm = 4.0, drop_outs = 0.0;
  double most_incidence_deg = 0.0;
  int passes = 1;
  double registration_mm = 0.0;
  std::string frame = "identity", unit = "mm";
  std::vector<double> range_mm, range_deg, range_y_mm;  ///< two numbers or none
  std::vector<double> from_mm;                          ///< three numbers a place
  double nominal_radius_mm = 0.0;
  double scale_to_mm = 1.0;
  std::uint64_t seed = 1;
  std::vector<std::string> overrides;
};

constexpr double kMetres = 1e-3, kDegree = std::numbers::pi / 180.0;

app::Range range(const std::vector<double>& numbers, double factor) {
  if (numbers.empty()) return {};
  return std::pair{factor * numbers[0], factor * numbers[1]};
}

app::ScanRequest request_of(const ScanOptions& options, bool quiet) {
  app::ScanRequest request;
  request.surface.body = body_asked(options.body, options.surface, quiet);
  request.surface.nominal_radius = kMetres * options.nominal_radius_mm;
  request.surface.scale_to_mm = options.scale_to_mm;
  request.surface.overrides = options.overrides;
  request.range_x = range(options.range_mm, kMetres);
  request.range_theta = range(options.range_deg, kDegree);
  request.unit = length_unit(options.unit).value_or(LengthUnit::millimetre);
  request.line = options.line;
  scans::ScannerSettings& scanner = request.scanner;
  if (!options.range_y_mm.empty()) {
    scanner.y_min = kMetres * options.range_y_mm[0];
    scanner.y_max = kMetres * options.range_y_mm[1];
  }
  if (options.from_mm.size() % 3 != 0)
    throw Error(ErrorKind::configuration, "--from-mm takes three numbers for each place of the scanner: X,Y,Z");
  for (std::size_t i = 0; i < options.from_mm.size(); i += 3)
    scanner.stands.emplace_back(kMetres * Vec3(options.from_mm[i], options.from_mm[i + 1], options.from_mm[i + 2]));
  scanner.points = options.points;
  scanner.spacing = kMetres * options.spacing_mm;
  scanner.noise = kMetres * options.noise_mm;
  scanner.noise_lateral = kMetres * options.noise_lateral_mm;
  scanner.outliers = options.outliers;
  scanner.holes = options.holes;
  scanner.hole_size = kMetres * options.hole_size_mm;
  scanner.drop_outs = options.drop_outs;
  scanner.most_incidence = kDegree * options.most_incidence_deg;
  scanner.passes = options.passes;
  scanner.registration = kMetres * options.registration_mm;
  scanner.random_frame = options.frame == "random";
  scanner.seed = options.seed;
  return request;
}

int scan_command(const ScanOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  const app::Scanned scanned = with_progress(common.quiet, [&](const Progress& progress) {
    return app::scan_surface(options.surface, options.cloud, request_of(options, common.quiet), progress);
  });
  const auto json = [&] { return app::truth_json(scanned); };
  write_json_file(options.truth_file, json);
  print_results(options.truth_file, json, [&] { return app::summary(scanned); });
  return kOk;
}

}  // namespace

Command add_scan(CLI::App& verb) {
  auto options = std::make_shared<ScanOptions>();
  const auto length = [&](const char* name, double& value, const char* text) {
    verb.add_option(name, value, text)->check(CLI::NonNegativeNumber)->type_name("MM");
  };
  const auto share = [&](const char* name, double& value, const char* text) {
    verb.add_option(name, value, text)->check(CLI::Range(0.0, 0.9))->type_name("SHARE");
  };
  const auto range = [&](const char* name, std::vector<double>& value, const char* text) {
    verb.add_option(name, value, text)->delimiter(',')->expected(2)->type_name("FROM,TO");
  };
  verb.add_option("SURFACE", options->surface,
                  "Profile, slices, triangles (.ply .stl .obj .off), offsets (.vdb .nvdb), or a case file")
      ->required();
  add_output(verb, "-o,--output", options->cloud, "File of points: " + io::written_scan_extensions(), "FILE")
      ->required();
  add_output(verb, "--truth", options->truth_file,
             "Write what is known about the scan here (JSON); - for standard output instead of the summary", "FILE");
  verb.add_option("--body", options->body, "wheel or rail, where the input does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  CLI::Option* points =
      verb.add_option("--points", options->points, "Points on the surface before any are lost, default 1000000")
          ->check(CLI::Range(std::size_t{1}, std::size_t{200'000'000}));
  verb.add_option("--spacing-mm", options->spacing_mm, "Between points, instead of their number")
      ->check(CLI::PositiveNumber)
      ->type_name("MM")
      ->excludes(points);
  length("--noise-mm", options->noise_mm,
         "Standard deviation along the beam, which meets the surface along its normal without --from-mm");
  length("--noise-lateral-mm", options->noise_lateral_mm, "Standard deviation across the beam");
  share("--outliers", options->outliers, "Share of all points that lie off the surface");
  share("--holes", options->holes, "Share of the area without points");
  length("--hole-size-mm", options->hole_size_mm, "Mean diameter of the holes, default 4");
  share("--drop-outs", options->drop_outs, "Share of the points lost one by one and in short runs");
  verb.add_option("--most-incidence-deg", options->most_incidence_deg,
                  "Steeper to the beam nothing is seen; 0 = everything is")
      ->check(CLI::Range(0.0, 90.0))
      ->type_name("DEG");
  CLI::Option* passes = verb.add_option("--passes", options->passes,
                                        "Passes that overlap by a quarter, beside each other (rail) or round the wheel")
                            ->check(CLI::Range(1, 1000));
  add_values(verb, "--from-mm", options->from_mm,
             "Where the scanner stands, in the frame of the surface: sees what nothing of the surface hides; once for "
             "each place",
             "X,Y,Z")
      ->excludes(passes);
  length("--registration-mm", options->registration_mm, "Standard deviation of each pass's error of position");
  verb.add_option("--frame", options->frame, "Frame of the cloud: identity (that of the surface) or random")
      ->check(CLI::IsMember({"identity", "random"}));
  verb.add_option("--unit", options->unit, "Unit of the file: mm (default), m, um, in")
      ->check(CLI::IsMember({"mm", "m", "um", "in"}));
  verb.add_option("--line", options->line,
                  "File with the [layout] along which a rail lies, x from its beginning; without: straight")
      ->type_name("FILE");
  range("--range-mm", options->range_mm, "Part of a rail: from, to along the track");
  range("--range-deg", options->range_deg, "Part of a wheel: from, to round it");
  range("--range-y-mm", options->range_y_mm, "Part across: from, to");
  verb.add_option("--nominal-radius,--nominal-radius-mm", options->nominal_radius_mm,
                  "Wheel radius at profile z = 0 [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--scale,--scale-to-mm", options->scale_to_mm,
                  "Factor from units of the surface's file to mm (1000 for a file in m)")
      ->check(CLI::PositiveNumber);
  verb.add_option("--seed", options->seed, "Of all random numbers, default 1; the same seed gives the same points");
  add_overrides(verb, options->overrides, "wheel.flats.0.depth_mm=1");
  return command(options, scan_command);
}

}  // namespace treadmark::cli
