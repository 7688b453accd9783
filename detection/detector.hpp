// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/detection/search_settings.hpp"

namespace treadmark::detection {

/// What looks for contact of two bodies, bound to one position of them: a wheel that moves along z of T only shifts
/// its gap. The surfaces outlive it. One per thread.
class Detector {
 public:
  virtual ~Detector() = default;

  /// Least gap [m] at the position given at construction; NaN where the bodies nowhere face each other.
  virtual double least_gap() = 0;

  /// Patches with the wheel moved by wheel_dz [m] along z of T from the position given at construction. Deterministic;
  /// results do not depend on the questions before, but for rounding.
  virtual SearchResult at(double wheel_dz) = 0;

  /// Contact that the last at() passed over, where the detector knows of any.
  virtual std::optional<Overlooked> overlooked() const { return std::nullopt; }
};

/// One way to look for contact: all that the rest of Treadmark knows of it.
struct DetectorRow {
  std::string name;     ///< for case files and the command line: small letters, digits, '-', '_'
  std::string summary;  ///< what it is, in one line
  /// Called from any thread. Errors: Error(configuration) for bodies or settings that it is not for.
  std::function<std::unique_ptr<Detector>(const BodyPair&, const SearchSettings&)> make;
};

/// Adds a detector; from then on it is a choice wherever names of detectors are read. Never removed. Safe from any
/// thread. Errors: Error(configuration) for a name that is taken or that no case file could hold, and a row that lacks
/// something.
void register_detector(DetectorRow row);

/// All of them: the built-in ones, then those added, in their order. The rows live as long as the program.
std::vector<const DetectorRow*> detectors();

/// Errors: Error(configuration) that lists the detectors if the name is none of them.
const DetectorRow& detector_of(std::string_view name);

}  // namespace treadmark::detection
