// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/validate_case.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/combination_rules.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::io {

namespace {

class Checker {
 public:
  explicit Checker(const Case& c) : whole_(c), where_(c.where), number_(c.number) {}

  void require(bool good, const std::string& message, std::string advice = {}) const {
    if (!good)
      throw Error(ErrorKind::configuration, fmt::format("case {}: {}", number_, message), where_, std::move(advice));
  }

  void surface(const SurfaceSource& s, Body which, double nominal_radius) const {
    const std::string body = body_name(which);
    const OffsetsInput& o = s.offsets;
    require(!o.file.empty() || (!o.unit && !o.deviation_unit && !o.angles_deg),
            body + ".offsets says how a table is meant, but names none", body + ".offsets.file is missing");
    if (!s.parts.empty()) return parts(s);
    shape(s, body);
    for (const WheelFlat& flat : s.defects.flats)
      require(flat.shape == WheelFlat::Shape::fresh || flat.depth > 0.0, "wheel.flats: a rounded flat needs depth_mm");
    try {
      check_defects(s.defects, which, nominal_radius);
    } catch (const Error& e) {
      throw Error(e.kind(), fmt::format("case {}: {}", number_, e.message()), where_, e.advice());
    }
  }

  void parts(const SurfaceSource& s) const {
    const auto* file = std::get_if<GeometryFile>(&s.geometry);
    require(file != nullptr && file->file.empty(), "rail.shape and rail.parts exclude each other", "give one of them");
    require(s.crossing.part == CrossingInput::Part::none, "rail.shape.crossing does not belong to rail.parts",
            "give it in the part");
    require(s.defects.empty(), "defects cannot be added to rail.parts");
    require(s.offsets.file.empty(), "a table of deviations (rail.offsets) cannot be added to rail.parts");
    for (std::size_t i = 0; i < s.parts.size(); ++i) shape(s.parts[i], fmt::format("rail.parts[{}]", i));
  }

  /// body: its name in messages.
  void shape(const SurfaceSource& s, const std::string& body) const {
    const bool part = body.ends_with(']');
    if (const auto* file = std::get_if<GeometryFile>(&s.geometry)) {
      require(!file->file.empty(), body + ".shape is missing",
              part ? "give its file, standard or arcs"
                   : fmt::format("give {0}.shape.file, {0}.shape.standard, {0}.shape.arcs or {0}.shape.solids", body));
      require(file->options.smoothing.kink_low <= file->options.smoothing.kink_high,
              body + ".shape: kink_low_deg must not exceed kink_high_deg");
    }
    if (const auto* arcs = std::get_if<ArcChain>(&s.geometry))
      require(!arcs->segments.empty(), body + ".shape.arcs is empty");
    if (const auto* given = std::get_if<SolidsInput>(&s.geometry)) {
      require(!given->solids.empty(), body + ".shape.solids is empty");
      require(given->solids.empty() || given->solids.front().use == Solid::Use::join,
              body + ".shape.solids: the first body must be joined", "there is nothing yet to cut from");
    }
    require(s.crossing.part == CrossingInput::Part::none || s.crossing.length > 0.5 * s.crossing.rounding,
            body + ": crossing_length_mm must be more than half of crossing_rounding_mm");
  }

  void friction(const FrictionLaw& f) const {
    constexpr double kSmallestFriction = 1e-4;
    if (f.kind == FrictionLaw::Kind::temperature) {
      require(f.temperature_range > 0.0, "friction.temperature_range_K must be positive");
      require(f.kinetic + f.temperature_change >= kSmallestFriction,
              "friction.temperature_change leaves no friction at high temperature");
    }
    if (f.kind == FrictionLaw::Kind::coulomb || f.kind == FrictionLaw::Kind::temperature) {
      require(f.amplitude_1 == 0.0 && f.amplitude_2 == 0.0, "friction amplitudes belong to a falling law",
              "give friction.law = \"linear\", \"rational\" or \"exponential\"");
      return;
    }
    require(f.amplitude_1 == 0.0 || f.half_velocity_1 > 0.0, "friction.half_velocity_1_m_s must be positive");
    require(f.amplitude_2 == 0.0 || f.half_velocity_2 > 0.0, "friction.half_velocity_2_m_s must be positive");
  }

