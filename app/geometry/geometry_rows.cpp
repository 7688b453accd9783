// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark {
namespace {

using F = const app::FunctionRow&;
using L = const geometry::LoadedPosition&;
using unit::kMm;
using unit::kMPa;
using unit::kN;
using unit::kOne;

constexpr FileUnit kRad{"rad"}, kPerM{"1/m"};

double shared(const geometry::LoadedSide& side) { return side.reason.empty() ? (side.shared ? 1.0 : 0.0) : kNaN; }

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
constexpr Column<app::FunctionRow> kFunctions[] = {
    {"y_mm", kMm, "", {[](F f) { return f.position.y; }}},
    {"delta_r_mm", kMm, "", {[](F f) { return f.position.radius_difference(); }}},
    {"radius_right_mm", kMm, "", {[](F f) { return f.position.right.radius; }}},
    {"radius_left_mm", kMm, "", {[](F f) { return f.position.left.radius; }}},
    {"wheel_y_right_mm", kMm, "", {[](F f) { return f.position.right.wheel_y; }}},
    {"wheel_y_left_mm", kMm, "", {[](F f) { return f.position.left.wheel_y; }}},
    {"rail_y_right_mm", kMm, "", {[](F f) { return f.position.right.rail_y; }}},
    {"rail_y_left_mm", kMm, "", {[](F f) { return f.position.left.rail_y; }}},
    {"angle_right_rad", kRad, "", {[](F f) { return f.position.right.angle; }}},
    {"angle_left_rad", kRad, "", {[](F f) { return f.position.left.angle; }}},
    {"delta_tan_gamma", kOne, "",
     {[](F f) { return std::tan(f.position.right.angle) - std::tan(f.position.left.angle); }}},
    {"wheel_curvature_right_per_m", kPerM, "", {[](F f) { return f.position.right.wheel_curvature; }}},
    {"wheel_curvature_left_per_m", kPerM, "", {[](F f) { return f.position.left.wheel_curvature; }}},
    {"rail_curvature_right_per_m", kPerM, "", {[](F f) { return f.position.right.rail_curvature; }}},
    {"rail_curvature_left_per_m", kPerM, "", {[](F f) { return f.position.left.rail_curvature; }}},
    {"roll_rad", kRad, "", {[](F f) { return f.position.roll; }}},
    {"z_mm", kMm, "", {[](F f) { return f.position.z; }}},
    {"holding_force_over_weight", kOne, "", {[](F f) { return f.wheelset.holding_force(f.position); }}}};

constexpr Column<geometry::LoadedPosition> kLoaded[] = {
    {"normal_force_right_N", kN, "", {[](L l) { return l.right.normal_force; }}},
    {"normal_force_left_N", kN, "", {[](L l) { return l.left.normal_force; }}},
    {"holding_force_N", kN, "", {[](L l) { return l.holding_force; }}},
    {"pressure_right_MPa", kMPa, "", {[](L l) { return l.right.pressure; }}},
    {"pressure_left_MPa", kMPa, "", {[](L l) { return l.left.pressure; }}},
    {"semi_axis_x_right_mm", kMm, "", {[](L l) { return l.right.semi_axis_x; }}},
    {"semi_axis_x_left_mm", kMm, "", {[](L l) { return l.left.semi_axis_x; }}},
    {"semi_axis_y_right_mm", kMm, "", {[](L l) { return l.right.semi_axis_y; }}},
    {"semi_axis_y_left_mm", kMm, "", {[](L l) { return l.left.semi_axis_y; }}},
    {"approach_right_mm", kMm, "", {[](L l) { return l.right.approach; }}},
    {"approach_left_mm", kMm, "", {[](L l) { return l.left.approach; }}},
    {"lowering_mm", kMm, "", {[](L l) { return l.lowering; }}},
    {"elastic_roll_rad", kRad, "", {[](L l) { return l.roll; }}},
    {"misfit_right", kOne, "", {[](L l) { return l.right.misfit; }}},
    {"misfit_left", kOne, "", {[](L l) { return l.left.misfit; }}},
    {"shared_right", kOne, "", {[](L l) { return shared(l.right); }}},
    {"shared_left", kOne, "", {[](L l) { return shared(l.left); }}},
    {"no_pressure_right", kOne, "",
     {nullptr, nullptr, [](L l) { return !l.right.reason.empty(); }, false,
      [](L l) -> const std::string& { return l.right.reason; }}},
    {"no_pressure_left", kOne, "",
     {nullptr, nullptr, [](L l) { return !l.left.reason.empty(); }, false,
      [](L l) -> const std::string& { return l.left.reason; }}}};
// clang-format on

}  // namespace

template <>
std::span<const Column<app::FunctionRow>> columns() {
  return kFunctions;
}
template <>
std::span<const Column<geometry::LoadedPosition>> columns() {
  return kLoaded;
}

}  // namespace treadmark
