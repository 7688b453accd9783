// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/app/measure/read_measured.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {

bool is_only_scan(const std::string& name) {
  const auto row = io::shape_extension(name);
  return row && row->kinds == io::kPointFile;
}

ReadMeasured read_scanned(const std::string& name, const MeasureRequest& request) {
  // Never committed: gone with this object.
  const OutputFolder scratch(std::filesystem::temp_directory_path(), OutputFolder::Old::kept);
  const std::filesystem::path slices = scratch.path() / (request.body == Body::wheel ? "scan.slcw" : "scan.slcs");
  ImportRequest import;
  import.scans = {name};
  import.outputs = {slices};
  import.settings.scan.body = body_name(request.body);
  if (!request.nominal.empty()) import.settings.placement.nominal = request.nominal;
  import.settings.placement.nominal_radius_mm = 1e3 * request.nominal_radius;
  import.settings.placement.zero = "scan";
  const io::ImportReport report = import_scan(import);
  if (report.outputs.size() != 1)
    throw Error(ErrorKind::input_data,
                fmt::format("the scan has holes that stay open: its surface is in {} parts", report.outputs.size()),
                {name}, "import it (treadmark import), and measure each part");
  NamedSurface said;
  said.body = request.body;
  said.nominal_radius = report.nominal_radius;
  ReadMeasured out;
  out.kind = "scan";
  out.surface = named_surface(slices, said).surface;
  out.nominal_radius = report.nominal_radius;
  out.placed = true;
  // What the fit leaves of the points' scatter, by halves of the points or else by points held out and by its number of
  // functions, and where the axis may lie.
  std::size_t functions = 0;
  for (const io::ImportReport::Level& level : report.levels) functions += level.used;
  const double scatter = report.noise * std::sqrt(static_cast<double>(functions) /
                                                  static_cast<double>(std::max<std::size_t>(1, report.fitted_points)));
  out.error = std::hypot(report.errors ? report.errors->rms : std::hypot(report.held_out_error, scatter),
                         report.axis_position_error);
  out.point_noise = report.noise;
  out.point_distance = report.spacing;
  out.x_min = report.u_min, out.x_max = report.u_max;
  out.notes = report.warnings;
  out.said.emplace_back("points", fmt::format("{}", report.points_used));
  out.said.emplace_back("noise of the points", fmt::format("{:.4g} mm", 1e3 * report.noise));
  out.said.emplace_back("error of the fit", fmt::format("{:.4g} mm", 1e3 * *out.error));
  return out;
}

}  // namespace treadmark::app
