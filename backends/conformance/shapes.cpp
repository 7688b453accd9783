// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/conformance/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::conformance {

namespace {

Pose pose(const Vec3& origin, double roll, double yaw, double pitch) { return {origin, rotation({roll, yaw, pitch})}; }

Shape rail_shape(std::string name, SurfaceSpec spec, std::function<double(double)> z, double y_min, double y_max) {
  const auto outside = [=, z = std::move(z)](const Vec3& p) {
    return p.y() < y_min || p.y() > y_max ? kNaN : z(p.y()) - p.z();
  };
  return {std::move(name), std::move(spec), outside, y_min, y_max, -0.03, 0.05, -0.15, 0.45, rail_planes()};
}

Shape wheel_shape(std::string name, SurfaceSpec spec, std::function<double(double)> z,
                  std::function<double(double, double)> depth, double y_min, double y_max) {
  const double R = spec.nominal_radius;
  const auto outside = [=, z = std::move(z), depth = std::move(depth)](const Vec3& p) {
    if (p.y() < y_min || p.y() > y_max) return kNaN;
    return std::hypot(p.x(), p.z()) - R - z(p.y()) + depth(std::atan2(p.x(), p.z()), p.y());
  };
  return {std::move(name), std::move(spec), outside, y_min, y_max, -0.05, 0.06, -0.15, 0.42, wheel_planes(R)};
}

/// The profile turned about an axle at z = radius; planes stand on the roller as they would on the rail, at some angle
/// round it.
Shape roller_shape(std::string name, SurfaceSpec spec, std::function<double(double)> z, double y_min, double y_max) {
  const double R = spec.roller_radius;
  Shape s = rail_shape(std::move(name), std::move(spec), z, y_min, y_max);
  s.outside = [=, z = std::move(z)](const Vec3& p) {
    return p.y() < y_min || p.y() > y_max ? kNaN : std::hypot(p.x(), p.z() - R) - (R - z(p.y()));
  };
  s.u_min = -0.35 * R;
  s.u_max = 0.42 * R;
  const auto at = [R](double theta, double y, double down, double roll, double yaw, double pitch) {
    const double r = R - down;
    return pose({r * std::sin(theta), y, R - r * std::cos(theta)}, roll, yaw, pitch);
  };
  s.planes = {at(0.0, 0.001, -0.0004, 0.0, 0.0, 0.0),   at(0.0, 0.012, 0.0, 0.07, 0.0, 0.0),
              at(0.3, -0.02, 0.003, -0.45, 0.03, -0.3), at(0.02, 0.005, 0.001, 0.02, -0.4, 0.1),
              at(-0.01, -0.03, 0.008, -1.1, 0.01, 0.0), at(0.0, 0.03, 0.008, 1.5, 1.3, 0.0)};
  return s;
}

/// The profile turned about an axle above it, material outside; planes stand on its lower part.
Shape ring_shape(std::string name, SurfaceSpec spec, std::function<double(double)> z, double y_min, double y_max) {
  const double R = -spec.roller_radius;
  Shape s = rail_shape(std::move(name), std::move(spec), z, y_min, y_max);
  s.outside = [=, z = std::move(z)](const Vec3& p) {
    return p.y() < y_min || p.y() > y_max ? kNaN : R + z(p.y()) - std::hypot(p.x(), p.z() + R);
  };
  s.u_min = -0.12;
  s.u_max = 0.15;
  s.varies = true;
  const auto at = [R](double theta, double y, double down, double roll, double yaw, double pitch) {
    const double r = R + down;
    return pose({r * std::sin(theta), y, -R + r * std::cos(theta)}, roll, yaw, pitch);
  };
  s.planes = {at(0.0, 0.0013, -0.0004, 0.0, 0.0, 0.0),     at(0.0, 0.0117, 0.0, 0.07, 0.0, 0.0),
              at(0.15, -0.02, 0.003, -0.45, 0.03, 0.15),   at(0.02, 0.0047, 0.001, 0.02, -0.4, 0.1),
              at(-0.01, -0.0297, 0.0081, -1.1, 0.01, 0.0), at(0.0, 0.0297, 0.0083, 1.5, 1.3, 0.0)};
  return s;
}

/// An arc of R60 put together from two parts that overlap, each in a frame of its own.
Shape two_part_shape() {
  constexpr double kRadius = 0.06, kEnd = 0.5, kOverlap = 0.05;
  const auto arc = [](double from, double to, double y, double z) {
    return ArcChain{kRadius * std::sin(from) - y,
                    kRadius * (1.0 - std::cos(from)) - z,
                    from,
                    {{kRadius * (to - from), 1.0 / kRadius}}};
  };
  Shape s = rail_shape(
      "two_part_rail", {Body::rail, 0.0, arc(-kEnd, kEnd, 0.0, 0.0), {}},
      [](double y) { return kRadius - std::sqrt(kRadius * kRadius - y * y); }, -kRadius * std::sin(kEnd),
      kRadius * std::sin(kEnd));
  s.natural = [arc] {
    const auto part = [&](double from, double to, double y, double z) {
      return SurfacePart{
          std::make_shared<const NaturalSurface>(create_natural({Body::rail, 0.0, arc(from, to, y, z), {}})),
          {0.1, y, z},
          "",
          0.0};
    };
    return join_surfaces({part(-kEnd, kOverlap, -0.015, 0.002), part(-kOverlap, kEnd, 0.02, 0.0)});
  };
  return s;
}

double flat_test_depth(double theta, double y, double R) {
  // one rounded flat that fades sideways, 60 mm long, 0.8 mm deep, at theta = 0.01, y = 4 mm, 50 mm wide
  const double x = R * (theta - 0.01);
  if (std::fabs(x) >= 0.03 || std::fabs(y - 0.004) >= 0.025) return 0.0;
  return 0.4e-3 * (1.0 + std::cos(2.0 * kPi * x / 0.06)) * 0.5 * (1.0 + std::cos(2.0 * kPi * (y - 0.004) / 0.05));
}

double chord_test_depth(double theta, double R) {
  // straight cut of 40 mm at theta = -0.005
  const double rho = std::sqrt(R * R - 0.02 * 0.02), phi = theta + 0.005;
  return std::fabs(phi) < kPi / 2 ? std::max(0.0, R - rho / std::cos(phi)) : 0.0;
}

}  // namespace

