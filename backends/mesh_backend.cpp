// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <variant>

#include <fmt/format.h>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/mesh/make.hpp"

namespace treadmark {
namespace {

std::string words(const mesh::MeshRepair& repair) {
  std::string text;
  const auto add = [&](std::size_t n, std::string_view what) {
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "repaired the mesh: " : ", ", n, what);
  };
  add(repair.merged_vertices, "coincident vertices merged");
  add(repair.degenerate, "triangles without area removed");
  add(repair.duplicates, "duplicate triangles removed");
  add(repair.flipped, "flipped triangles turned");
  if (repair.turned_inside_out) text += text.empty() ? "repaired the mesh: turned inside out" : ", turned inside out";
  return text.empty() ? text : text + ". ";
}

bool is_triangles(const SurfaceSpec& spec) { return std::holds_alternative<TriangleMesh>(spec.shape); }

std::shared_ptr<const Surface> natural_mesh(const SurfaceSpec& spec, std::string& note) {
  mesh::MeshRepair repair;
  auto surface = mesh::make_mesh_surface(std::get<TriangleMesh>(spec.shape), spec.body, {}, &repair);
  note += words(repair);
  return analytic::add_defects(std::move(surface), spec.defects, spec.body, spec.nominal_radius);
}

Backend mesh_row(std::string name, std::string summary, double order, mesh::Refinement refinement) {
  const auto resample = [refinement, name](Resampling& r) {
    mesh::MeshOptions options;
    options.refinement = refinement;
    options.backend = name;
    mesh::MeshRepair repair;
    auto surface = mesh::make_mesh_surface(r.triangles(), r.spec().body, options, &repair);
    r.add_note(words(repair));
    return surface;
  };
  return {name, std::move(summary), order, false, resample};
}

}  // namespace

std::vector<Backend> mesh_backends() {
  Backend smooth =
      mesh_row("mesh", "triangles with local polynomials blended over them", 4.0, mesh::Refinement::smooth);
  smooth.natural_for = is_triangles;
  smooth.make_natural = natural_mesh;
  Backend flat = mesh_row("mesh-flat", "the triangles themselves", 2.0, mesh::Refinement::facets);
  flat.creases = Creases::facets;
  return {smooth, flat};
}

}  // namespace treadmark
