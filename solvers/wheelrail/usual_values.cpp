// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/usual_values.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr double kNotAsked = std::numeric_limits<double>::quiet_NaN();

/// One number of a problem: from models at a fifth of full size to steam locomotives, broad gauges and record speeds.
struct UsualValue {
  const char* name;
  const char* unit;
  double si;           ///< of one unit
  double least, most;  ///< in the unit
  const char *if_less, *if_more;
  double (*of)(const Problem&);  ///< in SI units; NaN: the problem has none
};

double over_gauge(const Problem& p, double value) { return p.track.gauge_based && !p.roller ? value : kNotAsked; }

constexpr UsualValue kUsualValues[] = {
    {"nominal radius of the wheel", "mm", 1e-3, 80.0, 750.0, "is it in another unit?", "is it the diameter?",
     [](const Problem& p) { return p.wheelset.nominal_radius; }},
    {"vertical force of the wheel", "N", 1.0, 500.0, 1e6, "is it in kN?", "is it in another unit, or of a whole train?",
     [](const Problem& p) { return p.vertical_force.value_or(kNotAsked); }},
    {"gauge of the track", "mm", 1e-3, 250.0, 2200.0, "is it in another unit?", "is it in another unit?",
     [](const Problem& p) { return over_gauge(p, p.track.gauge_width); }},
    {"depth at which the gauge is measured", "mm", 1e-3, 2.0, 40.0, "is it in another unit?", "is it in another unit?",
     [](const Problem& p) { return over_gauge(p, p.track.gauge_height); }},
    {"gauge less the distance of the flange backs", "mm", 1e-3, 20.0, 200.0, "do wheelset and track belong together?",
     "do wheelset and track belong together?",
     [](const Problem& p) { return over_gauge(p, p.track.gauge_width - p.wheelset.flange_back_distance); }},
    {"speed", "m/s", 1.0, 0.0, 200.0, "", "is it in km/h?",
     [](const Problem& p) { return p.regime == kalker::Regime::shift ? kNotAsked : std::abs(p.state.velocity.x); }},
    {"roll of the wheelset", "rad", 1.0, 0.0, 0.3, "", "is it in degrees?",
     [](const Problem& p) { return std::abs(p.state.position.roll); }},
    {"yaw of the wheelset", "rad", 1.0, 0.0, 0.3, "", "is it in degrees?",
     [](const Problem& p) { return std::abs(p.state.position.yaw); }},
    {"cant of the rail", "rad", 1.0, 0.0, 0.15, "", "1:40 is 0.025 rad, or 1.43 degrees",
     [](const Problem& p) { return std::abs(p.track.cant); }}};

/// Beyond this the flange of the other wheel, though worn to the thinnest that any rule allows, has climbed its rail.
double farthest_aside(const Problem& p) {
  constexpr double kThinnestFlange = 20e-3;
  return 0.5 * (p.track.gauge_width - p.wheelset.flange_back_distance) - kThinnestFlange;
}

}  // namespace

void judge_values(const Problem& p, std::vector<Remark>& remarks) {
  for (const UsualValue& one : kUsualValues) {
    const double value = one.of(p) / one.si;
    constexpr double kRounding = 1e-9;
    const bool less = value<one.least*(1.0 - kRounding), more = value> one.most * (1.0 + kRounding);
    if (less || more)
      remarks.push_back(
          {RemarkKind::unusual_value, 0,
           fmt::format("the {} is {:.6g} {}, {} than {:g}: {}", one.name, value, one.unit, less ? "less" : "more",
                       less ? one.least : one.most, less ? one.if_less : one.if_more)});
  }
  const double aside = std::abs(p.state.position.y - p.track.dy), farthest = farthest_aside(p);
  if (p.track.gauge_based && !p.roller && farthest > 0.0 && aside > farthest)
    remarks.push_back(
        {RemarkKind::unusual_value, 0,
         fmt::format("the wheelset stands {:.4g} mm aside, and at {:.4g} mm the flange of its other wheel "
                     "has climbed the rail: is the position right?",
                     kMilli * aside, kMilli * farthest)});
}

std::string usual_value_table() {
  std::string text = "| number | least | most |\n|---|---|---|\n";
  for (const UsualValue& one : kUsualValues)
    text +=
        fmt::format("| {} | {} | {:g} {} |\n", one.name,
                    one.least > 0.0 ? fmt::format("{:g} {}", one.least, one.unit) : std::string(), one.most, one.unit);
  return text;
}

}  // namespace treadmark::wheelrail
