// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/write_vtk.hpp"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <utility>

#include "treadmark/core/never_cancelled.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/subsurface_table.hpp"

namespace treadmark::io {
namespace {

/// Corners of the elements in track axes, (nx + 1) (ny + 1) points.
std::vector<double> corner_points(const PatchFields& fields, double reference_s) {
  const std::vector<Vec2> rows = row_edges(fields, reference_s);
  const Grid2& grid = fields.grid;
  std::vector<double> points;
  points.reserve(3 * static_cast<std::size_t>(grid.nx + 1) * static_cast<std::size_t>(grid.ny + 1));
  for (int iy = 0; iy <= grid.ny; ++iy)
    for (int ix = 0; ix <= grid.nx; ++ix) {
      const Vec2& row = rows[static_cast<std::size_t>(iy)];
      const Vec3 p_T = fields.X_TC.apply({grid.x0 + (ix - 0.5) * grid.dx, row.x(), row.y()});
      points.insert(points.end(), {p_T.x(), p_T.y(), p_T.z()});
    }
  return points;
}

std::vector<float> as_float(const std::vector<double>& values) { return {values.begin(), values.end()}; }

/// Traction on the rail as a vector in track axes, for arrows.
std::vector<float> traction_vectors(const PatchFields& fields) {
  std::vector<float> out;
  out.reserve(3 * fields.pressure.size());
  const bool tangential = !fields.traction_x.empty() && !fields.traction_s.empty();
  for (std::size_t i = 0; i < fields.pressure.size(); ++i) {
    const double angle =
        fields.row_angle.empty() ? 0.0 : fields.row_angle[i / static_cast<std::size_t>(fields.grid.nx)];
    const Vec3 t_T =
        fields.X_TC.rotation * rotation_x(angle) *
        Vec3(tangential ? fields.traction_x[i] : 0.0, tangential ? fields.traction_s[i] : 0.0, fields.pressure[i]);
    for (int k = 0; k < 3; ++k) out.push_back(static_cast<float>(t_T[k]));
  }
  return out;
}

}  // namespace

std::string patch_to_vts(const PatchResult& patch, int case_number, int patch_number) {
  const PatchFields& fields = patch.fields;
  check_field_sizes(fields, case_number, patch_number);
  const std::string extent = fmt::format("0 {} 0 {} 0 0", fields.grid.nx, fields.grid.ny);

  std::string cells;
  for (const FieldColumn& column : kFieldColumns) {
    const std::vector<double>& values = fields.*column.values;
    if (values.empty()) continue;
    const std::string_view unit = patch.shift ? column.unit_shift : column.unit;
    cells += vtk_data_array(unit == "1" ? std::string(column.name) : fmt::format("{}_{}", column.name, unit),
                            as_float(values), 1);
  }
  if (!fields.pressure.empty()) cells += vtk_data_array("traction_on_rail_Pa", traction_vectors(fields), 3);
  if (!fields.state.empty()) cells += vtk_data_array("state", fields.state, 1);

  return vtk_structured_grid(extent, "CellData", cells,
                             vtk_data_array("points_m", corner_points(fields, patch.reference_s), 3));
}

namespace {

/// Files of a folder and what the collection says of them.
class VtkFiles {
 public:
  explicit VtkFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void add(double time, int part, const std::string& name, const std::string& text) {
    write_file(folder_ / name, text);
    this->name(time, part, name);
  }

  /// A file that is written elsewhere.
  void name(double time, int part, const std::string& name) {
    written.push_back(folder_ / name);
    entries += vtk_entry(time, part, name);
  }

  void add(const VtkFiles& others) {
    written.insert(written.end(), others.written.begin(), others.written.end());
    entries += others.entries;
  }

  std::vector<std::filesystem::path> finish(const std::string& stem) {
    written.push_back(folder_ / (stem + ".pvd"));
    write_file(written.back(), vtk_collection(entries));
    return std::move(written);
  }

  std::vector<std::filesystem::path> written;
  std::string entries;

