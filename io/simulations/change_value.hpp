// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>

#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::io {

/// Sets a value in parsed tables before they are read. path: keys joined by dots; in lists the number of an element
/// from 0, or the `name` of a table: "bodies.car.mass_kg". What a table lacks is added at its end; elements of lists
/// must exist. A word that happens to be a TOML number replaces text as text. Errors: Error(configuration) at the
/// override.
void change_value(CaseTable& root, std::string_view path, const CaseOverride& change);

/// The value at a path of tables (no lists), or null.
const CaseEntry* find_entry(const CaseTable& root, std::string_view path);

}  // namespace treadmark::io
