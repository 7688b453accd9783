// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/shared_keys.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

using Kind = FrictionLaw::Kind;
constexpr KeyLimits kFriction{{}, 1e-4, kMostFriction}, kFrictionChange{{}, -kMostFriction, kMostFriction};
const std::vector<std::pair<std::string, Kind>> kLaws{{"coulomb", Kind::coulomb},
                                                      {"linear", Kind::linear},
                                                      {"rational", Kind::rational},
                                                      {"exponential", Kind::exponential},
                                                      {"temperature", Kind::temperature}};

void add_one_law(KeyList& list) {
  shared_choice<Kind>(list, "friction.law", kLaws,
                      "constant friction, friction that falls with the slip velocity, or that depends on the surface "
                      "temperature",
                      [](auto& c) -> Kind& { return c.friction.kind; });
  shared_number(list, "friction.coefficient", kFriction,
                "coefficient of friction; of falling laws the limit at high slip velocity",
                [](auto& c) -> double& { return c.friction.kinetic; });
  shared_number(list, "friction.amplitude_1", kFrictionChange, "first falling term at rest, added to the coefficient",
                [](auto& c) -> double& { return c.friction.amplitude_1; });
  shared_number(list, "friction.half_velocity_1_m_s", kNotNegative, "slip velocity at which the first term is halved",
                [](auto& c) -> double& { return c.friction.half_velocity_1; });
  shared_number(list, "friction.amplitude_2", kFrictionChange, "second falling term at rest",
                [](auto& c) -> double& { return c.friction.amplitude_2; });
  shared_number(list, "friction.half_velocity_2_m_s", kNotNegative, "slip velocity at which the second term is halved",
                [](auto& c) -> double& { return c.friction.half_velocity_2; });
  shared_number(list, "friction.memory_distance_mm", kNotNegative, "sliding distance over which friction adapts",
                [](auto& c) -> double& { return c.friction.memory_distance; });
  shared_number(list, "friction.memory_velocity_mm_s", kNotNegative, "least slip velocity in the memory",
                [](auto& c) -> double& { return c.friction.memory_velocity; });
  shared_number(list, "friction.reference_temperature_C", kAnyNumber, "temperature: up to here the coefficient holds",
                [](auto& c) -> double& { return c.friction.reference_temperature; });
  shared_number(list, "friction.temperature_change", kFrictionChange,
                "temperature: change of the coefficient of friction over the range",
                [](auto& c) -> double& { return c.friction.temperature_change; });
  shared_number(list, "friction.temperature_range_K", kPositive,
                "temperature: range over which friction changes linearly",
                [](auto& c) -> double& { return c.friction.temperature_range; });
}

/// Keys of one law in a list of laws; law: Element& -> FrictionLaw&.
template <class Element, class Law>
std::vector<ElementKey<Element>> law_keys(Law law) {
  KeyInfo kind = key_info("law", KeyType::choice, "as friction.law");
  for (const auto& one : kLaws) kind.choices.push_back(one.first);
  kind.default_text = "\"coulomb\"";
  std::vector<ElementKey<Element>> keys{{kind,
                                         [law](Element& e, const CaseValue& v) {
                                           for (const auto& [word, value] : kLaws)
                                             if (word == v.text()) law(e).kind = value;
                                         },
                                         {},
                                         [law](const Element& e) {
                                           for (const auto& [word, value] : kLaws)
                                             if (law(const_cast<Element&>(e)).kind == value) return toml_text(word);
                                           return std::string();
                                         }}};
  const auto add = [&](const std::string& name, KeyLimits limits, double FrictionLaw::*member) {
    const auto place = [law, member](Element& e) -> double& { return law(e).*member; };
    keys.push_back(element_number<Element>(name, limits, "as friction." + name, place));
  };
  add("coefficient", kFriction, &FrictionLaw::kinetic);
  keys.back().info.required = true;
  add("amplitude_1", kFrictionChange, &FrictionLaw::amplitude_1);
  add("half_velocity_1_m_s", kNotNegative, &FrictionLaw::half_velocity_1);
  add("amplitude_2", kFrictionChange, &FrictionLaw::amplitude_2);
  add("half_velocity_2_m_s", kNotNegative, &FrictionLaw::half_velocity_2);
  add("memory_distance_mm", kNotNegative, &FrictionLaw::memory_distance);
  add("memory_velocity_mm_s", kNotNegative, &FrictionLaw::memory_velocity);
  add("reference_temperature_C", kAnyNumber, &FrictionLaw::reference_temperature);
  add("temperature_change", kFrictionChange, &FrictionLaw::temperature_change);
  add("temperature_range_K", kPositive, &FrictionLaw::temperature_range);
  return keys;
}