double s1002_mm(double S) {
  const auto power_sum = [S](std::initializer_list<double> c) {
    double sum = 0.0, p = 1.0;
    for (double ci : c) sum += ci * p, p *= S;
    return sum;
  };
  if (S < -62.764705882) return 9.519259302 + std::sqrt(std::max(0.0, 20.5 * 20.5 - (S + 49.5) * (S + 49.5)));
  if (S < -49.662510381) return 16.0 + std::sqrt(12.0 * 12.0 - (S + 55.0) * (S + 55.0));
  if (S < -39.764473993) return 8.834924130 + std::sqrt(20.0 * 20.0 - (S + 58.558326413) * (S + 58.558326413));
  if (S < -38.426669071) return -93.576667419 - 2.747477419 * S;
  if (S < -35.0) return 16.446 - std::sqrt(13.0 * 13.0 - (S + 26.210665) * (S + 26.210665));
  if (S < -26.0)
    return power_sum({-4.320221063e3, -1.038384026e3, -1.065501873e2, -6.051367875, -2.054332446e-1, -4.169739389e-3,
                      -4.687195829e-5, -2.252755540e-7});
  if (S < 32.15796)
    return power_sum({0.0, -3.358537058e-2, 1.565681624e-3, -2.810427944e-5, 5.844240864e-8, -1.562379023e-8,
                      5.309217349e-15, -5.957839843e-12, 2.646656573e-13});
  return 1.364323640 - 0.066666667 * S;
}

double rail_60e1_mm(double y) {
  // centres and joints as derived from the standard to 1e-6 mm, here to all digits
  const double a = std::fabs(y);
  const double j1 = 10.228, j2 = 26.0265;
  const double s1 = j1 / 300.0, c1 = std::sqrt(1.0 - s1 * s1);
  const double y80 = j1 - 80.0 * s1, z80 = 300.0 - 300.0 * c1 + 80.0 * c1;  // centre of R80, z down
  const double s2 = (j2 - y80) / 80.0, c2 = std::sqrt(1.0 - s2 * s2);
  const double y13 = j2 - 13.0 * s2, z13 = z80 - 80.0 * c2 + 13.0 * c2;
  const double j3 = y13 + 13.0 * 20.0 / std::sqrt(401.0), z3 = z13 - 13.0 / std::sqrt(401.0);
  if (a < j1) return 300.0 - std::sqrt(300.0 * 300.0 - a * a);
  if (a < j2) return z80 - std::sqrt(80.0 * 80.0 - (a - y80) * (a - y80));
  if (a < j3) return z13 - std::sqrt(13.0 * 13.0 - (a - y13) * (a - y13));
  return z3 + 20.0 * (a - j3);
}

