// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/read_scan.hpp"

#include <fmt/format.h>

#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io {

namespace {

using Parser = Scan (*)(scans::ByteBlocks&, const ScanReadOptions&);

Parser parser_of(const std::filesystem::path& file) {
  const std::string extension = profiles::lower(file.extension().string());
  if (extension == ".ply") return scans::parse_ply;
  if (extension == ".stl") return scans::parse_stl;
  if (extension == ".obj") return scans::parse_obj;
  if (extension == ".off") return scans::parse_off;
  if (extension == ".las") return scans::parse_las;
  if (extension == ".xyz" || extension == ".asc" || extension == ".txt" || extension == ".csv")
    return scans::parse_columns;
  return nullptr;
}

}  // namespace

bool is_scan_file(const std::filesystem::path& file) { return parser_of(file) != nullptr; }

Scan read_scan(const std::filesystem::path& file, const ScanReadOptions& options, const Progress& progress) {
  const Parser parser = parser_of(file);
  if (parser == nullptr) {
    const bool compressed = profiles::lower(file.extension().string()) == ".laz";
    throw Error(ErrorKind::input_data,
                fmt::format("the scan file {} is of no known kind", profiles::printable(file.filename().string())),
                options.asked_by,
                compressed ? "decompress it to .las first, for example with laszip"
                           : "known are .ply, .stl, .obj, .off, .xyz, .asc, .txt, .csv and .las");
  }
  scans::ByteBlocks bytes(file, options.asked_by, progress);
  return parser(bytes, options);
}

}  // namespace treadmark::io
