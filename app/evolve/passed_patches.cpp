// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/evolve/passed_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>

#include <fmt/format.h>

#include "treadmark/analysis/damage/fatigue.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

namespace treadmark::app {
namespace {

/// Coordinates on a body's own surface.
struct SurfacePlace {
  double u, y;
};

SurfacePlace place_on(Body body, bool left, const Pose& X_BT, const Vec3& point_T) {
  const Vec3 p = X_BT.apply(point_T);
  const double y = left ? -p.y() : p.y();
  return body == Body::wheel ? SurfacePlace{std::atan2(p.x(), p.z()), y} : SurfacePlace{p.x(), y};
}

damage::PassedPatch passed_patch(const io::PatchResult& patch, Body body, bool left, const Pose& X_BT) {
  const io::PatchFields& f = patch.fields;
  damage::PassedPatch out;
  out.velocity = patch.velocity;
  out.length = f.grid.dx;
  out.width = f.grid.dy;
  out.power = std::max(0.0, -patch.frictional_power);
  out.normal_force = patch.fn;
  out.traction_force = std::hypot(patch.fx, patch.fs);
  const std::vector<double>& temperature = body == Body::wheel ? f.temperature_2 : f.temperature_1;
  const std::vector<Vec2> edges = io::row_edges(f, patch.reference_s);
  for (int iy = 0; iy < f.grid.ny; ++iy) {
    const Vec2 &low = edges[static_cast<std::size_t>(iy)], &high = edges[static_cast<std::size_t>(iy) + 1];
    const Vec2 middle = 0.5 * (low + high);
    for (int ix = 0; ix < f.grid.nx; ++ix) {
      const std::size_t i = f.grid.index(ix, iy);
      if (f.state[i] == 0) continue;
      const auto at = [&](const Vec2& sn) {
        return place_on(body, left, X_BT, f.X_TC.apply({f.grid.x(ix), sn.x(), sn.y()}));
      };
      const auto [y_low, y_high] = std::minmax({at(low).y, at(high).y});
      out.elements.push_back({at(middle).u, y_low, y_high, f.pressure[i], std::hypot(f.traction_x[i], f.traction_s[i]),
                              std::hypot(f.slip_x[i], f.slip_s[i]), std::max(0.0, f.dissipation[i]),
                              temperature.empty() ? 0.0 : temperature[i]});
    }
  }
  return out;
}

/// Tractions of a patch with as much free surface before and behind it as it is long, where points come from and go to,
/// and with so many more rows to both sides.
struct WiderTractions {
  Grid2 grid;
  std::vector<double> pressure, x, s;

