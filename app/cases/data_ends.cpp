// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/data_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/app/surfaces/section_bridges.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::app {
namespace {

using Extent = std::pair<double, double>;

/// From where to where the elements in contact lie on the body: x of a rail [m], theta of a wheel about the middle of
/// what is known of it [rad].
std::optional<Extent> touched(const io::PatchResult& patch, const Pose& X_TB, Body body, double middle) {
  const Pose X_BT = X_TB.inverse();
  const io::PatchFields& f = patch.fields;
  Extent out{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int iy = 0; iy < f.grid.ny; ++iy)
    for (int ix = 0; ix < f.grid.nx; ++ix) {
      const std::size_t k = f.grid.index(ix, iy);
      if (k >= f.pressure.size() || !(f.pressure[k] > 0.0)) continue;
      const Vec3 at = X_BT.apply(f.X_TC.apply({f.grid.x(ix), f.grid.y(iy), 0.0}));
      const double u = body == Body::wheel ? middle + wrap_angle(std::atan2(at.x(), at.z()) - middle) : at.x();
      out = {std::min(out.first, u), std::max(out.second, u)};
    }
  if (!(out.first <= out.second)) return std::nullopt;
  return out;
}

std::string place_text(double u, Body body) {
  return body == Body::wheel ? fmt::format("{:.5g} degrees", u * 180.0 / kPi)
                             : fmt::format("x = {:.6g} mm", kMilli * u);
}

}  // namespace

void doubt_contact_beyond_data(const io::WheelRailCase& input, SurfaceStore& store, io::CaseResult& result) {
  if (!result.bodies || input.roller) return;
  for (const Body body : {Body::rail, Body::wheel}) {
    const bool wheel = body == Body::wheel;
    const io::SurfaceSource& source = wheel ? input.wheel : input.rail;
    const auto known = measured_range(*store.natural(source, body, profile_radius(input, body)), source);
    if (!known) continue;
    const double middle = 0.5 * (known->first + known->second), radius = wheel ? input.wheelset.nominal_radius : 1.0;
    for (std::size_t k = 0; k < result.patches.size(); ++k) {
      const auto at = touched(result.patches[k], wheel ? result.bodies->X_TA : result.bodies->X_TS, body, middle);
      if (!at) continue;
      const double before = known->first - at->first, behind = at->second - known->second;
      const double beyond = std::max(before, behind);
      if (!(beyond > 0.0)) continue;
      result.remarks.push_back(
          {RemarkKind::surface_ends_in_contact, static_cast<int>(k) + 1,
           fmt::format(
               "contact lies up to {:.4g} mm beyond the sections of the {}, which are known from {} to {}: there "
               "it is taken to go on as it ends",
               kMilli * beyond * radius, wheel ? "wheel" : "rail", place_text(known->first, body),
               place_text(known->second, body))});
    }
  }
}

void doubt_contact_between_sections(const io::WheelRailCase& input, SurfaceStore& store, io::CaseResult& result) {
  if (!result.bodies || input.roller) return;
  const auto natural = store.natural(input.rail, Body::rail, profile_radius(input, Body::rail));
  const auto* slices = std::get_if<SliceSet>(&natural->spec.shape);
  if (slices == nullptr) return;
  const std::vector<SectionBridge> bridges = section_bridges(*slices);
  if (bridges.empty()) return;
  const std::vector<double>& u = slices->u;
  // A spline through steps swings by 0.27 of them a section farther on: four leave a two-hundredth.
  constexpr std::size_t kSwings = 4;
  const auto doubt = [&](const Extent& at, int patch) {
    for (const SectionBridge& bridge : bridges) {
      const double from = u[bridge.first - std::min(bridge.first, kSwings)],
                   to = u[std::min(bridge.first + 1 + kSwings, u.size() - 1)];
      if (at.second < from || at.first > to) continue;
      result.remarks.push_back({RemarkKind::between_sections, patch, to_text(bridge)});
      return;
    }
  };
  for (std::size_t k = 0; k < result.patches.size(); ++k)
    if (const auto at = touched(result.patches[k], result.bodies->X_TS, Body::rail, 0.0))
      doubt(*at, static_cast<int>(k) + 1);
  if (result.patches.empty()) {
    const double here = result.bodies->X_TS.inverse().origin.x();
    doubt({here, here}, 0);
  }
}

}  // namespace treadmark::app
