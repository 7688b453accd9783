// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::io {

/// Columns of a history by names that do not depend on which wheel is watched: "ws1_right.Q_N", also where the column
/// is called "Q_N" and its description names the wheel. All functions are thread-safe.
std::string channel_name(const HistoryColumn& column);

/// Whether a name fits a pattern, in which * stands for any letters, none included.
bool fits(const std::string& name, const std::string& pattern);

/// The columns that fit one of the patterns by their own or their channel's name, in their order. Errors:
/// Error(configuration) at this place for a pattern that fits none, with the nearest name.
std::vector<std::size_t> fitting_columns(std::span<const HistoryColumn> columns, std::span<const std::string> patterns,
                                         const SourcePosition& where = {});

}  // namespace treadmark::io
