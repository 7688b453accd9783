// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/combination_rules.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

namespace treadmark::io {

namespace {

constexpr double kDissimilar = 1e-4;
constexpr double kSameStep = 0.01;       // relative difference of dq and dx that counts as none
constexpr double kAngleTolerance = 1e-6;   // [rad]
constexpr double kMostPoints = 2e7;

bool viscoelastic(const Material& m) { return m.creep_ratio_1 > 0.0 || m.creep_ratio_2 > 0.0; }
bool rolling(RegimeInput r) { return r == RegimeInput::transient || r == RegimeInput::steady; }
/// Rolling along +x or -x.
bool along_rows(double chi) { return std::abs(std::sin(chi)) < kAngleTolerance; }

class Rules {
 public:
  void of(const WheelRailCase& c) {
    const double difference = combine(c.material).difference;
    if (c.regime != RegimeInput::none && std::abs(difference) >= kDissimilar)
      add(CaseSetting::elastic_constants,
          fmt::format("dissimilar materials (K = {:.3g}) couple the normal and the tangential problem, which is not supported for a "
                      "wheel on a rail", difference),
          "without a tangential problem they are possible");
    if (c.material.layer_yield > 0.0)
      add(CaseSetting::layer, fmt::format("plasticity of the interface layer (yield stress {} MPa) is not supported for a wheel on a rail",
                                          c.material.layer_yield * 1e-6),
          "TAU_C0 = 0 or > 1e10 makes the layer purely elastic");
  }

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

  std::vector<Contradiction> found;

 private:
  void add(CaseSetting setting, std::string message, std::string advice = {}) {
    found.push_back({setting, std::move(message), std::move(advice)});
  }
  void refuse_if(bool bad, CaseSetting setting, std::string message, std::string advice = {}) {
    if (bad) add(setting, std::move(message), std::move(advice));
  }

  void regime(const BasicCase& c) {
    refuse_if(c.regime == RegimeInput::steady && !along_rows(c.chi), CaseSetting::regime,
              fmt::format("steady rolling in direction {:.6g} rad is not supported", c.chi),
              "0 and pi (180 degrees) are; transient rolling takes any direction");
  }

  void normal_model(const BasicCase& c) {
    using Model = NormalModelInput;
    using Given = HertzInput::Given;
    const auto* hertz = std::get_if<HertzInput>(&c.geometry);
    const bool sdec_geometry = hertz != nullptr && hertz->given == Given::semi_double_elliptic;
    const bool assumed = c.normal_model == Model::elliptic || c.normal_model == Model::parabolic;
    refuse_if(assumed && hertz == nullptr, CaseSetting::normal_model, "elliptic and parabolic pressures need Hertzian geometry",
              "IPOTCN < 0 in .inp, [patch.hertz] in .toml");
    refuse_if((c.normal_model == Model::semi_double_elliptic) != sdec_geometry, CaseSetting::normal_model,
              "semi-double-elliptic pressure (SDEC) and semi-double-elliptic geometry need each other",
              "B = 4 and IPOTCN = -6 in .inp, normal_model and hertz.given = \"semi_double_elliptic\" in .toml");
    const bool approximate = c.normal_model == Model::kpec || c.normal_model == Model::analyn;
    const std::string name = c.normal_model == Model::kpec ? "KPEC" : "ANALYN";
    refuse_if(approximate && c.normal_force_prescribed, CaseSetting::load, name + " needs a prescribed approach, but the normal force is given",
              "N = 0 in .inp, patch.approach_mm in .toml");
  }

