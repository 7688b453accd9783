// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/cases/shared_keys.hpp"

namespace treadmark::io {

namespace {

using B = BasicCase;

/// Keys of both bodies at once: files are written body by body.
std::string only_one_by_one(const Case&, const std::filesystem::path&) { return {}; }

void add_elastic(KeyList& list) {
  constexpr KeyLimits kPoisson{{}, 0.0, 0.5};
  const auto both = [&](const std::string& path, KeyLimits limits, const std::string& doc, auto first, auto second) {
    CaseKey& key = shared_number(list, path, limits, doc, first);
    const double unit = unit_of_key(path);
    key.set = [first, second, unit](Case& c, const CaseValue& v, const std::filesystem::path&) {
      std::visit([&](auto& content) { first(content) = second(content) = v.number() * unit; }, c.content);
    };
    key.written = only_one_by_one;
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
                "thickness over shear modulus of an interface layer: its elastic tangential flexibility",
                [](auto& c) -> double& { return c.material.layer_flexibility; });
}

void add_beyond_elastic(KeyList& list) {
  shared_number(list, "material.layer_yield_MPa", kNotNegative,
                "shear stress at which the interface layer yields; 0 = never",
                [](auto& c) -> double& { return c.material.layer_yield; });
  shared_number(list, "material.layer_hardening_MPa_per_mm", kAnyNumber,
                "change of that stress with the distance of plastic shear; negative = softening, down to a tenth",
                [](auto& c) -> double& { return c.material.layer_hardening; });
  shared_number(list, "material.sheet_flexibility_mm_per_MPa", kNotNegative,
                "normal flexibility of a thin compressible sheet; 0 = none",
                [](auto& c) -> double& { return c.material.sheet_flexibility; });

  const auto pair = [&](const std::string& name, const std::string& doc, double Material::*rail,
                        double Material::*wheel) {
    const auto place = [](double Material::*member) {
      return [member](auto& c) -> double& { return c.material.*member; };
    };
    CaseKey& key = shared_number(list, "material." + name, kNotNegative, doc + " of both bodies", place(rail));
    key.set = [rail, wheel](Case& c, const CaseValue& v, const std::filesystem::path&) {
      std::visit([&](auto& content) { content.material.*rail = content.material.*wheel = v.number(); }, c.content);
    };
    key.written = only_one_by_one;
    shared_number(list, "material.rail_" + name, kNotNegative, doc + " of body 1", place(rail));
    shared_number(list, "material.wheel_" + name, kNotNegative, doc + " of body 2", place(wheel));
  };
  pair("creep_ratio", "viscoelastic (standard linear solid, 0 = elastic): delayed over immediate compliance",
       &Material::creep_ratio_1, &Material::creep_ratio_2);
  pair("relaxation_time_s", "viscoelastic: relaxation time", &Material::relaxation_time_1,
       &Material::relaxation_time_2);
}

void add_influence(KeyList& list) {
  using Kind = InfluenceSettings::Kind;
  shared_choice<Kind>(
      list, "influence.kind", words_of<Case>(kInfluenceKinds),
      "influence coefficients: half-space with constant or bilinear tractions on an element, corrected for the "
      "inclination of the surface (wheel on rail: of the curved reference), or numerical ones from a file (patch only)",
      [](auto& c) -> Kind& { return c.influence.kind; });
  list.number_list<B>("influence.position_mm", "angle_corrected, patch only: positions along y, increasing",
                      [](B& c) -> std::vector<double>& { return c.influence.position; });
  for (const std::string unit : {"deg", "rad"}) {
    KeyInfo& info = list.number_list<B>("influence.inclination_" + unit,
                                        "angle_corrected, patch only: inclination of the surface at these positions",
                                        [](B& c) -> std::vector<double>& { return c.influence.inclination; });
    info.group = "influence inclination";
    info.alternative = unit;
  }
  shared_choice<bool>(list, "influence.inclination_fit", {{"line", true}, {"table", false}},
                      "angle_corrected: one straight line through the inclinations, or the table as it is",
                      [](auto& c) -> bool& { return c.influence.linear; });
  list.integer<Case>("influence.variant", 1, 4,
                     "angle_corrected: what is turned by the difference of inclinations: 1 tractions, 2 the same but "
                     "for their effect in x, 3 "
                     "displacements, 4 half of it each",
                     [](Case& c) -> int& {
                       return std::visit([](auto& content) -> int& { return content.influence.variant; }, c.content);
                     });
  KeyInfo file = key_info("influence.file", KeyType::path,
                          "table: file of numerical influence coefficients, relative to the case file");
  file.scope = KeyScope::patch;
  CaseKey& table = list.add(file);
  table.set = [](Case& c, const CaseValue& v, const std::filesystem::path& folder) {
    content_of<B>(c).influence.file = (folder / v.text()).lexically_normal();
  };
  table.written = [](const Case& c, const std::filesystem::path& folder) {
    return written_path(std::get<B>(c.content).influence.file, folder);
  };
}

}  // namespace

void add_material_keys(KeyList& list) {
  add_elastic(list);
  add_beyond_elastic(list);
  add_influence(list);
}

namespace {

template <class Content>
Thermal& heat(Content& c) {
  if (!c.thermal) c.thermal.emplace();
  return *c.thermal;
}

bool has_heat(const Case& c) {
  return std::visit([](const auto& content) { return content.thermal.has_value(); }, c.content);
}

/// Behind the keys of heat, for it changes what they have made.
void add_reference_ways(KeyList& list) {
  KeyInfo info =
      key_info("case.reference_ways", KeyType::flag,
               "details as the reference program (CONTACT) has them, as in its input files: spin moments of "
               "grids that are aligned in time, transient steps of more than two elements, temperatures; of a "
               "[patch] also KPEC, ANALYN and sub-patches");
  info.default_text = "false";
  CaseKey& key = list.add(info);
  key.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    std::visit(
        [ways = Conventions{v.flag()}](auto& content) {
          if (content.thermal) content.thermal->conventions = ways;
          content.conventions = ways;
        },
        c.content);
  };
  key.text = [](const Case& c) {
    const auto ways = [](auto& content) {
      return content.conventions == Conventions::contact ||
             (content.thermal && content.thermal->conventions == Conventions::contact);
    };
    return std::string(std::visit(ways, c.content) ? "true" : "false");
  };
}

}  // namespace

