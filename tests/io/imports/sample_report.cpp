// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/io/imports/sample_report.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "treadmark/core/constants.hpp"

namespace treadmark::testing {
namespace {

constexpr double kRadius = 0.46, kWidth = 0.14;
constexpr double kNoise = 35e-6;

/// Numbers between 0 and 1 (Knuth's multiplier), and normal ones from twelve of them.
class Random {
 public:
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) / 9007199254740992.0;
  }
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += next();
    return sum;
  }

 private:
  std::uint64_t state_ = 1;
};

/// Tread 1:20, a flange 28 mm high; y from the field side to the flange, z = r - R.
Vec2 wheel_section(double part) {
  const double y = 0.060 - 0.130 * part;
  const double flange = 0.028 * std::exp(-std::pow((y + 0.056) / 0.0115, 4.0));
  const double chamfer = y > 0.055 ? -(y - 0.055) : 0.0;
  return {y, -y / 20.0 + flange + chamfer};
}

io::BandMap make_map(std::size_t rows, std::size_t columns, double a_max, double s_max,
                     const std::function<double(double a, double s)>& value) {
  io::BandMap map{rows, columns, 0.0, a_max, 0.0, s_max, {}};
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < columns; ++k)
      map.value.push_back(
          static_cast<float>(value((static_cast<double>(i) + 0.5) * a_max / static_cast<double>(rows),
                                   (static_cast<double>(k) + 0.5) * s_max / static_cast<double>(columns))));
  return map;
}

bool in_hole(double a, double s) { return std::hypot(a - 1.9, s - 0.05) < 0.009; }

double deviation(double a, double s) {
  if (in_hole(a, s)) return std::numeric_limits<double>::quiet_NaN();
  const double flat = std::hypot((a - 1.2) / 0.04, (s - 0.06) / 0.022), pit = std::hypot(a - 2.3, s - 0.075) / 0.006;
  const double seam = std::hypot(a - 2.0 * kPi * kRadius + 0.004, s - 0.04) / 0.010;
  double depth = 25e-6 * std::sin(3.0 * a / kRadius);
  if (flat < 1.0) depth -= 0.85e-3 * (1.0 - flat * flat);
  if (pit < 1.0) depth -= 0.4e-3 * (1.0 - pit * pit);
  if (seam < 1.0) depth += 0.3e-3 * (1.0 - seam * seam);
  return depth;
}

