// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/measure/read_measured.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/surface_errors.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

constexpr double kLibraryStep = 0.1e-3;  // [m]

Profile library_points(const std::string& name, Body body) {
  const Body of = *library_body(name);
  if (of != body) throw Error(ErrorKind::configuration, name + " is a " + body_name(of) + ", not a " + body_name(body));
  Profile points;
  points.body = body;
  points.name = name;
  for (const Vec2& p : library_outline(name, kLibraryStep)) {
    points.y.push_back(p.x());
    points.z.push_back(p.y());
  }
  return points;
}

/// A section that was read is where it is: no scatter is looked for in exact shapes.
bool is_library_name(const std::string& name) { return library_body_of(name).has_value(); }

ReadMeasured read_points(const std::string& name, const MeasureRequest& request) {
  io::ProfileOptions options;
  options.scale = request.scale_to_mm;
  // two wheels of an axle are measured in its axes
  if (request.as_in_file || !request.mate.empty()) options.placement = io::ProfileOptions::Placement::as_in_file;
  options.smoothing = {};  // sections do that
  if (request.mirror_y) options.mirror_y = 1;
  io::SourcedProfile read = io::read_sourced_profile(name, request.body, options);
  ReadMeasured out;
  out.kind = "profile";
  out.notes = read.source.notes;
  for (const io::ProfileRemark& doubt : doubts_of(read)) {
    if (doubt.name == "noise") continue;  // sections smooth it
    out.notes.push_back(fmt::format("warning: {}: {}", doubt.name, doubt.text));
    out.doubtful = true;
  }
  out.flange_back = read.source.understood.wheel.back_y;
  out.points = std::move(read.whole ? *read.whole : read.profile);
  out.nominal_radius = request.nominal_radius > 0.0 ? request.nominal_radius : read.source.nominal_radius.value_or(0.0);
  out.said = std::move(read.source.said);
  return out;
}

/// Standard deviation of a surface [m]; NaN where nothing tells it; nothing of exact shapes.
std::optional<double> known_error(const SurfaceSpec& spec) {
  const auto mean_square = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v * v / static_cast<double>(values.size());
    return sum;
  };
  if (spec.errors) {
    double squares = std::pow(size_of(*spec.errors).rms, 2);
    for (const SurfaceErrors::Motion& motion : spec.errors->motions) squares += motion.z * motion.z;
    for (const SurfaceErrors::Field& field : spec.errors->fields)
      for (const std::vector<double>& sigma : field.sigma)
        squares += mean_square(sigma) / static_cast<double>(field.sigma.size());
    return std::sqrt(squares);
  }
  if (const auto* points = std::get_if<Profile>(&spec.shape); points != nullptr && points->scatter) {
    if (!measured::has_errors(*points)) return std::nullopt;
    return std::sqrt(mean_square(measured::deviations(*points->scatter)));
  }
  const bool exact = std::holds_alternative<StandardProfile>(spec.shape) ||
                     std::holds_alternative<ArcChain>(spec.shape) || std::holds_alternative<SolidShape>(spec.shape) ||
                     std::holds_alternative<SplineSurface>(spec.shape);
  return exact ? std::nullopt : std::optional(measures::kUnknown);
}

ReadMeasured read_any_surface(const std::string& name, const MeasureRequest& request) {
  NamedSurface said;
  said.body = request.body;
  said.nominal_radius = request.nominal_radius;
  said.scale_to_mm = request.scale_to_mm;
  said.overrides = request.overrides;
  const NaturalSurface natural = named_surface(name, said);
  ReadMeasured out;
  out.kind = "surface";
  out.surface = natural.surface;
  out.nominal_radius = natural.spec.nominal_radius;
  out.placed = true;
  const Box3 box = natural.surface->bounds();
  out.x_min = box.min.x(), out.x_max = box.max.x();
  if (const auto known = measured_range(natural, {}); known && request.body == Body::rail)
    out.x_min = known->first, out.x_max = known->second;
  out.error = known_error(natural.spec);
  if (!natural.note.empty()) out.notes.push_back(natural.note);
  if (out.error && std::isnan(*out.error))
    out.notes.emplace_back("how well this surface is known nothing says: its numbers have no uncertainty");
  const auto warn = [&](const std::string& doubt) {
    out.notes.push_back("warning: " + doubt);
    out.doubtful = true;
  };
  for (const SurfaceDoubt& doubt : natural.spec.doubts) warn(in_words(doubt, body_name(request.body), name));
  if (const auto* slices = std::get_if<SliceSet>(&natural.spec.shape))
    if (const std::string doubt = doubt_of_slices(*slices, name, request.body, {{}, {}, false, {}}); !doubt.empty())
      warn(doubt);
  return out;
}

}  // namespace

ReadMeasured read_measured(const std::string& name, const MeasureRequest& request) {
  const auto refuse = [&](const char* what, const char* advice) {
    throw Error(ErrorKind::configuration, what, {name}, advice);
  };
  const bool is_library = is_library_name(name);
  const fs::path file = name;
  const std::string extension = io::extension_of(file);
  const bool is_case = extension == ".toml" || extension == ".inp", is_mesh = io::is_mesh_file(file),
             is_surface = is_case || is_mesh || is_offset_file(file) || io::is_slices_file(file),
             is_scan = is_only_scan(name);
  if (!is_case) refuse_overrides(name, request.overrides);
  if (request.mirror_y && (is_library || is_surface || is_scan))
    refuse("mirror_y belongs to files of profiles",
           is_case ? "set the key of its shape: --set rail.shape.mirror_y=true" : "leave it out, or make a case of it");
  const auto scanned = [&] {
    if (request.scale_to_mm != 1.0)
      refuse("scale belongs to profiles, slices and triangles", "import it first, with --unit");
    return read_scanned(name, request);
  };
  if (is_library) {
    if (request.scale_to_mm != 1.0) refuse("scale belongs to profiles, slices and triangles", "leave it out");
    ReadMeasured out;
    out.kind = "library profile";
    out.points = library_points(name, request.body);
    out.nominal_radius = request.nominal_radius;
    out.placed = true;
    return out;
  }
  if (is_scan) return scanned();
  if (is_mesh) {
    try {
      return read_any_surface(name, request);
    } catch (const Error& error) {
      // the same extensions hold points of scanners
      if (error.message().find("triangle") == std::string::npos && error.message().find("face") == std::string::npos)
        throw;
      return scanned();
    }
  }
  return is_surface ? read_any_surface(name, request) : read_points(name, request);
}

measures::Section mirrored_section(const std::string& name, const MeasureRequest& request) {
  io::ProfileOptions options;
  options.scale = request.scale_to_mm;
  options.mirror_y = request.mirror_y ? -1 : 1;  // where the one is turned, the other lies as its mirror image
  options.placement = io::ProfileOptions::Placement::as_in_file;
  options.smoothing = {};  // sections do that, and know what it leaves
  return measures::Section(io::read_profile(name, Body::wheel, options));
}

measures::Section nominal_section(const std::string& name, Body body) {
  if (is_library_name(name)) return measures::Section(library_points(name, body), 0.0);
  std::error_code ignored;
  if (!fs::exists(io::profile_file(name), ignored)) refuse_missing_surface(name, ErrorKind::configuration);
  return measures::Section(io::read_profile(name, body, {}));
}

}  // namespace treadmark::app
