// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contact_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

using Columns = std::vector<ContactTableColumn>;

void require(bool holds, const char* message) {
  if (!holds) throw Error(ErrorKind::configuration, message);
}

const Columns& checked(const Columns& columns, const std::vector<double>& loads, std::size_t reference_level) {
  require(columns.size() >= 2, "a contact table needs two lateral positions or more");
  require(!loads.empty() && loads.front() > 0.0 && std::isfinite(loads.back()) &&
              std::ranges::is_sorted(loads, std::less_equal<>{}),
          "the loads of a contact table must be positive and increase");
  require(reference_level < loads.size(), "a contact table has no such reference level");
  for (const ContactTableColumn& column : columns) {
    require(column.under.size() == loads.size(), "every lateral position of a contact table needs all loads");
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const ContactUnderLoad& c = column.under[k];
      require(c.elastic_energy > 0.0 && c.area > 0.0 && c.aspect_ratio > 0.0,
              "energy, area and aspect ratio of a contact table must be positive");
      require(k == 0 || c.z > column.under[k - 1].z, "the wheel of a contact table must sink as the load grows");
    }
  }
  return columns;
}

template <class Value>
std::vector<double> along(const Columns& columns, Value&& value) {
  std::vector<double> values;
  for (const ContactTableColumn& column : columns) values.push_back(value(column));
  return values;
}

std::vector<double> positions(const Columns& columns) {
  return along(columns, [](const ContactTableColumn& column) { return column.y; });
}

template <class Value>
ShapeCurve curve(const Columns& columns, Value&& value) {
  return ShapeCurve::monotone(positions(columns), along(columns, value));
}

ShapeCurve curve(const Columns& columns, std::size_t level, double ContactUnderLoad::*member) {
  return curve(columns, [&](const ContactTableColumn& column) { return column.under[level].*member; });
}

ShapeCurve heights_less_energy(const Columns& columns, double load) {
  return {positions(columns),
          along(columns, [&](const ContactTableColumn& c) { return c.under[0].z - c.under[0].elastic_energy / load; }),
          along(columns, [](const ContactTableColumn& c) { return c.under[0].slope; })};
}

LoadLevel load_level(const Columns& columns, std::size_t level, double load) {
  const auto compression = [&](const ContactTableColumn& c) {
    // Up to the first load like Hertz: the approach that has this energy.
    return level == 0 ? 2.5 * c.under[0].elastic_energy / load : c.under[level].z - c.under[level - 1].z;
  };
  return {load, curve(columns, compression), curve(columns, level, &ContactUnderLoad::area),
          curve(columns, [&](const ContactTableColumn& c) { return std::log(c.under[level].aspect_ratio); })};
}

}  // namespace

ContactTable::ContactTable(const Columns& columns, const std::vector<double>& loads, std::size_t reference_level,
                           wheelrail::Problem problem, const wheelrail::Placement& nominal)
    : y_min_(checked(columns, loads, reference_level).front().y),
      y_max_(columns.back().y),
      problem_(std::move(problem)),
      nominal_(nominal),
      energy_height_(heights_less_energy(columns, loads.front())),
      wheel_y_(curve(columns, reference_level, &ContactUnderLoad::wheel_y)),
      wheel_z_(curve(columns, reference_level, &ContactUnderLoad::wheel_z)) {
  for (std::size_t k = 0; k < loads.size(); ++k) levels_.push_back(load_level(columns, k, loads[k]));
}

}  // namespace treadmark::vehicle