void add_pictures(io::ImportReport& report) {
  Random random;
  for (int i = 0; i <= 300; ++i) {
    Vec2 p = wheel_section(i / 300.0);
    report.nominal_section.push_back(p);
    p.y() -= 0.4e-3 * std::exp(-std::pow((p.x() - 0.005) / 0.02, 2.0));  // worn
    report.section.push_back(p);
  }
  for (int i = 0; i < 6000; ++i) {
    Vec2 p = report.section[static_cast<std::size_t>(300.0 * random.next())];
    p += Vec2(2e-4 * random.normal(), 1e-4 * random.normal());
    if (i % 40 == 0) p += Vec2(5e-3 * random.normal(), 8e-3 * random.normal());
    if (i % 300 == 0) p += Vec2(0.1, 0.3);
    report.raw_section.push_back(p);
    if (i % 40 == 0) report.removed_section.push_back(p);
  }
  const double a_max = 2.0 * kPi * kRadius;
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  report.density = make_map(1445, 70, a_max, kWidth, [&](double a, double s) {
    return in_hole(a, s) ? nan
                         : 4e6 * (1.0 + 0.3 * std::sin(8.0 * a)) * (s > 0.1 ? 0.4 : 1.0) * (0.8 + 0.4 * random.next());
  });
  report.removed_map = make_map(1445, 70, a_max, kWidth, [&](double a, double s) {
    if (in_hole(a, s)) return nan;
    return std::hypot(a - 0.6, s - 0.03) < 0.02 ? 2e6 * random.next() : random.next() < 0.02 ? 0.25e6 : 0.0;
  });
  report.fitted = make_map(2890, 140, a_max, kWidth, deviation);
  report.residual = make_map(1445, 70, a_max, kWidth,
                             [&](double a, double s) { return in_hole(a, s) ? nan : 0.5 * kNoise * random.normal(); });
  report.noise_map = make_map(290, 28, a_max, kWidth, [&](double a, double s) {
    return in_hole(a, s) ? nan
                         : kNoise * (1.0 + 0.2 * std::cos(2.0 * a) + (s > 0.1 ? 0.6 : 0.0) + 0.1 * random.normal());
  });
  report.residual_range = 4.0 * kNoise;
  report.residual_histogram.assign(80, 0);
  for (int i = 0; i < 200000; ++i) {
    const double x = (i % 20 == 0 ? 1.8 : 1.0) * kNoise * random.normal() / report.residual_range;
    if (std::abs(x) < 1.0) ++report.residual_histogram[static_cast<std::size_t>((x + 1.0) * 40.0)];
  }
  report.residuals = {{0.1e-6, 36e-6, 190e-6, 71e-6, 105e-6}, 31, 42};
  report.truth_map = make_map(722, 70, a_max, kWidth, [&](double a, double s) {
    return in_hole(a, s) ? nan : 2e-6 * std::sin(20.0 * a) * std::sin(60.0 * s);
  });
  for (int i = 0; i < 900; ++i) {
    const double theta = 2.0 * kPi * random.next(), y = 0.1 * random.next() - 0.05;
    const bool removed = i >= 800;
    const double r = kRadius + (removed ? 8e-3 * random.normal() : 0.0);
    report.cloud.x.push_back(static_cast<float>(r * std::sin(theta)));
    report.cloud.y.push_back(static_cast<float>(y));
    report.cloud.z.push_back(static_cast<float>(r * std::cos(theta)));
    report.cloud.residual.push_back(static_cast<float>(removed ? nan : kNoise * random.normal()));
    report.cloud.distance.push_back(static_cast<float>(removed ? nan : deviation(kRadius * theta, y + 0.05)));
    report.cloud.tilt.push_back(static_cast<float>(removed ? nan : 0.05));
  }
  report.cloud.all = 1600000;
  report.cloud.removed = 29000;
  report.cloud.far = 17;
}

}  // namespace

