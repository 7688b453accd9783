// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/solvers/kalker/halfspace/angle_corrected_kernel.hpp"

namespace treadmark {
struct InfluenceSettings;
}

namespace treadmark::kalker {

/// What an inclination does to a row: the trigonometric functions of the angle and of half of it.
enum class RowFactor { one, cosine, sine, half_cosine, half_sine };
inline constexpr std::size_t kRowFactors = 5;

/// Inclinations of the rows of a box of elements, and what is turned by their differences.
class RowInclination {
 public:
  /// angle: of every row [rad].
  RowInclination(std::vector<double> angle, AngleCorrection correction);

  AngleCorrection correction() const { return correction_; }
  std::size_t size() const { return angle_.size(); }
  /// Inclination of a loaded row minus that of the row that is looked at [rad].
  double difference(int loaded, int observed) const {
    return angle_[static_cast<std::size_t>(loaded)] - angle_[static_cast<std::size_t>(observed)];
  }
  /// One value a row.
  std::span<const double> values(RowFactor factor) const { return values_[static_cast<std::size_t>(factor)]; }

 private:
  std::vector<double> angle_;
  AngleCorrection correction_;
  std::array<std::vector<double>, kRowFactors> values_;
};

/// Inclination of a surface along y: linear between given positions, its first and last slope beyond them.
class InclinationTable {
 public:
  /// settings: positions [m] that increase, inclinations [rad], variant. Errors: Error(configuration) for less than two
  /// positions, another number of inclinations, positions that do not increase, numbers that are not finite, or an
  /// unknown variant.
  explicit InclinationTable(const InfluenceSettings& settings);

  /// [rad] at y [m].
  double at(double y) const;
  /// Of `count` rows of a grid from row `first` on; rows beyond the grid count too.
  RowInclination rows(const Grid2& grid, int first, int count) const;

 private:
  std::vector<double> position_, inclination_;
  AngleCorrection correction_;
};

/// The variant as a correction. Errors: Error(configuration) unless it is 1 to 4.
AngleCorrection angle_correction(const InfluenceSettings& settings);

}  // namespace treadmark::kalker
