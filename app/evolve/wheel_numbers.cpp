// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/evolve/wheel_numbers.hpp"

#include <limits>
#include <optional>

#include "treadmark/analysis/measures/wheel.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::app {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

std::optional<measures::WheelMeasures> measured(const Surface& wheel, double nominal_radius) {
  constexpr double kStep = 0.2e-3;  // between points of the section [m]
  measures::WheelGauge gauge;
  gauge.placed = true;
  try {
    const measures::Section section(measures::section_points(wheel, Body::wheel, nominal_radius, 0.0, kStep), 0.0);
    return measures::measure_wheel(section, gauge, nominal_radius);
  } catch (const Error&) {
    return std::nullopt;  // a cylinder, a cone, a tread without a flange
  }
}

double conicity_on(const RailMet& on, const std::shared_ptr<const geometry::Section>& wheel) {
  geometry::AnalysisSettings settings;
  settings.second = 0.0;
  settings.harmonic = false;
  geometry::SideBodies side;
  side.wheel = wheel;
  side.radius = wheel->at(0.0).z;
  side.cant = on.cant;
  try {
    side.rail = std::make_shared<const geometry::Section>(geometry::rail_section(*on.rail, on.cant, on.x));
    return geometry::analyse(side, side, on.placement, settings).at_3mm.tan_gamma;
  } catch (const Error&) {
    return kNotKnown;  // rails that the gauge does not reach, flanges in the way
  }
}

}  // namespace

bool is_measurable(const Surface& wheel, double nominal_radius) { return measured(wheel, nominal_radius).has_value(); }

std::vector<io::EvolutionQuantity> wheel_numbers(const Surface& wheel, double nominal_radius,
                                                 const std::vector<RailMet>& rails) {
  const measures::WheelMeasures found = measured(wheel, nominal_radius).value_or(measures::WheelMeasures{});
  const auto section = std::make_shared<const geometry::Section>(geometry::wheel_section(wheel));
  double conicity = 0.0;
  for (const RailMet& on : rails) conicity += on.weight * conicity_on(on, section);
  return {{"wheel_hollow_mm", "mm", "hollow of the tread", kMilli * found.hollow.value},
          {"wheel_flange_height_mm", "mm", "flange height Sh", kMilli * found.flange_height.value},
          {"wheel_flange_thickness_mm", "mm", "flange thickness Sd", kMilli * found.flange_thickness.value},
          {"wheel_flange_gradient_mm", "mm", "flange gradient qR", kMilli * found.flange_gradient.value},
          {"wheel_conicity_3mm", "1", "equivalent conicity at 3 mm on the rails, mean by weight", conicity}};
}

}  // namespace treadmark::app
