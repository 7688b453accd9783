// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// How reports and pictures show a field.
struct ShownField {
  enum class Kind { sequential, diverging, state };
  enum class Outside { nothing, zero, value };  ///< what it means in elements outside contact
  int rank = 0;  ///< place in menus, small ones first and kept longest where space is short; 0 = not shown
  std::string_view label = {}, unit = {};
  double factor = 1.0;  ///< from SI
  Kind kind = Kind::sequential;
  Outside outside = Outside::nothing;
};

/// A real-valued field of a patch: the name and unit it has in every field file.
struct FieldColumn {
  std::string_view name;
  std::string_view unit;        ///< SI; "1" = dimensionless
  std::string_view unit_shift;  ///< unit in a shift case
  std::string_view meaning;
  std::vector<double> PatchFields::*values;
  ShownField shown = {};
};

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
inline constexpr FieldColumn kFieldColumns[] = {
    {"gap", "m", "m", "undeformed distance, NaN where a surface is missing", &PatchFields::gap,
     {80, "undeformed distance", "µm", kMicro, ShownField::Kind::sequential, ShownField::Outside::value}},
    {"pressure", "Pa", "Pa", "normal pressure", &PatchFields::pressure,
     {10, "pressure", "MPa", kMega, ShownField::Kind::sequential, ShownField::Outside::zero}},
    {"traction_x", "Pa", "Pa", "longitudinal traction on the rail", &PatchFields::traction_x,
     {40, "longitudinal traction", "MPa", kMega, ShownField::Kind::diverging, ShownField::Outside::zero}},
    {"traction_s", "Pa", "Pa", "lateral traction on the rail", &PatchFields::traction_s,
     {50, "lateral traction", "MPa", kMega, ShownField::Kind::diverging, ShownField::Outside::zero}},
    {"displacement_n", "m", "m", "normal displacement, rail minus wheel", &PatchFields::displacement_n,
     {90, "normal displacement", "µm", kMicro, ShownField::Kind::sequential, ShownField::Outside::value}},
    {"displacement_x", "m", "m", "longitudinal displacement, rail minus wheel", &PatchFields::displacement_x},
    {"displacement_s", "m", "m", "lateral displacement, rail minus wheel", &PatchFields::displacement_s},
    {"slip_x", "1", "m", "longitudinal slip, rail minus wheel, over the rolling speed", &PatchFields::slip_x},
    {"slip_s", "1", "m", "lateral slip, rail minus wheel, over the rolling speed", &PatchFields::slip_s},
    {"friction", "1", "1", "coefficient of friction", &PatchFields::friction,
     {100, "coefficient of friction"}},
    {"dissipation", "W/m2", "J/m2", "power (shift: work) of friction that becomes heat", &PatchFields::dissipation,
     {75, "dissipation by friction", "W/mm²", 1e-6, ShownField::Kind::sequential, ShownField::Outside::zero}},
    {"plastic_x", "m", "m", "longitudinal plastic shear of the interface layer", &PatchFields::plastic_x,
     {130, "longitudinal plastic shear", "µm", kMicro, ShownField::Kind::diverging}},
    {"plastic_s", "m", "m", "lateral plastic shear of the interface layer", &PatchFields::plastic_s,
     {140, "lateral plastic shear", "µm", kMicro, ShownField::Kind::diverging}},
    {"yield_stress", "Pa", "Pa", "shear stress at which the interface layer yields", &PatchFields::yield_stress},
    {"temperature_1", "degC", "degC", "surface temperature of the rail", &PatchFields::temperature_1,
     {110, "temperature of the rail", "°C", 1.0, ShownField::Kind::sequential, ShownField::Outside::value}},
    {"temperature_2", "degC", "degC", "surface temperature of the wheel", &PatchFields::temperature_2,
     {120, "temperature of the wheel", "°C", 1.0, ShownField::Kind::sequential, ShownField::Outside::value}},
    {"extra_slip_x", "1", "m", "longitudinal rigid slip beyond the creepages", &PatchFields::extra_slip_x},
    {"extra_slip_s", "1", "m", "lateral rigid slip beyond the creepages", &PatchFields::extra_slip_s},
    {"pmax_by_rail", "Pa/m", "Pa/m", "derivative of the largest pressure by the height of the rail along n", &PatchFields::pmax_by_rail,
     {150, "largest pressure by height of the rail", "MPa/µm", kMega * kMega, ShownField::Kind::diverging, ShownField::Outside::value}},
    {"pmax_by_wheel", "Pa/m", "Pa/m", "derivative of the largest pressure by the height of the wheel along n", &PatchFields::pmax_by_wheel,
     {160, "largest pressure by height of the wheel", "MPa/µm", kMega * kMega, ShownField::Kind::diverging, ShownField::Outside::value}},
};
// clang-format on

/// The fields as Markdown table (docs/results.md).
std::string field_quantity_table();

/// Throws Error(configuration) unless every field of the patch is empty or has one value per element.
/// case_number and patch_number (from 1) go into the message.
void check_field_sizes(const PatchFields& fields, int case_number, int patch_number);

}  // namespace treadmark::io
