// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

constexpr double kMegapascal = 1e6;
constexpr double kFlexibility = kMillimetre / kMegapascal;  // mm^3/N
constexpr double kHardening = kMegapascal / kMillimetre;    // N/mm^3
constexpr double kNoYield = 1e-10, kNeverYields = 1e10;     // [MPa]: outside, a layer is purely elastic

double not_negative(ContactText& text, std::string_view name) {
  const double value = text.real(name);
  if (value < 0.0) text.fail(fmt::format("{} must not be negative", name));
  return value;
}
double positive_value(ContactText& text, std::string_view name, double greatest = kInfinity) {
  const double value = text.real(name, greatest);
  if (!(value > 0.0)) text.fail(fmt::format("{} must be positive", name));
  return value;
}

ContactSequence::Layer read_layer(ContactText& text) {
  text.begin_record("the layer line GG3");
  ContactSequence::Layer layer;
  const double modulus = positive_value(text, "GG3") * kMegapascal;
  layer.flexibility = not_negative(text, "LAYTHK") * kMillimetre / modulus;
  layer.written_yield = text.real("TAU_C0");
  layer.where = text.where();
  const double hardening = text.real("K_TAU");
  if (layer.written_yield > kNoYield && layer.written_yield < kNeverYields) {
    layer.yield = layer.written_yield * kMegapascal;
    layer.hardening = hardening * kHardening;
  }
  return layer;
}

}  // namespace

void ContactReader::read_rolling() {
  text.begin_record("the rolling line CHI");
  BasicCase& b = kept.basic;
  b.chi = text.angle("CHI");
  b.dq = positive_value(text, "DQ", kMostStep / kMillimetre) * kMillimetre;
  b.velocity = positive_value(text, "VELOC", kMostSpeed / kMillimetre) * kMillimetre;
  const auto factor = text.optional_real();
  b.spin_offset_factor = factor ? *factor : 1.0 / 6.0;
  kept.has_rolling = true;
}

void ContactReader::read_influence() {
  InfluenceInput in;
  using Kind = InfluenceSettings::Kind;
  in.kind = of_contact_digit(kInfluenceKinds, (*model)["INFLCF"]);
  if (in.kind == Kind::angle_corrected) {
    text.begin_record("the line IF_METH");
    const long method = text.integer("IF_METH");
    if (method != 0 && method != 1) text.fail(fmt::format("IF_METH = {} does not exist: expected 0 or 1", method));
    in.linear = method == 0;
    const long variant = text.integer("VARIANT");
    if (variant < 1 || variant > 4) text.fail(fmt::format("VARIANT = {} does not exist: expected 1 ... 4", variant));
    in.variant = static_cast<int>(variant);
    if (module == 3) {
      const long pairs = text.integer("NN");
      if (pairs < 2) text.fail("NN must be at least 2");
      text.begin_record("the table of surface inclinations");
      for (long i = 0; i < pairs; ++i) {
        const double position = text.real("S") * kMillimetre;
        if (!in.position.empty() && !(position > in.position.back()))
          text.fail("S of the table of surface inclinations must increase");
        in.position.push_back(position);
        in.inclination.push_back(text.angle("ALPHA"));
      }
    }
  } else if (in.kind == Kind::table) {
    text.begin_record("the file of influence coefficients");
    const std::string name = text.quoted("the file name");
    if (name.empty()) text.fail("the file of influence coefficients has no name");
    in.file = resolve_name(folder, name);
  }
  kept.influence = std::move(in);
}

void ContactReader::read_material() {
  const int kind = (*model)["MATER"];
  text.begin_record("the material line POISS");
  Material& m = kept.material;
  kept.material_where = text.where();
  const auto poisson = [&](std::string_view name) {
    const double value = text.real(name);
    if (value < 0.0 || value > 0.5) text.fail(fmt::format("{} = {} lies outside 0 ... 0.5", name, value));
    return value;
  };
  m.poisson_1 = poisson("POISS1");
  m.poisson_2 = poisson("POISS2");
  m.shear_modulus_1 = positive_value(text, "GG1") * kMegapascal;
  m.shear_modulus_2 = positive_value(text, "GG2") * kMegapascal;
  kept.has_material = true;

  if ((*problem)["BOUND"] == 1) {
    text.begin_record("the line FLXZ");
    kept.sheet_flexibility = not_negative(text, "FLXZ") * kFlexibility;
  }
  if (kind == 1) {
    text.begin_record("the viscoelastic line FG1");
    ContactSequence::Viscoelastic v;
    v.creep_ratio_1 = not_negative(text, "FG1");
    v.creep_ratio_2 = not_negative(text, "FG2");
    v.relaxation_time_1 = not_negative(text, "TC1");
    v.relaxation_time_2 = not_negative(text, "TC2");
    kept.viscoelastic = v;
  } else if (const auto simplified = of_contact_digit(kTangentialTheories, kind); simplified != TangentialModel::full) {
    text.begin_record("the flexibility line of the simplified theory");
    if (simplified == TangentialModel::fastsim_one_flexibility)
      kept.simplified_flexibility = positive_value(text, "FLX") * kFlexibility;
    FastsimSettings s;
    s.first_step = FastsimSettings::FirstStep::whole;  // as Conventions::contact
    s.k0 = text.real("K0_MF");
    s.alpha = text.real("ALFAMF");
    s.beta = text.real("BETAMF");
    kept.simplified = s;
  } else if (kind == 4) {
    kept.layer = read_layer(text);
  } else if (kind >= 6) {
    throw refusal();
  }
}

