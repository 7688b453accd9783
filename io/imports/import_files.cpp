// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/imports/import_maps.hpp"
#include "treadmark/io/imports/import_pictures.hpp"

namespace treadmark::io {

void write_import_report(const std::string& folder, const ImportReport& report) {
  const std::filesystem::path place(folder);
  write_text_file(place / "before.svg", import_before_svg(report));
  write_text_file(place / "removed.svg", import_removed_svg(report));
  write_text_file(place / "fitted.svg", import_fitted_svg(report));
  write_text_file(place / "residual.svg", import_residual_svg(report));
  write_import_maps(place / "maps.h5", report);
  write_text_file(place / "settings.toml", report.settings_toml);
  write_text_file(place / "summary.txt", import_summary(report));
  write_text_file(place / "times.json", import_times_json(report));
  write_text_file(place / "report.json", import_json(report, false));
}

}  // namespace treadmark::io
