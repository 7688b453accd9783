// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/read_scan.hpp"

#include <fmt/format.h>

#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io {

namespace {

using Parser = Scan (*)(scans::ByteBlocks&, const ScanReadOptions&);

struct Kind {
  std::string_view extension;
  Parser parser;
};

constexpr Kind kKinds[] = {
    {".ply", scans::parse_ply},     {".stl", scans::parse_stl},        {".obj", scans::parse_obj},
    {".off", scans::parse_off},     {".las", scans::parse_las},        {".pcd", scans::parse_pcd},
    {".e57", scans::parse_e57},     {".ptx", scans::parse_ptx},        {".pts", scans::parse_columns},
    {".xyz", scans::parse_columns}, {".xyzrgb", scans::parse_columns}, {".xyzn", scans::parse_columns},
    {".asc", scans::parse_columns}, {".txt", scans::parse_columns},    {".csv", scans::parse_columns}};

Parser parser_of(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  for (const Kind& kind : kKinds)
    if (kind.extension == extension) return kind.parser;
  return nullptr;
}

/// What makes a file readable that is not.
std::string way_out(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  const std::string name = file.filename().string(), stem = file.stem().string();
  if (extension == ".laz")
    return fmt::format("decompress it first: 'laszip -i {} -o {}.las', or 'pdal translate {} {}.las'", name, stem, name,
                       stem);
  if (extension == ".xyzi" || extension == ".neu" || extension == ".dat")
    return "if it has a point a line, rename it to .xyz; known are " + scan_extensions();
  return "known are " + scan_extensions();
}

}  // namespace

std::string scan_extensions() {
  std::string out;
  for (const Kind& kind : kKinds) out.append(out.empty() ? "" : " ").append(kind.extension);
  return out;
}

bool is_scan_file(const std::filesystem::path& file) { return parser_of(file) != nullptr; }

Scan read_scan(const std::filesystem::path& file, const ScanReadOptions& options, const Progress& progress) {
  const Parser parser = parser_of(file);
  if (parser == nullptr)
    throw Error(ErrorKind::input_data,
                fmt::format("the scan file {} is of no known kind", profiles::printable(file.filename().string())),
                options.asked_by, way_out(file));
  scans::ByteBlocks bytes(file, options.asked_by, progress);
  return parser(bytes, options);
}

std::optional<Scan> read_height_rows(const std::filesystem::path& file, const HeightRowOptions& how,
                                     const ScanReadOptions& options, const Progress& progress) {
  if (parser_of(file) != scans::parse_columns) return std::nullopt;
  scans::ByteBlocks bytes(file, options.asked_by, progress);
  const std::optional<scans::HeightRows> rows = scans::sniff_height_rows(bytes);
  if (!rows) return std::nullopt;
  return scans::parse_height_rows(bytes, *rows, how, options);
}

bool is_height_rows(const std::filesystem::path& file) {
  if (parser_of(file) != scans::parse_columns) return false;
  scans::ByteBlocks bytes(file, {file.string()}, {});
  return scans::sniff_height_rows(bytes).has_value();
}

}  // namespace treadmark::io
