// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheel_sections.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/analytic/curve_pieces.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::analytic {
namespace {

// EN 13715:2020, mm. Letters are those of its drawings.
constexpr double kFieldEnd = 60.0;       // where the chamfer of a rim of 135 mm begins
constexpr double kFullThickness = 32.5;  // e for which the coordinates are printed
constexpr double kBackRadius = 20.5, kTipRadius = 12.0, kThroatRadius = 13.0;
constexpr double kDmY = -26.210665, kDmZ = 16.446;  // centre of the throat
constexpr double kD1 = -35.0;                       // where the tread begins
constexpr double kT1 = -0.5;  // thinner flanges: the tread moves with the flange up to here, a line leads on to y = 0

/// EPS between D1 and C1b at y = -26 for e = 28.5, 29 ... 32.5, at equal steps.
const std::array<std::vector<double>, 9>& eps_throats() {
  static const std::array<std::vector<double>, 9> all{{
      {6.867, 6.464, 6.104, 5.78,  5.488, 5.224, 4.985, 4.768, 4.573, 4.398, 4.241, 4.101, 3.978, 3.871,
       3.776, 3.683, 3.592, 3.503, 3.417, 3.332, 3.248, 3.167, 3.088, 3.011, 2.935, 2.862, 2.79},
      {6.867, 6.468, 6.108, 5.784, 5.491, 5.226, 4.986, 4.769, 4.575, 4.4,   4.245, 4.109, 3.99,
       3.884, 3.781, 3.68,  3.582, 3.485, 3.391, 3.299, 3.209, 3.121, 3.035, 2.951, 2.87,  2.79},
      {6.867, 6.469, 6.11,  5.785, 5.49,  5.225, 4.985, 4.769, 4.576, 4.404, 4.252, 4.121, 4.003,
       3.889, 3.777, 3.668, 3.561, 3.456, 3.354, 3.254, 3.157, 3.062, 2.969, 2.878, 2.79},
      {6.867, 6.476, 6.122, 5.802, 5.513, 5.251, 5.016, 4.806, 4.619, 4.454, 4.31,  4.176,
       4.046, 3.918, 3.793, 3.671, 3.552, 3.435, 3.321, 3.209, 3.1,   2.994, 2.891, 2.79},
      {6.867, 6.468, 6.107, 5.78,  5.486, 5.22, 4.983, 4.772, 4.586, 4.424, 4.28, 4.14,
       4.003, 3.868, 3.737, 3.609, 3.483, 3.36, 3.24,  3.124, 3.01,  2.898, 2.79},
      {6.867, 6.467, 6.105, 5.778, 5.484, 5.221, 4.987, 4.781, 4.602, 4.442, 4.286,
       4.134, 3.985, 3.84,  3.697, 3.558, 3.422, 3.289, 3.16,  3.033, 2.91,  2.79},
      {6.867, 6.466, 6.104, 5.778, 5.486, 5.227, 4.998, 4.799, 4.622, 4.449, 4.281,
       4.116, 3.954, 3.796, 3.642, 3.491, 3.344, 3.2,   3.06,  2.923, 2.79},
      {6.867, 6.466, 6.104, 5.781, 5.493, 5.239, 5.018, 4.822, 4.631, 4.444,
       4.26,  4.081, 3.906, 3.735, 3.567, 3.404, 3.245, 3.089, 2.938, 2.79},
      {6.867, 6.466, 6.108, 5.788, 5.507, 5.262, 5.044, 4.832, 4.624, 4.421, 4.222, 4.028, 3.838, 3.652, 3.471, 3.295,
       3.122, 2.954, 2.79},
  }};
  return all;
}

/// Pieces of cubics through points at equal steps, C2, with natural ends.
void append_spline(GraphCurve& curve, double from, double to, const std::vector<double>& z) {
  const std::size_t n = z.size();
  const double h = (to - from) / static_cast<double>(n - 1);
  std::vector<double> second(n, 0.0), weight(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {  // Thomas' algorithm for M[i-1] + 4 M[i] + M[i+1] = 6 d2z/h^2
    const double pivot = 4.0 - weight[i - 1];
    weight[i] = 1.0 / pivot;
    second[i] = (6.0 * (z[i + 1] - 2.0 * z[i] + z[i - 1]) / (h * h) - second[i - 1]) / pivot;
  }
  for (std::size_t i = n - 2; i > 0; --i) second[i] -= weight[i] * second[i + 1];
  for (std::size_t i = 0; i + 1 < n; ++i) {
    // about the middle of the interval, t in [-1, 1]
    const double m0 = second[i] * h * h / 8.0, m1 = second[i + 1] * h * h / 8.0;
    PolynomialGraph p;
    p.x_min = (from + h * static_cast<double>(i)) * kPieceMm;
    p.x_max = i + 2 == n ? to * kPieceMm : (from + h * static_cast<double>(i + 1)) * kPieceMm;
    p.middle = 0.5 * (p.x_min + p.x_max);
    p.half = 0.5 * (p.x_max - p.x_min);
    p.c[3] = (m1 - m0) / 6.0;
    p.c[2] = (m0 + m1) / 2.0;
    p.c[1] = 0.5 * (z[i + 1] - z[i]) - p.c[3];
    p.c[0] = 0.5 * (z[i] + z[i + 1]) - p.c[2];
    for (double& c : p.c) c *= kPieceMm;
    curve.append(p);
  }
}

/// From the flange back to D1. moved: by how much the flange is thinner.
void append_flange(GraphCurve& curve, double height, double moved) {
  const double up = height - 28.0;
  const double back_z = 9.519259302 + up, tip_z = 16.0 + up;
  const double tip_in = -55.0, tip_out = -55.0 - moved;  // centres of the two arcs of the tip
  const double face_radius = 20.0 + 0.75 * up;
  // The face is a line at 70 degrees tangent to the throat, E1 its lower end.
  const double angle = 70.0 * std::numbers::pi / 180.0, sine = std::sin(angle), cosine = std::cos(angle);
  const double dm_y = kDmY - moved, e1_y = dm_y - kThroatRadius * sine, e1_z = kDmZ - kThroatRadius * cosine;
  // The centre Fm of the face's arc lies off the line by its radius, and off the tip's centre by the difference of
  // radii.
  const double base_y = e1_y - face_radius * sine, base_z = e1_z - face_radius * cosine;
  const double a_y = base_y - tip_out, a_z = base_z - tip_z;  // Fm = base + t (-cosine, sine)
  const double half_b = -a_y * cosine + a_z * sine;
  const double difference = face_radius - kTipRadius;
  const double t = -half_b - std::sqrt(half_b * half_b - (a_y * a_y + a_z * a_z - difference * difference));
  const double fm_y = base_y - t * cosine, fm_z = base_z + t * sine;
  const double f1_y = e1_y - t * cosine;
  const double g1_y = fm_y + (tip_out - fm_y) * face_radius / difference;
  const double h1_y = -49.5 + (tip_in + 49.5) * kBackRadius / (kBackRadius - kTipRadius);
  const double s_y = 0.5 * (tip_in + tip_out);
  curve.append(circle_mm(-70.0, h1_y, -49.5, back_z, kBackRadius, +1, h1_y));
  curve.append(circle_mm(h1_y, s_y, tip_in, tip_z, kTipRadius, +1, tip_in));
  curve.append(circle_mm(s_y, g1_y, tip_out, tip_z, kTipRadius, +1, tip_out));
  curve.append(circle_mm(g1_y, f1_y, fm_y, fm_z, face_radius, +1, g1_y));
  curve.append(line_mm(f1_y, e1_y, e1_z + e1_y * sine / cosine, -sine / cosine));
  curve.append(circle_mm(e1_y, kD1 - moved, dm_y, kDmZ, kThroatRadius, -1, kD1 - moved));
}

/// The line from T1, moved, to the tape circle.
void append_gap(GraphCurve& curve, double moved, double z) {
  curve.append(line_mm(kT1 - moved, 0.0, 0.0, z / (kT1 - moved)));
}

void append_field_side(GraphCurve& curve, double from, double z, double slope) {
  curve.append(line_mm(from, kFieldEnd, z + slope * from, -slope));
}

/// The polynomials of S1002, moved in y.
PolynomialGraph moved_powers(double from, double to, std::span<const double> c, double moved) {
  PolynomialGraph p = powers_mm(from, to, {c.begin(), c.end()});
  p.x_min = (from - moved) * kPieceMm;
  p.x_max = (to - moved) * kPieceMm;
  p.middle -= moved * kPieceMm;
  return p;
}

void append_s1002(GraphCurve& curve, double moved, double slope) {
  constexpr double kB = 32.15796;
  const auto throat = s1002_throat_powers();
  const auto tread = s1002_tread_powers();
  curve.append(moved_powers(kD1, -26.0, throat, moved));
  if (moved == 0.0) {
    curve.append(moved_powers(-26.0, kB, tread, 0.0));
  } else {
    const PolynomialGraph before = moved_powers(-26.0, kT1, tread, moved);
    curve.append(before);
    append_gap(curve, moved, before.jet(before.x_max).h / kPieceMm);
    curve.append(moved_powers(0.0, kB, tread, 0.0));
  }
  append_field_side(curve, kB, curve.end_height() / kPieceMm, slope);
}

void append_cone_40(GraphCurve& curve, double moved, double slope) {
  // The arc of 36 mm touches the cone below and the throat: its centre lies 36 off the cone, 23 off Dm.
  constexpr double kRadius = 36.0, kCone = 1.0 / 40.0, kB1 = 35.0;
  const double length = std::hypot(1.0, kCone), apart = kRadius - kThroatRadius;
  // on the line z = kRadius * length - kCone y
  const double z0 = kRadius * length - kDmZ;
  const double a = 1.0 + kCone * kCone, half_b = -kDmY - kCone * z0, c = kDmY * kDmY + z0 * z0 - apart * apart;
  const double jm_y = (-half_b + std::sqrt(half_b * half_b - a * c)) / a, jm_z = kRadius * length - kCone * jm_y;
  const double d1a_y = kDmY + (kDmY - jm_y) * kThroatRadius / apart, c11a_y = jm_y - kRadius * kCone / length;
  curve.append(circle_mm(kD1 - moved, d1a_y - moved, kDmY - moved, kDmZ, kThroatRadius, -1, kD1 - moved));
  curve.append(circle_mm(d1a_y - moved, c11a_y - moved, jm_y - moved, jm_z, kRadius, -1, d1a_y - moved));
  if (moved == 0.0) {
    curve.append(line_mm(c11a_y, kB1, 0.0, -kCone));
  } else {
    curve.append(line_mm(c11a_y - moved, kT1 - moved, -kCone * moved, -kCone));
    append_gap(curve, moved, -kCone * kT1);
    curve.append(line_mm(0.0, kB1, 0.0, -kCone));
  }
  append_field_side(curve, kB1, -kCone * kB1, slope);
}

void append_eps(GraphCurve& curve, double thickness, double slope) {
  constexpr double kC1b = -26.0, kC11b = -17.587, kC12 = 19.0, kB1b = 29.0, kLevel = -0.547;
  const auto& throat = eps_throats().at(to_whole<std::size_t>(std::round(2.0 * (thickness - 28.5))));
  append_spline(curve, kD1 - (kFullThickness - thickness), kC1b, throat);
  curve.append(circle_mm(kC1b, kC11b, -6.5, 100.871, 100.0, -1, kC11b));
  curve.append(circle_mm(kC11b, kC12, 19.0, 329.453, 330.0, -1, kC12));
  curve.append(line_mm(kC12, kB1b, kLevel, 0.0));
  append_field_side(curve, kB1b, kLevel, slope);
}

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

void check_range(double value, double low, double high, std::string_view what) {
  if (value >= low && value <= high) return;
  throw Error(ErrorKind::configuration,
              fmt::format("wheels of EN 13715 have {} from {:g} to {:g}, not {:g}", what, low, high, value));
}

}  // namespace

std::optional<WheelSection> wheel_section(std::string_view name) {
  using Tread = WheelSection::Tread;
  constexpr std::pair<std::string_view, Tread> kTreads[] = {
      {"S1002", Tread::s1002}, {"1:40", Tread::cone_40}, {"1/40", Tread::cone_40}, {"EPS", Tread::eps}};
  constexpr std::string_view kBefore = "EN13715";
  if (name.starts_with(kBefore)) name.remove_prefix(kBefore.size());
  for (const auto& [word, tread] : kTreads) {
    if (!name.starts_with(word)) continue;
    std::string_view rest = name.substr(word.size());
    WheelSection section;
    section.tread = tread;
    while (!rest.empty()) {
      if (rest.front() != '/') return std::nullopt;
      rest.remove_prefix(1);
      std::string_view part = rest.substr(0, rest.find('/'));
      rest.remove_prefix(part.size());
      const bool slope = part.ends_with('%');
      if (part.empty() || (!slope && part.front() != 'H' && part.front() != 'E')) return std::nullopt;
      const auto value = number(slope ? part.substr(0, part.size() - 1) : part.substr(1));
      if (!value) return std::nullopt;
      if (slope) {
        check_range(*value, 6.6, 15.0, "reverse slopes in per cent");
        constexpr double kRounded = 6.7;  // 1:15 is written so
        section.reverse_slope = *value == kRounded ? 0.0 : *value;
      } else if (part.front() == 'H') {
        check_range(*value, 28.0, 32.0, "flange heights in mm");
        section.flange_height = *value;
      } else {
        check_range(*value, 28.5, kFullThickness, "flange thicknesses in mm");
        if (2.0 * *value != std::round(2.0 * *value))
          throw Error(ErrorKind::configuration,
                      fmt::format("wheels of EN 13715 have flange thicknesses in steps of 0.5 mm, not {:g}", *value));
        section.flange_thickness = *value;
      }
    }
    return section;
  }
  return std::nullopt;
}

GraphCurve wheel_curve(const WheelSection& section) {
  const double moved = kFullThickness - section.flange_thickness;
  const double slope = section.reverse_slope > 0.0 ? section.reverse_slope / 100.0 : 1.0 / 15.0;
  GraphCurve curve;
  append_flange(curve, section.flange_height, moved);
  if (section.tread == WheelSection::Tread::s1002) append_s1002(curve, moved, slope);
  if (section.tread == WheelSection::Tread::cone_40) append_cone_40(curve, moved, slope);
  if (section.tread == WheelSection::Tread::eps) append_eps(curve, section.flange_thickness, slope);
  return curve;
}

GraphCurve cone_curve(double slope) {
  GraphCurve curve;
  curve.append(line_mm(-kFieldEnd, kFieldEnd, 0.0, -slope));
  return curve;
}

GraphCurve hollow_curve(double radius_mm) {
  constexpr double kHalfWidth = 30.0;
  GraphCurve curve;
  curve.append(circle_mm(-kHalfWidth, kHalfWidth, 0.0, radius_mm, radius_mm, -1, 0.0));
  return curve;
}

}  // namespace treadmark::analytic