void add_rows(KeyList& list) {
  KeyInfo rows =
      key_info("friction.rows", KeyType::table_list, "a law of its own for each row of elements, from the lowest y");
  rows.scope = KeyScope::patch;
  add_list<FrictionLaw, BasicCase>(list, std::move(rows),
                                   law_keys<FrictionLaw>([](FrictionLaw& f) -> FrictionLaw& { return f; }),
                                   [](BasicCase& c, bool) { return &c.friction_of_row; });
}

/// One entry of a FrictionVariation.
struct FrictionSet {
  double position = 0.0;
  FrictionLaw law;
};

std::vector<FrictionSet> sets_of(const FrictionVariation& v) {
  std::vector<FrictionSet> sets;
  for (std::size_t i = 0; i < v.positions.size(); ++i) sets.push_back({v.positions[i], v.laws.at(i)});
  return sets;
}

void put_sets(WheelRailCase& c, FrictionVariation::Kind kind, const std::vector<FrictionSet>& sets) {
  c.friction_variation = {};
  if (sets.empty()) return;
  c.friction_variation.kind = kind;
  for (const FrictionSet& one : sets) {
    c.friction_variation.positions.push_back(one.position);
    c.friction_variation.laws.push_back(one.law);
  }
  c.friction = sets.front().law;
}

void add_variation(KeyList& list, const std::string& name, FrictionVariation::Kind kind, std::string doc,
                   std::vector<ElementKey<FrictionSet>> keys) {
  KeyInfo info = key_info("friction." + name, KeyType::table_list, std::move(doc));
  info.scope = KeyScope::wheel_rail;
  info.group = "friction variation";
  info.alternative = name;
  for (auto& key : law_keys<FrictionSet>([](FrictionSet& s) -> FrictionLaw& { return s.law; }))
    keys.push_back(std::move(key));
  for (const auto& key : keys) info.elements.push_back(key.info);
  const std::string path = info.path;
  CaseKey& added = list.add(std::move(info));
  added.set = [keys, kind](Case& c, const CaseValue& v, const std::filesystem::path&) {
    put_sets(content_of<WheelRailCase>(c), kind, make_elements(keys, v));
  };
  added.set_element = [keys, kind, path](Case& c, std::size_t index, const CaseTable& entries,
                                         const SourcePosition& where) {
    auto& content = content_of<WheelRailCase>(c);
    std::vector<FrictionSet> sets;
    if (content.friction_variation.kind == kind) sets = sets_of(content.friction_variation);
    change_element(keys, &sets, path, index, entries, where);
    put_sets(content, kind, sets);
  };
  added.written = [keys, kind](const Case& c, const std::filesystem::path&) {
    const FrictionVariation& v = std::get<WheelRailCase>(c.content).friction_variation;
    return v.kind == kind ? written_elements(keys, sets_of(v)) : std::string();
  };
}

}  // namespace

void add_friction_keys(KeyList& list) {
  add_one_law(list);
  add_rows(list);
  using Variation = FrictionVariation::Kind;
  const std::string order = ", increasing from set to set";
  add_variation(
      list, "by_inclination", Variation::inclination,
      "friction that varies with the inclination of the rail, interpolated",
      element_angle<FrictionSet>("inclination", "inclination of the rail's surface" + order, &FrictionSet::position));
  add_variation(list, "along_track", Variation::along_track, "friction that varies along the track, interpolated",
                {required(element_number<FrictionSet>("s_mm", kAnyNumber, "position along the track" + order,
                                                      &FrictionSet::position))});
}

}  // namespace treadmark::io
