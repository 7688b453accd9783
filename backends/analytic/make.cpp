// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/make.hpp"

#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/backends/analytic/chain.hpp"
#include "treadmark/backends/analytic/prismatic_surface.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/analytic/wheels/revolved_surface.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::analytic {

std::shared_ptr<const Surface> make_prismatic_surface(const ArcChain& chain) {
  return std::make_shared<PrismaticSurface>(chain);
}

std::shared_ptr<const Surface> make_revolved_surface(const ArcChain& chain, double nominal_radius,
                                                     const std::vector<WheelFlat>& flats) {
  return std::make_shared<RevolvedSurface>(graph_of(chain), nominal_radius, flats);
}

std::shared_ptr<const Surface> make_standard_surface(const StandardProfile& profile, Body body, double nominal_radius,
                                                     const std::vector<WheelFlat>& flats) {
  std::variant<ArcChain, GraphCurve> shape = standard_curve(profile.name);
  const Body belongs_to = std::holds_alternative<ArcChain>(shape) ? Body::rail : Body::wheel;
  if (belongs_to != body)
    throw Error(ErrorKind::configuration,
                fmt::format("the standard profile {} belongs to a {}, not to a {}", profile.name,
                            belongs_to == Body::wheel ? "wheel" : "rail", body == Body::wheel ? "wheel" : "rail"));
  if (body == Body::wheel)
    return std::make_shared<RevolvedSurface>(std::get<GraphCurve>(std::move(shape)), nominal_radius, flats);
  if (!flats.empty()) throw Error(ErrorKind::configuration, "flats belong to wheels, not to rails");
  return make_prismatic_surface(std::get<ArcChain>(shape));
}

ArcChain cylinder_chain(double radius, double half_angle) {
  return {-radius * std::sin(half_angle),
          radius * (1.0 - std::cos(half_angle)),
          -half_angle,
          {{2.0 * radius * half_angle, 1.0 / radius}}};
}

ArcChain straight_chain(double half_width) { return {-half_width, 0.0, 0.0, {{2.0 * half_width, 0.0}}}; }

ArcChain barrel_chain(double meridian_radius, double half_angle) {
  return {-meridian_radius * std::sin(half_angle),
          -meridian_radius * (1.0 - std::cos(half_angle)),
          half_angle,
          {{2.0 * meridian_radius * half_angle, -1.0 / meridian_radius}}};
}

}  // namespace treadmark::analytic
