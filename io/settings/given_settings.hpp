// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/settings/key_rows.hpp"

namespace treadmark::io {

/// What a verb is asked for, by a program or on the command line: some of its settings, and changes of the keys of a
/// case. The settings of a verb are a KeyTable of its request: options of the command line, texts "key=value" of C and
/// keywords of Python come from it.
struct GivenSettings {
  std::vector<CaseOverride> settings;
  std::vector<std::string> overrides;
};

/// From texts "key=value"; a key with a point is one of the case. Errors: those of parse_override.
GivenSettings given_settings(std::span<const std::string> assignments);

/// The value that was given for a key. Errors: Error(configuration) for one that makes no sense.
CaseValue checked_value(const KeyInfo& key, const CaseOverride& given);
[[noreturn]] void refuse_unknown_setting(const CaseOverride& given, const TableKeys& known);

/// Errors: Error(configuration) for keys that there are not, too.
template <class Request>
void set_given(Request& request, const KeyTable<Request>& keys, const GivenSettings& given) {
  for (const CaseOverride& one : given.settings) {
    const auto key =
        ranges::find_if(keys.rows, [&](const SettingKey<Request>& row) { return row.info.path == one.path; });
    if (key == keys.rows.end()) refuse_unknown_setting(one, keys.infos);
    key->set(request, checked_value(key->info, one), {});
  }
  request.overrides = given.overrides;
}

/// What a request has other than the usual one: "roll = \"free\", step_mm = 0.2". left_out: marks of keys that do not
/// count.
template <class Request>
std::string settings_text(const KeyTable<Request>& keys, const Request& request, const Request& usual,
                          unsigned left_out = 0) {
  std::string text;
  for (const SettingKey<Request>& key : keys.rows)
    if (const std::string line = written_line(key, request);
        (key.factors & left_out) == 0 && line != written_line(key, usual))
      text += (text.empty() ? "" : ", ") + line;
  return text.empty() ? "all by default" : text;
}

}  // namespace treadmark::io
