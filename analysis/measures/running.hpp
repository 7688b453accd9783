// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/analysis/measures/section.hpp"
#include "treadmark/model/vehicle/assessment.hpp"

namespace treadmark::measures {

/// What running tests and passengers ask of a run, after EN 14363 and EN 12299: wheel forces and accelerations
/// filtered, sliding means, percentiles against limits, section by section. docs/assessment.md has the definitions. SI;
/// y to the right, z down.

/// One wheel: forces on the rail at every instant.
struct WheelSignal {
  std::string name;          ///< "ws1_right"
  bool left = false;         ///< its outside is y < 0
  std::size_t wheelset = 0;  ///< index in RunSignals::wheelsets
  std::vector<double> q, y;  ///< vertical, lateral [N]
  std::vector<double> wear;  ///< wear number T gamma [N]; empty: not known
  /// What laws make of it at every instant, by their names: volume by distance [m3/m], damage of a passage.
  std::map<std::string, std::vector<double>> laws = {};
};

struct WheelsetSignal {
  std::string name;        ///< "ws1"
  double load = kUnknown;  ///< on its two rails at rest, 2 Q0 [N]
};

/// Accelerations of a point of a body, and the rate at which the body rolls.
enum class PointMotion { longitudinal, lateral, vertical, roll };

struct PointSignal {
  std::string name;  ///< "floor"
  PointKind kind = PointKind::car_body;
  PointMotion motion = PointMotion::lateral;
  std::vector<double> values;  ///< [m/s2], [rad/s]
};

/// A run as it was recorded, at any steps.
struct RunSignals {
  std::vector<double> time, place;  ///< of each instant, increasing [s]; distance [m]
  std::vector<WheelSignal> wheels;
  std::vector<WheelsetSignal> wheelsets;
  std::vector<PointSignal> points;
  std::vector<double> curvature;  ///< of the line at each instant, positive to the right [1/m]; empty: straight
};

enum class AssessedStatus {
  ok,
  outside,     ///< the run does not hold all of the section, or of what a mean needs around it
  too_short,   ///< the section is shorter than the window of the mean or a period of the filter
  too_coarse,  ///< an eighth of a period of the filter is shorter than some step of the record
  unloaded,    ///< the wheel carries less than a hundredth of its load: there is no ratio of forces
};
const char* name_of(AssessedStatus status);
/// Why there are no numbers, in words; "" of ok.
const char* reason_of(AssessedStatus status);

/// A quantity of a section. Numbers are NaN unless the status is ok.
struct Assessed {
  std::string section, place;  ///< "curve 1"; "ws1_right", "ws1", "floor"
  std::string quantity;        ///< key of a row of assessed_quantities
  AssessedStatus status = AssessedStatus::ok;
  std::size_t samples = 0;
  double least = kUnknown, most = kUnknown, mean = kUnknown, rms = kUnknown;
  double low = kUnknown, middle = kUnknown, high = kUnknown;  ///< 0.15, 50 and 99.85 %
  double value = kUnknown;                                    ///< that is compared with the limit
  double limit = kUnknown;                                    ///< NaN: none
  double share() const { return value / limit; }
};

/// What is assessed: the rows of the table, with what stands behind each.
struct QuantityInfo {
  const char *key, *unit, *meaning;
  const char* value;        ///< which number is compared
  const char* source = "";  ///< of a law; empty: none
};
std::span<const QuantityInfo> assessed_quantities();
/// Errors: Error(configuration) for keys that are none.
const QuantityInfo& quantity_info(const std::string& key);

/// The longest step of a record that is too coarse for none of the quantities of these signals, whatever their values
/// [s].
double longest_record_step(const RunSignals& run);

/// Samples are taken at 1 kHz, sliding means every half metre. Errors: Error(input_data) for signals of different
/// lengths, with fewer than two instants, or whose time does not increase.
std::vector<Assessed> assess_run(const RunSignals& run, std::span<const AssessmentSection> sections,
                                 VehicleKind vehicle, const RunningLimits& limits = usual_limits());

}  // namespace treadmark::measures
