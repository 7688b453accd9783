// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>

#include "treadmark/core/parts.hpp"
#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/imports/import_maps.hpp"
#include "treadmark/pictures/imports/import_pictures.hpp"

namespace treadmark::io {

void write_import_report(const std::string& folder, const ImportReport& report) {
  const std::filesystem::path place(folder);
  write_text_file(place / "before.svg", import_before_svg(report));
  write_text_file(place / "removed.svg", import_removed_svg(report));
  write_text_file(place / "fitted.svg", import_fitted_svg(report));
  write_text_file(place / "residual.svg", import_residual_svg(report));
  if (has_part("hdf5")) write_import_maps(place / "maps.h5", report);
  write_text_file(place / "settings.toml", report.settings_toml);
  write_text_file(place / "summary.txt", import_summary(report));
  write_text_file(place / "times.json", import_times_json(report));
  write_text_file(place / "report.json", import_json(report, false));
}

ImportReport read_import_report(const std::filesystem::path& folder) {
  ImportReport report = read_import_json(folder / "report.json");
  const auto is_there = [&](const char* name) {
    std::error_code code;
    return std::filesystem::is_regular_file(folder / name, code);
  };
  if (is_there("maps.h5")) read_import_maps(folder / "maps.h5", report);
  if (is_there("times.json")) read_import_times(folder / "times.json", report);
  return report;
}

}  // namespace treadmark::io
