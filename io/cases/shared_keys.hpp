// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/key_builder.hpp"

namespace treadmark::io {

/// A key whose value is the name of a representation.
inline KeyInfo backend_key(std::string path, std::string doc) {
  KeyInfo key = key_info(std::move(path), KeyType::text, std::move(doc));
  key.pattern = kBackendPattern;
  key.matches = is_backend_name;
  key.like = kBackendLike;
  return key;
}

/// A key that both kinds of case have in a member of the same name and type.
template <class Place>
CaseKey& shared_number(KeyList& list, const std::string& path, KeyLimits limits, const std::string& doc, Place place) {
  WheelRailCase fresh;
  list.number_at(key_info(path, KeyType::number, doc, limits), place(fresh), [place](Case& c) -> double& {
    return std::visit([&](auto& content) -> double& { return place(content); }, c.content);
  });
  return list.keys.back();
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
  key.written = [place](const Case& c, const std::filesystem::path&) {
    return std::visit([&](auto& content) { return std::to_string(place(content)); }, const_cast<Case&>(c).content);
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
  key.written = [place, choices](const Case& c, const std::filesystem::path&) {
    const Enum value = std::visit([&](auto& content) { return place(content); }, const_cast<Case&>(c).content);
    for (const auto& one : choices)
      if (one.second == value) return toml_text(one.first);
    return std::string();
  };
  return key;
}

/// place: content& -> bool&.
template <class Place>
void shared_flag(KeyList& list, const std::string& path, const std::string& doc, Place place) {
  KeyInfo info = key_info(path, KeyType::flag, doc);
  WheelRailCase fresh;
  info.default_text = place(fresh) ? "true" : "false";
  CaseKey& key = list.add(info);
  key.set = [place](Case& c, const CaseValue& v, const std::filesystem::path&) {
    std::visit([&](auto& content) { place(content) = v.flag(); }, c.content);
  };
  key.text = [place](const Case& c) {
    return std::visit([&](auto& content) { return std::string(place(content) ? "true" : "false"); },
                      const_cast<Case&>(c).content);
  };
}

/// Key of the tables in a list such as wheel.flats.
template <class Element>
struct ElementKey {
  KeyInfo info;
  KeyFunction<void(Element&, const CaseValue&)> set;
  /// table_list only: changes one key of one of its tables; rest is "number.key".
  KeyFunction<void(Element&, std::string_view rest, const CaseEntry&)> set_nested = {};
  /// As SettingKey::written.
  KeyFunction<std::string(const Element&)> written = {};
};

/// One table of a list as TOML, inline; of several ways to say the same the shortest one. What is as in a fresh element
/// is left out.
template <class Element>
std::string written_element(const std::vector<ElementKey<Element>>& keys, const Element& e) {
  struct Said {
    const KeyInfo* key;
    std::string text;
  };
  std::vector<Said> all;
  const Element fresh{};
  for (const auto& key : keys) {
    const std::string value = key.written ? key.written(e) : "";
    if (value.empty() || (!key.info.required && key.written(fresh) == value)) continue;
    const std::string text = key.info.path + " = " + value;
    const auto other = ranges::find_if(all, [&](const Said& s) {
      return !key.info.group.empty() && s.key->group == key.info.group && s.key->alternative != key.info.alternative;
    });
    if (other == all.end())
      all.push_back({&key.info, text});
    else if (text.size() < other->text.size())
      *other = {&key.info, text};
  }
  std::string text;
  for (const Said& said : all) text += (text.empty() ? "{ " : ", ") + said.text;
  return text.empty() ? "{}" : text + " }";
}

/// A list of tables as TOML; empty text for none.
template <class Element>
std::string written_elements(const std::vector<ElementKey<Element>>& keys, const std::vector<Element>& elements) {
  std::string text;
  for (const Element& e : elements) text += (text.empty() ? "[\n  " : ",\n  ") + written_element(keys, e);
  return text.empty() ? text : text + "\n]";
}

/// place: a member of Element, or Element& -> double&.
template <class Element, class Place>
ElementKey<Element> element_number(const std::string& name, KeyLimits limits, std::string doc, Place place) {
  KeyInfo info = key_info(name, KeyType::number, std::move(doc));
  info.above = limits.above;
  info.at_least = limits.at_least;
  info.at_most = limits.at_most;
  const double unit = unit_of_key(name);
  return {std::move(info),
          [place, unit](Element& e, const CaseValue& v) { std::invoke(place, e) = v.number() * unit; },
          {},
          [place, unit](const Element& e) { return exact_text(std::invoke(place, const_cast<Element&>(e)), unit); }};
}

template <class Element>
ElementKey<Element> required(ElementKey<Element> key) {
  key.info.required = true;
  return key;
}
template <class Element>
ElementKey<Element> with_default(ElementKey<Element> key, const std::string& text) {
  key.info.default_text = text;
  return key;
}

/// Keys base_deg and base_rad, that exclude each other; 0 without them.
template <class Element>
std::vector<ElementKey<Element>> element_angle(const std::string& base, const std::string& doc,
                                               double Element::*member) {
  std::vector<ElementKey<Element>> keys;
  for (const char* unit : {"_deg", "_rad"}) {
    keys.push_back(with_default(element_number<Element>(base + unit, kAnyNumber, doc, member), "0"));
    keys.back().info.group = base;
    keys.back().info.alternative = keys.back().info.path;
  }
  return keys;
}

/// Applies entries that have been checked to one table of a list; an entry's key may lead on into a nested list
/// ("waves.1.phase_deg").
template <class Element>
void fill_element(const std::vector<ElementKey<Element>>& keys, Element& e, const CaseTable& entries) {
  for (const auto& key : keys)
    for (const CaseEntry& entry : entries) {
      if (entry.key == key.info.path)
        key.set(e, entry.value);
      else if (key.set_nested && entry.key.starts_with(key.info.path + '.'))
        key.set_nested(e, std::string_view(entry.key).substr(key.info.path.size() + 1), entry);
    }
}

template <class Element>
std::vector<Element> make_elements(const std::vector<ElementKey<Element>>& keys, const CaseValue& list) {
  std::vector<Element> fresh;
  for (const CaseValue& one : list.list()) fill_element(keys, fresh.emplace_back(), one.table());
  return fresh;
}

/// elements may be nullptr: there is no such list.
template <class Element>
void change_element(const std::vector<ElementKey<Element>>& keys, std::vector<Element>* elements,
                    const std::string& path, std::size_t index, const CaseTable& entries, const SourcePosition& where) {
  const std::size_t count = elements == nullptr ? 0 : elements->size();
  if (index >= count)
    throw Error(ErrorKind::configuration,
                fmt::format("{} has {} entries, number {} (counted from 0) does not exist", path, count, index), where);
  fill_element(keys, (*elements)[index], entries);
}

/// A list of tables within the tables of a list.
template <class Element, class Nested>
ElementKey<Element> element_list(std::string name, std::string doc, std::vector<ElementKey<Nested>> keys,
                                 std::vector<Nested> Element::*member) {
  KeyInfo info = key_info(std::move(name), KeyType::table_list, std::move(doc));
  info.required = true;
  for (const auto& key : keys) info.elements.push_back(key.info);
  const KeyInfo shared = info;
  return {std::move(info), [keys, member](Element& e, const CaseValue& v) { e.*member = make_elements(keys, v); },
          [keys, member, shared](Element& e, std::string_view rest, const CaseEntry& entry) {
            const ElementPath place = split_element_path(shared, rest, entry.key_where);
            change_element(keys, &(e.*member), shared.path, place.index, {{place.key, entry.key_where, entry.value}},
                           entry.key_where);
          },
          [keys, member](const Element& e) { return written_elements(keys, e.*member); }};
}

/// Adds a key for a list of tables; elements(c, create) is the vector in the case or nullptr, made ready for a new list
/// if create.
template <class Element, class Content = WheelRailCase, class Elements>
void add_list(KeyList& list, KeyInfo info, std::vector<ElementKey<Element>> keys, Elements elements) {
  for (const auto& key : keys) info.elements.push_back(key.info);
  const std::string path = info.path;
  CaseKey& added = list.add(std::move(info));
  added.set = [keys, elements](Case& c, const CaseValue& v, const std::filesystem::path&) {
    std::vector<Element> fresh = make_elements(keys, v);
    *elements(content_of<Content>(c), true) = std::move(fresh);
  };
  added.set_element = [keys, elements, path](Case& c, std::size_t index, const CaseTable& entries,
                                             const SourcePosition& where) {
    change_element(keys, elements(content_of<Content>(c), false), path, index, entries, where);
  };
  added.written = [keys, elements](const Case& c, const std::filesystem::path&) {
    const std::vector<Element>* all = elements(content_of<Content>(const_cast<Case&>(c)), false);
    return all == nullptr ? std::string() : written_elements(keys, *all);
  };
}

/// Keys of an arc in a chain: length and curvature or radius.
template <class Segment>
std::vector<ElementKey<Segment>> arc_keys() {
  auto length = required(element_number<Segment>("length_mm", kPositive, "arc length", &Segment::length));
  auto curvature = with_default(
      element_number<Segment>("curvature_per_m", kAnyNumber,
                              "curvature, positive bends towards +z (down); 0 = straight", &Segment::curvature),
      "0");
  KeyInfo radius = key_info("radius_mm", KeyType::number, "radius instead of the curvature, with its sign");
  radius.group = curvature.info.group = "curvature";
  radius.alternative = "radius";
  curvature.info.alternative = "curvature";
  const auto set_radius = [](Segment& s, const CaseValue& v) {
    if (v.number() == 0.0)
      throw Error(ErrorKind::configuration, "radius_mm must not be 0", v.where,
                  "use curvature_per_m = 0 for a straight line");
    s.curvature = 1.0 / (v.number() * unit_of_key("radius_mm"));
  };
  return {length, curvature, {radius, set_radius}};
}

}  // namespace treadmark::io
