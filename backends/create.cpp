// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/create.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {

namespace {

std::string_view word(Body body) { return body == Body::wheel ? "wheel" : "rail"; }

void require_same_body(Body shape, Body wanted, std::string_view what) {
  if (shape != wanted)
    throw Error(ErrorKind::configuration, fmt::format("{} belongs to a {}, not to a {}", what, word(shape), word(wanted)));
}

std::shared_ptr<const Surface> make_analytic(const SurfaceSpec& spec) {
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape))
    return analytic::make_standard_surface(*standard, spec.body, spec.nominal_radius, spec.defects.flats);
  if (const auto* chain = std::get_if<ArcChain>(&spec.shape))
    return spec.body == Body::wheel ? analytic::make_revolved_surface(*chain, spec.nominal_radius, spec.defects.flats)
                                    : analytic::make_prismatic_surface(*chain);
  throw Error(ErrorKind::configuration, "the backend 'analytic' needs a formula, not measured points or slices", {},
              "use the backend 'spline', or a standard profile or arc chain");
}

std::shared_ptr<const Surface> make_spline(const SurfaceSpec& spec) {
  if (const auto* slices = std::get_if<SliceSet>(&spec.shape)) return spline::make_slice_surface(*slices, spec.nominal_radius);
  if (const auto* points = std::get_if<Profile>(&spec.shape)) return spline::make_profile_surface(*points, spec.nominal_radius);

  const auto* chain = std::get_if<ArcChain>(&spec.shape);
  const Profile sampled = chain != nullptr ? analytic::sample_profile(*chain, spec.body, kResampleStep)
                                           : analytic::sample_profile(std::get<StandardProfile>(spec.shape), kResampleStep);
  if (spec.defects.flats.empty()) return spline::make_profile_surface(sampled, spec.nominal_radius);
  return spline::make_slice_surface(analytic::sample_wheel(sampled, spec.nominal_radius, spec.defects.flats, kResampleStep),
                                    spec.nominal_radius);
}

void check(const SurfaceSpec& spec) {
  if (spec.body == Body::wheel && !(spec.nominal_radius > 0.0))
    throw Error(ErrorKind::configuration, "a wheel needs a positive nominal radius");
  if (spec.body == Body::rail && !spec.defects.flats.empty())
    throw Error(ErrorKind::configuration, "flats belong to wheels, not to rails");
  const auto* points = std::get_if<Profile>(&spec.shape);
  const auto* slices = std::get_if<SliceSet>(&spec.shape);
  if (points != nullptr) require_same_body(points->body, spec.body, fmt::format("the profile '{}'", points->name));
  if (slices != nullptr) require_same_body(slices->body, spec.body, fmt::format("the slices '{}'", slices->name));
  if (!spec.defects.flats.empty() && (points != nullptr || slices != nullptr))
    throw Error(ErrorKind::configuration, "flats can be added to standard profiles and arc chains only, not to points or slices",
                {}, "give the worn wheel as slices");
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape))
    require_same_body(analytic::standard_profile_body(standard->name), spec.body,
                      fmt::format("the standard profile {}", standard->name));
}

}  // namespace

std::span<const std::string_view> backend_names() {
  static constexpr std::array<std::string_view, 2> kNames{"analytic", "spline"};
  return kNames;
}

std::span<const std::string_view> standard_profile_names() { return analytic::standard_profile_names(); }

std::shared_ptr<const Surface> create_surface(const SurfaceSpec& spec, std::string_view backend) {
  check(spec);
  if (backend.empty())
    backend = std::holds_alternative<StandardProfile>(spec.shape) || std::holds_alternative<ArcChain>(spec.shape) ? "analytic"
                                                                                                                   : "spline";
  if (backend == "analytic") return make_analytic(spec);
  if (backend == "spline") return make_spline(spec);
  const bool elsewhere = backend == "mesh" || backend == "offset";
  throw Error(ErrorKind::configuration,
              elsewhere ? fmt::format("the backend '{}' is not part of this build", backend)
                        : fmt::format("unknown backend '{}'", backend),
              {}, fmt::format("available: {}", fmt::join(backend_names(), ", ")));
}

}  // namespace treadmark