std::vector<Shape> shapes() {
  std::vector<Shape> all;
  const auto no_depth = [](double, double) { return 0.0; };
  const auto s1002 = [](double y) { return 1e-3 * s1002_mm(1e3 * y); };
  const auto rail_60e1 = [](double y) { return 1e-3 * rail_60e1_mm(1e3 * y); };
  const auto z_barrel = [](double y) { return 0.08 - std::sqrt(0.08 * 0.08 - y * y); };
  const double y_barrel = 0.08 * std::sin(0.6);
  const ArcChain barrel{-y_barrel, 0.08 * (1.0 - std::cos(0.6)), -0.6, {{0.08 * 1.2, 1.0 / 0.08}}};

  {
    ArcChain two_arcs;  // R300 towards the field, R60 towards the gauge, crown at 0
    two_arcs.start_y = -0.06 * std::sin(0.5);
    two_arcs.start_z = 0.06 * (1.0 - std::cos(0.5));
    two_arcs.start_angle = -0.5;
    two_arcs.segments = {{0.06 * 0.5, 1.0 / 0.06}, {0.3 * 0.1, 1.0 / 0.3}};
    const auto z = [](double y) {
      const double r = y < 0 ? 0.06 : 0.3;
      return r - std::sqrt(r * r - y * y);
    };
    all.push_back(
        rail_shape("two_arc_rail", {Body::rail, 0.0, two_arcs, {}}, z, two_arcs.start_y, 0.3 * std::sin(0.1)));
  }
  all.push_back(
      rail_shape("rail_60e1", {Body::rail, 0.0, StandardProfile{"60E1"}, {}}, rail_60e1, -37.05e-3, 37.05e-3));
  all.push_back(two_part_shape());
  all.push_back(
      roller_shape("roller_60e1", {Body::rail, 0.0, StandardProfile{"60E1"}, {}, 0.5}, rail_60e1, -37.05e-3, 37.05e-3));
  all.push_back(roller_shape("barrel_roller", {Body::rail, 0.0, barrel, {}, 0.2}, z_barrel, -y_barrel, y_barrel));
  all.push_back(ring_shape("barrel_ring", {Body::rail, 0.0, barrel, {}, -0.6}, z_barrel, -y_barrel, y_barrel));
  all.push_back(
      ring_shape("ring_60e1", {Body::rail, 0.0, StandardProfile{"60E1"}, {}, -0.7}, rail_60e1, -37.05e-3, 37.05e-3));
  {
    const ArcChain round{-0.05 * std::sin(0.8), -0.05 * (1.0 - std::cos(0.8)), 0.8, {{0.05 * 1.6, -1.0 / 0.05}}};
    all.push_back(wheel_shape(
        "barrel_wheel", {Body::wheel, 0.3, round, {}}, [](double y) { return std::sqrt(0.05 * 0.05 - y * y) - 0.05; },
        no_depth, -0.05 * std::sin(0.8), 0.05 * std::sin(0.8)));
  }
  all.push_back(
      wheel_shape("wheel_s1002", {Body::wheel, 0.46, StandardProfile{"S1002"}, {}}, s1002, no_depth, -0.07, 0.06));
  {
    WheelFlat flat;
    flat.shape = WheelFlat::Shape::rounded;
    flat.length = 0.06;
    flat.depth = 0.8e-3;
    flat.theta_center = 0.01;
    flat.y_center = 0.004;
    flat.width = 0.05;
    // the angle is x/R with R = 0.46 m
    all.push_back(wheel_shape(
        "rounded_flat", {Body::wheel, 0.46, StandardProfile{"S1002"}, {.flats = {flat}}}, s1002,
        [](double theta, double y) { return flat_test_depth(theta, y, 0.46); }, -0.07, 0.06));
    WheelFlat cut;
    cut.shape = WheelFlat::Shape::fresh;
    cut.length = 0.04;
    cut.theta_center = -0.005;
    all.push_back(wheel_shape(
        "fresh_flat", {Body::wheel, 0.46, StandardProfile{"S1002"}, {.flats = {cut}}}, s1002,
        [](double theta, double) { return chord_test_depth(theta, 0.46); }, -0.07, 0.06));
    all.back().kinks = 0.05;
  }
  {
    Defects defects;
    Polygonization polygon;
    polygon.harmonics = {{1, 0.1e-3, 0.3}, {20, 20e-6, -0.7}};
    defects.polygonizations = {polygon};
    all.push_back(wheel_shape(
        "polygonal_wheel", {Body::wheel, 0.46, StandardProfile{"S1002"}, defects}, s1002,
        [](double theta, double) { return -0.1e-3 * std::cos(theta - 0.3) - 20e-6 * std::cos(20.0 * theta + 0.7); },
        -0.07, 0.06));
  }
  {
    Squat squat;
    squat.length = 0.03;
    squat.width = 0.024;
    squat.depth = 0.4e-3;
    squat.x_center = 0.31;
    squat.y_center = 0.004;
    Defects defects;
    defects.squats = {squat};
    Shape shape =
        rail_shape("squat_rail", {Body::rail, 0.0, StandardProfile{"60E1"}, defects}, rail_60e1, -37.05e-3, 37.05e-3);
    shape.outside = [plain = shape.outside](const Vec3& p) {
      const double x = p.x() - 0.31, y = p.y() - 0.004;
      if (std::fabs(x) >= 0.015 || std::fabs(y) >= 0.012) return plain(p);
      return plain(p) + 0.1e-3 * (1.0 + std::cos(2.0 * kPi * x / 0.03)) * (1.0 + std::cos(2.0 * kPi * y / 0.024));
    };
    all.push_back(shape);
  }
  return all;
}

