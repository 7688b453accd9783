// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/convert_surface.hpp"

#include <chrono>

#include <fmt/format.h>

#include "treadmark/app/read_surface.hpp"
#include "treadmark/app/wheelrail_case.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/line_scanner.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/write_slices.hpp"

namespace treadmark::app {
namespace {

using Clock = std::chrono::steady_clock;

std::string lower_extension(const std::filesystem::path& file) { return io::profiles::lower(file.extension().string()); }

Body body_of(const std::filesystem::path& input, const std::optional<Body>& asked) {
  if (asked) return *asked;
  const std::string extension = lower_extension(input);
  for (const char* wheel : {".slcw", ".prw", ".whl"})
    if (extension == wheel) return Body::wheel;
  for (const char* rail : {".slcs", ".prr", ".ban"})
    if (extension == rail) return Body::rail;
  throw Error(ErrorKind::configuration, "the file does not tell whether it is a wheel or a rail", {input.string()}, "say --body wheel or --body rail");
}

NaturalSurface source_of(const std::filesystem::path& input, const ConvertSettings& settings) {
  const std::string extension = lower_extension(input);
  io::SurfaceSource source;
  double radius = settings.nominal_radius;
  const bool is_case = extension == ".toml" || extension == ".inp";
  const auto refuse = [&](const char* what) { throw Error(ErrorKind::configuration, what, {input.string()}, "leave it out"); };
  if (!is_case && !settings.overrides.empty()) refuse("--set changes keys of case files, this is none");
  if ((is_case || is_offset_file(input)) && settings.scale_to_mm != 1.0) refuse("--scale belongs to profiles, slices and triangles");
  if (is_offset_file(input) && radius > 0.0) refuse("offsets have their own nominal radius, --nominal-radius cannot change it");
  if (is_case) {
    const io::CaseFile file = io::read_any_case(input.string(), settings.overrides);
    const io::WheelRailCase* first = first_wheelrail_case(file);
    if (first == nullptr) throw Error(ErrorKind::configuration, "there is no case of a wheel on a rail in the file", {input.string()});
    const Body body = body_of(input, settings.body);
    source = body == Body::wheel ? first->wheel : first->rail;
    source.backend.clear();
    source.resolution = 0.0;
    return read_surface(source, body, radius > 0.0 ? radius : first->wheelset.nominal_radius);
  }
  if (is_offset_file(input)) {
    NaturalSurface natural = read_offset_surface(input);
    if (settings.body && *settings.body != natural.spec.body)
      throw Error(ErrorKind::configuration, "the offsets belong to the other body", {input.string()}, "leave out --body");
    return natural;
  }
  const Body body = body_of(input, settings.body);
  if (body == Body::wheel && !(radius > 0.0))
    throw Error(ErrorKind::configuration, "a wheel needs its nominal radius", {input.string()}, "say --nominal-radius in mm");
  io::GeometryFile file{input, {}};
  file.options.scale = settings.scale_to_mm;
  source.geometry = file;
  source.where = {input.string(), 0, 0};
  return read_surface(source, body, radius);
}

Region region_of(Body body, const ConvertSettings& settings) {
  if (body == Body::wheel ? settings.range_x.has_value() : settings.range_theta.has_value())
    throw Error(ErrorKind::configuration, "a range along the track belongs to a rail, one in degrees to a wheel");
  const auto& range = body == Body::wheel ? settings.range_theta : settings.range_x;
  Region region;
  if (!range) return region;
  if (!(range->first < range->second)) throw Error(ErrorKind::configuration, "a range must run from a smaller to a greater number");
  region.u_min = range->first;
  region.u_max = range->second;
  return region;
}

}  // namespace

Converted convert_surface(const std::filesystem::path& input, const std::filesystem::path& output, const ConvertSettings& settings) {
  const std::string extension = lower_extension(output);
  const bool triangles = io::is_mesh_file(output), slices = io::is_slices_file(output), offsets = is_offset_file(output);
  if (!triangles && !slices && !offsets)
    throw Error(ErrorKind::configuration, fmt::format("surfaces cannot be written to files '{}'", extension), {output.string()},
                "use .ply, .stl, .obj or .off for triangles, .slcs or .slcw for slices, .vdb for offsets");
  Converted out;
  out.source = source_of(input, settings);
  out.body = out.source.spec.body;
  Representation wanted{triangles ? "mesh" : slices ? "spline" : "offset", settings.resolution, region_of(out.body, settings)};
  // the same data again need a resolution to be sampled anew
  if (wanted.resolution == 0.0 && !triangles) wanted.resolution = kDefaultResolution;
  Sampled sampled;
  const auto start = Clock::now();
  if (triangles) {
    out.kind = "triangles";
    io::write_mesh(output, to_triangles(out.source, wanted, &sampled));
  } else if (slices) {
    out.kind = "slices";
    io::write_slices(output, to_slices(out.source, wanted, &sampled));
  } else {
    out.kind = "offsets";
    write_offsets(output, out.source, wanted, &sampled);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  // measured on the surface that a reader of the file gets
  io::SurfaceSource again;
  again.geometry = io::GeometryFile{output, {}};
  again.where = {output.string(), 0, 0};
  const NaturalSurface back = read_surface(again, out.body, out.source.spec.nominal_radius);
  out.written = {back.surface, true, sampled.resolution, sampled.region, seconds, sampled.note + back.note};
  out.fit = fit_error(out.source, out.written);
  return out;
}

}  // namespace treadmark::app
