// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::io {

/// A text as a cell of a table with commas (RFC 4180): in quotes where it needs them. Thread-safe.
std::string csv_cell(const std::string& text);

/// The shortest number that reads back exactly, "nan", "inf" or "-inf". Thread-safe.
std::string csv_number(double value);

}  // namespace treadmark::io