 private:
  std::filesystem::path folder_;
};

double time_of(const RunResult& run, std::size_t k, std::span<const double> times) {
  return k < times.size() ? times[k] : run.cases[k].number;
}

/// Parts of a case: its patches, then their blocks of points.
void write_case(VtkFiles& files, const CaseResult& result, double time, const std::string& stem) {
  int part = 0, number = 0;
  for (const PatchResult& patch : result.patches) {
    ++number;
    if (patch.fields.grid.size() != 0)
      files.add(time, part, fmt::format("{}_case{:04}_patch{}.vts", stem, result.number, number),
                patch_to_vts(patch, result.number, number));
    ++part;
  }
  number = 0;
  for (const PatchResult& patch : result.patches) {
    check_blocks(patch.subsurface, fmt::format("case {}, patch {}: ", result.number, ++number));
    int block_number = 0;
    for (const SubsurfaceBlock& block : patch.subsurface)
      files.add(time, part++,
                fmt::format("{}_case{:04}_patch{}_block{}.vts", stem, result.number, number, ++block_number),
                block_to_vts(block, patch.fields.X_TC));
  }
}

}  // namespace

std::vector<std::filesystem::path> write_vtk(const std::filesystem::path& folder, const RunResult& run,
                                             const std::string& stem, std::span<const double> times) {
  std::vector<VtkFiles> of_case(run.cases.size(), VtkFiles(folder));
  const NeverCancelled whole;
  parallel_for(run.cases.size(),
               [&](std::size_t k) { write_case(of_case[k], run.cases[k], time_of(run, k, times), stem); });
  VtkFiles files(folder);
  for (const VtkFiles& one : of_case) files.add(one);
  return files.finish(stem);
}

std::string surface_to_vtp(const SampledSurface& surface, const Pose& X_TB) {
  std::vector<float> points, deviation;
  std::vector<std::int32_t> number(surface.x.size(), -1), corners;
  points.reserve(3 * surface.x.size());
  deviation.reserve(surface.deviation.size());
  std::int32_t count = 0;
  for (std::size_t k = 0; k < surface.x.size(); ++k) {
    const Vec3 p_T = X_TB.apply({surface.x[k], surface.y[k], surface.z[k]});
    if (!p_T.allFinite()) continue;
    number[k] = count++;
    for (int i = 0; i < 3; ++i) points.push_back(static_cast<float>(p_T[i]));
    if (!surface.deviation.empty()) deviation.push_back(static_cast<float>(surface.deviation[k]));
  }
  corners.reserve(4 * surface.x.size());
  for (int iu = 0; iu + 1 < surface.nu + (surface.closed ? 1 : 0); ++iu)
    for (int iv = 0; iv + 1 < surface.nv; ++iv) {
      const int next = (iu + 1) % surface.nu;
      const std::int32_t quad[] = {number[surface.index(iu, iv)], number[surface.index(next, iv)],
                                   number[surface.index(next, iv + 1)], number[surface.index(iu, iv + 1)]};
      if (ranges::all_of(quad, [](std::int32_t k) { return k >= 0; }))
        corners.insert(corners.end(), std::begin(quad), std::end(quad));
    }
  return vtk_polygons(4, corners, static_cast<std::size_t>(count),
                      deviation.empty() ? "" : vtk_data_array("deviation_m", deviation, 1),
                      vtk_data_array("points_m", points, 3));
}

std::string triangles_to_vtp(const TriangleMesh& mesh) {
  std::vector<double> points;
  points.reserve(3 * mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.insert(points.end(), {v.x(), v.y(), v.z()});
  std::vector<std::int32_t> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) corners.push_back(static_cast<std::int32_t>(corner));
  return vtk_polygons(3, corners, mesh.vertices.size(), "", vtk_data_array("points_m", points, 3));
}

std::vector<std::filesystem::path> write_vtk_bodies(const std::filesystem::path& folder, const RunResult& run,
                                                    const std::string& stem, std::span<const double> times) {
  if (run.sampled.empty()) return {};
  VtkFiles files(folder);
  struct Stand {
    Pose pose;
    std::string file;
    int surface;
  };
  std::map<std::string, std::vector<Stand>> stands;  // a rail mostly stands in one place
  for (std::size_t k = 0; k < run.cases.size(); ++k) {
    const CaseResult& result = run.cases[k];
    if (!result.bodies) continue;
    int part = 0;
    for (const auto& body : {std::pair<const std::string&, const Pose&>{result.rail_surface, result.bodies->X_TS},
                             {result.wheel_surface, result.bodies->X_TA}}) {
      const std::string& name = body.first;
      const Pose& pose = body.second;
      const int index = surface_index(run.sampled, name);
      if (index < 0) continue;
      std::vector<Stand>& known = stands[name];
      const auto same = ranges::find_if(
          known, [&](const Stand& s) { return s.pose.origin == pose.origin && s.pose.rotation == pose.rotation; });
      const double time = time_of(run, k, times);
      if (same != known.end()) {
        files.entries += vtk_entry(time, part++, same->file);
        continue;
      }
      const std::string file = fmt::format("{}_{}_{:04}.vtp", stem, name, known.size() + 1);
      files.name(time, part++, file);
      known.push_back({pose, file, index});
    }
  }
  std::vector<const Stand*> all;
  for (const auto& [name, known] : stands)
    for (const Stand& stand : known) all.push_back(&stand);
  const NeverCancelled whole;
  parallel_for(all.size(), [&](std::size_t k) {
    write_file(folder / all[k]->file,
               surface_to_vtp(run.sampled[static_cast<std::size_t>(all[k]->surface)], all[k]->pose));
  });
  return files.finish(stem);
}

}  // namespace treadmark::io
