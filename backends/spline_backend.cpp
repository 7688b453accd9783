// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/assembly/outermost_surface.hpp"
#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/sampling/seen_vertices.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/slices/slice_net.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

std::shared_ptr<const Surface> slice_surface(const SliceSet& slices, double nominal_radius) {
  if (slices.kinks.empty()) return spline::make_slice_surface(slices, nominal_radius);
  std::vector<std::shared_ptr<const Surface>> parts;
  for (const SliceSet& part : spline::split_at_kinks(slices))
    parts.push_back(spline::make_slice_surface(part, nominal_radius));
  return assembly::outermost_of(std::move(parts));
}

bool is_measured_lines(const SurfaceSpec& spec) {
  return std::holds_alternative<Profile>(spec.shape) || std::holds_alternative<SliceSet>(spec.shape);
}

std::shared_ptr<const Surface> natural_spline(const SurfaceSpec& spec, std::string&) {
  const auto* slices = std::get_if<SliceSet>(&spec.shape);
  auto surface = slices != nullptr ? slice_surface(*slices, spec.nominal_radius)
                                   : spline::make_profile_surface(std::get<Profile>(spec.shape), spec.nominal_radius);
  return analytic::add_defects(std::move(surface), spec.defects, spec.body, spec.nominal_radius);
}

std::shared_ptr<const Surface> natural_nurbs(const SurfaceSpec& spec, std::string& note) {
  auto surface = spline::make_nurbs_surface(std::get<TensorSpline>(spec.shape), note);
  return analytic::add_defects(std::move(surface), spec.defects, spec.body, spec.nominal_radius);
}

std::shared_ptr<const Surface> as_spline(Resampling& r) {
  const SurfaceSpec& spec = r.spec();
  if (is_formula(spec) && (spec.defects.empty() || flats_only(spec))) {
    // formulas are sampled at their own joints
    const double step = r.asked() ? r.resolution() : kResampleStep;
    const Profile profile = *sampled_formula(spec, step);
    r.set_resolution(step);
    if (spec.defects.empty()) return spline::make_profile_surface(profile, spec.nominal_radius);
    return spline::make_slice_surface(analytic::sample_wheel(profile, spec.nominal_radius, spec.defects.flats, step),
                                      spec.nominal_radius);
  }
  if (r.natural().constant_profile()) return spline::make_profile_surface(r.section(), spec.nominal_radius);
  return spline::make_slice_surface(r.slices(), spec.nominal_radius);
}

std::shared_ptr<const Surface> as_nurbs(Resampling& r) {
  const SurfaceSpec& spec = r.spec();
  const auto* chain = std::get_if<ArcChain>(&spec.shape);
  std::optional<ArcChain> known;
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape); standard != nullptr && spec.body == Body::rail)
    known = std::get<ArcChain>(analytic::standard_curve(standard->name));
  if (spec.defects.empty() && !r.asked() && (chain != nullptr || known)) {
    r.set_resolution(0.0);
    r.limit_rail();
    return spline::make_nurbs_surface(chain != nullptr ? *chain : *known, spec.body, spec.nominal_radius,
                                      r.region().u_min, r.region().u_max);
  }
  return spline::make_nurbs_surface(r.points(true));
}

/// Triangles of a scan, unless their samples are asked for: their vertices are what was measured.
std::shared_ptr<const Surface> thb_of_vertices(const TriangleMesh& mesh, Resampling& r, int degree) {
  const Body body = r.spec().body;
  // the outermost vertices lie inside of the region, and the surface is to reach its ends
  constexpr double kBeyond = 2e-3;
  const double beyond_u = kBeyond / (body == Body::wheel ? r.spec().nominal_radius : 1.0);
  const Region& wanted = r.region();
  const Region region{wanted.u_min - beyond_u, wanted.u_max + beyond_u, wanted.y_min - kBeyond, wanted.y_max + kBeyond};
  const std::vector<Vec3> seen = sampling::seen_vertices(r.surface(), body, mesh.vertices, region);
  std::string note;
  try {
    auto surface = spline::make_thb_surface(seen, body, region, degree, note);
    r.set_resolution(0.0);
    r.add_note(note);
    return surface;
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::input_data) throw;
    throw Error(e.kind(), e.message() + " (vertices of triangles are fitted where no resolution is given)", e.where(),
                "give a resolution, at which the triangles are sampled");
  }
}

std::shared_ptr<const Surface> as_thb(Resampling& r, int degree) {
  const auto* mesh = std::get_if<TriangleMesh>(&r.spec().shape);
  if (mesh != nullptr && !r.asked() && r.spec().defects.empty()) return thb_of_vertices(*mesh, r, degree);
  // a quadratic needs two points to each of its intervals, which are to be as long as was asked for
  const double spacing = r.resolution();
  if (degree == 2) r.set_resolution(0.5 * spacing);
  const sampling::PointGrid points = r.points(true);
  r.set_resolution(spacing);
  std::string note;
  auto surface = spline::make_thb_surface(points, degree, note);
  r.add_note(note);
  return surface;
}

}  // namespace

std::vector<Backend> spline_backends() {
  Backend spline{"spline", "cubic along the section, tensor B-spline of slices along or round", 4.0, false, as_spline};
  spline.natural_for = is_measured_lines;
  spline.make_natural = natural_spline;
  Backend nurbs{"nurbs", "full-parametric tensor B-spline, exact rational arcs", 4.0, false, as_nurbs};
  nurbs.natural_for = [](const SurfaceSpec& spec) { return std::holds_alternative<TensorSpline>(spec.shape); };
  nurbs.make_natural = natural_nurbs;
  return {spline,
          nurbs,
          {"thb", "truncated hierarchical B-spline, fine where the shape asks for it", 4.0, false,
           [](Resampling& r) { return as_thb(r, 3); }},
          {"thb-quadratic", "the same of degree 2", 3.0, false, [](Resampling& r) { return as_thb(r, 2); }}};
}

}  // namespace treadmark
