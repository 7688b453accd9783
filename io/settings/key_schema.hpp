// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "treadmark/io/settings/key_info.hpp"

namespace treadmark::io {

inline constexpr const char* kSchemaDialect = "https://json-schema.org/draft/2020-12/schema";

/// JSON Schema (draft 2020-12) of a file with these keys and nothing else, for editors and validators.
std::string file_schema(std::string_view title, std::span<const KeyInfo> keys);

/// Its part about the tables, as JSON on one line. sweep: a list may stand where one value is expected.
std::string tables_schema(std::span<const KeyInfo> keys, std::span<const ExclusiveSections> exclusive, bool sweep);

/// All keys as Markdown tables, one for each section, for the documentation. Keys without a dot are not shown but for
/// what is in them, if they are tables.
std::string key_table(std::span<const KeyInfo> keys);

/// Whether the value of a key is a list itself.
bool is_list(const KeyInfo& key);

}  // namespace treadmark::io
