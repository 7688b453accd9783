// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/convert_surface.hpp"

#include <fmt/format.h>

#include <chrono>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/offset_table.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/app/surfaces/written_surface.hpp"
#include "treadmark/backends/added_offsets.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/spline/spline_gaps.hpp"
#include "treadmark/backends/tensor_fit.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/copy_bytes.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/write_slices.hpp"
#include "treadmark/io/results/write_vtk.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/surface_errors.hpp"

namespace treadmark::app {
namespace {

using Clock = std::chrono::steady_clock;

/// One section where there is one, else all of the surface, as close as another program can tell.
io::CadContent to_cad(const NaturalSurface& natural, const Representation& wanted, Sampled& sampled) {
  constexpr double kTolerance = 0.05e-6;  // [m]
  if (natural.spec.roller_radius != 0.0)
    throw Error(ErrorKind::configuration, "CAD files hold rails and wheels, not rollers", {}, "convert its profile");
  TensorFit fit = to_tensor_spline(natural, wanted, kTolerance);
  sampled = fit.sampled;
  io::CadContent out;
  const Body body = out.body = natural.spec.body;
  if (fit.one_section) {
    const Region& r = fit.sampled.region;
    const bool part = body == Body::rail || r.u_max - r.u_min < 2.0 * kPi;
    out.swept = part ? std::pair{r.u_min, r.u_max} : std::pair{0.0, 2.0 * kPi};
  }
  out.description = fmt::format(
      "{} as one B-spline face, {}", body_name(body),
      fit.deviation > 0.0
          ? fmt::format("at most {:.2g} um off what it was made of, as far as was looked", 1e6 * fit.deviation)
          : "with the coefficients that it was given with");
  const auto& [u, v] = fit.spline.levels.front();
  sampled.note += fmt::format("{} x {} coefficients. ", u.functions(), v.functions());
  if (fit.deviation > kTolerance)
    sampled.note += fmt::format("more points would be needed to lie within {:g} um. ", 1e6 * kTolerance);
  out.spline = std::move(fit.spline);
  return out;
}

}  // namespace

double tolerance_of(const ConvertSettings& settings) {
  return settings.tolerance > 0.0 ? settings.tolerance : sampled_tolerance(settings.resolution);
}

namespace {

/// A table that is added to a surface, and the surface without it.
struct AddedTable {
  NaturalSurface below;
  OffsetMap table;
};

/// same: offsets that are written as they are; empty: the source is sampled.
Converted write_checked(NaturalSurface source, const std::optional<AddedTable>& added,
                        const std::filesystem::path& output, const ConvertSettings& settings,
                        const std::filesystem::path& same = {}) {
  const std::string extension = io::extension_of(output);
  const bool view = extension == ".vtp";  // only to be looked at
  const bool triangles = view || io::is_mesh_file(output), slices = io::is_slices_file(output),
             offsets = is_offset_file(output), cad = io::is_step_file(output), splines = io::is_spline_file(output);
  if (!triangles && !slices && !offsets && !cad && !splines)
    throw Error(
        ErrorKind::configuration, fmt::format("surfaces cannot be written to files '{}'", extension), {output.string()},
        "use .ply, .stl, .obj, .off or .vtp (ParaView) for triangles, .slcs or .slcw for slices, .vdb or .nvdb for "
        "offsets, .step for CAD, .xml for splines");
  Converted out;
  out.source = std::move(source);
  out.body = out.source.spec.body;
  Representation wanted{splines     ? settings.backend
                        : triangles ? "mesh"
                        : slices    ? "spline"
                                    : "offset",
                        settings.resolution, part_of(out.body, settings.range_x, settings.range_theta)};
  // the same data again need a resolution to be sampled anew
  if (wanted.resolution == 0.0 && !triangles && !cad && !splines) wanted.resolution = kDefaultResolution;
  Sampled sampled;
  // What a pipe, a device or ParaView takes cannot be read again: it gets what a file has.
  std::optional<OutputFolder> own;
  StagedOutputs staged;
  if ((is_stream(output) && !slices) || view)
    own.emplace(std::filesystem::temp_directory_path(), OutputFolder::Old::kept);
  std::filesystem::path place = own ? own->path() / output.filename() : staged.place(output);
  if (view) place.replace_extension(".ply");
  std::string to_view;
  const std::shared_ptr<const SurfaceErrors>& errors = out.source.spec.errors;
  const std::vector<SurfaceDoubt>& doubts = out.source.spec.doubts;
  std::vector<std::string> lines = to_lines(doubts);
  if (errors) ranges::copy(to_lines(*errors), std::back_inserter(lines));
  if (extension == ".stl") lines = doubts.empty() ? std::vector<std::string>() : std::vector{names_line(doubts)};
  const auto write = [&] {
    if (cad) {
      out.kind = "CAD";
      io::write_cad(place, to_cad(out.source, wanted, sampled));
    } else if (splines) {
      out.kind = "splines";
      const std::vector<SplineSurface> told = to_splines(out.source, wanted, &sampled);
      std::vector<SplineInterface> met;
      if (told.size() > 1) spline::spline_gaps(told, {}, &met);
      io::write_splines(place, told, met);
    } else if (triangles) {
      out.kind = "triangles";
      const TriangleMesh mesh = to_triangles(out.source, wanted, &sampled);
      io::write_mesh(place, mesh, lines);
      if (view) to_view = io::triangles_to_vtp(mesh);
    } else if (slices) {
      out.kind = "slices";
      io::write_slices(place, to_slices(out.source, wanted, &sampled), {}, lines);
    } else {
      out.kind = "offsets";
      if (added)
        write_added_offsets(place, added->below, added->table, wanted);
      else if (!same.empty())
        offset::write_vdb(place, offset::read_vdb(same));
      else
        write_offsets(place, out.source, wanted, &sampled);
    }
  };
  naming(output, place, [&] {
    const auto start = Clock::now();
    write();
    if (errors && (extension == ".stl" || view || cad || splines))
      sampled.note += "what scatter of the scan leaves uncertain of the surface has no place in such a file. ";
    if (!doubts.empty() && (view || cad || splines))
      sampled.note += "what its import doubted has no place in such a file. ";
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    // measured on the surface that a reader of the file gets
    io::SurfaceSource again;
    again.geometry = io::GeometryFile{place, {}};
    again.where = {place.string(), 0, 0};
    const NaturalSurface back = read_surface(again, out.body, out.source.spec.nominal_radius);
    out.written = {back.surface, true, sampled.resolution, sampled.region, seconds, sampled.note + back.note};
  });
  out.fit = fit_error(out.source, out.written);
  require_as_written(output, out.kind, out.body, out.fit, tolerance_of(settings));
  if (view)
    write_file(output, to_view);
  else if (own)
    copy_bytes(place, output);
  else
    staged.commit();
  return out;
}

}  // namespace

Converted write_surface(const NaturalSurface& surface, const std::filesystem::path& output,
                        const ConvertSettings& settings) {
  return write_checked(surface, std::nullopt, output, settings);
}

Converted convert_surface(const std::filesystem::path& input, const std::filesystem::path& output,
                          const ConvertSettings& settings) {
  NaturalSurface source =
      named_surface(input, {settings.body, settings.nominal_radius, settings.scale_to_mm, settings.overrides});
  std::optional<AddedTable> added;
  if (!settings.offsets.file.empty()) {
    added = AddedTable{source, read_offset_table(settings.offsets, source)};
    source = add_offsets(source, added->table);
  }
  const bool same = is_offset_file(input) && is_offset_file(output) && !added && settings.resolution == 0.0 &&
                    !settings.range_x && !settings.range_theta;
  return write_checked(std::move(source), added, output, settings, same ? input : std::filesystem::path());
}

}  // namespace treadmark::app
