// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/combination_rules.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/io/cases/shared_rules.hpp"

namespace treadmark::io {

namespace {

constexpr double kAngleTolerance = 1e-6;  // [rad]

/// Rolling along +x or -x.
bool along_rows(double chi) { return std::abs(std::sin(chi)) < kAngleTolerance; }

class Rules {
 public:
  void of(const BasicCase& c) {
    regime(c);
    normal_model(c);
    tangential_model(c);
    material(c);
    influence(c);
    planform(c);
    friction_and_heat(c);
    lists(c);
    subsurface(c.subsurface, c);
  }

  std::vector<Contradiction> take() { return std::move(found_.found); }

 private:
  void add(CaseSetting setting, std::string message, std::string advice = {}) {
    found_.add(setting, std::move(message), std::move(advice));
  }
  void refuse_if(bool bad, CaseSetting setting, std::string message, std::string advice = {}) {
    found_.refuse_if(bad, setting, std::move(message), std::move(advice));
  }

  void regime(const BasicCase& c) {
    refuse_if(c.regime == Regime::steady && !along_rows(c.chi), CaseSetting::regime,
              fmt::format("steady rolling in direction {:.6g} rad is not supported", c.chi),
              "0 and pi (180 degrees) are; transient rolling takes any direction");
  }

  void normal_model(const BasicCase& c) {
    const Theory<NormalModel>& model = theory(c.normal_model);
    using Given = HertzInput::Given;
    const auto* hertz = std::get_if<HertzInput>(&c.geometry);
    const bool sdec_geometry = hertz != nullptr && hertz->given == Given::semi_double_elliptic;
    refuse_if(model.limits.hertzian && hertz == nullptr, CaseSetting::normal_model,
              "elliptic and parabolic pressures need Hertzian geometry", "IPOTCN < 0 in .inp, [patch.hertz] in .toml");
    refuse_if((c.normal_model == NormalModel::semi_double_elliptic) != sdec_geometry, CaseSetting::normal_model,
              "semi-double-elliptic pressure (SDEC) and semi-double-elliptic geometry need each other",
              "B = 4 and IPOTCN = -6 in .inp, normal_model and hertz.given = \"semi_double_elliptic\" in .toml");
    refuse_if(model.limits.given_approach && c.normal_force_prescribed, CaseSetting::load,
              std::string(model.name) + " needs a prescribed approach, but the normal force is given",
              "N = 0 in .inp, patch.approach_mm in .toml");
  }

  void tangential_model(const BasicCase& c) {
    simplified_theory(found_, c, !c.friction_of_row.empty(),
                      !c.extra_slip_x.empty() || (c.spin_slip != SpinSlip::both && c.phi != 0.0));
    refuse_if(c.tangential_model == TangentialModel::fastsim_one_flexibility && !(c.fastsim.flexibility > 0.0),
              CaseSetting::material, "FASTSIM with one flexibility needs that flexibility",
              "FLX in .inp, patch.fastsim_flexibility_mm_per_MPa in .toml");
  }

  void material(const BasicCase& c) {
    viscoelastic_rules(found_, c);
    if (viscoelastic(c.material) && c.regime != Regime::frictionless)
      refuse_if(!along_rows(c.chi) || std::cos(c.chi) < 0.0, CaseSetting::material,
                fmt::format("viscoelastic bodies must roll in direction 0, found {:.6g} rad", c.chi));
    if (!(c.material.layer_yield > 0.0) || !rolling(c.regime)) return;
    refuse_if(!along_rows(c.chi), CaseSetting::layer,
              "a layer that yields must roll in direction 0 or pi (180 degrees)");
    if (c.dx > 0.0) step_of_one_element(found_, c.dq, c.dx);
  }

  void influence(const BasicCase& c) {
    const InfluenceInput& in = c.influence;
    using Kind = InfluenceSettings::Kind;
    if (!theory(in.kind).limits.full_normal) return;
    const std::string name = in.kind == Kind::table ? "numerical" : "angle-corrected";
    refuse_if(c.normal_model != NormalModel::full, CaseSetting::influence,
              fmt::format("{} influence coefficients need the full normal problem", name),
              "the other pressures rest on the half-space");
    refuse_if(in.kind == Kind::table && in.file.empty(), CaseSetting::influence,
              "the file of influence coefficients is missing", "give influence.file");
    if (in.kind == Kind::table) return;
    refuse_if(in.position.size() != in.inclination.size() || in.position.size() < 2, CaseSetting::influence,
              fmt::format("angle-corrected influence coefficients have {} positions and {} inclinations",
                          in.position.size(), in.inclination.size()),
              "give one inclination for each position, at least two");
    const bool increasing =
        std::adjacent_find(in.position.begin(), in.position.end(), std::greater_equal<>()) == in.position.end();
    refuse_if(!increasing, CaseSetting::influence, "the positions of surface inclinations must increase");
  }

