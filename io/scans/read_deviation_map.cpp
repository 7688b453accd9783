// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>

#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io {

namespace {

bool may_be_map(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".csv" || extension == ".txt" || extension == ".asc";
}

}  // namespace

bool is_deviation_map(const std::filesystem::path& file) {
  if (!may_be_map(file)) return false;
  try {
    scans::ByteBlocks bytes(file, {}, {});
    return scans::sniff_map(bytes) != scans::MapKind::none;
  } catch (const Error&) {
    return false;  // reading it will say what is wrong
  }
}

OffsetMap read_deviation_map(const std::filesystem::path& file, const MapReadOptions& options) {
  const bool wheel = options.body == Body::wheel;
  const auto refuse = [&](ErrorKind kind, const std::string& message, const std::string& advice) {
    throw Error(kind, message, options.asked_by, advice);
  };
  if (!may_be_map(file))
    refuse(ErrorKind::input_data,
           fmt::format("the map of deviations {} is of no known kind", profiles::printable(file.filename().string())),
           "known are .csv and .txt (a matrix) and .asc (an ESRI ASCII grid)");
  if (options.angles_deg && !wheel)
    refuse(ErrorKind::configuration, "positions in degrees on a rail", "angles are for maps of wheels");
  if (wheel && !options.angles_deg && !(options.nominal_radius > 0.0 && std::isfinite(options.nominal_radius)))
    refuse(ErrorKind::configuration,
           fmt::format("the nominal radius of a wheel must be positive, this is {:g}", options.nominal_radius),
           "it turns lengths round the wheel into angles");
  scans::ByteBlocks bytes(file, options.asked_by, {});
  // anything that is no ESRI grid is read as a matrix, so that the errors tell what is wrong with it
  if (scans::sniff_map(bytes) == scans::MapKind::esri_grid) return scans::parse_esri_grid(bytes, options);
  return scans::parse_map_matrix(bytes, options);
}

}  // namespace treadmark::io
