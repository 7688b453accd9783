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

constexpr const io::FieldColumn* column_named(std::string_view name) {
  for (const io::FieldColumn& column : io::kFieldColumns)
    if (column.name == name) return &column;
  return nullptr;
}
constexpr auto *kTractionX = column_named("traction_x"), *kTractionS = column_named("traction_s"),
               *kSlipX = column_named("slip_x"), *kSlipS = column_named("slip_s");

using Kind = FieldInfo::Kind;
// Beside the fields of the files.
constexpr FieldInfo kMadeFields[] = {
    {{20, "adhesion and slip", "", 1.0, Kind::state}, "state"},
    {{30, "traction", "MPa", kMega, Kind::sequential, FieldInfo::Outside::zero}, "traction", kTractionX, kTractionS},
    {{60, "slip", "%", kPercent}, "slip", kSlipX, kSlipS},
    {{70, "slip distance", "µm", kMicro}, "slip_distance", kSlipX, kSlipS, true},
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
  if (column == nullptr) return {};
  if (column->unit != column->unit_shift && patch.shift != of_shifts) return {};  // the shown unit is another one
  Values out = patch.fields.*column->values;
  if (other != nullptr) {
    const Values& s = patch.fields.*other->values;
    if (s.size() != out.size()) return {};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::hypot(out[i], s[i]);
  }
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