  explicit WiderTractions(const io::PatchFields& f, int more_rows = 0) : grid(f.grid) {
    const int more = f.grid.nx;
    grid.nx += 2 * more, grid.ny += 2 * more_rows;
    grid.x0 -= more * grid.dx, grid.y0 -= more_rows * grid.dy;
    for (auto [to, from] : {std::pair{&pressure, &f.pressure}, {&x, &f.traction_x}, {&s, &f.traction_s}}) {
      to->assign(grid.size(), 0.0);
      for (int iy = 0; iy < f.grid.ny; ++iy)
        for (int ix = 0; ix < f.grid.nx; ++ix)
          (*to)[grid.index(ix + more, iy + more_rows)] = (*from)[f.grid.index(ix, iy)];
    }
  }
};

void check_depths(const std::vector<double>& depths, const Grid2& grid, const SourcePosition& where) {
  if (const double least = std::max(grid.dx, grid.dy); depths.front() < 0.999 * least)
    throw Error(
        ErrorKind::configuration,
        fmt::format("stresses at a depth of {:.3g} mm below elements of {:.3g} mm", 1e3 * depths.front(), 1e3 * least),
        where, "choose smaller elements (discretisation.dx_mm and ds_mm), or greater depths_mm");
}

/// Depths as the solver counts them: the wheel is the other half-space.
std::vector<double> depths_in(Body body, std::vector<double> depths) {
  if (body == Body::wheel)
    for (double& depth : depths) depth = -depth;
  return depths;
}

void add_stresses_of(damage::PassedPatch& out, const io::PatchResult& patch, const io::Case& given, Body body,
                     bool left, const Pose& X_BT, const FatigueSettings& fatigue) {
  const io::PatchFields& f = patch.fields;
  check_depths(fatigue.depths, f.grid, given.where);
  const WiderTractions wider(f);
  const auto& input = std::get<io::WheelRailCase>(given.content);
  const std::vector<double> z = depths_in(body, fatigue.depths);
  const auto points =
      kalker::subsurface_stress_on_grid({wider.grid, wider.pressure, wider.x, wider.s}, input.material, z);
  const std::vector<Vec2> edges = io::row_edges(f, patch.reference_s);
  const auto y_at = [&](const Vec2& sn) { return place_on(body, left, X_BT, f.X_TC.apply({0.0, sn.x(), sn.y()})).y; };
  for (int iy = 0; iy < f.grid.ny; ++iy) {
    const auto state = f.state.begin() + static_cast<std::ptrdiff_t>(f.grid.index(0, iy));
    if (std::all_of(state, state + f.grid.nx, [](auto s) { return s == 0; })) continue;
    const auto row = static_cast<std::size_t>(iy);
    const auto [y_low, y_high] = std::minmax({y_at(edges[row]), y_at(edges[row + 1])});
    for (std::size_t depth = 0; depth < z.size(); ++depth) {
      std::vector<Mat3> history;
      history.reserve(static_cast<std::size_t>(wider.grid.nx));
      for (int ix = 0; ix < wider.grid.nx; ++ix)
        history.push_back(points[depth * wider.grid.size() + wider.grid.index(ix, iy)].stress);
      damage::StressMeasures found = damage::stress_measures(history, fatigue.dang_van_slope);
      if (!fatigue.has(FatigueMeasure::subsurface)) found.von_mises = found.shear = found.shakedown = 0.0;
      if (!fatigue.has(FatigueMeasure::dang_van)) found.dang_van = 0.0;
      out.stresses.push_back({y_low, y_high, depth, found});
    }
  }
}

}  // namespace

std::vector<damage::PassedPatch> passed_patches(const io::Case& given, const io::CaseResult& result, Body body,
                                                const FatigueSettings& fatigue) {
  if (result.patches.empty()) return {};
  const auto& input = std::get<io::WheelRailCase>(given.content);
  const Pose X_BT = (body == Body::wheel ? result.bodies->X_TA : result.bodies->X_TS).inverse();
  std::vector<damage::PassedPatch> out;
  for (const io::PatchResult& patch : result.patches) {
    if (patch.shift || !patch.has_rolling || !(patch.velocity > 0.0))
      throw Error(ErrorKind::configuration, "a case of an evolution must roll", given.where,
                  "choose case.regime steady or transient, and a speed");
    if (patch.fields.dissipation.empty() || patch.fields.slip_x.empty())
      throw Error(ErrorKind::configuration, "a case of an evolution needs tractions and slip of its contacts",
                  given.where, "choose a tangential model other than none, without a plastic layer");
    for (const FatigueMeasureRow& row : fatigue_measures())
      if (row.heat && fatigue.has(row.measure) && patch.fields.temperature_1.empty())
        throw Error(ErrorKind::configuration, fmt::format("{} needs the temperatures of contacts", row.word),
                    given.where,
                    "say heat.compute = true in the base: temperatures are those of steady rolling at a speed");
    out.push_back(passed_patch(patch, body, input.side == Side::left, X_BT));
    out.back().fatigue = damage::contact_fatigue(fatigue, out.back());
  }
  return out;
}

void add_stresses(std::vector<damage::PassedPatch>& patches, const io::Case& given, const io::CaseResult& result,
                  Body body, const FatigueSettings& fatigue) {
  if (fatigue.depths.empty() || patches.empty()) return;
  const auto& input = std::get<io::WheelRailCase>(given.content);
  const Pose X_BT = (body == Body::wheel ? result.bodies->X_TA : result.bodies->X_TS).inverse();
  for (std::size_t k = 0; k < patches.size(); ++k)
    add_stresses_of(patches[k], result.patches[k], given, body, input.side == Side::left, X_BT, fatigue);
}

std::vector<damage::PassedShear> passed_shears(const io::Case& given, const io::CaseResult& result, std::size_t number,
                                               Body body, const FlowLaw& law) {
  const io::PatchResult& patch = result.patches[number];
  const io::PatchFields& f = patch.fields;
  const auto& input = std::get<io::WheelRailCase>(given.content);
  const bool left = input.side == Side::left;
  const Pose X_BT = (body == Body::wheel ? result.bodies->X_TA : result.bodies->X_TS).inverse();
  check_depths(law.depths, f.grid, given.where);
  const int more = f.grid.ny / 2 + 1;
  const WiderTractions wider(f, more);
  const std::vector<double> z = depths_in(body, law.depths);
  const auto points =
      kalker::subsurface_stress_on_grid({wider.grid, wider.pressure, wider.x, wider.s}, input.material, z);
  std::vector<Vec2> edges = io::row_edges(f, patch.reference_s);
  const Vec2 first = edges[0] - edges[1], last = edges[edges.size() - 1] - edges[edges.size() - 2];
  for (int k = 0; k < more; ++k) {
    edges.insert(edges.begin(), edges.front() + first);
    edges.emplace_back(edges.back() + last);
  }
  // the rail's surface is dragged by the traction, the wheel's against it; stresses xz and yz are less the traction
  const double sense = body == Body::wheel ? 1.0 : -1.0;
  std::vector<damage::PassedShear> out;
  for (int iy = 0; iy < wider.grid.ny; ++iy) {
    const Vec2 &low = edges[static_cast<std::size_t>(iy)], &high = edges[static_cast<std::size_t>(iy) + 1];
    const Vec2 middle = 0.5 * (low + high);
    for (int ix = 0; ix < wider.grid.nx; ++ix) {
      const auto at = [&](const Vec2& sn) {
        return place_on(body, left, X_BT, f.X_TC.apply({wider.grid.x(ix), sn.x(), sn.y()}));
      };
      const double y_first = at(low).y, y_last = at(high).y;
      for (std::size_t depth = 0; depth < z.size(); ++depth) {
        const Mat3& stress = points[depth * wider.grid.size() + wider.grid.index(ix, iy)].stress;
        const Vec2 shear = sense * Vec2(stress(0, 2), y_last > y_first ? stress(1, 2) : -stress(1, 2));
        if (shear.norm() > law.shear_yield)
          out.push_back({at(middle).u, std::min(y_first, y_last), std::max(y_first, y_last), depth, shear});
      }
    }
  }
  return out;
}

double place_along(const io::WheelRailCase& input, Body body) {
  if (body == Body::rail) return input.state.position.x;
  const double theta = std::fmod(-input.state.position.pitch, 2.0 * kPi);
  return theta < 0.0 ? theta + 2.0 * kPi : theta;
}

std::vector<damage::Stretch> stretches(const std::vector<double>& places, Body body, double length) {
  const std::size_t n = places.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  ranges::sort(order, {}, [&](std::size_t i) { return places[i]; });
  std::vector<damage::Stretch> out(n);
  const double turn = 2.0 * kPi;
  for (std::size_t k = 0; k < n; ++k) {
    const double here = places[order[k]];
    double before = k > 0 ? places[order[k - 1]] : NAN, after = k + 1 < n ? places[order[k + 1]] : NAN;
    if (body == Body::wheel) {
      if (k == 0) before = places[order[n - 1]] - turn;
      if (k + 1 == n) after = places[order[0]] + turn;
    } else {
      if (n == 1) before = here - length, after = here + length;
      if (k == 0 && n > 1) before = 2.0 * here - after;
      if (k + 1 == n && n > 1) after = 2.0 * here - before;
    }
    if (!(after > here))
      throw Error(ErrorKind::configuration,
                  fmt::format("two cases of a position are at one place of the {}", body_name(body)), {},
                  "give every case of the base its own wheelset.pitch_deg (wheel) or wheelset.s_mm (rail)");
    out[order[k]] = {here, 0.5 * (before + here), 0.5 * (here + after)};
  }
  return out;
}

}  // namespace treadmark::app
