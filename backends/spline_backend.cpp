// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
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

constexpr int kAnyDegree = 1'000'000;  // one that is not known is refused when the surface is made

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

/// make: spline::make_nurbs_surface or what is called like it.
template <class Make>
auto as_nurbs(Resampling& r, const Make& make) {
  const SurfaceSpec& spec = r.spec();
  const auto* chain = std::get_if<ArcChain>(&spec.shape);
  std::optional<ArcChain> known;
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape); standard != nullptr && spec.body == Body::rail)
    known = std::get<ArcChain>(analytic::standard_curve(standard->name));
  if (spec.defects.empty() && !r.asked() && (chain != nullptr || known)) {
    r.set_resolution(0.0);
    r.limit_rail();
    return make(chain != nullptr ? *chain : *known, spec.body, spec.nominal_radius, r.region().u_min, r.region().u_max);
  }
  return make(r.points(true));
}

/// Triangles of a scan, unless their samples are asked for: their vertices are what was measured.
template <class Make>
auto thb_of_vertices(const TriangleMesh& mesh, Resampling& r, int degree, const Make& make) {
  const Body body = r.spec().body;
  // the outermost vertices lie inside of the region, and the surface is to reach its ends
  constexpr double kBeyond = 2e-3;
  const double beyond_u = kBeyond / (body == Body::wheel ? r.spec().nominal_radius : 1.0);
  const Region& wanted = r.region();
  const Region region{wanted.u_min - beyond_u, wanted.u_max + beyond_u, wanted.y_min - kBeyond, wanted.y_max + kBeyond};
  const std::vector<Vec3> seen = sampling::seen_vertices(r.surface(), body, mesh.vertices, region);
  std::string note;
  try {
    auto made = make(seen, body, region, degree, note);
    r.set_resolution(0.0);
    r.add_note(note);
    return made;
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::input_data) throw;
    throw Error(e.kind(), e.message() + " (vertices of triangles are fitted where no resolution is given)", e.where(),
                "give a resolution, at which the triangles are sampled");
  }
}

/// make: spline::make_thb_surface or what is called like it.
template <class Make>
auto as_thb(Resampling& r, int degree, const Make& make) {
  const auto* mesh = std::get_if<TriangleMesh>(&r.spec().shape);
  if (mesh != nullptr && !r.asked() && r.spec().defects.empty()) return thb_of_vertices(*mesh, r, degree, make);
  // a quadratic needs two points to each of its intervals, which are to be as long as was asked for
  const double spacing = r.resolution();
  if (degree == 2) r.set_resolution(0.5 * spacing);
  const sampling::PointGrid points = r.points(true);
  r.set_resolution(spacing);
  std::string note;
  auto made = make(points, degree, note);
  r.add_note(note);
  return made;
}

/// Shapes given by their splines belong to the backend of their kind.
bool is_given(const SurfaceSpec& spec, bool hierarchical, int most_degree) {
  const auto* splines = std::get_if<SplineSurface>(&spec.shape);
  if (splines == nullptr || splines->hierarchical != hierarchical) return false;
  int degree = 0;
  for (const auto& level : splines->levels)
    for (const SplineKnots& knots : level) degree = std::max(degree, knots.degree);
  return degree <= most_degree;
}

std::shared_ptr<const Surface> natural_given(const SurfaceSpec& spec, std::string& note) {
  auto surface = spline::make_given_surface(std::get<SplineSurface>(spec.shape), spec.body, &note);
  return analytic::add_defects(std::move(surface), spec.defects, spec.body, spec.nominal_radius);
}

Backend nurbs_row() {
  Backend row{"nurbs", "full-parametric tensor B-spline, exact rational arcs", 4.0, false, [](Resampling& r) {
                return as_nurbs(r, [](const auto&... from) { return spline::make_nurbs_surface(from...); });
              }};
  row.tell_splines = [](Resampling& r) {
    return as_nurbs(r, [](const auto&... from) { return spline::tell_nurbs(from...); });
  };
  row.natural_for = [](const SurfaceSpec& spec) { return is_given(spec, false, kAnyDegree); };
  row.make_natural = natural_given;
  return row;
}

Backend thb_row(std::string name, std::string summary, int degree) {
  Backend row{std::move(name), std::move(summary), degree + 1.0, false, [degree](Resampling& r) {
                return as_thb(r, degree, [](auto&&... from) { return spline::make_thb_surface(from...); });
              }};
  row.tell_splines = [degree](Resampling& r) {
    return as_thb(r, degree, [](auto&&... from) { return spline::tell_thb(from...); });
  };
  row.natural_for = [degree](const SurfaceSpec& spec) {
    return is_given(spec, true, degree == 2 ? 2 : kAnyDegree) && !(degree == 3 && is_given(spec, true, 2));
  };
  row.make_natural = natural_given;
  return row;
}

}  // namespace

std::vector<Backend> spline_backends() {
  Backend spline{"spline", "cubic along the section, tensor B-spline of slices along or round", 4.0, false, as_spline};
  spline.natural_for = is_measured_lines;
  spline.make_natural = natural_spline;
  return {spline, nurbs_row(), thb_row("thb", "truncated hierarchical B-spline, fine where the shape asks for it", 3),
          thb_row("thb-quadratic", "the same of degree 2", 2)};
}

}  // namespace treadmark
