// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/section_heights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "treadmark/backends/assembly/placed_surface.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/backends/displacement/section_offsets.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::app {
namespace {

bool moves(const SectionHeights& h) { return h.y != 0.0 || h.z != 0.0 || h.roll != 0.0; }

double largest_height(std::span<const double> values) {
  double out = 0.0;
  for (const double value : values) out = std::max(out, std::abs(value));
  return out;
}

/// Takes up another one of the same places; false where it has others.
bool joined(SectionHeights& sum, const SectionHeights& more, double factor) {
  if (sum.first != more.first || sum.step != more.step || sum.values.size() != more.values.size()) return false;
  for (std::size_t i = 0; i < more.values.size(); ++i) sum.values[i] += factor * more.values[i];
  sum.y += factor * more.y, sum.z += factor * more.z, sum.roll += factor * more.roll;
  return true;
}

SectionHeights of_motion(const SurfaceErrors::Motion& motion, Body body, std::span<const double> places) {
  SectionHeights out;
  out.y = motion.y;
  if (body == Body::rail) {
    out.z = motion.z, out.roll = motion.roll;
    return out;
  }
  out.facing = Facing::down;
  if (motion.z == 0.0 && motion.roll == 0.0) return out;
  // what turns about its axle stays so
  out.first = places.front(), out.step = places.back() - places.front();
  for (const double y : {places.front(), places.back()}) out.values.push_back(motion.z + motion.roll * y);
  return out;
}

}  // namespace

std::shared_ptr<const Surface> with_heights(std::shared_ptr<const Surface> surface, const SectionHeights& heights,
                                            double factor) {
  const bool rail = heights.facing == Facing::up;
  if (!heights.values.empty()) {
    std::vector<double> values = heights.values;
    for (double& value : values) value *= factor;
    const std::string backend(surface->backend());
    surface = displacement::make_displaced_surface(
        std::move(surface), displacement::section_offsets(heights.first, heights.step, std::move(values)),
        rail ? Body::rail : Body::wheel, backend);
  }
  if (!moves(heights)) return surface;
  const Pose moved{factor * Vec3(0.0, heights.y, heights.z),
                   heights.roll == 0.0 ? Mat3(Mat3::Identity()) : rotation_x(factor * heights.roll)};
  return assembly::place_surface(std::move(surface), moved);
}

double factor_step(const SectionHeights& heights) {
  // near places little height is much curvature, as of the points of a profile
  constexpr double kCurvature = 1e-3, kLeast = 2e-11, kMost = 5e-8, kLever = 0.05;  // [1/m], [m]
  double step = kInfinity;
  if (const double height = largest_height(heights.values); height > 0.0)
    step = std::clamp(kCurvature * heights.step * heights.step, kLeast, kMost) / height;
  if (moves(heights))
    step =
        std::min(step, kMost / std::max({std::abs(heights.y), std::abs(heights.z), kLever * std::abs(heights.roll)}));
  return std::isfinite(step) ? step : 1.0;
}

std::shared_ptr<const Surface> with_heights(std::shared_ptr<const Surface> surface,
                                            std::span<const SectionHeights> heights, std::span<const double> factors) {
  SectionHeights sum;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (k > 0 && joined(sum, heights[k], factors[k])) continue;
    if (k > 0) surface = with_heights(std::move(surface), sum, 1.0);
    sum = heights[k];
    for (double& value : sum.values) value *= factors[k];
    sum.y *= factors[k], sum.z *= factors[k], sum.roll *= factors[k];
  }
  return heights.empty() ? surface : with_heights(std::move(surface), sum, 1.0);
}

std::vector<double> places_across(const Surface& surface, double step) {
  constexpr double kFar = 0.2;  // [m], of bounds that may be infinite
  constexpr std::size_t kMost = 2000;
  const Box3 box = surface.bounds();
  const double from = std::max(box.min.y(), -kFar), to = std::min(box.max.y(), kFar);
  const auto count = to_whole<std::size_t>(std::ceil(std::max(0.0, to - from) / step)) + 2;
  if (count > kMost)
    throw Error(ErrorKind::configuration, fmt::format("errors of heights {:g} mm apart are too many", kMilli * step),
                {}, "give a greater case.uncertainty.length_mm");
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(from + static_cast<double>(k) * step);
  return out;
}

