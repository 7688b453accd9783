// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Report of an import whose files pictures::write_import_report wrote to a folder: pictures and the summary are taken
/// from there as far as they are there. document: the text of report.json. Errors: Error(input_data) for files that
/// cannot be read.
report::Page import_page(const io::ImportReport& report, std::string document, const std::filesystem::path& folder);

/// The same from the files alone. Errors: as io::read_import_report. Not to be called from two threads at once (HDF5).
report::Page import_page(const std::filesystem::path& folder);

/// Tables of the report of an import, a line an entry, with the numbers of report.json.

report::Table input_table(const io::ImportReport& report);
report::Table removed_table(const io::ImportReport& report);
report::Table hole_table(const io::ImportReport& report);
report::Table damage_table(const io::ImportReport& report);
report::Table pass_table(const io::ImportReport& report);
report::Table level_table(const io::ImportReport& report);
report::Table output_table(const io::ImportReport& report);
report::Table step_table(const io::ImportReport& report);

}  // namespace treadmark::app::pages