  void wheel_rail(const WheelRailCase& c) const {
    surface(c.rail, Body::rail, 0.0);
    surface(c.wheel, Body::wheel, c.wheelset.nominal_radius);
    require(!c.vertical_force_prescribed || c.vertical_force > 0.0, "the vertical load is missing",
            "give wheelset.vertical_force_N or wheelset.z_mm");
    const DiscretisationInput& d = c.discretisation;
    require(d.separation >= d.combination, "discretisation.separation_mm must not be less than combination_mm");
    require(c.tangential_model != TangentialModel::fastsim_one_flexibility || c.fastsim.flexibility > 0.0,
            "solver.fastsim_flexibility_mm_per_MPa is missing");
    if (const auto& damping = c.damping) {
      require(damping->normal == 0.0 || damping->max_rate_normal > 0.0, "damping.max_rate_normal_N_per_s is missing");
      require(damping->tangential == 0.0 || damping->max_rate_tangential > 0.0,
              "damping.max_rate_tangential_N_per_s is missing");
    }
    friction(c.friction);
    friction_variation(c.friction_variation);
    for (const UncertainInput& u : c.uncertainty) {
      if (u.key == "rail.shape" || u.key == "wheel.shape") {
        require(u.length > 0.0, "case.uncertainty: heights need length_mm", "give the distance of the points");
        continue;
      }
      require(u.length == 0.0, "case.uncertainty: length_mm belongs to rail.shape and wheel.shape");
      require(number_of(whole_, u.key).has_value(), "case.uncertainty: the case does not give " + u.key,
              "write it into the case file, or name another key");
    }
  }

  void friction_variation(const FrictionVariation& v) const {
    if (v.kind == FrictionVariation::Kind::none) return;
    const auto& at = v.positions;
    require(!at.empty() && at.size() == v.laws.size(), "a variation of friction needs at least one set");
    require(std::adjacent_find(at.begin(), at.end(), std::greater_equal<>()) == at.end(),
            "the positions of friction sets must increase");
    for (const FrictionLaw& law : v.laws) {
      require(law.kind == v.laws.front().kind, "all friction sets must have the same law");
      friction(law);
    }
  }

  void hertz(const HertzInput& h) const {
    using Given = HertzInput::Given;
    const auto positive = [&](double value, const std::string& name) {
      require(value > 0.0, fmt::format("patch.hertz.{} is missing", name));
    };
    const bool a1 =
        h.given == Given::curvatures || h.given == Given::curvature_and_ratio || h.given == Given::line_curvature;
    if (a1)
      positive(h.a1, "curvature_x_per_m");
    else
      positive(h.aa, "semi_axis_x_mm");
    if (h.given == Given::curvatures)
      positive(h.b1, "curvature_y_per_m");
    else if (h.given == Given::curvature_and_ratio)
      positive(h.aob, "axis_ratio");
    else if (h.given == Given::semi_double_elliptic) {
      positive(h.bb_negative, "semi_axis_y_negative_mm");
      positive(h.bb_positive, "semi_axis_y_positive_mm");
    } else
      positive(h.bb, "semi_axis_y_mm");
  }

  void gap(const GapInput& g, const BasicCase& c) const {
    require(c.dx > 0.0 && c.dy > 0.0, "patch.dx_mm and patch.dy_mm are missing");
    const std::size_t count = g.coefficients.size();
    using Kind = GapInput::Kind;
    switch (g.kind) {
      case Kind::quadratic:
        require(count == 6, fmt::format("patch.gap.coefficients_si has {} values, a quadratic gap needs 6", count));
        return;
      case Kind::circular:
        require(count >= 5,
                fmt::format("patch.gap.coefficients_si has {} values, a circular gap needs at least 5", count));
        require(g.coefficients[1] != 0.0, "patch.gap: the radius of a circular gap must not be 0");
        return;
      case Kind::sinusoidal:
        require(count == 8, fmt::format("patch.gap.coefficients_si has {} values, a sinusoidal gap needs 8", count));
        require(g.coefficients[6] != 0.0 && g.coefficients[7] != 0.0, "patch.gap: b7 and b8 must not be 0");
        return;
      case Kind::per_element:
        require(count == static_cast<std::size_t>(c.mx) * static_cast<std::size_t>(c.my),
                fmt::format("patch.gap.coefficients_si has {} values for {} elements", count,
                            static_cast<long>(c.mx) * c.my));
        return;
    }
  }