void add_heat_keys(KeyList& list) {
  for (ThermalProperties Thermal::*body : {&Thermal::body_1, &Thermal::body_2}) {
    const bool rail = body == &Thermal::body_1;
    const auto property = [&](const std::string& name, KeyLimits limits, const std::string& doc,
                              double ThermalProperties::*member) {
      shared_number(list, fmt::format("heat.{}_{}", rail ? "rail" : "wheel", name), limits,
                    fmt::format("{} of body {}", doc, rail ? 1 : 2),
                    [body, member](auto& c) -> double& { return heat(c).*body.*member; });
      say_only_where(list.keys.back(), has_heat);
    };
    property("bulk_temperature_C", kAnyNumber, "temperature far from the contact",
             &ThermalProperties::bulk_temperature);
    property("heat_capacity_J_per_kg_K", kPositive, "specific heat capacity", &ThermalProperties::heat_capacity);
    property("conductivity_W_per_m_K", kPositive, "thermal conductivity", &ThermalProperties::conductivity);
    property("density_kg_per_m3", kPositive, "density", &ThermalProperties::density);
  }
  constexpr KeyLimits kShare{{}, 0.0, 1.0};
  shared_number(list, "heat.plastic_fraction", kShare,
                "share of the plastic work of the interface layer that becomes heat",
                [](auto& c) -> double& { return heat(c).plastic_fraction; });
  say_only_where(list.keys.back(), has_heat);

  KeyInfo compute = key_info("heat.compute", KeyType::flag,
                             "surface temperatures (steady rolling only); any other key of [heat] asks for them too");
  compute.default_text = "false";
  CaseKey& wanted = list.add(compute);
  wanted.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    std::visit(
        [&](auto& content) {
          if (v.flag())
            heat(content);
          else
            content.thermal.reset();
        },
        c.content);
  };
  wanted.text = [](const Case& c) { return std::string(has_heat(c) ? "true" : "false"); };
  add_reference_ways(list);
}

}  // namespace treadmark::io