std::vector<SectionPlace> places_of_section(std::span<const double> arcs, std::span<const double> y,
                                            std::span<const double> z, std::span<const double> places) {
  constexpr double kSteepest = 0.2;  // beyond it heights tell nothing
  std::vector<double> cosines;       // of pieces
  for (std::size_t i = 0; i + 1 < y.size(); ++i) {
    const double dy = std::abs(y[i + 1] - y[i]);
    cosines.push_back(dy > 0.0 ? dy / std::hypot(dy, z[i + 1] - z[i]) : 0.0);
  }
  std::vector<SectionPlace> out;
  for (const double place : places) {
    const bool first = std::abs(place - y.front()) < std::abs(place - y.back());
    double arc = first ? arcs.front() : arcs.back(), flattest = 0.0;
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      const double dy = y[i + 1] - y[i], share = dy != 0.0 ? (place - y[i]) / dy : -1.0;
      if (share < 0.0 || share > 1.0 || cosines[i] <= flattest) continue;
      flattest = cosines[i], arc = arcs[i] + share * (arcs[i + 1] - arcs[i]);
    }
    if (flattest == 0.0) flattest = first ? cosines.front() : cosines.back();  // beyond the ends as at them
    out.push_back({arc, std::max(flattest, kSteepest)});
  }
  return out;
}

double extent_of(const SourceOfErrors& source, std::span<const double> places) {
  double squares = 0.0;
  for (const SectionHeights& one : source.errors) {
    for (const double value : one.values) squares += value * value / static_cast<double>(one.values.size());
    for (const double place : places)
      squares += (one.y * one.y + std::pow(one.z + one.roll * place, 2)) / static_cast<double>(places.size());
  }
  return std::sqrt(squares);
}

std::vector<SourceOfErrors> sources_of_errors(const SurfaceErrors& errors, Body body, double u,
                                              const Surface& surface) {
  constexpr double kFinest = 0.25e-3, kShortest = 1e-3;  // of knots; of errors of their own, which are to be few [m]
  std::vector<SourceOfErrors> out;
  const auto put = [&](ErrorSource source, SectionHeights one) {
    const std::string name = fmt::format("{} of the {}", name_of(source), body == Body::rail ? "rail" : "wheel");
    const auto known = ranges::find(out, name, &SourceOfErrors::name);
    (known == out.end() ? out.emplace_back(SourceOfErrors{name, {}}) : *known).errors.push_back(std::move(one));
  };
  const std::vector<double> places = places_across(surface, kFinest), arcs = arc_lengths(errors);
  for (const SurfaceErrors::Motion& motion : errors.motions) put(motion.source, of_motion(motion, body, places));
  if (errors.fields.empty()) return out;
  const std::size_t nearest = nearest_draws(errors, u, 1, body == Body::wheel ? 2.0 * kPi : 0.0).front();
  const std::vector<SectionPlace> of_section = places_of_section(arcs, errors.y, errors.z, places);
  for (const SurfaceErrors::Field& field : errors.fields) {
    const BrokenLine sigma(arcs, field.at(nearest));
    const double length = std::max(field.length, kShortest);
    const auto last = to_whole<int>(std::ceil(arcs.back() / length));
    for (int k = 0; k <= last; ++k) {
      SectionHeights one{body == Body::rail ? Facing::up : Facing::down, places.front(), kFinest, {}};
      for (const SectionPlace& place : of_section) {
        // weights whose squares add up to 1 everywhere, without a kink
        const double off = std::abs(place.arc / length - k);
        const double weight = off < 1.0 ? std::cos(0.5 * kPi * off * off * (3.0 - 2.0 * off)) : 0.0;
        one.values.push_back(weight * sigma.held_at(place.arc) / place.cosine);
      }
      if (largest_height(one.values) > 0.0) put(field.source, std::move(one));
    }
  }
  return out;
}

std::vector<std::vector<double>> draws_of_errors(const SurfaceErrors& errors, Body body, double u,
                                                 std::span<const double> places) {
  const std::vector<double> arcs = arc_lengths(errors);
  const std::vector<SectionPlace> of_section = places_of_section(arcs, errors.y, errors.z, places);
  std::vector<std::vector<double>> out;
  for (const std::size_t draw : nearest_draws(errors, u, kNearestDraws, body == Body::wheel ? 2.0 * kPi : 0.0)) {
    const BrokenLine line(arcs, errors.draws[draw]);
    std::vector<double>& heights = out.emplace_back();
    for (const SectionPlace& place : of_section) heights.push_back(line.held_at(place.arc) / place.cosine);
  }
  return out;
}

double normal(Random& random) {
  const double size = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return size * std::cos(2.0 * kPi * random.uniform());
}

}  // namespace treadmark::app
