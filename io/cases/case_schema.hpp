// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::io {

/// JSON Schema (draft 2020-12) of the Treadmark case file, for editors and validators; from the same table as the
/// reader.
std::string case_file_schema();

/// All keys as Markdown tables, one for each section (docs/case-file.md).
std::string case_key_table();

}  // namespace treadmark::io
