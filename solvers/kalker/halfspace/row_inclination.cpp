// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/row_inclination.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

namespace {

[[noreturn]] void refuse(const std::string& message, const std::string& advice) {
  throw Error(ErrorKind::configuration, "inclinations of the surface row by row: " + message, {}, advice);
}

}  // namespace

RowInclination::RowInclination(std::vector<double> angle, AngleCorrection correction)
    : angle_(std::move(angle)), correction_(correction) {
  const auto fill = [&](RowFactor factor, auto function) {
    auto& values = values_[static_cast<std::size_t>(factor)];
    values.reserve(angle_.size());
    for (const double a : angle_) values.push_back(function(a));
  };
  fill(RowFactor::one, [](double) { return 1.0; });
  fill(RowFactor::cosine, [](double a) { return std::cos(a); });
  fill(RowFactor::sine, [](double a) { return std::sin(a); });
  fill(RowFactor::half_cosine, [](double a) { return std::cos(0.5 * a); });
  fill(RowFactor::half_sine, [](double a) { return std::sin(0.5 * a); });
}

InclinationTable::InclinationTable(const InfluenceSettings& settings)
    : position_(settings.position), inclination_(settings.inclination), correction_(angle_correction(settings)) {
  if (position_.size() != inclination_.size() || position_.size() < 2)
    refuse(
        std::to_string(position_.size()) + " positions have " + std::to_string(inclination_.size()) + " inclinations",
        "give one inclination for each position, at least two");
  for (std::size_t i = 0; i < position_.size(); ++i) {
    if (!std::isfinite(position_[i]) || !std::isfinite(inclination_[i]))
      refuse("a position or an inclination is not finite", "check the table of inclinations");
    if (i > 0 && !(position_[i] > position_[i - 1]))
      refuse("position " + std::to_string(position_[i]) + " m follows " + std::to_string(position_[i - 1]) + " m",
             "positions must increase");
  }
}

double InclinationTable::at(double y) const { return BrokenLine(position_, inclination_).at(y); }

RowInclination InclinationTable::rows(const Grid2& grid, int first, int count) const {
  std::vector<double> angle;
  angle.reserve(static_cast<std::size_t>(count));
  for (int iy = first; iy < first + count; ++iy) angle.push_back(at(grid.y(iy)));
  return {std::move(angle), correction_};
}

AngleCorrection angle_correction(const InfluenceSettings& settings) {
  if (settings.variant < 1 || settings.variant > 4)
    throw Error(ErrorKind::configuration, "angle correction of variant " + std::to_string(settings.variant), {},
                "there are variants 1 to 4");
  return static_cast<AngleCorrection>(settings.variant);
}

}  // namespace treadmark::kalker
