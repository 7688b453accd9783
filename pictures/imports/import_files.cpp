// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/imports/import_maps.hpp"
#include "treadmark/pictures/imports/import_pictures.hpp"

namespace treadmark::pictures {

void write_import_report(const std::string& folder, const io::ImportReport& report) {
  const std::filesystem::path place(folder);
  io::write_text_file(place / "before.svg", import_before_svg(report));
  io::write_text_file(place / "removed.svg", import_removed_svg(report));
  io::write_text_file(place / "fitted.svg", import_fitted_svg(report));
  io::write_text_file(place / "residual.svg", import_residual_svg(report));
  io::write_import_maps(place / "maps.h5", report);
  io::write_text_file(place / "settings.toml", report.settings_toml);
  io::write_text_file(place / "summary.txt", io::import_summary(report));
  io::write_text_file(place / "times.json", io::import_times_json(report));
  io::write_text_file(place / "report.json", io::import_json(report, false));
}

}  // namespace treadmark::pictures
