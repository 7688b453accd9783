// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/representation/kinds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "treadmark/backends/analytic/sample.hpp"

namespace treadmark::testing {
namespace {

constexpr double kStep = 0.5e-3;  ///< of the points, slices and triangles that shapes are given by [m]
constexpr double kBeyond = 6e-3;  ///< how far slices and triangles reach beyond the region [m]

Region sampled(Body body) {
  Region r;
  r.u_min = body == Body::wheel ? -0.04 : -0.02;
  r.u_max = body == Body::wheel ? 0.05 : 0.025;
  return r;
}

Region wider(Region r, Body body) {
  const double by = body == Body::wheel ? kBeyond / kWheelRadius : kBeyond;
  r.u_min -= by;
  r.u_max += by;
  return r;
}

ArcChain arcs(Body body) {
  if (body == Body::rail)
    return {-0.06 * std::sin(0.4), 0.06 * (1.0 - std::cos(0.4)), -0.4, {{0.06 * 0.4, 1.0 / 0.06}, {0.03, 1.0 / 0.3}}};
  return {-0.03, 0.0, 0.05, {{0.03, -1.0 / 0.5}, {0.03, -1.0 / 0.3}}};
}

std::string base_name(Body body, const std::string& shape) {
  return (body == Body::wheel ? "wheel_" : "rail_") + shape;
}

}  // namespace

SurfaceSpec s1002(Defects defects) { return {Body::wheel, kWheelRadius, StandardProfile{"S1002"}, std::move(defects)}; }
SurfaceSpec rail_60e1(Defects defects) { return {Body::rail, 0.0, StandardProfile{"60E1"}, std::move(defects)}; }

Defects one_flat() {
  WheelFlat flat;
  flat.length = 0.03;
  flat.depth = 0.3e-3;
  flat.theta_center = 0.005;
  flat.y_center = 0.004;
  flat.width = 0.04;
  Defects d;
  d.flats = {flat};
  return d;
}

Defects one_polygonization() {
  Polygonization p;
  p.harmonics = {{1, 0.2e-3, 0.4}, {24, 30e-6, -0.2}};
  Defects d;
  d.polygonizations = {p};
  return d;
}

Defects one_squat() {
  Squat s;
  s.length = 0.03;
  s.width = 0.024;
  s.depth = 0.3e-3;
  s.x_center = 0.003;
  s.y_center = -0.002;
  Defects d;
  d.squats = {s};
  return d;
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  const auto add_body = [&](Body body, const SurfaceSpec& standard,
                            const std::vector<std::pair<std::string, Defects>>& damage) {
    const Region region = sampled(body);
    const NaturalSurface natural = create_natural(standard);
    const Representation samples{"", kStep, wider(region, body)};
    SurfaceSpec chain = standard, points = standard, slices = standard, triangles = standard;
    chain.shape = arcs(body);
    points.shape = analytic::sample_profile(std::get<StandardProfile>(standard.shape), kStep);
    slices.shape = to_slices(natural, samples);
    triangles.shape = to_triangles(natural, samples);
    const auto add = [&](const std::string& shape, SurfaceSpec spec, const std::string& backend, SurfaceSpec formula) {
      for (const auto& [name, defects] : damage) {
        spec.defects = formula.defects = defects;
        all.push_back({base_name(body, shape) + name, spec, backend, formula, region});
      }
    };
    add("standard", standard, "analytic", standard);
    add("arcs", chain, "analytic", chain);
    add("points", points, "spline", standard);
    add("slices", slices, "spline", standard);
    add("triangles", triangles, "mesh", standard);
  };
  add_body(Body::wheel, s1002(), {{"", {}}, {"_flat", one_flat()}, {"_polygonal", one_polygonization()}});
  add_body(Body::rail, rail_60e1(), {{"", {}}, {"_squat", one_squat()}});
  return all;
}

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

Distance distance(const Surface& reference, const Surface& candidate, Body body, const Region& region, int n,
                  double margin, double aside) {
  // planes of their own: straight up at the station (rail), turned to it (wheel)
  const double turn = aside / reference.bounds().max.z();
  const auto plane = [&](double u) {
    return body == Body::rail ? Pose{{u, 0.0, 0.0}, Mat3::Identity()}
                              : Pose{Vec3::Zero(), rotation({0.0, 0.0, u - turn})};
  };
  const Box3 box = reference.bounds();
  const double y_min = std::max(region.y_min, box.min.y() + margin),
               y_max = std::min(region.y_max, box.max.y() - margin);
  constexpr double kGolden1 = 0.7548776662466927, kGolden2 = 0.5698402909980532;  // Roberts' sequence in two dimensions
  Distance d;
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = region.u_min + (region.u_max - region.u_min) * std::fmod(0.5 + kGolden1 * i, 1.0);
    const double y = y_min + (y_max - y_min) * std::fmod(0.5 + kGolden2 * i, 1.0);
    const auto at = [&](const Surface& s, double& dzdx, double& dzdy) {
      double z = 0.0;
      s.heights({plane(u), {aside, y, 1.0, 1.0, 1, 1}}, {{&z, 1}, {&dzdx, 1}, {&dzdy, 1}});
      return z;
    };
    double ax = 0.0, ay = 0.0, bx = 0.0, by = 0.0;
    const double a = at(reference, ax, ay), b = at(candidate, bx, by);
    if (std::isnan(a)) continue;
    if (std::isnan(b)) {
      ++d.missing;
      continue;
    }
    const double normal = std::fabs(a - b) / std::sqrt(1.0 + ax * ax + ay * ay);
    const Vec3 na = Vec3(-ax, -ay, 1.0).normalized(), nb = Vec3(-bx, -by, 1.0).normalized();
    ++d.points;
    d.max = std::max(d.max, normal);
    d.slope = std::max(d.slope, std::atan2(na.cross(nb).norm(), na.dot(nb)));
    const double weight = std::sqrt(1.0 + ay * ay);  // even along the section, not along y
    sum += weight * normal * normal;
    weights += weight;
  }
  d.rms = d.points > 0 ? std::sqrt(sum / weights) : std::numeric_limits<double>::quiet_NaN();
  return d;
}

}  // namespace treadmark::testing
