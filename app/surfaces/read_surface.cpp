// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/read_surface.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/offset_table.hpp"
#include "treadmark/backends/added_offsets.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/backends/spline/spline_gaps.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/model/body_name.hpp"

namespace treadmark::app {
namespace {

NaturalSurface read_offsets(const io::GeometryFile& file, const io::SurfaceSource& source, Body body,
                            double nominal_radius) {
  NaturalSurface natural = read_offset_surface(file.file);
  if (body == Body::rail && nominal_radius != 0.0)
    throw Error(ErrorKind::configuration, "a file of offsets cannot become a roller", {file.file.string()},
                "use a profile, slices or triangles");
  if (natural.spec.body != body)
    throw Error(ErrorKind::configuration,
                fmt::format("the offsets belong to a {}", body == Body::rail ? "wheel" : "rail"), {file.file.string()});
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

SliceSet slices_of(const io::GeometryFile& file, Body body, const SourcePosition& where) {
  SliceSet slices = io::read_slices(file.file, body, file.options, where);
  slices.open_seam = file.open_seam;
  return slices;
}

/// Its units are its own: another scale is a mistake.
decltype(SurfaceSpec::shape) shape_of_cad(const io::GeometryFile& file, Body body, double radius,
                                          const SourcePosition& where, std::string& note) {
  if (file.options.scale != 1.0)
    throw Error(ErrorKind::configuration, "files of CAD have units of their own", where, "leave out scale_to_mm");
  if (body == Body::rail && radius != 0.0)
    throw Error(ErrorKind::configuration, "a file of CAD cannot become a roller", where, "use a profile or slices");
  io::CadSurface cad = io::read_cad(file.file, body, radius, where);
  note = std::move(cad.note);
  if (auto* profile = std::get_if<Profile>(&cad.shape)) profile->smoothing = file.options.smoothing;
  if (auto* slices = std::get_if<SliceSet>(&cad.shape)) slices->open_seam = file.open_seam;
  return std::visit([](auto& shape) -> decltype(SurfaceSpec::shape) { return std::move(shape); }, cad.shape);
}

/// One surface, or a body of several.
NaturalSurface read_spline_file(const io::GeometryFile& file, const io::SurfaceSource& source, Body body,
                                double radius) {
  io::ProfileOptions scale_alone;
  scale_alone.scale = file.options.scale;
  if (!(file.options == scale_alone) || file.open_seam)
    throw Error(ErrorKind::configuration, "a file of splines is taken as it is", source.where,
                "of the keys beside shape.file only scale_to_mm belongs to it");
  io::SplineFile read = io::read_splines(file.file, file.options.scale, source.where);
  if (read.surfaces.size() > 1 && !source.defects.empty())
    throw Error(ErrorKind::configuration, "defects cannot be added to a body of several parts", source.where);
  const std::string gaps = spline::spline_gaps(read.surfaces, read.interfaces);
  std::vector<SurfacePart> parts;
  parts.reserve(read.surfaces.size());
  for (SplineSurface& splines : read.surfaces) {
    SurfaceSpec spec;
    spec.body = body;
    (body == Body::wheel ? spec.nominal_radius : spec.roller_radius) = radius;
    spec.defects = source.defects;
    spec.shape = std::move(splines);
    SurfacePart part;
    part.natural = std::make_shared<const NaturalSurface>(create_natural(std::move(spec)));
    parts.push_back(std::move(part));
  }
  NaturalSurface out = parts.size() == 1 ? *parts.front().natural : join_surfaces(std::move(parts));
  if (body == Body::wheel) {
    const double reach = std::max(-out.surface->bounds().min.z(), out.surface->bounds().max.z());
    constexpr double kLeast = 0.5, kMost = 1.5;
    if (!(reach > kLeast * radius && reach < kMost * radius))
      throw Error(ErrorKind::input_data,
                  fmt::format("the surface reaches out to {:.6g} mm, the nominal radius is {:.6g} mm", 1e3 * reach,
                              1e3 * radius),
                  {file.file.string()}, "is the axle the y axis, the running surface below it, and scale_to_mm right?");
  }
  out.note += gaps;
  return out;
}

NaturalSurface read_parts(const io::SurfaceSource& source, Body body, double radius) {
  if (!source.defects.empty())
    throw Error(ErrorKind::configuration, "defects cannot be added to a body of several parts", source.where);
  std::vector<SurfacePart> parts;
  for (const io::SurfaceSource& part : source.parts)
    parts.push_back({std::make_shared<const NaturalSurface>(read_surface(part, body, radius)), part.offset,
                     part.backend, part.resolution});
  return join_surfaces(std::move(parts));
}

}  // namespace

bool is_offset_file(const std::filesystem::path& file) {
  return io::profiles::lower(file.extension().string()) == ".vdb";
}

MovingSection motion_of(const io::CrossingInput& c) {
  MovingSection m;
  m.x = c.x, m.y = c.y, m.z = c.z;
  m.rounding = c.rounding;
  const bool nose = c.part == io::CrossingInput::Part::nose;
  m.slope_z_before = nose ? -c.slope : 0.0;
  m.slope_y_after = nose ? 0.0 : c.slope;
  m.length_before = nose ? c.length : c.rounding;
  m.length_after = nose ? c.rounding : c.length;
  return m;
}

namespace {

/// Of files: standard profiles and arcs are what they are.
void refuse_narrow(const NaturalSurface& natural, const io::SurfaceSource& source) {
  constexpr double kNarrowestWheel = 10e-3, kNarrowestRail = 5e-3;  // [m]
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (file == nullptr) return;
  const Box3 box = natural.surface->bounds();
  const double width = box.max.y() - box.min.y();
  const bool wheel = natural.spec.body == Body::wheel;
  if (!(width < (wheel ? kNarrowestWheel : kNarrowestRail))) return;
  throw Error(ErrorKind::input_data,
              fmt::format("the {} of {} is {:.3g} mm wide, and none is", body_name(natural.spec.body),
                          file->file.string(), kMilli * width),
              source.where, "is the file in inches or cm? the factor to mm is then 25.4 or 10 (scale_to_mm, --scale)");
}

NaturalSurface read_shape(const io::SurfaceSource& source, Body body, double radius) {
  if (!source.parts.empty()) return read_parts(source, body, radius);
  SurfaceSpec spec;
  spec.body = body;
  (body == Body::wheel ? spec.nominal_radius : spec.roller_radius) = radius;
  spec.defects = source.defects;
  std::string note;
  if (const auto* file = std::get_if<io::GeometryFile>(&source.geometry)) {
    if (is_offset_file(file->file)) return read_offsets(*file, source, body, radius);
    if (io::is_spline_file(file->file)) return read_spline_file(*file, source, body, radius);
    if (io::is_mesh_file(file->file))
      spec.shape = io::read_mesh(file->file, file->options.scale, source.where);
    else if (io::is_cad_file(file->file))
      spec.shape = shape_of_cad(*file, body, radius, source.where, note);
    else if (io::is_slices_file(file->file))
      spec.shape = slices_of(*file, body, source.where);
    else
      spec.shape = io::read_profile(file->file, body, file->options, source.where);
  } else if (const auto* standard = std::get_if<StandardProfile>(&source.geometry)) {
    if (!library_body(standard->name)) {
      const std::string near = nearest_library_name(standard->name);
      throw Error(ErrorKind::configuration, fmt::format("there is no standard profile '{}'", standard->name),
                  source.where,
                  near.empty() ? "treadmark list profiles prints those there are"
                               : fmt::format("did you mean '{}'? treadmark list profiles prints all", near));
    }
    spec.shape = *standard;
  } else {
    spec.shape = std::get<ArcChain>(source.geometry);
  }
  if (source.crossing.part != io::CrossingInput::Part::none)
    spec.shape = move_section(spec, motion_of(source.crossing));
  NaturalSurface natural = create_natural(std::move(spec));
  refuse_narrow(natural, source);
  natural.note += note;
  return natural;
}

}  // namespace

NaturalSurface read_surface(const io::SurfaceSource& source, Body body, double radius) {
  NaturalSurface shape = read_shape(source, body, radius);
  if (source.offsets.file.empty()) return shape;
  if (body == Body::rail && radius != 0.0)
    throw Error(ErrorKind::configuration, "a table of deviations cannot be added to a roller", source.offsets.where,
                "use a profile, slices or triangles that have them");
  return add_offsets(shape, read_offset_table(source.offsets, shape));
}

}  // namespace treadmark::app
