// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// A real-valued field of a patch: the name and unit it has in every field file.
struct FieldColumn {
  std::string_view name;
  std::string_view unit;        ///< SI; "1" = dimensionless
  std::string_view unit_shift;  ///< unit in a shift case
  std::string_view meaning;
  std::vector<double> PatchFields::*values;
};

inline constexpr std::array<FieldColumn, 17> kFieldColumns{{
    {"gap", "m", "m", "undeformed distance, NaN where a surface is missing", &PatchFields::gap},
    {"pressure", "Pa", "Pa", "normal pressure", &PatchFields::pressure},
    {"traction_x", "Pa", "Pa", "longitudinal traction on the rail", &PatchFields::traction_x},
    {"traction_s", "Pa", "Pa", "lateral traction on the rail", &PatchFields::traction_s},
    {"displacement_n", "m", "m", "normal displacement, rail minus wheel", &PatchFields::displacement_n},
    {"displacement_x", "m", "m", "longitudinal displacement, rail minus wheel", &PatchFields::displacement_x},
    {"displacement_s", "m", "m", "lateral displacement, rail minus wheel", &PatchFields::displacement_s},
    {"slip_x", "1", "m", "longitudinal slip, rail minus wheel, over the rolling speed", &PatchFields::slip_x},
    {"slip_s", "1", "m", "lateral slip, rail minus wheel, over the rolling speed", &PatchFields::slip_s},
    {"friction", "1", "1", "coefficient of friction", &PatchFields::friction},
    {"plastic_x", "m", "m", "longitudinal plastic shear of the interface layer", &PatchFields::plastic_x},
    {"plastic_s", "m", "m", "lateral plastic shear of the interface layer", &PatchFields::plastic_s},
    {"yield_stress", "Pa", "Pa", "shear stress at which the interface layer yields", &PatchFields::yield_stress},
    {"temperature_1", "degC", "degC", "surface temperature of the rail", &PatchFields::temperature_1},
    {"temperature_2", "degC", "degC", "surface temperature of the wheel", &PatchFields::temperature_2},
    {"extra_slip_x", "1", "m", "longitudinal rigid slip beyond the creepages", &PatchFields::extra_slip_x},
    {"extra_slip_s", "1", "m", "lateral rigid slip beyond the creepages", &PatchFields::extra_slip_s},
}};

/// Throws Error(configuration) unless every field of the patch is empty or has one value per element.
/// case_number and patch_number (from 1) go into the message.
void check_field_sizes(const PatchFields& fields, int case_number, int patch_number);

}  // namespace treadmark::io
