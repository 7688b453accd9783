// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/key_builder.hpp"

namespace treadmark::io {

namespace {

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

void add_material(KeyList& list) {
  constexpr KeyLimits kPoisson{{}, 0.0, 0.5};
  const auto both = [&](const std::string& path, KeyLimits limits, const std::string& doc, auto first, auto second) {
    CaseKey& key = shared_number(list, path, limits, doc, first);
    const double unit = unit_of_key(path);
    key.set = [first, second, unit](Case& c, const CaseValue& v, const std::filesystem::path&) {
      std::visit([&](auto& content) { first(content) = second(content) = v.number() * unit; }, c.content);
    };
  };
  const auto g1 = [](auto& c) -> double& { return c.material.shear_modulus_1; };
  const auto g2 = [](auto& c) -> double& { return c.material.shear_modulus_2; };
  const auto nu1 = [](auto& c) -> double& { return c.material.poisson_1; };
  const auto nu2 = [](auto& c) -> double& { return c.material.poisson_2; };
  both("material.shear_modulus_GPa", kPositive, "shear modulus G of both bodies", g1, g2);
  both("material.poisson_ratio", kPoisson, "Poisson's ratio of both bodies", nu1, nu2);
  shared_number(list, "material.rail_shear_modulus_GPa", kPositive, "shear modulus of the rail (body 1)", g1);
  shared_number(list, "material.wheel_shear_modulus_GPa", kPositive, "shear modulus of the wheel (body 2)", g2);
  shared_number(list, "material.rail_poisson_ratio", kPoisson, "Poisson's ratio of the rail (body 1)", nu1);
  shared_number(list, "material.wheel_poisson_ratio", kPoisson, "Poisson's ratio of the wheel (body 2)", nu2);
  shared_number(list, "material.layer_flexibility_mm_per_MPa", kNotNegative,
                "thickness over shear modulus of an elastic interface layer; 0 = no layer",
                [](auto& c) -> double& { return c.material.layer_flexibility; });
}

void add_friction(KeyList& list) {
  using Kind = FrictionLaw::Kind;
  shared_choice<Kind>(list, "friction.law",
                      {{"coulomb", Kind::coulomb}, {"linear", Kind::linear}, {"rational", Kind::rational}, {"exponential", Kind::exponential}},
                      "how friction falls with the slip velocity", [](auto& c) -> Kind& { return c.friction.kind; });
  constexpr KeyLimits kFriction{{}, 1e-4, {}};
  shared_number(list, "friction.coefficient", kFriction, "coefficient of friction; of falling laws the limit at high slip velocity",
                [](auto& c) -> double& { return c.friction.kinetic; });
  shared_number(list, "friction.amplitude_1", kAnyNumber, "first falling term at rest, added to the coefficient",
                [](auto& c) -> double& { return c.friction.amplitude_1; });
  shared_number(list, "friction.half_velocity_1_m_s", kNotNegative, "slip velocity at which the first term is halved",
                [](auto& c) -> double& { return c.friction.half_velocity_1; });
  shared_number(list, "friction.amplitude_2", kAnyNumber, "second falling term at rest",
                [](auto& c) -> double& { return c.friction.amplitude_2; });
  shared_number(list, "friction.half_velocity_2_m_s", kNotNegative, "slip velocity at which the second term is halved",
                [](auto& c) -> double& { return c.friction.half_velocity_2; });
  shared_number(list, "friction.memory_distance_mm", kNotNegative, "sliding distance over which friction adapts",
                [](auto& c) -> double& { return c.friction.memory_distance; });
  shared_number(list, "friction.memory_velocity_mm_s", kNotNegative, "least slip velocity in the memory",
                [](auto& c) -> double& { return c.friction.memory_velocity; });
}

void add_solver(KeyList& list) {
  shared_number(list, "solver.tolerance", {0.0, {}, 0.1}, "relative accuracy of tractions and forces",
                [](auto& c) -> double& { return c.solver.eps; });
  shared_integer(list, "solver.max_solver_iterations", "iterations of one linear or tangential solve",
                 [](auto& c) -> int& { return c.solver.max_gs; });
  shared_integer(list, "solver.max_set_iterations", "changes of the contact, adhesion and slip areas",
                 [](auto& c) -> int& { return c.solver.max_in; });
  shared_integer(list, "solver.max_force_iterations", "iterations on prescribed total forces",
                 [](auto& c) -> int& { return c.solver.max_nr; });
  shared_integer(list, "solver.max_outer_iterations", "alternations of the normal and the tangential problem",
                 [](auto& c) -> int& { return c.solver.max_out; });
}

}  // namespace

void add_general_keys(KeyList& list) {
  CaseKey& regime = shared_choice<RegimeInput>(
      list, "case.regime", {{"none", RegimeInput::none}, {"shift", RegimeInput::shift}, {"steady", RegimeInput::steady}},
      "tangential problem: none, one shift (patch only), or steady rolling; a [patch] starts from \"none\"",
      [](auto& c) -> RegimeInput& { return c.regime; });
  regime.info.default_text = "\"steady\"";
  add_material(list);
  add_friction(list);
  add_solver(list);
}

}  // namespace treadmark::io