  void basic(const BasicCase& c) const {
    require(c.mx >= 1 && c.my >= 1, "patch.mx and patch.my are missing");
    require(static_cast<long>(c.mx) * c.my <= kMostElements,
            fmt::format("potential contact too large: {} x {} elements, at most {}", c.mx, c.my, kMostElements));
    if (const auto* h = std::get_if<HertzInput>(&c.geometry))
      hertz(*h);
    else
      gap(std::get<GapInput>(c.geometry), c);
    require(!c.normal_force_prescribed || c.normal_force > 0.0, "the normal load is missing",
            "give patch.normal_force_N or patch.approach_mm");
    require(!c.fy_relative || c.fx_relative, "patch.force_y_relative needs patch.force_x_relative");
    if (c.regime == Regime::steady || c.regime == Regime::transient) {
      require(c.dq > 0.0, "patch.rolling_step_mm is missing");
      require(c.velocity > 0.0, "patch.velocity_m_s is missing");
    }
    friction(c.friction);
    for (const FrictionLaw& law : c.friction_of_row) friction(law);
  }

  void none(const std::vector<Contradiction>& found) const {
    for (const Contradiction& one : found) require(false, one.message, one.advice);
  }

 private:
  const Case& whole_;
  SourcePosition where_;
  int number_;
};

}  // namespace

void validate_case(const Case& c) {
  const Checker check(c);
  if (const auto* rail = std::get_if<WheelRailCase>(&c.content))
    check.wheel_rail(*rail);
  else
    check.basic(std::get<BasicCase>(c.content));
  check.none(contradictions(c));
}

namespace {

/// Patches of instants that follow each other lie on one raster.
void settle_elements(std::vector<Case>& cases) {
  std::map<int, std::vector<Case*>> sequences;
  for (Case& c : cases) sequences[c.sequence].push_back(&c);
  const auto share_raster = [](const std::vector<Case*>& instants) {
    const bool raster = ranges::any_of(instants, [](const Case* c) {
      const auto* w = std::get_if<WheelRailCase>(&c->content);
      return w != nullptr && (w->regime == Regime::transient || w->regime == Regime::shift || w->damping);
    });
    for (Case* c : instants)
      if (auto* w = std::get_if<WheelRailCase>(&c->content); raster && w != nullptr)
        w->discretisation.choose_dx = w->discretisation.choose_ds = false;
  };
  for (const auto& [number, all] : sequences) {
    std::vector<Case*> instants;
    for (Case* c : all) {
      const bool anew =
          std::visit([](const auto& content) { return content.history == HistoryUse::start; }, c->content);
      if (anew) share_raster(std::exchange(instants, {}));
      instants.push_back(c);
    }
    share_raster(instants);
  }
}

}  // namespace

void settle_sequences(std::vector<Case>& cases, std::vector<std::string>* notes) {
  settle_elements(cases);
  std::map<int, const Case*> last;
  bool told = false;
  for (Case& c : cases) {
    const auto [previous, first] = last.try_emplace(c.sequence, &c);
    const Checker check(c);
    if (first) {
      std::visit([](auto& content) { content.history = HistoryUse::start; }, c.content);
    } else {
      check.none(contradictions(*previous->second, c));
      const auto step = rolled_step(*previous->second, c);
      const std::string complaint = notes != nullptr ? doubt_about_history(*previous->second, c) : std::string();
      const auto* rail = std::get_if<WheelRailCase>(&c.content);
      const bool long_steps = rail != nullptr && rail->conventions == Conventions::contact;
      check.require(complaint.empty() || !step || !step->too_long() || long_steps, complaint,
                    "more and shorter steps (case.steps, case.time_step_s)");
      if (!complaint.empty() && !std::exchange(told, true))
        notes->push_back(fmt::format("case {}: {}", c.number, complaint));
    }
    previous->second = &c;
  }
}

}  // namespace treadmark::io
