// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/report/page.hpp"
#include "treadmark/io/json/json_tree.hpp"

namespace treadmark::app::report {

using io::JsonTree;

/// Tables of the report of an import (docs/import.schema.json), a line an entry. Errors: Error(input_data) for keys
/// that are missing.

Table input_table(const JsonTree& report);
Table removed_table(const JsonTree& report);
Table hole_table(const JsonTree& report);
Table damage_table(const JsonTree& report);
Table pass_table(const JsonTree& frame);
Table level_table(const JsonTree& report);
Table output_table(const JsonTree& report);

/// times: what times.json holds.
Table step_table(const JsonTree& times);

}  // namespace treadmark::app::report
