// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/read_surface.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/line_scanner.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"

namespace treadmark::app {
namespace {

NaturalSurface read_offsets(const io::GeometryFile& file, const io::SurfaceSource& source, Body body, double nominal_radius) {
  NaturalSurface natural = read_offset_surface(file.file);
  if (body == Body::rail && nominal_radius != 0.0)
    throw Error(ErrorKind::configuration, "a file of offsets cannot become a roller", {file.file.string()}, "give a profile");
  if (natural.spec.body != body)
    throw Error(ErrorKind::configuration, fmt::format("the offsets belong to a {}", body == Body::rail ? "wheel" : "rail"),
                {file.file.string()});
  constexpr double kSameRadius = 1e-9;
  if (body == Body::wheel && std::fabs(natural.spec.nominal_radius - nominal_radius) > kSameRadius)
    throw Error(ErrorKind::configuration,
                fmt::format("the offsets were made for a nominal wheel radius of {:.6g} mm, the case has {:.6g} mm",
                            1e3 * natural.spec.nominal_radius, 1e3 * nominal_radius),
                {file.file.string()}, "set wheelset.nominal_radius_mm to the file's radius");
  if (!source.defects.empty())
    throw Error(ErrorKind::configuration, "defects cannot be added to a file of offsets", source.where,
                "add them before the offsets are written");
  return natural;
}

/// The one place where the radius of a roller reaches its surface.
template <class Spec>
void make_roller(Spec& spec, double radius, const SourcePosition& where) {
  if constexpr (requires { spec.roller_radius; }) spec.roller_radius = radius;
  else if (radius != 0.0) throw Error(ErrorKind::configuration, "surfaces of rollers are not supported", where);
}

}  // namespace

bool is_offset_file(const std::filesystem::path& file) {
  return io::profiles::lower(file.extension().string()) == ".vdb";
}

NaturalSurface read_surface(const io::SurfaceSource& source, Body body, double nominal_radius) {
  SurfaceSpec spec;
  spec.body = body;
  spec.nominal_radius = body == Body::wheel ? nominal_radius : 0.0;
  if (body == Body::rail) make_roller(spec, nominal_radius, source.where);
  spec.defects = source.defects;
  if (const auto* file = std::get_if<io::GeometryFile>(&source.geometry)) {
    if (is_offset_file(file->file)) return read_offsets(*file, source, body, nominal_radius);
    if (io::is_mesh_file(file->file))
      spec.shape = io::read_mesh(file->file, file->options.scale, source.where);
    else if (io::is_slices_file(file->file))
      spec.shape = io::read_slices(file->file, body, file->options, source.where);
    else
      spec.shape = io::read_profile(file->file, body, file->options, source.where);
  } else if (const auto* standard = std::get_if<StandardProfile>(&source.geometry)) {
    spec.shape = *standard;
  } else {
    spec.shape = std::get<ArcChain>(source.geometry);
  }
  return create_natural(std::move(spec));
}

}  // namespace treadmark::app
