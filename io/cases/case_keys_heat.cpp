// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/shared_keys.hpp"

namespace treadmark::io {

namespace {

template <class Content>
Thermal& heat(Content& c) {
  if (!c.thermal) c.thermal.emplace();
  return *c.thermal;
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

  KeyInfo compute = key_info("heat.compute", KeyType::flag,
                             "surface temperatures (steady rolling only); any other key of [heat] asks for them too");
  compute.default_text = "false";
  list.add(compute).set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    std::visit(
        [&](auto& content) {
          if (v.flag())
            heat(content);
          else
            content.thermal.reset();
        },
        c.content);
  };
}

}  // namespace treadmark::io