  void tangential_model(const BasicCase& c) {
    if (c.tangential_model == TangentialModelInput::full) return;
    refuse_if(c.regime == RegimeInput::shift || c.regime == RegimeInput::transient, CaseSetting::material,
              "the simplified theory (FASTSIM, FaStrip) is for steady rolling, not for a shift or transient rolling");
    refuse_if(c.tangential_model == TangentialModelInput::fastsim_one_flexibility && !(c.fastsim_flexibility > 0.0), CaseSetting::material,
              "FASTSIM with one flexibility needs that flexibility", "FLX in .inp, patch.fastsim_flexibility_mm_per_MPa in .toml");
    refuse_if(c.material.layer_yield > 0.0, CaseSetting::layer, "the simplified theory knows no plasticity of the interface layer");
    refuse_if(!c.friction_of_row.empty() || c.friction.kind == FrictionLaw::Kind::temperature, CaseSetting::friction,
              "the simplified theory knows one coefficient of friction, not one by row or by temperature");
    refuse_if(!c.extra_slip_x.empty(), CaseSetting::extra_slip, "the simplified theory takes no slip that is given for every element");
    refuse_if(c.sensitivities, CaseSetting::material, "the simplified theory gives no sensitivities");
  }

  void material(const BasicCase& c) {
    const Material& m = c.material;
    refuse_if(m.relaxation_time_1 < 0.0 || m.relaxation_time_2 < 0.0 || m.creep_ratio_1 < 0.0 || m.creep_ratio_2 < 0.0,
              CaseSetting::material, "creep ratios and relaxation times must not be negative");
    if (viscoelastic(m)) {
      refuse_if(c.regime == RegimeInput::shift || c.regime == RegimeInput::transient, CaseSetting::regime,
                "viscoelastic bodies need steady rolling or no tangential problem");
      refuse_if(c.regime != RegimeInput::none && (!along_rows(c.chi) || std::cos(c.chi) < 0.0), CaseSetting::material,
                fmt::format("viscoelastic bodies must roll in direction 0, found {:.6g} rad", c.chi));
      const double difference = combine(m).difference;
      refuse_if(std::abs(difference) >= kDissimilar, CaseSetting::elastic_constants,
                fmt::format("viscoelastic bodies must not be dissimilar (K = {:.3g})", difference));
      refuse_if(c.influence.kind != InfluenceInput::Kind::constant, CaseSetting::influence,
                "viscoelastic bodies need the half-space with constant elements");
      refuse_if(c.normal_model != NormalModelInput::full || c.tangential_model != TangentialModelInput::full, CaseSetting::material,
                "viscoelastic bodies need the full normal and tangential problem");
    }
    if (m.layer_yield > 0.0 && rolling(c.regime)) {
      refuse_if(!along_rows(c.chi), CaseSetting::layer, "a layer that yields must roll in direction 0 or pi (180 degrees)");
      refuse_if(c.dx > 0.0 && std::abs(c.dq - c.dx) > kSameStep * c.dx, CaseSetting::layer,
                fmt::format("a layer that yields needs a rolling step of one element: the step is {:.6g} mm, elements are {:.6g} mm",
                            c.dq * 1e3, c.dx * 1e3));
    }
  }

  void influence(const BasicCase& c) {
    const InfluenceInput& in = c.influence;
    using Kind = InfluenceInput::Kind;
    if (in.kind != Kind::angle_corrected && in.kind != Kind::table) return;
    const std::string name = in.kind == Kind::table ? "numerical" : "angle-corrected";
    refuse_if(c.normal_model != NormalModelInput::full, CaseSetting::influence,
              fmt::format("{} influence coefficients need the full normal problem", name),
              "the other pressures rest on the half-space");
    refuse_if(in.kind == Kind::table && in.file.empty(), CaseSetting::influence, "the file of influence coefficients is missing",
              "give influence.file");
    if (in.kind == Kind::table) return;
    refuse_if(in.position.size() != in.inclination.size() || in.position.size() < 2, CaseSetting::influence,
              fmt::format("angle-corrected influence coefficients have {} positions and {} inclinations", in.position.size(),
                          in.inclination.size()),
              "give one inclination for each position, at least two");
    const bool increasing = std::adjacent_find(in.position.begin(), in.position.end(), std::greater_equal<>()) == in.position.end();
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
              fmt::format("the rectangles of the planform have {} values, each needs 4 and two_rectangles two of them", count));
    for (std::size_t i = 0; i + 1 < count; i += 2)
      if (!(p.coefficients[i] < p.coefficients[i + 1])) return add(CaseSetting::geometry, "a rectangle of the planform has no extent");
    if (p.kind == Kind::two_rectangles) return;
    const std::size_t patches = count / 4;
    refuse_if(p.coupling.size() != patches * patches, CaseSetting::geometry,
              fmt::format("{} sub-patches need {} coupling factors", patches, patches * (patches - 1) / 2),
              "row by row above the diagonal: 1-2, 1-3, ..., 2-3, ...");
    refuse_if(c.normal_force_prescribed, CaseSetting::load, "sub-patches need a prescribed approach, but the normal force is given");
    refuse_if(c.normal_model != NormalModelInput::full, CaseSetting::normal_model, "sub-patches need the full normal problem");
  }

