// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// Every JSON document is one of these; members keep their order.
using Json = nlohmann::ordered_json;

/// Rounded, so that changes of unit leave no tail of nines; zero has no sign; null for what is not finite.
Json number(double value, treadmark::Digits digits = treadmark::Digits::twelve);
Json numbers(std::span<const double> values, treadmark::Digits digits = treadmark::Digits::twelve);

/// Null for an empty text.
Json text_or_null(const std::string& text);

/// Characters that are none become U+FFFD. indent: blanks a level, -1: on one line.
std::string dumped(const Json& json, int indent = 1);

}  // namespace treadmark::io
