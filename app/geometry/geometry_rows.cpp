// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <string_view>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark {
namespace {

using F = const app::FunctionRow&;
using C = const app::ConicityRow&;
using R = const app::GeometryResult&;
using J = const geometry::Jump&;
using O = const geometry::FurtherTouch&;
using N = app::ConicityNoise;
using Side = geometry::LoadedSide;
using L = const geometry::LoadedPosition&;
using S = const geometry::LoadedSide&;
using D = const geometry::LoadedFunctions&;
using access::flag;
using access::of;
using access::word;
using access::word_or_null;
using unit::kMm;
using unit::kMPa;
using unit::kN;
using unit::kOne;

constexpr FileUnit kRad{"rad"}, kPerM{"1/m"}, kPerMm{"1/mm", 1e-3, "1/m"};
constexpr unsigned kTableAndCards = kInTable | kInCards;
constexpr std::string_view kWhyNone = "why there is no number; null: there is one",
                           kNoEllipse = "why there is no ellipse; null: there is one",
                           kOfNoise =
                               "standard deviation of what noise of measured profiles or the import of scans leaves "
                               "uncertain; only where known";

std::string side(bool right) { return right ? "right" : "left"; }
const geometry::Touch& before(J j) { return j.right ? j.before.right : j.before.left; }
const geometry::Touch& after(J j) { return j.right ? j.after.right : j.after.left; }

double youngs_modulus(double shear_modulus, double poisson) { return 2.0 * shear_modulus * (1.0 + poisson); }

const std::string& left_or(const std::string& left, const std::string& right) { return left.empty() ? right : left; }

/// A number with the reason why there is none, and its uncertainty.
template <class Row>
constexpr Access<Row> because(double (*get)(const Row&), std::string (*reason)(const Row&),
                              double (*uncertainty)(const Row&) = nullptr) {
  Access<Row> access{get};
  access.reason = reason, access.uncertainty = uncertainty;
  return access;
}

/// Of a number that noise of measured profiles leaves uncertain.
template <auto Noise>
constexpr Access<app::GeometryResult> noise() {
  return {[](R r) { return (*r.noise).*Noise; }, nullptr, [](R r) { return r.noise.has_value(); }};
}
template <auto Noise>
double noise_or_none(R r) {
  return r.noise ? (*r.noise).*Noise : kNaN;
}

double shared(const geometry::LoadedSide& side) { return side.reason.empty() ? (side.shared ? 1.0 : 0.0) : kNaN; }

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
constexpr Column<app::FunctionRow> kFunctions[] = {
    {"y_mm", kMm, "", {[](F f) { return f.position.y; }}, "shift of the wheelset to the right, at rail level"},
    {"delta_r_mm", kMm, "", {[](F f) { return f.position.radius_difference(); }}, "rolling radius right minus left"},
    {"radius_right_mm", kMm, "", {[](F f) { return f.position.right.radius; }}},
    {"radius_left_mm", kMm, "", {[](F f) { return f.position.left.radius; }}},
    {"wheel_y_right_mm", kMm, "", {[](F f) { return f.position.right.wheel_y; }}, "on the wheel's profile; left ones as of a right-hand side"},
    {"wheel_y_left_mm", kMm, "", {[](F f) { return f.position.left.wheel_y; }}},
    {"rail_y_right_mm", kMm, "", {[](F f) { return f.position.right.rail_y; }}},
    {"rail_y_left_mm", kMm, "", {[](F f) { return f.position.left.rail_y; }}},
    {"angle_right_rad", kRad, "", {[](F f) { return f.position.right.angle; }}, "positive where the wheel's radius grows towards its flange"},
    {"angle_left_rad", kRad, "", {[](F f) { return f.position.left.angle; }}},
    {"delta_tan_gamma", kOne, "",
     {[](F f) { return std::tan(f.position.right.angle) - std::tan(f.position.left.angle); }}, "tan of the angle right minus left"},
    {"wheel_curvature_right_per_m", kPerM, "", {[](F f) { return f.position.right.wheel_curvature; }}, "across the profile, positive for convex"},
    {"wheel_curvature_left_per_m", kPerM, "", {[](F f) { return f.position.left.wheel_curvature; }}},
    {"rail_curvature_right_per_m", kPerM, "", {[](F f) { return f.position.right.rail_curvature; }}},
    {"rail_curvature_left_per_m", kPerM, "", {[](F f) { return f.position.left.rail_curvature; }}},
    {"roll_rad", kRad, "", {[](F f) { return f.position.roll; }}},
    {"z_mm", kMm, "", {[](F f) { return f.position.z; }}, "of the middle of the axle, down; without roll the mean of both sides"},
    {"holding_force_over_weight", kOne, "", {[](F f) { return f.wheelset.holding_force(f.position); }}, "force to the right at rail level that holds the wheelset against gravity"}};

constexpr Column<geometry::LoadedPosition> kLoaded[] = {
    {"normal_force_right_N", kN, "", {[](L l) { return l.right.normal_force; }}, "with an axle load, as all that follows; negative: the wheel would have to be held down"},
    {"normal_force_left_N", kN, "", {[](L l) { return l.left.normal_force; }}},
    {"holding_force_N", kN, "", {[](L l) { return l.holding_force; }}, "to the right at rail level"},
    {"pressure_right_MPa", kMPa, "", {[](L l) { return l.right.pressure; }}, "the largest one by Hertz"},
    {"pressure_left_MPa", kMPa, "", {[](L l) { return l.left.pressure; }}},
    {"semi_axis_x_right_mm", kMm, "", {[](L l) { return l.right.semi_axis_x; }}, "along the track"},
    {"semi_axis_x_left_mm", kMm, "", {[](L l) { return l.left.semi_axis_x; }}},
    {"semi_axis_y_right_mm", kMm, "", {[](L l) { return l.right.semi_axis_y; }}, "across"},
    {"semi_axis_y_left_mm", kMm, "", {[](L l) { return l.left.semi_axis_y; }}},
    {"approach_right_mm", kMm, "", {[](L l) { return l.right.approach; }}, "of wheel and rail along the normal"},
    {"approach_left_mm", kMm, "", {[](L l) { return l.left.approach; }}},
    {"lowering_mm", kMm, "", {[](L l) { return l.lowering; }}, "of the axle by the approaches"},
    {"elastic_roll_rad", kRad, "", {[](L l) { return l.roll; }}, "by the approaches, right side down; null without free roll"},
    {"misfit_right", kOne, "", {[](L l) { return l.right.misfit; }}, "of the profiles' gap at the ends of the ellipse and Hertz' parabola, over the parabola's"},
    {"misfit_left", kOne, "", {[](L l) { return l.left.misfit; }}},
    {"shared_right", kOne, "", {[](L l) { return shared(l.right); }}, "1: the approach closes the gap of a second contact, which carries a part"},
    {"shared_left", kOne, "", {[](L l) { return shared(l.left); }}},
    {"no_pressure_right", kOne, "", word_or_null(+[](L l) { return l.right.reason; }), kNoEllipse},
    {"no_pressure_left", kOne, "", word_or_null(+[](L l) { return l.left.reason; })}};

constexpr Column<app::GeometryResult> kGeometry[] = {
    {"profiles.wheel_right", kOne, "", word(+[](R r) { return r.request.wheel; }), "", 0, "wheel, right"},
    {"profiles.wheel_left", kOne, "", word(+[](R r) { return left_or(r.request.wheel_left, r.request.wheel); }), "", 0, "wheel, left"},
    {"profiles.rail_right", kOne, "", word(+[](R r) { return r.request.rail; }), "", 0, "rail, right"},
    {"profiles.rail_left", kOne, "", word(+[](R r) { return left_or(r.request.rail_left, r.request.rail); }), "", 0, "rail, left"},
    {"wheelset.wheel_origins_mm", kMm, "", {[](R r) { return r.analysis.wheel_origins; }}, "distance of the tape lines"},
    {"wheelset.back_to_back_mm", kMm, "", {[](R r) { return r.analysis.wheel_origins - 0.14; }}, "of backs 70 mm from the tape lines", 0, "back to back", 2},
    {"track.gauge_mm", kMm, "", {[](R r) { return r.analysis.gauge; }}, "distance of the rails below their tops", kTableAndCards, "gauge", 3, "gauge_mm"},
    {"track.gauge_height_mm", kMm, "", {[](R r) { return r.placement.gauge_height; }}},
    {"track.inclination", kOne, "", {[](R r) { return std::tan(r.right.cant); }}, "tangent", 0, "inclination of the rails", 4},
    {"track.rail_origin_right_mm", kMm, "", {[](R r) { return r.analysis.rail_y_right; }}, "outwards from the middle of the track"},
    {"track.rail_origin_left_mm", kMm, "", {[](R r) { return r.analysis.rail_y_left; }}},
    {"wheelset.active_faces_mm", kMm, "", {[](R r) { return r.analysis.active_faces; }}, "distance of the flanges' faces 10 mm below the tape lines", 0, "active faces", 3, "active_faces_mm"},
    {"track.clearance_mm", kMm, "", {[](R r) { return r.analysis.gauge - r.analysis.active_faces; }}, "gauge minus active faces", kTableAndCards, "clearance", 3, "clearance_mm"},
    {"wheelset.diameter_right_mm", kMm, "", {[](R r) { return 2.0 * r.analysis.radius_right; }}, "at the tape line", 0, "diameter, right", 2},
    {"wheelset.diameter_left_mm", kMm, "", {[](R r) { return 2.0 * r.analysis.radius_left; }}, "", 0, "diameter, left", 2},
    {"method.roll", kOne, "", word(+[](R r) { return std::string(r.request.settings.roll == geometry::Roll::none ? "none" : "free"); }), "", 0, "roll"},
    {"method.smoothing_mm", kMm, "", {[](R) { return 0.0; }}},
    {"equilibrium_y_mm", kMm, "", because(+[](R r) { return r.analysis.equilibrium.value_or(kNaN); }, +[](R r) { return r.analysis.no_equilibrium; }), "shift with equal rolling radii", kTableAndCards, "equilibrium", 3, "equilibrium_y_mm"},
    {"equilibrium_reason", kOne, "", word_or_null(+[](R r) { return r.analysis.no_equilibrium; }), kWhyNone},
    {"conicity_at.amplitude_mm", kMm, "", {[](R r) { return r.analysis.single.amplitude; }}, "", 0, "amplitude", -1, "amplitude_mm"},
    {"conicity_at.tan_gamma_e", kOne, "", because(+[](R r) { return r.analysis.single.tan_gamma; }, +[](R r) { return r.analysis.single.reason; }, noise_or_none<&N::single>), "at the amplitude of the rule", kTableAndCards, "equivalent conicity", 4, "tan_gamma_e"},
    {"conicity_at.rule", kOne, "", word(+[](R r) { return r.analysis.rule; }), "by which the amplitude was chosen", 0, "rule"},
    {"conicity_at.reason", kOne, "", word_or_null(+[](R r) { return r.analysis.single.reason; }), kWhyNone},
    {"conicity_at.noise", kOne, "", noise<&N::single>(), kOfNoise},
    {"conicity_3mm", kOne, "", because(+[](R r) { return r.analysis.at_3mm.tan_gamma; }, +[](R r) { return r.analysis.at_3mm.reason; }, noise_or_none<&N::at_3mm>), "", kInTable, "conicity at 3 mm", 4, "tan_gamma_e_3mm"},
    {"conicity_3mm_noise", kOne, "", noise<&N::at_3mm>(), kOfNoise},
    {"nonlinearity_per_mm", kPerMm, "", {[](R r) { return r.analysis.nonlinearity; }}, "of the conicity between 2 and 4 mm", kTableAndCards, "nonlinearity", 5, "nonlinearity_per_mm"},
    {"greatest_amplitude_mm", kMm, "", {[](R r) { return r.analysis.greatest_amplitude; }}, "", 0, "", -1, "greatest_amplitude_mm"},
    {"contact_spread.amplitude_mm", kMm, "", {[](R r) { return r.analysis.spread.amplitude; }}},
    {"contact_spread.contact_spread_rail_mm", kMm, "", {[](R r) { return r.analysis.spread.rail; }}, "width that the contact points cover, jumps left out, mean of both sides", 0, "contact spread, rail", 2},
    {"contact_spread.contact_spread_wheel_mm", kMm, "", {[](R r) { return r.analysis.spread.wheel; }}, "", 0, "contact spread, wheel", 2},
    {"contact_spread.rail_over_shift", kOne, "", {[](R r) { return r.analysis.spread.rail / (2.0 * r.analysis.spread.amplitude); }}},
    {"contact_spread.wheel_over_shift", kOne, "", {[](R r) { return r.analysis.spread.wheel / (2.0 * r.analysis.spread.amplitude); }}},
    {"steering.delta_r_max_mm", kMm, "", {[](R r) { return r.analysis.steering.largest_difference; }}, "before a contact is steeper than 30 degrees", 0, "delta r before flange", 3},
    {"steering.smallest_steered_radius_m", unit::kM, "", {[](R r) { return r.analysis.steering.smallest_radius; }}, "", 0, "steers to a radius of", 0},
    {"gravitational_stiffness_per_weight_per_m", kPerM, "", {[](R r) { return r.analysis.gravitational_stiffness; }}, "over 3 mm to both sides of the equilibrium", 0, "stiffness by gravity", 4},
    {"wheelset.flange_thickness_right_mm", kMm, "", {[](R r) { return r.analysis.flange_thickness_right; }}, "", 0, "", -1, "flange_thickness_mm"},
    {"wheelset.flange_thickness_left_mm", kMm, "", {[](R r) { return r.analysis.flange_thickness_left; }}, "", 0, "", -1, "flange_thickness_left_mm"}};

constexpr Column<app::ConicityRow> kConicity[] = {
    {"amplitude_mm", kMm, "", {[](C c) { return c.conicity.amplitude; }}, "half the distance of the turning points", 0, "amplitude"},
    {"tan_gamma_e", kOne, "", {[](C c) { return c.conicity.tan_gamma; }}, "equivalent conicity, integral method", 0, "tan gamma_e", 4},
    {"noise", kOne, "", of<&app::ConicityRow::noise>(), kOfNoise},
    {"harmonic", kOne, "", of<&app::ConicityRow::harmonic>(), "harmonic linearization, for comparison", 0, "harmonic", 4},
    {"wavelength_mm", kMm, "", {[](C c) { return geometry::wavelength(c.conicity.tan_gamma, c.analysis.wheel_origins, 0.5 * (c.analysis.radius_right + c.analysis.radius_left)); }}, "", 0, "wavelength", 0},
    {"turns_left_mm", kMm, "", {[](C c) { return c.conicity.low; }}},
    {"turns_right_mm", kMm, "", {[](C c) { return c.conicity.high; }}},
    {"", kOne, "", of<&app::ConicityRow::with_new>(), "", 0, "new profiles", 4},
    {"reason", kOne, "", word_or_null(+[](C c) { return c.conicity.reason; }), kWhyNone, 0, "why there is none"}};

constexpr Column<geometry::Jump> kJumps[] = {
    {"y_mm", kMm, "", {[](J j) { return 0.5 * (j.before.y + j.after.y); }}, "", 0, "y", 4},
    {"side", kOne, "", word(+[](J j) { return side(j.right); }), "", 0, "side"},
    {"from_rail_y_mm", kMm, "", {[](J j) { return before(j).rail_y; }}, "", 0, "rail from", 2},
    {"to_rail_y_mm", kMm, "", {[](J j) { return after(j).rail_y; }}, "", 0, "to", 2},
    {"from_wheel_y_mm", kMm, "", {[](J j) { return before(j).wheel_y; }}},
    {"to_wheel_y_mm", kMm, "", {[](J j) { return after(j).wheel_y; }}},
    {"dr_before_mm", kMm, "", {[](J j) { return j.before.radius_difference(); }}, "", 0, "delta r from", 3},
    {"dr_after_mm", kMm, "", {[](J j) { return j.after.radius_difference(); }}, "", 0, "to", 3}};

constexpr Column<geometry::FurtherTouch> kFurther[] = {
    {"y_mm", kMm, "", {[](O o) { return o.y; }}},
    {"side", kOne, "", word(+[](O o) { return side(o.right); })},
    {"wheel_y_mm", kMm, "", {[](O o) { return o.touch.wheel_y; }}},
    {"rail_y_mm", kMm, "", {[](O o) { return o.touch.rail_y; }}},
    {"angle_rad", kRad, "", {[](O o) { return o.touch.angle; }}},
    {"gap_mm", kMm, "", {[](O o) { return o.touch.gap; }}, "above that of the first contact"}};

constexpr Column<geometry::ShiftLimit> kLimits[] = {
    {"y_mm", kMm, "", of<&geometry::ShiftLimit::y>(), "last sound shift"},
    {"limited", kOne, "", flag<&geometry::ShiftLimit::limited>(), "false: no further shifts were asked for"},
    {"reason", kOne, "", word_or_null(+[](const geometry::ShiftLimit& l) { return l.reason; }), kWhyNone}};

constexpr Column<geometry::LoadedSide> kSides[] = {
    {"normal_force_N", kN, "", of<&Side::normal_force>(), "", 0, "normal force", 0},
    {"pressure_MPa", kMPa, "", because(+[](S s) { return s.pressure; }, +[](S s) { return s.reason; }), "", 0, "largest pressure", 0},
    {"semi_axis_x_mm", kMm, "", of<&Side::semi_axis_x>(), "", 0, "semi-axis along", 2},
    {"semi_axis_y_mm", kMm, "", of<&Side::semi_axis_y>(), "", 0, "across", 2},
    {"approach_mm", kMm, "", of<&Side::approach>(), "", 0, "approach", 4},
    {"misfit", kOne, "", of<&Side::misfit>(), "", 0, "misfit", 2},
    {"shared", kOne, "", flag<&Side::shared>(), "with a second contact, whose gap the approach closes", 0, "shared by a second contact"},
    {"reason", kOne, "", word_or_null(+[](S s) { return s.reason; }), kNoEllipse}};

constexpr Column<geometry::LoadedFunctions> kLoad[] = {
    {"axle_load_N", kN, "", {[](D d) { return d.load.weight; }}, "what both wheels carry", 0, "axle load", 0},
    {"rail.youngs_modulus_MPa", kMPa, "", {[](D d) { return youngs_modulus(d.load.material.shear_modulus_1, d.load.material.poisson_1); }}},
    {"rail.poisson", kOne, "", {[](D d) { return d.load.material.poisson_1; }}},
    {"wheel.youngs_modulus_MPa", kMPa, "", {[](D d) { return youngs_modulus(d.load.material.shear_modulus_2, d.load.material.poisson_2); }}},
    {"wheel.poisson", kOne, "", {[](D d) { return d.load.material.poisson_2; }}},
    {"y_mm", kMm, "", of<&geometry::LoadedFunctions::middle>(), "", 0, "at a displacement of", 3},
    {"holding_force_N", kN, "", {[](D d) { return d.at_middle.holding_force; }}, "to the right at rail level", 0, "holding force", 0},
    {"lowering_mm", kMm, "", {[](D d) { return d.at_middle.lowering; }}},
    {"elastic_roll_rad", kRad, "", {[](D d) { return d.at_middle.roll; }}, "null without free roll"},
    {"largest_pressure.amplitude_mm", kMm, "", of<&geometry::LoadedFunctions::amplitude>(), "", 0, "nearer to it than"},
    {"largest_pressure.pressure_MPa", kMPa, "", {[](D d) { return d.largest.pressure; }}, "by Hertz", kInCards, "largest pressure", 0},
    {"largest_pressure.misfit", kOne, "", {[](D d) { return d.largest.misfit; }}, "", 0, "its misfit", 2},
    {"largest_pressure.shared", kOne, "", {.get = [](D d) { return d.largest.shared ? 1.0 : 0.0; }, .flag = true}, "", 0, "shared by a second"},
    {"largest_pressure.y_mm", kMm, "", of<&geometry::LoadedFunctions::largest_y>(), "", 0, "at", 2},
    {"largest_pressure.side", kOne, "", word_or_null(+[](D d) { return std::isnan(d.largest_y) ? std::string() : side(d.largest_right); }), "", 0, "on the side"}};
// clang-format on

}  // namespace

