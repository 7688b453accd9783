// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/backend_name.hpp"
#include "treadmark/io/cases/case_keys.hpp"

namespace treadmark::io {

/// Shorthands for the tables of keys.

inline KeyInfo key_info(std::string path, KeyType type, std::string doc) {
  KeyInfo info;
  info.path = std::move(path);
  info.type = type;
  info.doc = std::move(doc);
  return info;
}

struct KeyLimits {
  std::optional<double> above, at_least, at_most;
};
inline constexpr KeyLimits kPositive{0.0, {}, {}};
inline constexpr KeyLimits kNotNegative{{}, 0.0, {}};
inline constexpr KeyLimits kAnyNumber{};

/// Part of a Case that keys of one scope live in; Case: those of every case.
template <class Content>
Content& content_of(Case& c) {
  if constexpr (std::is_same_v<Content, Case>)
    return c;
  else
    return std::get<Content>(c.content);
}
template <class Content>
constexpr KeyScope scope_of() {
  return std::is_same_v<Content, Case>            ? KeyScope::any
         : std::is_same_v<Content, WheelRailCase> ? KeyScope::wheel_rail
                                                  : KeyScope::patch;
}

/// The numbers of a list that has been checked, in SI units.
inline std::vector<double> numbers_of(const CaseValue& list, double unit) {
  std::vector<double> numbers;
  for (const CaseValue& one : list.list()) numbers.push_back(one.number() * unit);
  return numbers;
}

/// A list of keys under construction.
class KeyList {
 public:
  std::vector<CaseKey> keys;

  CaseKey& add(KeyInfo info) {
    keys.push_back({std::move(info), {}, {}, {}});
    return keys.back();
  }

  /// place: Content& -> double&.
  template <class Content, class Place>
  KeyInfo& number(std::string path, KeyLimits limits, std::string doc, Place place) {
    KeyInfo info = key_info(path, KeyType::number, std::move(doc));
    info.above = limits.above;
    info.at_least = limits.at_least;
    info.at_most = limits.at_most;
    info.scope = scope_of<Content>();
    const double unit = unit_of_key(path);
    Content fresh;
    info.default_text = fmt::format("{:.10g}", place(fresh) / unit);
    CaseKey& key = add(std::move(info));
    key.set = [place, unit](Case& c, const CaseValue& v, const std::filesystem::path&) {
      place(content_of<Content>(c)) = v.number() * unit;
    };
    key.get = [place, unit](const Case& c) {
      Case copy = c;
      return place(content_of<Content>(copy)) / unit;
    };
    return key.info;
  }

  /// place: Content& -> std::vector<double>&.
  template <class Content, class Place>
  KeyInfo& number_list(std::string path, std::string doc, Place place) {
    KeyInfo info = key_info(path, KeyType::number_list, std::move(doc));
    info.scope = scope_of<Content>();
    CaseKey& key = add(std::move(info));
    key.set = [place, unit = unit_of_key(path)](Case& c, const CaseValue& v, const std::filesystem::path&) {
      place(content_of<Content>(c)) = numbers_of(v, unit);
    };
    return key.info;
  }

  /// Two keys, base_deg and base_rad, that exclude each other.
  template <class Content, class Place>
  void angle(const std::string& base, KeyLimits limits_deg, const std::string& doc, Place place) {
    for (const std::string unit : {"deg", "rad"}) {
      KeyInfo& info = number<Content>(base + '_' + unit, limits_deg, doc, place);
      const double factor = unit == "rad" ? unit_of_key("x_deg") : 1.0;
      for (auto* limit : {&info.above, &info.at_least, &info.at_most})
        if (*limit) *limit = **limit * factor;
      info.group = base;
      info.alternative = unit;
    }
  }

  template <class Content, class Place>
  KeyInfo& integer(std::string path, double least, double most, std::string doc, Place place) {
    KeyInfo info = key_info(std::move(path), KeyType::integer, std::move(doc));
    info.at_least = least;
    info.at_most = most;
    info.scope = scope_of<Content>();
    Content fresh;
    info.default_text = std::to_string(place(fresh));
    CaseKey& key = add(std::move(info));
    key.set = [place](Case& c, const CaseValue& v, const std::filesystem::path&) {
      place(content_of<Content>(c)) = static_cast<int>(v.integer());
    };
    return key.info;
  }

  /// choices: word and enumerator.
  template <class Content, class Enum, class Place>
  KeyInfo& choice(std::string path, std::vector<std::pair<std::string, Enum>> choices, std::string doc, Place place) {
    KeyInfo info = key_info(std::move(path), KeyType::choice, std::move(doc));
    info.scope = scope_of<Content>();
    Content fresh;
    for (const auto& [word, value] : choices) {
      info.choices.push_back(word);
      if (place(fresh) == value) info.default_text = '"' + word + '"';
    }
    CaseKey& key = add(std::move(info));
    key.set = [place, choices](Case& c, const CaseValue& v, const std::filesystem::path&) {
      for (const auto& [word, value] : choices)
        if (word == v.text()) place(content_of<Content>(c)) = value;
    };
    return key.info;
  }
};

/// tangential_model and the fastsim_... keys under prefix.
template <class Content>
void add_simplified_theory(KeyList& list, const std::string& prefix) {
  using T = TangentialModelInput;
  list.choice<Content, T>(prefix + "tangential_model",
                          {{"full", T::full},
                           {"fastsim", T::fastsim},
                           {"fastsim_one_flexibility", T::fastsim_one_flexibility},
                           {"fastrip", T::fastrip}},
                          "tractions: exact theory, FASTSIM with three flexibilities or with one, or FaStrip",
                          [](Content& c) -> T& { return c.tangential_model; });
  list.number<Content>(prefix + "fastsim_k0", kPositive, "FASTSIM: initial slope reduction",
                       [](Content& c) -> double& { return c.fastsim_k0; });
  list.number<Content>(prefix + "fastsim_alpha", kNotNegative, "FASTSIM: slope at large creepage over the initial one",
                       [](Content& c) -> double& { return c.fastsim_alpha; });
  list.number<Content>(prefix + "fastsim_beta", kNotNegative, "FASTSIM: rate of the slope reduction",
                       [](Content& c) -> double& { return c.fastsim_beta; });
  list.number<Content>(prefix + "fastsim_flexibility_mm_per_MPa", kPositive,
                       "flexibility of \"fastsim_one_flexibility\"",
                       [](Content& c) -> double& { return c.fastsim_flexibility; });
}

/// Keys by subject; see the .cpp of the same name.
void add_general_keys(KeyList& list);
void add_material_keys(KeyList& list);
void add_friction_keys(KeyList& list);
void add_shape_keys(KeyList& list);
void add_part_keys(KeyList& list);
void add_defect_keys(KeyList& list);
void add_wheel_rail_keys(KeyList& list);
void add_balance_keys(KeyList& list);
void add_patch_keys(KeyList& list);
void add_patch_geometry_keys(KeyList& list);
void add_heat_keys(KeyList& list);
void add_subsurface_keys(KeyList& list);

}  // namespace treadmark::io
