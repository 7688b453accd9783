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
#include "treadmark/model/shape/profile_scatter.hpp"
#include "treadmark/solvers/kalker/plausibility.hpp"

namespace treadmark::app {

const Profile* noisy_profile(const NaturalSurface& natural) {
  const auto* profile = std::get_if<Profile>(&natural.spec.shape);
  return profile != nullptr && measured::is_smoothed(*profile) ? profile : nullptr;
}

NoiseOfResults::Known NoiseOfResults::known_of(const NaturalSurface& natural) {
  Known side;
  const Profile* profile = noisy_profile(natural);
  if (profile == nullptr) return side;
  side.scatter = profile->scatter;
  side.draws.emplace(*profile);
  side.y = profile->y;
  side.z = profile->z;
  return side;
}

NoiseOfResults::NoiseOfResults(const NaturalSurface& rail, const NaturalSurface& wheel)
    : rail_(known_of(rail)), wheel_(known_of(wheel)) {}

double NoiseOfResults::Known::arc_at(double y_at, double z_at) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < y.size(); ++i)
    if (const double d = std::hypot(y[i] - y_at, z[i] - z_at); d < least) least = d, nearest = i;
  return scatter->s[nearest];
}

io::PatchResult::Noise NoiseOfResults::of_patch(const io::WheelRailCase& input, const io::PatchResult& patch) const {
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
  std::vector<std::vector<double>> errors;
  const auto add = [&](const NoiseOfResults::Known& body, double y, double z, double direction) {
    if (!body.draws) return;
    const double middle = body.arc_at(side * y, z);
    errors.resize(body.draws->size(), std::vector<double>(rows.gap.size(), 0.0));
    for (std::size_t draw = 0; draw < errors.size(); ++draw)
      for (int iy = 0; iy < grid.ny; ++iy)
        errors[draw][static_cast<std::size_t>(iy)] +=
            body.draws->at(draw, middle + side * direction * (grid.y(iy) - patch.reference_s));
  };
  add(rail_, patch.y_rail, patch.z_rail, 1.0);
  add(wheel_, patch.y_wheel, patch.z_wheel, -1.0);
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
    const io::PatchResult::Noise noise = of_patch(input, patch);
    patch.noise = noise;
    if (!(noise.pmax > kLarge * patch.pmax)) continue;
    std::string points;
    for (const auto& [name, body] : {std::pair{"wheel", &wheel_}, std::pair{"rail", &rail_}})
      if (body->scatter)
        points +=
            fmt::format("{}the {}'s points scatter by {:.2g} mm at steps of {:.2g} mm", points.empty() ? "" : ", ",
                        name, kMilli * body->scatter->white, kMilli * body->scatter->step);
    result.remarks.push_back(
        {RemarkKind::noisy_profile, static_cast<int>(k) + 1,
         fmt::format("the largest pressure is known to +-{:.2g} % (standard deviation): {}; measure "
                     "with closer points or less noise, or take the mean of several measurements",
                     100.0 * noise.pmax / patch.pmax, points)});
  }
}

}  // namespace treadmark::app
