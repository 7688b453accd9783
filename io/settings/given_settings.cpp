// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/given_settings.hpp"

#include <fmt/format.h>

namespace treadmark::io {

GivenSettings given_settings(std::span<const std::string> assignments) {
  GivenSettings given;
  for (const std::string& assignment : assignments)
    if (CaseOverride one = parse_override(assignment); one.path.find('.') != std::string::npos)
      given.overrides.push_back(assignment);
    else
      given.settings.push_back(std::move(one));
  return given;
}

CaseValue checked_value(const KeyInfo& key, const CaseOverride& given) {
  CaseValue value = given.value;
  // "60E1" and "1:40" look like numbers to some
  const bool as_written = key.type == KeyType::text || (key.type == KeyType::value_list && !value.is_list());
  if (as_written && !std::holds_alternative<std::string>(value.data)) value.data = given.raw;
  check_value(key, value);
  return value;
}

void refuse_unknown_setting(const CaseOverride& given, const TableKeys& known) {
  std::vector<std::string> names;
  for (const KeyInfo& key : known) names.push_back(key.path);
  const std::string nearest = nearest_key(given.path, names);
  throw Error(ErrorKind::configuration, fmt::format("there is no setting '{}'", given.path.substr(0, 100)),
              given.value.where,
              nearest.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                              : fmt::format("did you mean '{}'?", nearest));
}

}  // namespace treadmark::io
