// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/field_catalogue.hpp"

#include <cmath>
#include <iterator>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::report {
namespace {

using Values = std::vector<double>;

constexpr double kPercent = 1e2;

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
// Beside the fields of the files.
constexpr FieldInfo kMadeFields[] = {
    {{20, "adhesion and slip", "", 1.0, Kind::state}, "state", nullptr, no_values},
    {{30, "traction", "MPa", 1.0, Kind::sequential, FieldInfo::Outside::zero}, "traction", nullptr, traction},
    {{60, "slip", "%"}, "slip", nullptr, slip},
    {{70, "slip distance", "µm"}, "slip_distance", nullptr, slip_distance},
};

std::vector<FieldInfo> shown_fields() {
  std::vector<FieldInfo> out(std::begin(kMadeFields), std::end(kMadeFields));
  for (const io::FieldColumn& column : io::kFieldColumns)
    if (column.shown.rank > 0) out.push_back({column.shown, column.name, &column});
  ranges::sort(out, {}, [](const FieldInfo& field) { return field.rank; });
  return out;
}

}  // namespace

std::vector<double> FieldInfo::values(const io::PatchResult& patch) const {
  if (column == nullptr) return made(patch);
  if (patch.shift && column->unit != column->unit_shift) return {};  // the shown unit is not that of a shift
  Values out = patch.fields.*column->values;
  for (double& value : out) value *= factor;
  return out;
}

std::span<const FieldInfo> field_catalogue() {
  static const std::vector<FieldInfo> fields = shown_fields();
  return fields;
}

const FieldInfo* find_field(std::string_view name) {
  for (const FieldInfo& field : field_catalogue())
    if (field.name == name) return &field;
  return nullptr;
}

}  // namespace treadmark::report
