// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/instructions/import_paths.hpp"

#include <cmath>
#include <filesystem>
#include <memory>

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/scans/virtual/virtual_scanner.hpp"

namespace treadmark::bench {
namespace {

constexpr double kNoise = 20e-6;  // [m]

/// A scan in a folder that goes with it.
struct ScanFolder {
  const OutputFolder own{std::filesystem::temp_directory_path(), OutputFolder::Old::kept};
  const std::filesystem::path folder = own.path();
  std::size_t points = 0;

  explicit ScanFolder(const Surface& rail) {
    scans::ScannerSettings scanner;
    scanner.u_min = -25e-3, scanner.u_max = 25e-3;
    scanner.points = 12500;
    scanner.noise = kNoise;
    scanner.outliers = 0.01;
    const scans::VirtualScan scan = scans::scan_surface(rail, scanner);
    points = scan.cloud.points.size();
    io::write_scan(cloud(), scan.cloud, LengthUnit::millimetre);
  }
  std::filesystem::path cloud() const { return folder / "rail.ply"; }
};

}  // namespace

std::vector<std::string> import_kinds() { return {"slcs", "ply"}; }

MeasuredPath import_path(const Surface& rail, const std::string& kind) {
  static const auto scan = std::make_shared<const ScanFolder>(rail);
  app::ImportRequest request;
  request.scans = {scan->cloud()};
  request.outputs = {scan->folder / ("out." + kind)};
  request.settings.scan.body = "rail";
  request.settings.fit.resolution_mm = 1.0;
  request.settings.fit.errors = false;  // the fit once more, of halves
  const auto check = [request]() -> std::string {
    const io::ImportReport report = app::import_scan(request);
    if (!(std::fabs(report.noise / kNoise - 1.0) < 0.1)) return "the noise is not that of the scanner";
    return report.outputs.front().height_rms < 2e-6 ? "" : "what was written is not what was fitted";
  };
  return {"point", scan->points, [request] { app::import_scan(request); }, check};
}

}  // namespace treadmark::bench
