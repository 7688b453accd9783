// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/geometry/loaded_wheelset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/contact/hertz_ellipse.hpp"

namespace treadmark::geometry {
namespace {

constexpr double kWidestEllipse = 0.5;  // half width over a radius: there a circle leaves its parabola by 7 %
constexpr double kSamples = 3.0;        // over which sections take their curvature
constexpr double kEdge = 3e-3;          // bends between two samples that are less are none [rad]
constexpr double kAlone = 4.0;          // times the bends beside it that make it an edge, not an arc

/// Modulus of the pair by which Hertz' formulas count [Pa].
double modulus_of(const AxleLoad& load) {
  const CombinedMaterial m = combine(load.material);
  const double modulus = m.shear_modulus / (1.0 - m.poisson);
  if (!(load.weight > 0.0) || !std::isfinite(load.weight))
    throw Error(ErrorKind::configuration, fmt::format("an axle load of {:g} N", load.weight), {},
                "it must be positive and finite");
  if (!(modulus > 0.0) || !std::isfinite(modulus))
    throw Error(ErrorKind::configuration, "elastic constants of wheel and rail that no material has");
  return modulus;
}

/// Whether a section has a corner at y: it bends between two samples, and not beside them.
bool is_edge(const Section& s, double y) {
  const double t = (y - s.first()) / s.step();
  if (!(t >= 1.0) || !(t < static_cast<double>(s.size()) - 2.0)) return false;
  const auto i = to_whole<std::size_t>(t);
  const auto bend = [&](std::size_t k) { return std::fabs(std::atan(s.slope()[k + 1]) - std::atan(s.slope()[k])); };
  return bend(i) > kEdge && bend(i) > kAlone * std::max(bend(i - 1), bend(i + 1));
}

/// Why there can be no ellipse, known before it is computed; empty where there may be one.
std::string obstacle(const Touch& t, double normal_force, const SideInput& input) {
  if (!std::isfinite(t.gap)) return "nothing touches";
  if (!std::isfinite(normal_force)) return "no forces hold the wheelset there";
  if (t.end != ProfileEnd::none) return "a profile ends there";
  const double across = t.wheel_curvature + t.rail_curvature;
  if (!std::isfinite(across)) return "no curvature there";
  if (is_edge(*input.wheel, t.wheel_y)) return "an edge of the wheel's profile";
  if (is_edge(*input.rail, t.track_y - input.rail_y)) return "an edge of the rail's profile";
  if (across <= 0.0) return "conformal: one profile is as hollow as the other one is round, or more";
  return {};
}

/// How far a section has fallen off its tangent at y, seen so far along it [m]; NaN beyond its end.
double off_tangent(const Section& section, double y, double along) {
  const SectionPoint at = section.at(y);
  const double c = 1.0 / std::sqrt(1.0 + at.slope * at.slope);
  double u = along * c, off = kNaN;
  constexpr int kSteps = 6;  // each leaves of the error what the section bends
  for (int k = 0; k < kSteps; ++k) {
    const double dz = section.at(y + u).z - at.z;
    off = (dz - at.slope * u) * c;
    u += (along - (u + at.slope * dz) * c) * c;
  }
  return off;
}

/// The misfit of an ellipse with the semi-axis b across; NaN where a profile ends before.
double misfit_of(const Touch& t, const SideInput& input, double b) {
  const double parabola = 0.5 * (t.wheel_curvature + t.rail_curvature) * b * b;
  const auto misfit = [&](double along) {
    return std::fabs(
        (off_tangent(*input.rail, t.track_y - input.rail_y, along) - off_tangent(*input.wheel, t.wheel_y, along)) /
            parabola -
        1.0);
  };
  const double low = misfit(-b), high = misfit(b);
  return low > high || std::isnan(low) ? low : high;
}

LoadedSide side_of(const Touch& t, double normal_force, const SideInput& input, double modulus) {
  LoadedSide out;
  out.normal_force = normal_force;
  out.reason = obstacle(t, normal_force, input);
  if (!out.reason.empty() || !(normal_force > 0.0)) return out;
  const HertzEllipse e = hertz_by_force(0.5 * std::cos(t.angle) / t.radius,
                                        0.5 * (t.wheel_curvature + t.rail_curvature), normal_force, modulus);
  const double sharpest = std::max(std::fabs(t.wheel_curvature), std::fabs(t.rail_curvature));
  const double samples = kSamples * std::max(input.wheel->step(), input.rail->step());
  if (!(e.semi_axis_y * sharpest < kWidestEllipse))
    out.reason = "nearly conformal: the ellipse would be wider than a radius of the profiles";
  else if (2.0 * e.semi_axis_y < samples)
    out.reason =
        fmt::format("the ellipse would be narrower than {:g} mm, over which curvatures are taken", kMilli * samples);
  const double misfit = misfit_of(t, input, e.semi_axis_y);
  if (out.reason.empty() && std::isnan(misfit)) out.reason = "a profile ends within the ellipse";
  if (!out.reason.empty()) return out;
  out.misfit = misfit;
  out.semi_axis_x = e.semi_axis_x;
  out.semi_axis_y = e.semi_axis_y;
  out.pressure = e.largest_pressure();
  out.approach = e.approach;
  return out;
}

}  // namespace

LoadedPosition loaded(const WheelsetOnTrack& wheelset, const Position& p, const AxleLoad& load) {
  const double modulus = modulus_of(load);
  const Balance balance = wheelset.balance(p);
  LoadedPosition out;
  out.right = side_of(p.right, load.weight * balance.right, wheelset.side(true), modulus);
  out.left = side_of(p.left, load.weight * balance.left, wheelset.side(false), modulus);
  out.holding_force = load.weight * balance.holding;
  for (const bool right : {true, false}) {
    if ((right ? balance.right : balance.left) > 0.0 || !std::isfinite(out.holding_force)) continue;
    // the forces of the other side are not what they seem either
    for (LoadedSide* side : {&out.right, &out.left}) {
      const double force = side->normal_force;
      *side = {};
      side->normal_force = force;
      side->reason = fmt::format("the wheelset tips over: its {} wheel lifts off", right ? "right" : "left");
    }
    return out;
  }
  // Down, along the normals: what each side does by itself.
  const double down_right = out.right.approach / std::cos(p.right.angle),
               down_left = out.left.approach / std::cos(p.left.angle);
  const auto shared = [&](const LoadedSide& side, bool right, double down) {
    return side.reason.empty() && !wheelset.further_touches(p, right, down).empty();
  };
  out.right.shared = shared(out.right, true, down_right);
  out.left.shared = shared(out.left, false, down_left);
  if (wheelset.roll() == Roll::none) {
    out.lowering = 0.5 * (down_right + down_left);
    return out;
  }
  // The approach of a side is what its line of force does not give way: virtual work, so the coefficients of the
  // balance again.
  const ForceLine r = force_line(p, true), l = force_line(p, false);
  const double determinant = r.n_z * l.moment() - l.n_z * r.moment();
  out.lowering = (out.left.approach * r.moment() - out.right.approach * l.moment()) / determinant;
  out.roll = (out.right.approach * l.n_z - out.left.approach * r.n_z) / determinant;
  return out;
}

LoadedFunctions loaded_functions(const WheelsetOnTrack& wheelset, const ContactFunctions& functions,
                                 const AxleLoad& load, double middle, double amplitude) {
  LoadedFunctions out;
  out.load = load;
  out.middle = middle;
  out.amplitude = amplitude;
  const auto add = [&](const Position& p, std::vector<LoadedPosition>& to) {
    check_cancelled();
    const LoadedPosition& at = to.emplace_back(loaded(wheelset, p, load));
    if (std::fabs(p.y - middle) > amplitude + kJumpWidth) return;
    for (const bool right : {true, false}) {
      const LoadedSide& side = right ? at.right : at.left;
      if (!(side.pressure > out.largest.pressure) && !(std::isnan(out.largest.pressure) && side.reason.empty()))
        continue;
      out.largest = side;
      out.largest_y = p.y, out.largest_right = right;
    }
  };
  for (const Position& p : functions.rows) add(p, out.rows);
  for (const Jump& jump : functions.jumps) add(jump.before, out.before), add(jump.after, out.after);
  out.at_middle = loaded(wheelset, wheelset.at(middle), load);
  return out;
}

}  // namespace treadmark::geometry
