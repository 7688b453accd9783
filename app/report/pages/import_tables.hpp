// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/report/page.hpp"
#include "treadmark/io/imports/import_report.hpp"

namespace treadmark::app::report {

/// Tables of the report of an import, a line an entry, with the numbers of report.json (docs/import.schema.json).

Table input_table(const io::ImportReport& report);
Table removed_table(const io::ImportReport& report);
Table hole_table(const io::ImportReport& report);
Table damage_table(const io::ImportReport& report);
Table pass_table(const io::ImportReport& report);
Table level_table(const io::ImportReport& report);
Table output_table(const io::ImportReport& report);
Table step_table(const io::ImportReport& report);

}  // namespace treadmark::app::report
