// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <numbers>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/scan_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/files/atomic_file.hpp"

namespace treadmark::cli {
namespace {

constexpr double kMetres = 1e-3, kDegree = std::numbers::pi / 180.0;

app::Range range(const std::vector<double>& numbers, double factor) {
  if (numbers.empty()) return {};
  return std::pair{factor * numbers[0], factor * numbers[1]};
}

app::ScanRequest request_of(const ScanOptions& options) {
  app::ScanRequest request;
  if (!options.body.empty()) request.surface.body = options.body == "wheel" ? Body::wheel : Body::rail;
  request.surface.nominal_radius = kMetres * options.nominal_radius_mm;
  request.surface.scale_to_mm = options.scale_to_mm;
  request.surface.overrides = options.overrides;
  request.range_x = range(options.range_mm, kMetres);
  request.range_theta = range(options.range_deg, kDegree);
  request.unit = length_unit(options.unit).value_or(LengthUnit::millimetre);
  scans::ScannerSettings& scanner = request.scanner;
  if (!options.range_y_mm.empty()) {
    scanner.y_min = kMetres * options.range_y_mm[0];
    scanner.y_max = kMetres * options.range_y_mm[1];
  }
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

}  // namespace

int scan_command(const ScanOptions& options, const CommonOptions& common) {
  if (!options.truth_file.empty() && std::filesystem::path(options.truth_file) == std::filesystem::path(options.cloud))
    throw Error(ErrorKind::configuration, "the points and the truth about them cannot go to the same file",
                {options.cloud});
  const ThreadLimit limit(common.threads);
  catch_interrupt();
  app::Scanned scanned;
  {
    ProgressLine line(common.quiet);
    Progress progress;
    progress.stop = &interrupted();
    progress.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
      line.update(finished, total, what);
    };
    scanned = app::scan_surface(options.surface, options.cloud, request_of(options), progress);
  }
  if (options.truth_file == "-") {
    std::cout << app::truth_json(scanned);
  } else {
    if (!options.truth_file.empty()) io::write_text_file(options.truth_file, app::truth_json(scanned));
    std::cout << app::summary(scanned);
  }
  std::cout.flush();
  if (!std::cout) throw Error(ErrorKind::numerical, "the results could not be written to standard output");
  return kOk;
}

}  // namespace treadmark::cli
