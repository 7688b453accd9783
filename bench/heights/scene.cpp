// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/heights/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "treadmark/backends/create.hpp"

namespace treadmark::bench {
namespace {

// bilinear and flat representations at 1 mm differ most
constexpr double kMayDiffer = 8e-6;  // [m]

SurfaceSpec wheel_spec() {
  SurfaceSpec spec{Body::wheel, 0.49, StandardProfile{"S1002"}, {}};
  WheelFlat flat;
  flat.length = 0.16;
  flat.depth = 1.4e-3;
  flat.y_center = 6e-3;
  flat.width = 0.06;
  spec.defects.flats = {flat};
  return spec;
}

SurfaceSpec rail_spec() {
  SurfaceSpec spec{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  Squat squat;
  squat.length = 0.04;
  squat.width = 0.03;
  squat.depth = 0.5e-3;
  spec.defects.squats = {squat};
  return spec;
}

double worst(const Surface& a, const Surface& b, const Pose& plane, const Grid2& grid) {
  std::vector<double> za(grid.size()), zb(grid.size());
  a.heights({plane, grid}, {za, {}, {}});
  b.heights({plane, grid}, {zb, {}, {}});
  double largest = 0.0;
  for (std::size_t i = 0; i < za.size(); ++i) {
    const double difference = std::fabs(za[i] - zb[i]);
    largest = std::isnan(za[i]) != std::isnan(zb[i]) ? INFINITY : std::max(largest, std::isnan(difference) ? 0.0 : difference);
  }
  return largest;
}

std::vector<Subject> build() {
  std::vector<Subject> all;
  for (const Body body : {Body::wheel, Body::rail}) {
    const bool wheel = body == Body::wheel;
    const NaturalSurface natural = create_natural(wheel ? wheel_spec() : rail_spec());
    Region region;
    region.u_min = wheel ? -0.12 : -0.06;
    region.u_max = -region.u_min;
    const Vec3 origin(0.0, 0.002, wheel ? 0.49 : 0.0);
    const Pose level{origin, Mat3::Identity()}, tilted{origin, rotation({0.05, 0.03, 0.02})};
    const Grid2 grid{-0.01, -0.0075, 1e-4, 1e-4, 200, 150};
    for (const auto backend : backend_names())
      for (const double resolution : {1e-3, 0.25e-3}) {
        if (backend == "analytic" && resolution != 1e-3) continue;
        Representation wanted{std::string(backend), resolution, region};
        Subject s{std::string(wheel ? "wheel/" : "rail/") + std::string(backend), represent(natural, wanted).surface, level, tilted, grid};
        if (backend != "analytic") s.name += resolution == 1e-3 ? "/1mm" : "/0.25mm";
        const double difference = std::max(worst(*natural.surface, *s.surface, level, grid), worst(*natural.surface, *s.surface, tilted, grid));
        if (!(difference < kMayDiffer)) {
          std::fprintf(stderr, "%s differs from the analytic surface by %g m\n", s.name.c_str(), difference);
          std::exit(1);
        }
        std::fprintf(stderr, "%-28s agrees within %8.3g um, %8.3g MB\n", s.name.c_str(), 1e6 * difference,
                     1e-6 * static_cast<double>(s.surface->memory_bytes()));
        all.push_back(std::move(s));
      }
  }
  return all;
}

}  // namespace

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = build();
  return all;
}

}  // namespace treadmark::bench
