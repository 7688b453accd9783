// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/check_settings.hpp"

#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::app {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& why) {
  throw Error(ErrorKind::configuration, key + " would be ignored: " + why, {}, "leave it out");
}

}  // namespace

void check_settings(const io::ImportSettings& settings, Body body) {
  const auto& placement = settings.placement;
  if (body == Body::wheel) {
    if (!placement.up.empty()) refuse("placement.up", "it is that of a rail's head, and this is a wheel");
    if (placement.zero_mm != 0.0) refuse("placement.zero_mm", "it is that of a rail, and this is a wheel (zero_deg)");
  } else {
    if (placement.zero_deg != 0.0) refuse("placement.zero_deg", "it is that of a wheel, and this is a rail (zero_mm)");
    if (placement.nominal_radius_mm > 0.0) refuse("placement.nominal_radius_mm", "a rail has none");
    if (settings.map.angles_deg) refuse("map.angles_deg", "a rail has none");
  }
  if (!placement.zero_direction.empty() && placement.zero != "direction")
    refuse("placement.zero_direction", "placement.zero is " + placement.zero);
  if (settings.fit.mesh == "free" && settings.fit.decimate_um > 0.0)
    refuse("fit.decimate_um", "triangles of an advancing front (fit.mesh = free) are not decimated");
}

}  // namespace treadmark::app
