// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/noise_of_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/shape/arc_at.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/profile_scatter.hpp"

namespace treadmark::app {

const Profile* noisy_profile(const NaturalSurface& natural) {
  const auto* profile = std::get_if<Profile>(&natural.spec.shape);
  return profile != nullptr && measured::has_errors(*profile) ? profile : nullptr;
}

namespace {

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

double NoiseOfResults::Known::error(std::size_t draw, std::span<const std::size_t> near, double arc) const {
  return draws ? draws->at(draw, arc) : BrokenLine(s, surface->draws[near[draw]]).held_at(arc);
}

std::string NoiseOfResults::Known::in_words(const std::string& name) const {
  if (scatter && !scatter->between.empty())
    return fmt::format("the {}'s points lie {:.2g} mm apart and do not tell where arcs between them meet", name,
                       kMilli * scatter->step);
  if (scatter)
    return fmt::format("the {}'s points scatter by {:.2g} mm at steps of {:.2g} mm", name, kMilli * scatter->white,
                       kMilli * scatter->step);
  const ErrorSize size = size_of(*surface);
  return fmt::format("the {}, a scan, is known to {:.2g} um (up to {:.2g} um off)", name, kMicro * size.rms,
                     kMicro * size.largest);
}

double NoiseOfResults::Known::station(Body body, const io::CaseResult& result) {
  const io::PatchResult& largest = *ranges::max_element(result.patches, {}, &io::PatchResult::fn);
  const bool wheel = body == Body::wheel;
  return result.bodies ? along(largest, wheel ? result.bodies->X_TA : result.bodies->X_TS, body) : 0.0;
}

std::vector<std::size_t> NoiseOfResults::Known::near_draws(Body body, const io::CaseResult& result) const {
  if (!surface) return {};
  return nearest_draws(*surface, station(body, result), draws_count(), body == Body::wheel ? 2.0 * kPi : 0.0);
}

std::vector<std::vector<double>> NoiseOfResults::heights(Body body, const io::CaseResult& result,
                                                         std::span<const double> places) const {
  const Known& known = body == Body::wheel ? wheel_ : rail_;
  const std::vector<std::size_t> near = known.near_draws(body, result);
  std::vector<std::vector<double>> out(known.draws_count());
  if (out.empty()) return out;
  for (const SectionPlace& place : places_of_section(known.s, known.y, known.z, places))
    for (std::size_t draw = 0; draw < out.size(); ++draw)
      out[draw].push_back(known.error(draw, near, place.arc) / place.cosine);
  return out;
}

std::vector<SourceOfErrors> NoiseOfResults::sources(Body body, const io::CaseResult& result,
                                                    const Surface& surface) const {
  const Known& known = body == Body::wheel ? wheel_ : rail_;
  if (!known.surface) return {};
  return sources_of_errors(*known.surface, body, Known::station(body, result), surface);
}

void NoiseOfResults::add_errors(const io::WheelRailCase& input, const io::CaseResult& result,
                                std::span<io::PatchResult* const> patches,
                                std::span<wheelrail::UncertainPatch> uncertain) const {
  // s of the contact grows with y; the points of a wheel run the other way, and a left-hand side is a mirror image
  const double side = input.side == Side::left ? -1.0 : 1.0;
  const std::size_t draws = std::max(rail_.draws_count(), wheel_.draws_count());
  for (std::size_t k = 0; k < patches.size(); ++k)
    uncertain[k].errors.assign(draws, std::vector<double>(static_cast<std::size_t>(uncertain[k].grid.ny), 0.0));
  for (const Body which : {Body::rail, Body::wheel}) {
    const bool wheel = which == Body::wheel;
    const Known& body = wheel ? wheel_ : rail_;
    if (!body.known()) continue;
    const std::size_t own = body.draws_count();
    // the same for all patches: a body has one error at a time
    const std::vector<std::size_t> near = body.near_draws(which, result);
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const io::PatchResult& patch = *patches[k];
      const Grid2& grid = uncertain[k].grid;
      const double middle =
                       arc_at(body.s, body.y, body.z,
                              {side * (wheel ? patch.y_wheel : patch.y_rail), wheel ? patch.z_wheel : patch.z_rail}),
                   way = wheel ? -side : side;
      for (std::size_t draw = 0; draw < draws; ++draw) {
        // the other body may have more draws: errors are as probable the other way round
        const double sign = draw / own % 2 == 0 ? 1.0 : -1.0;
        for (int iy = 0; iy < grid.ny; ++iy)
          uncertain[k].errors[draw][static_cast<std::size_t>(iy)] +=
              sign * body.error(draw % own, near, middle + way * (grid.y(iy) - patch.reference_s));
      }
    }
  }
}

void NoiseOfResults::add(const io::WheelRailCase& input, io::CaseResult& result) const {
  constexpr double kLarge = 0.025;   // so that hardly any error of 5 % is not doubted
  constexpr double kNothing = 1e-9;  // [m] a hundredth of what exact points may be off
  if (!any()) return;
  std::vector<io::PatchResult*> patches;
  std::vector<wheelrail::UncertainPatch> uncertain;
  for (io::PatchResult& patch : result.patches) {
    const io::PatchFields& f = patch.fields;
    if (f.gap.empty() || f.gap.size() != f.grid.size() || !(patch.pmax > 0.0)) continue;
    const double force = f.grid.cell_area() * std::accumulate(f.pressure.begin(), f.pressure.end(), 0.0);
    patches.push_back(&patch);
    uncertain.push_back({f.grid,
                         f.gap,
                         patch.approach,
                         force,
                         patch.loads ? patch.loads->track.force.z() : force * f.X_TC.rotation(2, 2),
                         f.X_TC.rotation(2, 2),
                         {}});
  }
  if (patches.empty()) return;
  add_errors(input, result, patches, uncertain);
  const auto is_known = [](const wheelrail::UncertainPatch& patch) {
    return ranges::all_of(patch.errors, [](const std::vector<double>& rows) {
      return ranges::all_of(rows, [](double error) { return std::fabs(error) < kNothing; });
    });
  };
  if (ranges::all_of(uncertain, is_known)) return;  // what lies between the points of a flange is nothing to a tread
  const std::vector<std::optional<wheelrail::ErrorSpread>> spread =
      wheelrail::error_spread(uncertain, input.material, input.vertical_force_prescribed);
  std::string why;
  for (const Body body : {Body::wheel, Body::rail})
    if (const Known& one = body == Body::wheel ? wheel_ : rail_; one.known())
      why += (why.empty() ? "" : ", ") + one.in_words(body_name(body));
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (!spread[k]) continue;
    io::PatchResult& patch = *patches[k];
    patch.noise = {spread[k]->pressure * patch.pmax, spread[k]->area * patch.ncon * patch.fields.grid.cell_area(),
                   spread[k]->force * patch.fn, spread[k]->place, spread[k]->approach};
    if (!(spread[k]->pressure > kLarge)) continue;
    result.remarks.push_back(
        {RemarkKind::noisy_profile, static_cast<int>(&patch - result.patches.data()) + 1,
         fmt::format("the largest pressure is known to +-{:.2g} % (standard deviation): {}; measure "
                     "with closer points or less noise, or take the mean of several measurements",
                     100.0 * spread[k]->pressure, why)});
  }
}

}  // namespace treadmark::app