io::ImportReport sample_report() {
  io::ImportReport report;
  report.version = "1.2.3";
  report.body = Body::wheel;
  report.inputs = {{"wheel left.ply", std::string(64, 'a'), "PLY (binary)", 1500000, 3},
                   {"wheel <b>& \"second\".xyz", std::string(64, 'b'), "columns of text", 100000, 0}};
  report.unit = "mm";
  report.unit_from = "the size of the wheel";
  report.points_read = 1600000;
  report.points_used = 1571000;
  report.removed = {{"not finite", 3, "coordinates that are no numbers"},
                    {"far from the band", 17200, "farther than 25 mm from the section or beyond its ends"},
                    {"stray points", 9100,
                     "farther than 4.5 standard deviations (0.157 mm) from a quadratic through their 24 neighbours"},
                    {"stray clusters", 2200, "fewer than 200 points, farther than 3 mm from all others"},
                    {"edges of shadows", 497, "within 0.4 mm of a hole whose rim is bent"},
                    {"thinned", 0, "closer than 0.05 mm to another"}};
  report.warnings = {"2.1 % of the band has no points: the largest hole (18 mm) stays open",
                     "the scan overlaps itself by 12 degrees with a step of 0.02 mm at the seam"};
  report.nominal = "S1002 <t32.5>";
  report.X_CS.origin = Vec3(1.25, -0.75, 0.5);
  report.X_CS.rotation = rotation({0.1, 0.3, -0.2});
  report.nominal_radius = kRadius;
  report.axis_position_error = 1.2e-6;
  report.axis_direction_error = 4.5e-6;
  report.scatter = 42e-6;
  report.undamaged = 0.93;
  report.match_residual = 61e-6;
  report.match_agreeing = 0.81;
  report.zero = "the deepest place of the largest damage";
  report.passes = {{1, 800000, Vec3(1e-5, 0.0, -2e-5), Vec3(0.0, 1e-4, 0.0)}, {2, 800000, Vec3::Zero(), Vec3::Zero()}};
  report.truth = io::ImportReport::Truth{"truth.json",
                                         "wheel.slcw",
                                         true,
                                         400000,
                                         120,
                                         {-1.5e-6, 4e-6, 21e-6, 8e-6, 11e-6},
                                         {0.1e-6, 2e-6, 19e-6, 4e-6, 6e-6},
                                         0.25,
                                         false,
                                         Vec3(1e-6, -2e-6, 3e-6),
                                         Vec3(0.0, 5e-6, -6e-6)};
  report.pass_before = 1.1e-4;
  report.pass_after = 2.2e-5;
  report.spacing = 0.5e-3;
  report.gap_a = 0.6e-3;
  report.gap_s = 0.4e-3;
  report.noise = kNoise;
  report.area = 0.4046;
  report.hole_area = 0.0085;
  report.hole_limit = 5e-3;
  report.holes = {{1.9 / kRadius, 0.0136, 18e-3, 2.5e-4, false, 0.05}, {0.4, 0.02, 3e-3, 7e-6, true}};
  report.levels = {{16e-3, 8e-3, 4000, 3100, 12}, {2e-3, 2e-3, 101000, 87000, 31}};
  report.fitted_points = 1413900;
  report.held_out_points = 157100;
  report.residual_rms = 36e-6;
  report.residual_max = 190e-6;
  report.held_out_rms = 36.5e-6;
  report.held_out_error = 6e-6;
  report.errors = ErrorSize{3e-6, 17e-6};
  report.error_parts = {{"lateral placement", 0.12e-3, -4e-6, 0.3e-3, 0.0, 0.0},
                        {"smoothing", 0.0, 0.0, 0.0, 2.5e-6, 4e-3}};
  report.damage = {{1.2 / kRadius, 0.0042, 0.08, 0.044, 0.85e-3, 1.17e-6, 0.06},
                   {2.3 / kRadius, -0.0097, 0.012, 0.012, 0.4e-3, 2.3e-8, 0.075},
                   {2.0 * kPi - 0.004 / kRadius, 0.0229, 0.02, 0.02, -0.3e-3, -4.7e-8, 0.04}};
  report.damage_threshold = 0.1e-3;
  report.y_min = -0.07;
  report.y_max = 0.06;
  report.u_max = 2.0 * kPi;
  report.closed = true;
  report.outputs = {
      {"wheel.slices", "slices", std::string(64, 'c'), 1234567, "412 slices of 301 points", 3.1e-6, 0.4e-6},
      {"wheel.stl", "triangles", std::string(64, 'd'), 23456789, "469 134 triangles", 5.2e-6, 1.1e-6}};
  report.steps = {{"read", 1.5}, {"place", 2.25}, {"read", 0.25}};
  report.settings_toml = "[scan]\nunit = \"mm\"\n";
  add_pictures(report);
  return report;
}

io::ImportReport sample_map_report() {
  io::ImportReport report;
  report.version = "1.2.3";
  report.body = Body::rail;
  report.from_map = true;
  report.inputs = {{"rail.asc", std::string(64, 'e'), "ESRI grid", 0, 0}};
  report.unit = "um";
  report.unit_from = "given";
  report.nominal = "none";
  report.fitted_points = 2000;
  report.u_max = 0.6;
  report.y_min = -0.036;
  report.y_max = 0.036;
  for (int i = 0; i <= 60; ++i) report.section.push_back({-0.036 + 0.0012 * i, 0.012 * std::pow(i / 30.0 - 1.0, 4.0)});
  report.fitted =
      make_map(300, 40, 0.6, 0.076, [](double a, double s) { return -5e-5 * std::sin(40.0 * a) * std::cos(30.0 * s); });
  return report;
}

}  // namespace treadmark::testing