  void friction_and_heat(const BasicCase& c) {
    const auto thermal = [](const FrictionLaw& f) { return f.kind == FrictionLaw::Kind::temperature; };
    refuse_if(!c.thermal && (thermal(c.friction) || std::any_of(c.friction_of_row.begin(), c.friction_of_row.end(), thermal)),
              CaseSetting::friction, "friction that depends on the temperature needs the thermal data of the bodies",
              "H = 3 in .inp, [heat] in .toml");
    refuse_if(c.thermal && c.regime != RegimeInput::steady, CaseSetting::heat, "surface temperatures need steady rolling");
    refuse_if(!c.friction_of_row.empty() && c.friction_of_row.size() != static_cast<std::size_t>(c.my), CaseSetting::friction,
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
        return add(CaseSetting::subsurface, fmt::format("subsurface points lie outside the {} x {} elements", c.mx, c.my));
      if (b.z.empty() || (!b.at_elements && (b.x.empty() || b.y.empty())))
        return add(CaseSetting::subsurface, "a block of subsurface points is empty", "give depths, and x and y of free points");
      const auto share = [](std::size_t given, int all) { return static_cast<double>(given == 0 ? static_cast<std::size_t>(all) : given); };
      points += (b.at_elements ? share(b.columns.size(), c.mx) * share(b.rows.size(), c.my)
                               : static_cast<double>(b.x.size()) * static_cast<double>(b.y.size())) * static_cast<double>(b.z.size());
    }
    refuse_if(points > kMostPoints, CaseSetting::subsurface,
              fmt::format("{:.0f} subsurface points are more than {:.0f}", points, kMostPoints));
  }
};

/// Steps equal, origins a whole number of steps apart.
bool same_raster(double a0, double a_step, double b0, double b_step) {
  constexpr double kTolerance = 1e-3;   // of a step
  const double steps = (b0 - a0) / a_step;
  return std::abs(b_step - a_step) < kTolerance * a_step && std::abs(steps - std::round(steps)) < kTolerance;
}

}  // namespace

std::vector<Contradiction> contradictions(const Case& previous, const Case& next) {
  const auto *a = std::get_if<BasicCase>(&previous.content), *b = std::get_if<BasicCase>(&next.content);
  if (a == nullptr || b == nullptr) return {};
  const bool continues = b->history == HistoryInput::keep_going || b->history == HistoryInput::same_instant;
  const bool depends = b->regime == RegimeInput::shift || b->regime == RegimeInput::transient;
  // The grid of Hertzian geometry is not known before it is solved.
  const bool known = a->dx > 0.0 && a->dy > 0.0 && b->dx > 0.0 && b->dy > 0.0;
  if (!continues || !depends || !known || (same_raster(a->x0, a->dx, b->x0, b->dx) && same_raster(a->y0, a->dy, b->y0, b->dy))) return {};
  return {{CaseSetting::grid, "a case that continues the previous one needs elements of the same size, moved by whole elements",
           "start anew (P = 2 in .inp, case.history = \"start\" in .toml)"}};
}

std::vector<Contradiction> contradictions(const Case& c) {
  Rules rules;
  std::visit([&](const auto& content) { rules.of(content); }, c.content);
  return std::move(rules.found);
}

}  // namespace treadmark::io
