// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/field_catalogue.hpp"

#include <array>
#include <cmath>

#include "treadmark/core/constants.hpp"

namespace treadmark::app::report {
namespace {

using Values = std::vector<double>;
using Fields = io::PatchFields;

constexpr double kPercent = 1e2;

template <Values Fields::*Member>
Values scaled(const io::PatchResult& patch, double factor) {
  Values out = patch.fields.*Member;
  for (double& value : out) value *= factor;
  return out;
}

template <Values Fields::*Member>
Values megapascals(const io::PatchResult& patch) {
  return scaled<Member>(patch, kMega);
}

template <Values Fields::*Member>
Values micrometres(const io::PatchResult& patch) {
  return scaled<Member>(patch, kMicro);
}

template <Values Fields::*Member>
Values plain(const io::PatchResult& patch) {
  return patch.fields.*Member;
}

Values length_of(const Values& x, const Values& s, double factor) {
  Values out;
  if (x.size() != s.size()) return out;
  for (std::size_t i = 0; i < x.size(); ++i) out.push_back(factor * std::hypot(x[i], s[i]));
  return out;
}

Values traction(const io::PatchResult& patch) {
  return length_of(patch.fields.traction_x, patch.fields.traction_s, kMega);
}

/// Of a shift these are lengths; see slip_distance.
Values slip(const io::PatchResult& patch) {
  return patch.shift ? Values{} : length_of(patch.fields.slip_x, patch.fields.slip_s, kPercent);
}

Values slip_distance(const io::PatchResult& patch) {
  return patch.shift ? length_of(patch.fields.slip_x, patch.fields.slip_s, kMicro) : Values{};
}

Values no_values(const io::PatchResult&) { return {}; }

using Kind = FieldInfo::Kind;
constexpr std::array<FieldInfo, 14> kFields{{
    {"pressure", "pressure", "MPa", Kind::sequential, megapascals<&Fields::pressure>},
    {"state", "adhesion and slip", "", Kind::state, no_values},
    {"traction", "traction", "MPa", Kind::sequential, traction},
    {"traction_x", "longitudinal traction", "MPa", Kind::diverging, megapascals<&Fields::traction_x>},
    {"traction_s", "lateral traction", "MPa", Kind::diverging, megapascals<&Fields::traction_s>},
    {"slip", "slip", "%", Kind::sequential, slip},
    {"slip_distance", "slip distance", "µm", Kind::sequential, slip_distance},
    {"gap", "undeformed distance", "µm", Kind::diverging, micrometres<&Fields::gap>},
    {"displacement_n", "normal displacement", "µm", Kind::sequential, micrometres<&Fields::displacement_n>},
    {"friction", "coefficient of friction", "", Kind::sequential, plain<&Fields::friction>},
    {"temperature_1", "temperature of the rail", "°C", Kind::sequential, plain<&Fields::temperature_1>},
    {"temperature_2", "temperature of the wheel", "°C", Kind::sequential, plain<&Fields::temperature_2>},
    {"plastic_x", "longitudinal plastic shear", "µm", Kind::diverging, micrometres<&Fields::plastic_x>},
    {"plastic_s", "lateral plastic shear", "µm", Kind::diverging, micrometres<&Fields::plastic_s>},
}};

}  // namespace

std::span<const FieldInfo> field_catalogue() { return kFields; }

const FieldInfo* find_field(std::string_view name) {
  for (const FieldInfo& field : kFields)
    if (field.name == name) return &field;
  return nullptr;
}

}  // namespace treadmark::app::report