void ContactReader::read_damping() {
  if (damping == 0) kept.damping.reset();
  if (damping < 2) return;
  text.begin_record("the damping line CDAMPN");
  Damping d;
  d.normal = not_negative(text, "CDAMPN");
  d.tangential = not_negative(text, "CDAMPT");
  d.max_rate_normal = not_negative(text, "DFNMAX");
  d.max_rate_tangential = not_negative(text, "DFTMAX");
  kept.damping = d;
}

void ContactReader::read_heat() {
  if ((*run)["HEAT"] != 3) return;
  constexpr double kMilli = 1e3, kPerCubicMillimetre = 1e9;
  Thermal heat;
  heat.conventions = Conventions::contact;
  for (ThermalProperties* body : {&heat.body_1, &heat.body_2}) {
    text.begin_record(body == &heat.body_1 ? "the thermal line of body 1" : "the thermal line of body 2");
    body->bulk_temperature = text.real("BKTEMP");
    body->heat_capacity = positive_value(text, "HEATCP");
    body->conductivity = positive_value(text, "LAMBDA") * kMilli;
    body->density = positive_value(text, "DENS") * kPerCubicMillimetre;
  }
  if ((*model)["MATER"] == 4) {
    text.begin_record("the line BETAPL");
    heat.plastic_fraction = text.real("BETAPL");
    if (heat.plastic_fraction < 0.0 || heat.plastic_fraction > 1.0) text.fail("BETAPL must lie in 0 ... 1");
  }
  kept.thermal = heat;
}

Material ContactReader::effective_material() {
  const int kind = (*model)["MATER"];
  if (!kept.has_material)
    fail_at(*model, "INFLCF", "keeps the material, but no earlier case has given it", "use C = 2 in the first case");
  const auto need = [&](bool given, const ControlWord& word, std::string_view keyword, std::string_view line) {
    if (!given)
      fail_at(word, keyword, fmt::format("needs the line {}, but no case has given it", line), "use C (INFLCF) = 2");
  };
  Material m = kept.material;
  if ((*problem)["BOUND"] == 1) {
    need(kept.sheet_flexibility.has_value(), *problem, "BOUND", "FLXZ");
    m.sheet_flexibility = *kept.sheet_flexibility;
  }
  if (kind == 1) {
    need(kept.viscoelastic.has_value(), *model, "MATER", "FG1");
    const auto& v = *kept.viscoelastic;
    m.creep_ratio_1 = v.creep_ratio_1;
    m.creep_ratio_2 = v.creep_ratio_2;
    m.relaxation_time_1 = v.relaxation_time_1;
    m.relaxation_time_2 = v.relaxation_time_2;
  }
  if (kind == 4) {
    need(kept.layer.has_value(), *model, "MATER", "GG3");
    m.layer_flexibility = kept.layer->flexibility;
    m.layer_yield = kept.layer->yield;
    m.layer_hardening = kept.layer->hardening;
  }
  return m;
}

void ContactReader::put_simplified_theory(TangentialModel& tangential, FastsimSettings& fastsim) const {
  tangential = of_contact_digit(kTangentialTheories, (*model)["MATER"]);
  if (tangential == TangentialModel::full) return;
  if (!kept.simplified)
    fail_at(*model, "MATER", "needs the line K0_MF, but no case has given it", "use C (INFLCF) = 2");
  fastsim = *kept.simplified;
  if (tangential != TangentialModel::fastsim_one_flexibility) return;
  if (!kept.simplified_flexibility)
    fail_at(*model, "MATER", "needs FLX, but no case has given it", "use C (INFLCF) = 2");
  fastsim.flexibility = *kept.simplified_flexibility;
}

std::optional<Thermal> ContactReader::effective_heat() const {
  const int heat = (*run)["HEAT"];
  if (heat == 0) return std::nullopt;
  if (!kept.thermal) fail_at(*run, "HEAT", "keeps the thermal data, but no earlier case has given them", "use H = 3");
  return kept.thermal;
}

}  // namespace treadmark::io
