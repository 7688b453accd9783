// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/named_surface.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/foreign_kind.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/model/magnitudes.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

Body body_of(const std::filesystem::path& input, const std::optional<Body>& asked) {
  if (asked) return *asked;
  if (const auto named = io::body_by_extension(io::profile_file(input))) return *named;
  throw Error(ErrorKind::configuration, "the file does not say whether it is a wheel or a rail", {input.string()},
              "say --body wheel or --body rail");
}

}  // namespace

std::optional<Body> library_body_of(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) return std::nullopt;
  return library_body(file.string());
}

std::string nearest_library_name(const std::string& name) {
  std::vector<std::string> names;
  for (const LibraryProfile& profile : profile_library()) names.push_back(profile.name);
  return nearest_name(name, names);
}

void refuse_missing_surface(const std::filesystem::path& file, ErrorKind kind) {
  const std::string near = nearest_library_name(file.string());
  throw MissingFile(kind, "neither a file nor a profile that is built in", {file.string()},
                    near.empty() ? advice_on_missing(file, "treadmark list profiles shows what is built in")
                                 : fmt::format("did you mean {}?", near));
}

void refuse_overrides(const std::string& file, std::span<const std::string> overrides) {
  if (!overrides.empty())
    throw Error(ErrorKind::configuration, "--set changes keys of case files, this is none", {file}, "leave it out");
}

void require_wheel_radius(double radius) {
  if (radius >= kLeastWheelRadius && radius <= kMostWheelRadius) return;
  throw Error(ErrorKind::configuration,
              fmt::format("no wheel has a radius of {:g} m: {:g} to {:g} m is possible", radius, kLeastWheelRadius,
                          kMostWheelRadius),
              {}, "is it in the unit that is asked for?");
}

NaturalSurface named_surface(const std::filesystem::path& file, const NamedSurface& said) {
  io::refuse_foreign_file(file);
  const std::string extension = io::extension_of(file);
  io::SurfaceSource source;
  double radius = said.nominal_radius;
  const bool is_case = extension == ".toml" || extension == ".inp";
  const auto refuse = [&](const char* what) {
    throw Error(ErrorKind::configuration, what, {file.string()}, "leave it out");
  };
  if (!is_case) refuse_overrides(file.string(), said.overrides);
  if ((is_case || is_offset_file(file)) && said.scale_to_mm != 1.0)
    refuse("--scale belongs to profiles, slices and triangles");
  if (is_offset_file(file) && radius > 0.0)
    refuse("offsets have their own nominal radius, --nominal-radius cannot change it");
  if (is_case) {
    const io::CaseFile cases = read_registered_case(file.string(), said.overrides);
    const io::WheelRailCase* first = first_wheelrail_case(cases);
    if (first == nullptr)
      throw Error(ErrorKind::configuration, "there is no case of a wheel on a rail in the file", {file.string()});
    const Body body = body_of(file, said.body);
    source = body == Body::wheel ? first->wheel : first->rail;
    source.backend.clear();
    source.resolution = 0.0;
    for (io::SurfaceSource& part : source.parts) part.backend.clear(), part.resolution = 0.0;
    return read_surface(source, body, body == Body::wheel && radius > 0.0 ? radius : profile_radius(*first, body));
  }
  if (is_offset_file(file)) {
    NaturalSurface natural = read_offset_surface(file);
    if (said.body && *said.body != natural.spec.body)
      throw Error(ErrorKind::configuration, "the offsets belong to the other body", {file.string()},
                  "leave out --body");
    return natural;
  }
  const std::optional<Body> library = library_body_of(file);
  std::error_code ignored;
  if (!library && !std::filesystem::exists(io::profile_file(file), ignored) &&
      !std::filesystem::exists(io::profiles::portable_path(file.string()), ignored))
    refuse_missing_surface(file, ErrorKind::input_data);
  if (library && said.body && *said.body != *library)
    throw Error(ErrorKind::configuration, fmt::format("{} is a {}", file.string(), body_name(*library)), {},
                "leave out --body");
  if (library && said.scale_to_mm != 1.0) refuse("--scale belongs to profiles, slices and triangles");
  const Body body = library ? *library : body_of(file, said.body);
  if (body == Body::wheel && radius > 0.0) require_wheel_radius(radius);
  if (body == Body::wheel && !(radius > 0.0))
    throw Error(ErrorKind::configuration, "a wheel needs its nominal radius", {file.string()},
                "say --nominal-radius in mm");
  if (library) {
    source.geometry = StandardProfile{file.string()};
  } else {
    io::GeometryFile geometry{file, {}};
    geometry.options.scale = said.scale_to_mm;
    source.geometry = geometry;
  }
  source.where = {file.string(), 0, 0};
  return read_surface(source, body, body == Body::wheel ? radius : 0.0);
}

Region part_of(Body body, const Range& range_x, const Range& range_theta) {
  if (body == Body::wheel ? range_x.has_value() : range_theta.has_value())
    throw Error(ErrorKind::configuration, "a range along the track belongs to a rail, one in degrees to a wheel");
  const Range& range = body == Body::wheel ? range_theta : range_x;
  Region region;
  if (!range) return region;
  if (!(range->first < range->second))
    throw Error(ErrorKind::configuration, "a range must run from a smaller to a greater number");
  region.u_min = range->first;
  region.u_max = range->second;
  return region;
}

}  // namespace treadmark::app
