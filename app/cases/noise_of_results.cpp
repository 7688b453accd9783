// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/noise_of_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/analysis/measured/patch_spread.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/model/shape/profile_scatter.hpp"
#include "treadmark/solvers/kalker/plausibility.hpp"

namespace treadmark::app {

const Profile* noisy_profile(const NaturalSurface& natural) {
  const auto* profile = std::get_if<Profile>(&natural.spec.shape);
  return profile != nullptr && measured::is_smoothed(*profile) ? profile : nullptr;
}

namespace {

constexpr std::size_t kNearestDraws = 8;

/// Where on a body a patch lies along it: x of a rail [m], angle of a wheel [rad].
double along(const io::PatchResult& patch, const Pose& X_TB, Body body) {
  const Vec3 at = X_TB.inverse().apply({patch.x_tr, patch.y_tr, patch.z_tr});
  return body == Body::wheel ? std::atan2(at.x(), at.z()) : at.x();
}

}  // namespace

NoiseOfResults::Known NoiseOfResults::known_of(const NaturalSurface& natural) {
  Known side;
  if (const Profile* profile = noisy_profile(natural)) {
    side.scatter = profile->scatter;
    side.draws.emplace(*profile);
    side.s = profile->scatter->s;
    side.y = profile->y;
    side.z = profile->z;
  } else if (natural.spec.errors) {
    side.surface = natural.spec.errors;
    side.s = arc_lengths(*side.surface);
    side.y = side.surface->y;
    side.z = side.surface->z;
  }
  return side;
}

NoiseOfResults::NoiseOfResults(const NaturalSurface& rail, const NaturalSurface& wheel)
    : rail_(known_of(rail)), wheel_(known_of(wheel)) {}

std::size_t NoiseOfResults::Known::draws_count() const {
  return draws ? draws->size() : surface ? std::min(kNearestDraws, surface->draws.size()) : 0;
}

double NoiseOfResults::Known::arc_at(double y_at, double z_at) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < y.size(); ++i)
    if (const double d = std::hypot(y[i] - y_at, z[i] - z_at); d < least) least = d, nearest = i;
  return s[nearest];
}

std::string NoiseOfResults::Known::in_words(const std::string& name) const {
  if (scatter)
    return fmt::format("the {}'s points scatter by {:.2g} mm at steps of {:.2g} mm", name, kMilli * scatter->white,
                       kMilli * scatter->step);
  const ErrorSize size = size_of(*surface);
  return fmt::format("the {}, a scan, is known to {:.2g} um (up to {:.2g} um off)", name, kMicro * size.rms,
                     kMicro * size.largest);
}

io::PatchResult::Noise NoiseOfResults::of_patch(const io::WheelRailCase& input, const io::CaseResult& result,
                                                const io::PatchResult& patch) const {
  const Grid2& grid = patch.fields.grid;
  measured::PatchRows rows;
  rows.width = grid.dy;
  rows.force = patch.fn;
  rows.modulus = kalker::contact_modulus(input.material);
  rows.curvature_x = std::cos(patch.angle_wheel) / (input.wheelset.nominal_radius + patch.z_wheel) +
                     (input.roller ? 1.0 / input.roller->nominal_radius : 0.0);
  for (int iy = 0; iy < grid.ny; ++iy) {
    double least = std::numeric_limits<double>::quiet_NaN();
    for (int ix = 0; ix < grid.nx; ++ix) least = std::fmin(least, patch.fields.gap[grid.index(ix, iy)]);
    rows.gap.push_back(least);
  }
  // s of the contact grows with y; the points of a wheel run the other way, and a left-hand side is a mirror image
  const double side = input.side == Side::left ? -1.0 : 1.0;
  const std::size_t draws = std::max(rail_.draws_count(), wheel_.draws_count());
  std::vector<std::vector<double>> errors(draws, std::vector<double>(rows.gap.size(), 0.0));
  const auto add = [&](const NoiseOfResults::Known& body, const std::optional<double>& u, double period, double y,
                       double z, double direction) {
    if (!body.known()) return;
    const double middle = body.arc_at(side * y, z);
    const std::size_t own = body.draws_count();
    const std::vector<std::size_t> near =
        body.surface ? nearest_draws(*body.surface, u.value_or(0.0), own, period) : std::vector<std::size_t>();
    for (std::size_t draw = 0; draw < draws; ++draw)
      for (int iy = 0; iy < grid.ny; ++iy) {
        const double s = middle + side * direction * (grid.y(iy) - patch.reference_s);
        // the other body may have more draws: errors are as probable the other way round
        const double sign = draw / own % 2 == 0 ? 1.0 : -1.0;
        errors[draw][static_cast<std::size_t>(iy)] +=
            sign * (body.draws ? body.draws->at(draw % own, s)
                               : BrokenLine(body.s, body.surface->draws[near[draw % own]]).held_at(s));
      }
  };
  std::optional<double> on_rail, on_wheel;
  if (result.bodies) {
    on_rail = along(patch, result.bodies->X_TS, Body::rail);
    on_wheel = along(patch, result.bodies->X_TA, Body::wheel);
  }
  add(rail_, on_rail, 0.0, patch.y_rail, patch.z_rail, 1.0);
  add(wheel_, on_wheel, 2.0 * kPi, patch.y_wheel, patch.z_wheel, -1.0);
  const measured::PatchSpread spread = measured::patch_spread(rows, errors);
  return {spread.pressure * patch.pmax, spread.area * patch.ncon * grid.cell_area(),
          input.vertical_force_prescribed ? 0.0 : spread.force * patch.fn, spread.shift};
}

void NoiseOfResults::add(const io::WheelRailCase& input, io::CaseResult& result) const {
  constexpr double kLarge = 0.025;  // so that hardly any error of 5 % is not doubted
  if (!any()) return;
  for (std::size_t k = 0; k < result.patches.size(); ++k) {
    io::PatchResult& patch = result.patches[k];
    if (patch.fields.gap.size() != patch.fields.grid.size() || !(patch.pmax > 0.0)) continue;
    const io::PatchResult::Noise noise = of_patch(input, result, patch);
    patch.noise = noise;
    if (!(noise.pmax > kLarge * patch.pmax)) continue;
    std::string why;
    for (const auto& [name, body] : {std::pair{"wheel", &wheel_}, std::pair{"rail", &rail_}})
      if (body->known()) why += (why.empty() ? "" : ", ") + body->in_words(name);
    result.remarks.push_back(
        {RemarkKind::noisy_profile, static_cast<int>(k) + 1,
         fmt::format("the largest pressure is known to +-{:.2g} % (standard deviation): {}; measure "
                     "with closer points or less noise, or take the mean of several measurements",
                     100.0 * noise.pmax / patch.pmax, why)});
  }
}

}  // namespace treadmark::app