namespace {

/// The shape that has its section in the middle of the region everywhere: along the track, round a wheel or a roller.
Shape with_one_section(Shape s) {
  const double R = s.spec.roller_radius, middle = 0.5 * (s.u_min + s.u_max);
  const bool along = s.spec.body == Body::rail && R <= 0.0;
  s.natural = [natural = s.natural, spec = s.spec] { return natural ? natural() : create_natural(spec); };
  s.outside = [outside = s.outside, along, middle, R](const Vec3& p) {
    if (along) return outside({middle, p.y(), p.z()});
    const double angle = R > 0.0 ? middle / R : middle, low = R > 0.0 ? R : 0.0, side = R > 0.0 ? -1.0 : 1.0;
    const double r = std::hypot(p.x(), p.z() - low);
    return outside({r * std::sin(angle), p.y(), low + side * r * std::cos(angle)});
  };
  s.spec.defects = {};
  s.varies = false;
  return s;
}

}  // namespace

Shape shape_for(const Backend& backend, Shape shape) {
  return backend.one_place ? with_one_section(std::move(shape)) : shape;
}

std::shared_ptr<const Surface> represented(const Shape& shape, const std::string& backend, double resolution) {
  Representation wanted{backend, resolution, {}};
  wanted.region.u_min = shape.u_min;
  wanted.region.u_max = shape.u_max;
  return represent(shape.natural ? shape.natural() : create_natural(shape.spec), wanted).surface;
}

Vec3 gradient(const Shape& shape, const Vec3& p) {
  constexpr double kStep = 1e-7;
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    const Vec3 e = Vec3::Unit(k) * kStep;
    g[k] = (shape.outside(p + e) - shape.outside(p - e)) / (2.0 * kStep);
  }
  return g;
}

BruteHit brute_force(const Shape& shape, const Pose& X, double x, double y) {
  const bool wheel = shape.spec.body == Body::wheel;
  // from the outermost end inwards in fine steps: along -z of the plane for a wheel, along +z for a rail
  constexpr double kStep = 1e-4;
  const double from = wheel ? shape.r_high : shape.r_low, step = wheel ? -kStep : kStep;
  const int n = to_whole<int>((shape.r_high - shape.r_low) / kStep);
  const auto f = [&](double t) { return shape.outside(X.apply({x, y, t})); };
  double before = f(from);
  for (int i = 1; i <= n; ++i) {
    const double t = from + i * step, now = f(t);
    if ((before > 0.0 && now <= 0.0) || (before < 0.0 && now >= 0.0)) {
      double a = t - step, b = t;
      const bool down = before > 0.0;
      for (int k = 0; k < 60; ++k) {
        const double m = 0.5 * (a + b);
        ((f(m) > 0.0) == down ? a : b) = m;
      }
      const Vec3 p = X.apply({x, y, b}), g = gradient(shape, p);
      return {b, std::fabs(g.dot(X.rotation.col(2))) / g.norm(), p.y()};
    }
    before = now;
  }
  return {kNaN, 0.0, kNaN};
}

}  // namespace treadmark::conformance
