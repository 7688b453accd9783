// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/tables/number.hpp"

#include <cmath>

#include "treadmark/io/files/text.hpp"

namespace treadmark::io {

Json number(double value, Digits digits) {
  if (!std::isfinite(value)) return nullptr;
  return rounded(value, digits);
}

Json numbers(std::span<const double> values, Digits digits) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value, digits));
  return list;
}

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace treadmark::io
