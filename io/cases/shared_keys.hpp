// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/io/cases/key_builder.hpp"

namespace treadmark::io {

/// A key that both kinds of case have in a member of the same name and type.
template <class Place>
CaseKey& shared_number(KeyList& list, const std::string& path, KeyLimits limits, const std::string& doc, Place place) {
  list.number<WheelRailCase>(path, limits, doc, place);
  CaseKey& key = list.keys.back();
  key.info.scope = KeyScope::any;
  const double unit = unit_of_key(path);
  key.set = [place, unit](Case& c, const CaseValue& v, const std::filesystem::path&) {
    std::visit([&](auto& content) { place(content) = v.number() * unit; }, c.content);
  };
  key.get = [place, unit](const Case& c) {
    Case copy = c;
    return std::visit([&](auto& content) -> double { return place(content); }, copy.content) / unit;
  };
  return key;
}

template <class Place>
void shared_integer(KeyList& list, const std::string& path, const std::string& doc, Place place) {
  constexpr double kMost = 1e9;
  list.integer<WheelRailCase>(path, 0, kMost, doc, place);
  CaseKey& key = list.keys.back();
  key.info.scope = KeyScope::any;
  key.set = [place](Case& c, const CaseValue& v, const std::filesystem::path&) {
    std::visit([&](auto& content) { place(content) = static_cast<int>(v.integer()); }, c.content);
  };
}

template <class Enum, class Place>
CaseKey& shared_choice(KeyList& list, const std::string& path, std::vector<std::pair<std::string, Enum>> choices,
                       const std::string& doc, Place place) {
  list.choice<WheelRailCase, Enum>(path, choices, doc, place);
  CaseKey& key = list.keys.back();
  key.info.scope = KeyScope::any;
  key.set = [place, choices](Case& c, const CaseValue& v, const std::filesystem::path&) {
    for (const auto& one : choices)
      if (one.first == v.text()) std::visit([&](auto& content) { place(content) = one.second; }, c.content);
  };
  return key;
}

/// place: content& -> bool&.
template <class Place>
void shared_flag(KeyList& list, const std::string& path, const std::string& doc, Place place) {
  KeyInfo info = key_info(path, KeyType::flag, doc);
  WheelRailCase fresh;
  info.default_text = place(fresh) ? "true" : "false";
  list.add(info).set = [place](Case& c, const CaseValue& v, const std::filesystem::path&) {
    std::visit([&](auto& content) { place(content) = v.flag(); }, c.content);
  };
}

}  // namespace treadmark::io
