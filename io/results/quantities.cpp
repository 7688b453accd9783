// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/quantities.hpp"

#include <fmt/format.h>

#include <cmath>

#include "treadmark/core/constants.hpp"

namespace treadmark::io {
namespace {

using P = PatchResult;
using C = CaseResult;
using B = Block;
using Digits = Label::Digits;
using access::of;
using access::part;
using access::smooth;
using access::within;

constexpr double unchanged(double value) { return value; }
constexpr double by_thousand(double value) { return value * kMilli; }

constexpr Unit kCount{"", unchanged, "", unchanged};
constexpr Unit kRatio{"1", unchanged, "-", unchanged};
constexpr Unit kLength{"m", by_thousand, "mm", by_thousand};
constexpr Unit kArea{"m2", [](double v) { return v * kMilli * kMilli; }, "mm2", [](double v) { return v * kMicro; }};
constexpr Unit kAngle{"rad", unchanged, "deg", [](double v) { return v * (180.0 / kPi); }};
constexpr Unit kTurn{"rad", unchanged, "rad", unchanged};
constexpr Unit kSpin{"rad/m", [](double v) { return v / kMilli; }, "rad/mm", [](double v) { return v * 1e-3; }};
constexpr Unit kForce{"N", unchanged, "N", unchanged};
constexpr Unit kMoment{"N m", by_thousand, "N mm", by_thousand};
constexpr Unit kStress{"Pa", [](double v) { return v * kMega; }, "MPa", [](double v) { return v * kMega; }};
constexpr Unit kEnergy{"J", unchanged, "J", unchanged};
constexpr Unit kPower{"W", unchanged, "W", unchanged};
constexpr Unit kSpeed{"m/s", by_thousand, "mm/s", by_thousand};
constexpr Unit kRate{"rad/s", unchanged, "rad/s", unchanged};
constexpr Unit kTime{"s", unchanged, "s", unchanged};
constexpr Unit kCurvature{"1/m", unchanged, "1/m", unchanged};
constexpr Unit kCelsius{"degC", unchanged, "degC", unchanged};

template <int I>
constexpr Access<C> deflection() {
  return {[](const C& c) { return (*c.rail_deflection)[I]; },
          [](C& c, double v) {
            if (!c.rail_deflection) c.rail_deflection = Vec2::Zero();
            (*c.rail_deflection)[I] = v;
          },
          [](const C& c) { return c.rail_deflection.has_value(); }};
}

using Local = P::LocalForces;
using Curvatures = P::Curvatures;
using Refinement = P::Refinement;
using Noise = P::Noise;
using Roller = C::Roller;

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
constexpr Quantity<P> kPatchQuantities[] = {
    {"reference", "x_tr_mm", kLength, B::place, smooth(of<&P::x_tr>()), "contact reference in track axes",
     {"reference_track", 0}, {"position x_tr", Digits::four_decimals, "x_tr_mm"}},
    {"reference", "y_tr_mm", kLength, B::place, smooth(of<&P::y_tr>()), "",
     {"reference_track", 1}, {"position y_tr", Digits::four_decimals, "y_tr_mm"}},
    {"reference", "z_tr_mm", kLength, B::place, smooth(of<&P::z_tr>()), "",
     {"reference_track", 2}, {"position z_tr", Digits::four_decimals}},
    {"reference", "angle_rad", kAngle, B::angle, smooth(of<&P::angle>()), "contact angle: roll of the contact plane",
     {"contact_angle"}, {"contact angle", Digits::four_decimals, "angle_rad"}},
    {"reference", "x_rail_mm", kLength, B::place, smooth(of<&P::x_rail>()), "contact reference in rail axes",
     {"reference_rail", 0}},
    {"reference", "y_rail_mm", kLength, B::place, smooth(of<&P::y_rail>()), "", {"reference_rail", 1}},
    {"reference", "z_rail_mm", kLength, B::place, smooth(of<&P::z_rail>()), "", {"reference_rail", 2}},
    {"reference", "s_rail_mm", kLength, B::arc, smooth(of<&P::s_rail>()), "arc length along the rail profile",
     {"s_rail"}},
    {"reference", "x_wheel_mm", kLength, B::place, smooth(of<&P::x_wheel>()), "contact reference in wheel-profile axes",
     {"reference_wheel", 0}},
    {"reference", "y_wheel_mm", kLength, B::place, smooth(of<&P::y_wheel>()), "", {"reference_wheel", 1}},
    {"reference", "z_wheel_mm", kLength, B::place, smooth(of<&P::z_wheel>()), "", {"reference_wheel", 2}},
    {"reference", "x_ws_mm", kLength, B::place, smooth(of<&P::x_wheelset>()), "contact reference in wheelset axes",
     {"reference_wheelset", 0}},
    {"reference", "y_ws_mm", kLength, B::place, smooth(of<&P::y_wheelset>()), "", {"reference_wheelset", 1}},
    {"reference", "z_ws_mm", kLength, B::place, smooth(of<&P::z_wheelset>()), "", {"reference_wheelset", 2}},
    {"reference", "angle_rail_rad", kAngle, B::angle, smooth(of<&P::angle_rail>()), "contact angle in rail axes",
     {"contact_angle_rail"}},
    {"reference", "angle_ws_rad", kAngle, B::angle, smooth(of<&P::angle_wheelset>()), "contact angle in wheelset axes",
     {"contact_angle_wheelset"}},
    {"reference", "angle_wheel_rad", kAngle, B::angle, smooth(of<&P::angle_wheel>()), "contact angle in wheel axes",
     {"contact_angle_wheel"}},
    {"rail_curvatures", "greater_per_m", kCurvature, B::shape, within<&P::rail_curvatures, &Curvatures::greater>(),
     "principal curvatures of the rail at the contact reference, the greater and the lesser one; positive: convex",
     {"rail_curvature_1"}, {"", Digits::five, "rail_curvature_1_per_m"}},
    {"rail_curvatures", "lesser_per_m", kCurvature, B::shape, within<&P::rail_curvatures, &Curvatures::lesser>(), "",
     {"rail_curvature_2"}, {"", Digits::five, "rail_curvature_2_per_m"}},
    {"rail_curvatures", "direction_rad", kAngle, B::shape, within<&P::rail_curvatures, &Curvatures::direction>(),
     "direction of the greater one in the contact plane, from x towards s", {"rail_curvature_direction"}},
    {"wheel_curvatures", "greater_per_m", kCurvature, B::shape, within<&P::wheel_curvatures, &Curvatures::greater>(),
     "the same of the wheel", {"wheel_curvature_1"}, {"", Digits::five, "wheel_curvature_1_per_m"}},
    {"wheel_curvatures", "lesser_per_m", kCurvature, B::shape, within<&P::wheel_curvatures, &Curvatures::lesser>(), "",
     {"wheel_curvature_2"}, {"", Digits::five, "wheel_curvature_2_per_m"}},
    {"wheel_curvatures", "direction_rad", kAngle, B::shape, within<&P::wheel_curvatures, &Curvatures::direction>(),
     "", {"wheel_curvature_direction"}},
    {"kinematics", "chi_rad", kAngle, B::rolling, of<&P::chi>(), "rolling direction", {"chi"}},
    {"kinematics", "dq_mm", kLength, B::rolling, of<&P::dq>(), "rolled distance per step", {"dq"}},
    {"kinematics", "velocity_mm_s", kSpeed, B::rolling, smooth(of<&P::velocity>()), "rolling speed", {"velocity"}},
    {"kinematics", "xi", kRatio, B::creepage, smooth(of<&P::xi>()),
     "longitudinal creepage, rail minus wheel; shift: mm",
     {"xi"}, {"creepage xi", Digits::four, "xi", "shift x"}, kLength},
    {"kinematics", "eta", kRatio, B::creepage, smooth(of<&P::eta>()), "lateral creepage; shift: mm",
     {"eta"}, {"creepage eta", Digits::four, "eta", "shift s"}, kLength},
    {"kinematics", "phi", kSpin, B::creepage, smooth(of<&P::phi>()), "spin in rad/mm; shift: rad",
     {"phi"}, {"spin phi", Digits::four, "phi_rad_mm", "turn"}, kTurn},
    {"", "xi", kRatio, B::creepage, of<&P::xi>(), "as in kinematics", {}, {}, kLength},
    {"", "eta", kRatio, B::creepage, of<&P::eta>(), "as in kinematics", {}, {}, kLength},
    {"", "fn_N", kForce, B::force, smooth(of<&P::fn>()), "normal force",
     {"fn"}, {"normal force Fn", Digits::five, "fn_N"}},
    {"", "fx_N", kForce, B::force, smooth(of<&P::fx>()), "longitudinal force on the rail",
     {"fx"}, {"longitudinal force Fx", Digits::five, "fx_N"}},
    {"", "fs_N", kForce, B::force, smooth(of<&P::fs>()), "lateral force on the rail",
     {"fs"}, {"lateral force Fs", Digits::five, "fs_N"}},
    {"", "mn_Nmm", kMoment, B::force, smooth(of<&P::mn>()), "spin moment on the rail", {"mn"}, {"spin moment Mn"}},
    {"", "elastic_energy_J", kEnergy, B::energy, smooth(of<&P::elastic_energy>()), "stored elastic energy",
     {"elastic_energy"}, {"elastic energy", Digits::four}},
    {"", "dissipated_W", kPower, B::energy, smooth<P>({[](const P& p) { return 0.0 - p.frictional_power; }}),
     "power that friction dissipates; shift: the work, done in one second",
     {}, {"dissipated by friction", Digits::four, "dissipated_W"}, kEnergy},
    {"", "t_gamma_N", kForce, B::energy,
     smooth<P>({[](const P& p) { return p.wear_number(); }, nullptr,
                [](const P& p) { return !std::isnan(p.wear_number()); }}),
     "wear number: power that friction dissipates over the rolling speed", {},
     {"wear number T gamma", Digits::four, "t_gamma_N"}},
    {"", "frictional_power_W", kPower, B::energy, of<&P::frictional_power>(),
     "dissipated_W with the sign of CONTACT, negative: dissipated", {"frictional_power"}, {}, kEnergy},
    {"", "frictional_work_J", kEnergy, B::work, of<&P::frictional_power>(), "likewise, of shift cases only"},
    {"", "", kStress, B::energy, of<&P::shear_modulus>(), "combined shear modulus", {"shear_modulus"}},
    {"", "fn_over_g_mm2", kArea, B::energy, smooth<P>({[](const P& p) { return p.fn / p.shear_modulus; }}),
     "normal force over the combined shear modulus"},
    {"", "fx_rel", kRatio, B::relative, smooth(of<&P::fx_relative>()), "fx over static friction times fn",
     {"fx_relative"}},
    {"", "fs_rel", kRatio, B::relative, smooth(of<&P::fs_relative>()), "fs over static friction times fn",
     {"fs_relative"}},
    {"", "approach_mm", kLength, B::approach, smooth(of<&P::approach>()), "approach of the bodies",
     {"approach"}, {"approach", Digits::five, "approach_mm"}},
    {"", "pmax_MPa", kStress, B::pressure, smooth(of<&P::pmax>()), "largest pressure at an element's centre",
     {"pmax"}, {"largest pressure", Digits::five, "pmax_MPa"}},
    {"", "pmax_refinement", kRatio, B::refined, within<&P::refinement, &Refinement::pmax>(),
     "estimates of what smaller elements would still change, relative: the largest pressure, the area of contact, and "
     "forces (the normal force at a given approach, the tangential force over the friction bound)",
     {"pmax_refinement"}, {"its change by refining", Digits::four, "pmax_refinement"}},
    {"", "area_refinement", kRatio, B::refined, within<&P::refinement, &Refinement::area>(), "",
     {"area_refinement"}},
    {"", "force_refinement", kRatio, B::refined, within<&P::refinement, &Refinement::force>(), "",
     {"force_refinement"}},
    {"", "fn_tilde_N", kForce, B::local, within<&P::local, &Local::fn>(),
     "curved reference: sum of the normal components in the axes of the rows", {"local_forces_x_s_n", 2}},
    {"", "fx_tilde_N", kForce, B::local, within<&P::local, &Local::fx>(), "sum of the longitudinal components",
     {"local_forces_x_s_n", 0}},
    {"", "fs_tilde_N", kForce, B::local, within<&P::local, &Local::fs>(), "sum of the lateral components",
     {"local_forces_x_s_n", 1}},
    {"", "max_temperature_1_C", kCelsius, B::heat, of<&P::max_temperature_1>(),
     "greatest surface temperature of the rail in contact; where temperatures were asked for", {"max_temperature_1"}},
    {"", "max_temperature_2_C", kCelsius, B::heat, of<&P::max_temperature_2>(),
     "greatest surface temperature of the wheel in contact",
     {"max_temperature_2"}},
    {"noise", "pmax_MPa", kStress, B::heat, within<&P::noise, &Noise::pmax>(),
     "standard deviation that noise of measured profiles and of imported scans, or points far apart, leave to the largest pressure; where they do",
     {"noise_pmax"}, {"its error by noise", Digits::four, "noise_pmax_MPa"}},
    {"noise", "area_mm2", kArea, B::heat, within<&P::noise, &Noise::area>(), "to the area of contact",
     {"noise_area"}},
    {"noise", "fn_N", kForce, B::heat, within<&P::noise, &Noise::fn>(),
     "to the normal force: 0 of one patch alone under a prescribed vertical force", {"noise_fn"}},
    {"noise", "place_mm", kLength, B::heat, within<&P::noise, &Noise::place>(),
     "to the place of contact across the rolling direction", {"noise_place"}},
    {"noise", "approach_mm", kLength, B::heat, within<&P::noise, &Noise::approach>(), "to the approach of the bodies",
     {"noise_approach"}},
    {"", "slip_share", kRatio, B::count,
     {[](const P& p) { return static_cast<double>(p.nslip) / p.ncon; }, nullptr, [](const P& p) { return p.ncon > 0; }},
     "elements in slip over elements in contact", {}, {"share in slip", Digits::four, "slip_share"}},
    {"elements", "npot", kCount, B::count, of<&P::npot>(), "elements of the grid"},
    {"elements", "ncon", kCount, B::count, of<&P::ncon>(), "elements in contact",
     {"elements_in_contact"}, {"elements in contact", Digits::whole, "elements_in_contact"}},
    {"elements", "nadh", kCount, B::count, of<&P::nadh>(), "elements in adhesion", {"elements_in_adhesion"}},
    {"elements", "nslip", kCount, B::count, of<&P::nslip>(), "elements in slip",
     {"elements_in_slip"}, {"", Digits::whole, "elements_in_slip"}},
    {"", "", kLength, B::in_grid, of<&P::reference_x>(), "contact reference in the axes of the grid", {"reference_x"}},
    {"", "", kLength, B::in_grid, of<&P::reference_s>(), "", {"reference_s"}},
};

constexpr Quantity<C> kCaseQuantities[] = {
    {"wheelset", "s_mm", kLength, B::wheelset, of<&C::s>(),
     "position of the wheelset; z as found where the vertical force is prescribed", {"wheelset_position", 0}},
    {"wheelset", "y_mm", kLength, B::wheelset, of<&C::y>(), "", {"wheelset_position", 1}},
    {"wheelset", "z_mm", kLength, B::wheelset, smooth(of<&C::z>()), "",
     {"wheelset_position", 2}},
    {"wheelset", "roll_rad", kAngle, B::wheelset, of<&C::roll>(),
     "angles of the wheelset", {"wheelset_roll_yaw_pitch", 0}},
    {"wheelset", "yaw_rad", kAngle, B::wheelset, of<&C::yaw>(), "", {"wheelset_roll_yaw_pitch", 1}},
    {"wheelset", "pitch_rad", kAngle, B::wheelset, of<&C::pitch>(), "", {"wheelset_roll_yaw_pitch", 2}},
    {"wheelset_velocity", "vx_mm_s", kSpeed, B::wheelset, of<&C::vs>(),
     "speed of the wheelset", {"wheelset_velocity", 0}},
    {"wheelset_velocity", "vy_mm_s", kSpeed, B::wheelset, of<&C::vy>(), "", {"wheelset_velocity", 1}},
    {"wheelset_velocity", "vz_mm_s", kSpeed, B::wheelset, of<&C::vz>(), "", {"wheelset_velocity", 2}},
    {"wheelset_velocity", "vroll_rad_s", kRate, B::wheelset, of<&C::vroll>(),
     "rates of its angles; pitch as found where the longitudinal force is prescribed",
     {"wheelset_rates_roll_yaw_pitch", 0}},
    {"wheelset_velocity", "vyaw_rad_s", kRate, B::wheelset, of<&C::vyaw>(), "",
     {"wheelset_rates_roll_yaw_pitch", 1}},
    {"wheelset_velocity", "vpitch_rad_s", kRate, B::wheelset, of<&C::vpitch>(),
     "", {"wheelset_rates_roll_yaw_pitch", 2}},
    {"force_on_rail", "fx_tr_N", kForce, B::wheelset, smooth(part<&C::force_tr, 0>()), "total force in track axes",
     {"force_on_rail_track", 0}},
    {"force_on_rail", "fy_tr_N", kForce, B::wheelset, smooth(part<&C::force_tr, 1>()), "", {"force_on_rail_track", 1}},
    {"force_on_rail", "fz_tr_N", kForce, B::wheelset, smooth(part<&C::force_tr, 2>()), "", {"force_on_rail_track", 2}},
    {"force_on_rail", "fx_ws_N", kForce, B::wheelset, smooth(part<&C::force_ws, 0>()), "total force in wheelset axes",
     {"force_on_rail_wheelset", 0}},
    {"force_on_rail", "fy_ws_N", kForce, B::wheelset, smooth(part<&C::force_ws, 1>()), "",
     {"force_on_rail_wheelset", 1}},
    {"force_on_rail", "fz_ws_N", kForce, B::wheelset, smooth(part<&C::force_ws, 2>()), "",
     {"force_on_rail_wheelset", 2}},
    {"force_on_rail", "mx_r_Nmm", kMoment, B::wheelset, smooth(part<&C::moment_rail, 0>()),
     "total moment about the rail's origin in track axes", {"moment_on_rail_at_rail", 0}},
    {"force_on_rail", "my_r_Nmm", kMoment, B::wheelset, smooth(part<&C::moment_rail, 1>()), "",
     {"moment_on_rail_at_rail", 1}},
    {"force_on_rail", "mz_r_Nmm", kMoment, B::wheelset, smooth(part<&C::moment_rail, 2>()), "",
     {"moment_on_rail_at_rail", 2}},
    {"force_on_rail", "mx_w_Nmm", kMoment, B::wheelset, smooth(part<&C::moment_wheel, 0>()),
     "total moment about the wheel's origin in wheelset axes", {"moment_on_rail_at_wheel", 0}},
    {"force_on_rail", "my_w_Nmm", kMoment, B::wheelset, smooth(part<&C::moment_wheel, 1>()), "",
     {"moment_on_rail_at_wheel", 1}},
    {"force_on_rail", "mz_w_Nmm", kMoment, B::wheelset, smooth(part<&C::moment_wheel, 2>()), "",
     {"moment_on_rail_at_wheel", 2}},
    {"rail_deflection", "y_mm", kLength, B::deflection, deflection<0>(), "deflection of a rail on springs",
     {"rail_deflection_y"}},
    {"rail_deflection", "z_mm", kLength, B::deflection, deflection<1>(), "", {"rail_deflection_z"}},
    {"roller", "nominal_radius_mm", kLength, B::roller, within<&C::roller, &Roller::nominal_radius>(),
     "of a roller in place of the rail; negative: a ring", {"roller_nominal_radius"}},
    {"roller", "pitch_rate_rad_s", kRate, B::roller, within<&C::roller, &Roller::pitch_rate>(), "",
     {"roller_pitch_rate"}},
    {"timing", "search_s", kTime, B::timing, of<&C::search_s>(),
     "time of the search for contact, undeformed distance, normal and tangential problem: processor time on one "
     "thread, else of the day"},
    {"timing", "distance_s", kTime, B::timing, of<&C::distance_s>(), ""},
    {"timing", "normal_s", kTime, B::timing, of<&C::normal_s>(), ""},
    {"timing", "tangential_s", kTime, B::timing, of<&C::tangential_s>(), ""},
    {"timing", "total_s", kTime, B::timing, of<&C::seconds>(), "wall-clock time of the case"},
    {"counts", "searches", kCount, B::timing, of<&C::searches>(),
     "how often each of these was done, without looks: on few elements, and for a place alone"},
    {"counts", "distances", kCount, B::timing, of<&C::distances>(), ""},
    {"counts", "normal_solves", kCount, B::timing, of<&C::normal_solves>(), ""},
    {"counts", "tangential_solves", kCount, B::timing, of<&C::tangential_solves>(), ""},
};
// clang-format on

/// A row without a meaning goes on with that of the row above.
template <class T>
std::string markdown(std::span<const Quantity<T>> rows) {
  std::string out = "| JSON | HDF5 attribute | meaning |\n|---|---|---|\n", keys, stored, meaning;
  const auto finish = [&] {
    if (!keys.empty() || !stored.empty()) out += fmt::format("| {} | {} | {} |\n", keys, stored, meaning);
    keys.clear(), stored.clear();
  };
  std::string_view object, attribute;
  for (const Quantity<T>& row : rows) {
    if (!row.meaning.empty() || row.object != object) {
      finish();
      meaning = row.meaning;
      attribute = {};
    }
    object = row.object;
    if (!row.key.empty())
      keys += fmt::format("{}`{}{}{}`", keys.empty() ? "" : ", ", row.object, row.object.empty() ? "" : ".", row.key);
    if (row.stored.name.empty() || row.stored.name == attribute) continue;
    attribute = row.stored.name;
    const std::string_view shift = row.in_shift.si;
    stored += fmt::format("{}`{}`{}{}{}{}", stored.empty() ? "" : ", ", attribute, row.unit.si.empty() ? "" : " [",
                          row.unit.si, shift.empty() ? "" : fmt::format("; shift: {}", shift),
                          row.unit.si.empty() ? "" : "]");
  }
  finish();
  return out;
}

}  // namespace

template <>
std::span<const Quantity<P>> quantities() {
  return kPatchQuantities;
}
template <>
std::span<const Quantity<C>> quantities() {
  return kCaseQuantities;
}

template <>
bool P::*flag_of(Block block) {
  switch (block) {
    case B::rolling:
      return &P::has_rolling;
    case B::place:
    case B::angle:
    case B::in_grid:
    case B::arc:
      return &P::has_reference;
    case B::work:
      return &P::shift;
    default:
      return nullptr;
  }
}

template <>
bool C::*flag_of(Block block) {
  return block == B::wheelset ? &C::has_wheelset : nullptr;
}

std::string name_in_file(std::string_view object, std::string_view key) {
  return object.empty() ? std::string(key) : fmt::format("{}.{}", object, key);
}

std::string name_in_si(std::string_view object, std::string_view key, const Unit& unit) {
  constexpr std::string_view kEndings[] = {"_N_mm", "_Nmm", "_mm_s", "_rad_s", "_rad_mm", "_mm2", "_mm",
                                           "_rad",  "_MPa", "_N",    "_J",     "_W",      "_s",   "_C"};
  if (!unit.si.empty() && unit.si != "1")
    for (const std::string_view ending : kEndings)
      if (key.ends_with(ending)) return name_in_file(object, key.substr(0, key.size() - ending.size()));
  return name_in_file(object, key);
}

std::string patch_quantity_table() { return markdown<P>(kPatchQuantities); }
std::string case_quantity_table() { return markdown<C>(kCaseQuantities); }

}  // namespace treadmark::io