  void planform(const BasicCase& c) {
    const PlanformInput& p = c.planform;
    using Kind = PlanformInput::Kind;
    if (p.kind == Kind::free) return;
    refuse_if(std::holds_alternative<HertzInput>(c.geometry), CaseSetting::geometry,
              "a restricted planform and Hertzian geometry exclude each other");
    const std::size_t count = p.coefficients.size();
    refuse_if(p.kind == Kind::quadratic && count != 6, CaseSetting::geometry,
              fmt::format("a quadratic planform has {} coefficients, it needs 6", count));
    if (p.kind == Kind::quadratic) return;
    refuse_if(p.kind == Kind::two_rectangles ? count != 8 : count == 0 || count % 4 != 0, CaseSetting::geometry,
              fmt::format("the rectangles of the planform have {} values, each needs 4 and two_rectangles two of them",
                          count));
    for (std::size_t i = 0; i + 1 < count; i += 2)
      if (!(p.coefficients[i] < p.coefficients[i + 1]))
        return add(CaseSetting::geometry, "a rectangle of the planform has no extent");
    if (p.kind == Kind::two_rectangles) return;
    const std::size_t patches = count / 4;
    refuse_if(p.coupling.size() != patches * patches, CaseSetting::geometry,
              fmt::format("{} sub-patches need {} coupling factors", patches, patches * (patches - 1) / 2),
              "row by row above the diagonal: 1-2, 1-3, ..., 2-3, ...");
    refuse_if(c.normal_model != NormalModel::full, CaseSetting::normal_model,
              "sub-patches need the full normal problem");
  }

  void friction_and_heat(const BasicCase& c) {
    temperatures(found_, c, c.friction_of_row);
    refuse_if(!c.friction_of_row.empty() && c.friction_of_row.size() != static_cast<std::size_t>(c.my),
              CaseSetting::friction,
              fmt::format("friction is given for {} rows, but there are {}", c.friction_of_row.size(), c.my));
  }

  void lists(const BasicCase& c) {
    const std::size_t elements = static_cast<std::size_t>(c.mx) * static_cast<std::size_t>(c.my);
    const std::size_t x = c.extra_slip_x.size(), y = c.extra_slip_y.size();
    refuse_if(x != y || (x != 0 && x != elements), CaseSetting::extra_slip,
              fmt::format("the extra rigid slip has {} values in x and {} in y for {} elements", x, y, elements),
              "give both components for every element");
  }

  void subsurface(const SubsurfaceInput& s, const BasicCase& c) {
    double points = 0.0;
    for (const SubsurfaceInput::Block& b : s.blocks) {
      const auto outside = [](const std::vector<int>& list, int count) {
        return std::any_of(list.begin(), list.end(), [count](int i) { return i < 0 || i >= count; });
      };
      if (b.at_elements && (outside(b.columns, c.mx) || outside(b.rows, c.my)))
        return add(CaseSetting::subsurface,
                   fmt::format("subsurface points lie outside the {} x {} elements", c.mx, c.my));
      if (b.z.empty() || (!b.at_elements && (b.x.empty() || b.y.empty())))
        return add(CaseSetting::subsurface, "a block of subsurface points is empty",
                   "give depths, and x and y of free points");
      const auto share = [](std::size_t given, int all) {
        return static_cast<double>(given == 0 ? static_cast<std::size_t>(all) : given);
      };
      points += (b.at_elements ? share(b.columns.size(), c.mx) * share(b.rows.size(), c.my)
                               : static_cast<double>(b.x.size()) * static_cast<double>(b.y.size())) *
                static_cast<double>(b.z.size());
    }
    refuse_if(points > kMostPoints, CaseSetting::subsurface,
              fmt::format("{:.0f} subsurface points are more than {:.0f}", points, kMostPoints));
  }

  RuleList found_;
};

}  // namespace

std::vector<Contradiction> contradictions(const Case& c) {
  if (const auto* rail = std::get_if<WheelRailCase>(&c.content)) return contradictions(*rail);
  Rules rules;
  rules.of(std::get<BasicCase>(c.content));
  return rules.take();
}

}  // namespace treadmark::io