template <>
std::span<const Column<app::GeometryResult>> columns() {
  return kGeometry;
}
template <>
std::span<const Column<app::FunctionRow>> columns() {
  return kFunctions;
}
template <>
std::span<const Column<app::ConicityRow>> columns() {
  return kConicity;
}
template <>
std::span<const Column<geometry::Jump>> columns() {
  return kJumps;
}
template <>
std::span<const Column<geometry::FurtherTouch>> columns() {
  return kFurther;
}
template <>
std::span<const Column<geometry::ShiftLimit>> columns() {
  return kLimits;
}
template <>
std::span<const Column<geometry::LoadedPosition>> columns() {
  return kLoaded;
}
template <>
std::span<const Column<geometry::LoadedSide>> columns() {
  return kSides;
}
template <>
std::span<const Column<geometry::LoadedFunctions>> columns() {
  return kLoad;
}

namespace app {

std::vector<ConicityRow> conicity_rows(const geometry::Analysis& a, const GeometryResult* beside) {
  std::vector<ConicityRow> rows;
  for (const geometry::Conicity& c : a.conicity) {
    ConicityRow& row = rows.emplace_back(ConicityRow{c, a});
    if (beside == nullptr) continue;
    const std::size_t i = rows.size() - 1;
    if (!a.harmonic.empty()) row.harmonic = a.harmonic[i];
    if (beside->noise) row.noise = beside->noise->of_amplitude[i];
    if (beside->with_new) row.with_new = beside->with_new->conicity[i].tan_gamma;
  }
  return rows;
}

}  // namespace app
}  // namespace treadmark
