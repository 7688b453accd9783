// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/placement/band_frame.hpp"
#include "treadmark/scans/placement/circle_axis.hpp"
#include "treadmark/scans/placement/even_sample.hpp"

namespace treadmark::scans {
namespace {

constexpr double kSurelyFlat = 0.8;
constexpr double kWideArc = 2.0;  // [rad]
constexpr double kDatum = 70e-3;  // of the tread from the back of the flange (EN 13715) [m]
constexpr std::size_t kMostUsed = 120'000;

struct Limits {
  double least, most;
};
Limits limits(Body body) { return body == Body::wheel ? Limits{0.15, 0.75} : Limits{0.03, 0.22}; }
const char* size_name(Body body) { return body == Body::wheel ? "radius" : "width of the section"; }

double part_of(std::vector<double>& values, double part) {
  const auto at = values.begin() + to_whole<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Vec3 any_perpendicular(const Vec3& direction) {
  return direction.cross(std::fabs(direction.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
}

Pose frame_of(Body body, const Vec3& origin, const Vec3& along, const Vec3& out) {
  Pose pose;
  pose.origin = origin;
  const Vec3 z = body == Body::rail ? -out : out;
  if (body == Body::rail)
    pose.rotation << along, z.cross(along), z;  // x along, z into the rail, y = z x x
  else
    pose.rotation << along.cross(z), along, z;  // y along the axle, x = y x z
  return pose;
}

/// Out of the head: the normals that point away from the middle of the section, summed; they cancel on both sides.
Vec3 outwards(const RoughPlace& roughly) {
  const Vec3 along = roughly.rough.axis.direction;
  Vec3 middle = Vec3::Zero(), sum = Vec3::Zero();
  for (const Vec3& p : roughly.elements.position) middle += p;
  middle /= static_cast<double>(roughly.elements.position.size());
  for (std::size_t i = 0; i < roughly.elements.position.size(); ++i) {
    const Vec3& n = roughly.elements.normal[i];
    const double away = n.dot(roughly.elements.position[i] - middle);
    sum += (away < 0.0 ? -1.0 : 1.0) * n * std::fabs(away);
  }
  sum -= along * along.dot(sum);
  return sum.norm() > 0.0 ? sum.normalized() : any_perpendicular(along);
}

/// Turns the frame round its z axis by half a turn.
Pose turned(const Pose& X_CS) {
  return X_CS * Pose{Vec3::Zero(), Mat3(Eigen::DiagonalMatrix<double, 3>(-1.0, -1.0, 1.0))};
}

/// Angle about an axle that most of the points take up, on either side of where they are on average.
double arc_of(std::span<const Vec3> points, const Axis& axle) {
  const Vec3 e1 = any_perpendicular(axle.direction), e2 = axle.direction.cross(e1);
  std::vector<double> u;
  Vec2 mean = Vec2::Zero();
  for (const Vec3& p : points) {
    u.push_back(std::atan2((p - axle.point).dot(e1), (p - axle.point).dot(e2)));
    mean += Vec2(std::sin(u.back()), std::cos(u.back()));
  }
  const double middle = std::atan2(mean.x(), mean.y());
  for (double& angle : u) angle = wrap_angle(angle - middle);
  const double high = part_of(u, 0.99);
  return high - part_of(u, 0.01);
}

/// By normals or by circles, whichever gathers the radii better. Normals alone decide where they are many and turn by
/// most of a turn.
RoughAxis revolution(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                     const SurfaceElements& elements) {
  std::optional<RoughAxis> normals;
  std::optional<Error> why;
  try {
    require_surface(elements);
    normals = rough_revolution(elements);
  } catch (const Error& error) {
    why = error;
  }
  if (normals && elements.flat_part > kSurelyFlat && arc_of(elements.position, normals->axis) > kWideArc)
    return *normals;
  const std::optional<RoughAxis> circles = circle_axis(points, keep, elements);
  if (!normals && !circles) throw Error(*why);
  if (!circles) return *normals;
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 100'000)
    if (keep.empty() || keep[i] != 0) kept.push_back(points[i]);
  const bool better = normals && radius_scatter(kept, normals->axis, elements.radius) <
                                     radius_scatter(kept, circles->axis, elements.radius);
  return better ? *normals : *circles;
}

/// Standard error of the radius of a refined wheel at a place y of its section.
double radius_error(const RefinedAxis& refined, double y) {
  const Eigen::RowVector4d h = refined.section_moves.row(0) + y * refined.section_moves.row(1);
  return std::sqrt(std::max(0.0, (h * refined.covariance * h.transpose()).value()));
}

struct Reference {
  Vec2 shift;  ///< added to (y, v) of the measured section
};

/// Without a nominal profile. Wheel: y = 0 is kDatum from the back of the flange and has the
/// nominal radius. Rail: the highest point has z = 0; y = 0 is the middle of the head 14 mm below it, or of what was
/// scanned.
Reference own_reference(const Section& section, Body body) {
  if (body == Body::wheel) {
    const double y = std::clamp(section.y_min() + kDatum, section.y_min(), section.y_max());
    return {{-(section.y_min() + kDatum), -section.v_at(y)}};
  }
  constexpr double kBelow = 14e-3, kStep = 0.1e-3;
  double top = -1e300;
  for (double s = 0.0; s <= section.length(); s += kStep) top = std::max(top, section.at(s).position.y());
  double left = section.y_max(), right = section.y_min();
  for (double s = 0.0; s <= section.length(); s += kStep) {
    const Vec2 p = section.at(s).position;
    if (p.y() < top - kBelow) continue;
    left = std::min(left, p.x());
    right = std::max(right, p.x());
  }
  return {{-0.5 * (left + right), -top}};
}

/// From the back of a wheel's flange, where that was scanned, over the tip to the field side: points (y, v) of all
/// stations and the part of their section that is not too steep to be seen from outside.
measured::SectionPoints with_back(const Section& section, std::span<const Vec2> points, double radius) {
  constexpr double kNodes = 0.5e-3, kStrip = 0.5e-3;
  constexpr std::size_t kStrips = 100, kFewest = 3;
  std::vector<Vec2> nodes;
  for (double s = 0.0; s < section.length(); s += kNodes) nodes.push_back(section.at(s).position);
  const auto tip = ranges::max_element(nodes, {}, [](const Vec2& p) { return p.y(); });
  std::array<std::vector<double>, kStrips> strips;
  for (const Vec2& p : points)
    if (const double below = tip->y() - p.y(); p.x() < tip->x() && below >= 0.0 && below < kStrip * kStrips)
      strips[to_whole<std::size_t>(below / kStrip)].push_back(p.x());
  measured::SectionPoints out{Body::wheel, {}, {}};
  const auto add = [&](double y, double v) { out.y.push_back(y), out.z.push_back(v - radius); };
  for (std::size_t k = kStrips; k-- > 0;)
    if (strips[k].size() >= kFewest) add(median_of(strips[k]), tip->y() - kStrip * (static_cast<double>(k) + 0.5));
  for (auto p = tip; p != nodes.end(); ++p) add(p->x(), p->y());
  return out;
}

/// Where y = 0 lies on a wheel is measured where its flange is, over the tip or on its back; its face wears.
std::optional<measured::Doubt> missing_flange(const measured::WheelMarks& marks, bool nominal) {
  if (marks.back_y || marks.tip_seen || marks.second_flange) return std::nullopt;
  return measured::Doubt{
      "no_flange",
      fmt::format("{} scanned: y = 0 was put {}; scan the flange over its tip, or its back",
                  marks.tip_y ? "only the face of the flange was" : "the flange was not",
                  nominal ? "where what was fits the nominal profile best, millimetres off where that is worn"
                          : "70 mm from where the section begins, as if its back were there")};
}

/// Sides tell where y = 0 lies on a rail, and how it is rolled: one of them if it is compared with a nominal section,
/// else both. points: (y, v) as it was placed.
std::optional<measured::Doubt> missing_sides(std::span<const Vec2> points, bool nominal) {
  constexpr double kDeep = 5e-3, kTop = 0.999, kLowest = 0.01;  // but for strays
  std::vector<double> heights;
  for (const Vec2& p : points) heights.push_back(p.y());
  const double top = part_of(heights, kTop);
  std::array<std::vector<double>, 2> below;
  for (const Vec2& p : points) below[p.x() < 0.0 ? 0 : 1].push_back(top - p.y());
  std::size_t deep = 0;
  for (std::vector<double>& side : below) deep += !side.empty() && part_of(side, 1.0 - kLowest) >= kDeep ? 1 : 0;
  if (deep >= (nominal ? 1u : 2u)) return std::nullopt;
  return measured::Doubt{
      "no_sides",
      fmt::format("{} of the head was scanned as far as {:g} mm below its top: where y = 0 lies and how the "
                  "rail is rolled follow from its top, which wears; scan its field side, too",
                  nominal || deep == 0 ? "neither side" : "only one side", kMilli * kDeep)};
}

/// Of a rail, as it was matched: errors of roll and height that go with one across belong to it.
std::vector<SurfaceErrors::Motion> errors_of_match(const Mat3& covariance) {
  // z points down; roots in this order
  const Mat3 order{{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}};
  Mat3 rest = order * covariance * order.transpose();
  std::vector<SurfaceErrors::Motion> out;
  for (const auto& [source, k] :
       {std::pair{ErrorSource::lateral, 0}, std::pair{ErrorSource::tilt, 1}, std::pair{ErrorSource::height, 2}}) {
    if (!(rest(k, k) > 0.0)) continue;
    const Vec3 one = rest.col(k) / std::sqrt(rest(k, k));
    out.push_back({source, one[0], one[2], one[1]});
    rest -= one * one.transpose();
  }
  return out;
}

/// Of a wheel: across, by the match or what tells it otherwise; its axle by the scatter of the points. A lean of the
/// axle turns the section, and moves it across by the radius. The radius follows from the place of the axle: of a short
/// arc both are off by the same.
std::vector<SurfaceErrors::Motion> errors_of_wheel(const Placement& found, double across) {
  constexpr double kOneAxis = 0.5 * std::numbers::sqrt2;  // of two that errors of the axle have
  const double lean = kOneAxis * found.direction_error,
               height = std::max(found.radius_error, kOneAxis * found.position_error);
  std::vector<SurfaceErrors::Motion> out;
  if (across > 0.0) out.push_back({ErrorSource::lateral, across, 0.0, 0.0});
  if (lean > 0.0) out.push_back({ErrorSource::tilt, -found.nominal_radius * lean, 0.0, lean});
  if (height > 0.0) out.push_back({ErrorSource::height, 0.0, height, 0.0});
  return out;
}

}  // namespace

RoughPlace find_roughly(std::span<const Vec3> points, std::span<const std::uint8_t> keep, Body body) {
  RoughPlace out;
  out.elements = look_for_elements(points, keep);
  if (body == Body::rail) {
    require_surface(out.elements);
    out.rough = rough_sweep(out.elements);
  } else {
    out.rough = revolution(points, keep, out.elements);
  }
  const Axis& axis = out.rough.axis;
  std::vector<double> values, other;
  if (body == Body::wheel) {
    // of points, for elements may be few
    for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 100'000)
      if (keep.empty() || keep[i] != 0) values.push_back((points[i] - axis.point).cross(axis.direction).norm());
    out.size = part_of(values, 0.95);
  } else {
    const Vec3 up = outwards(out), side = axis.direction.cross(up);
    for (const Vec3& p : out.elements.position) values.push_back(p.dot(side));
    other = values;
    out.size = part_of(values, 0.99) - part_of(other, 0.01);
  }
  return out;
}

void scale(RoughPlace& roughly, double factor) {
  for (Vec3& p : roughly.elements.position) p *= factor;
  roughly.elements.size *= factor;
  roughly.elements.centre *= factor;
  roughly.elements.radius *= factor;
  roughly.elements.spacing *= factor;
  roughly.rough.axis.point *= factor;
  roughly.size *= factor;
}

LengthUnit unit_by_size(Body body, double size) {
  std::string list;
  // an inch is the last guess: scanners rarely speak it
  for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::metre, LengthUnit::micrometre, LengthUnit::inch}) {
    const double metres = size * metres_per(unit);
    if (metres >= limits(body).least && metres <= limits(body).most) return unit;
    list += fmt::format("{}{:.4g} m in {}", list.empty() ? "" : ", ", metres, symbol(unit));
  }
  throw Error(ErrorKind::input_data,
              fmt::format("the {} found in the scan, {:.6g}, is that of no {} in any unit: {}", size_name(body), size,
                          body == Body::wheel ? "wheel" : "rail", list),
              {}, "is it the right object? say the unit with --unit if it is");
}

void check_unit(Body body, double size, LengthUnit unit) {
  const double metres = size * metres_per(unit);
  if (metres >= limits(body).least && metres <= limits(body).most) return;
  std::string fitting;
  for (const LengthUnit other : kLengthUnits) {
    const double m = size * metres_per(other);
    if (m >= limits(body).least && m <= limits(body).most)
      fitting += fmt::format("{}{}", fitting.empty() ? "" : " or ", symbol(other));
  }
  throw Error(ErrorKind::input_data,
              fmt::format("in {} the {} would be {:.4g} m{}", symbol(unit), size_name(body), metres,
                          metres > limits(body).most ? ", far too large" : ", far too small"),
              {},
              fmt::format("{0}is it a {1} (--body {1})?",
                          fitting.empty() ? "" : fmt::format("with --unit {} it fits; or ", fitting),
                          body == Body::wheel ? "rail" : "wheel"));
}

Eigen::Index nearest_axis(const Vec3& direction) {
  constexpr double kAlike = 0.95;
  Eigen::Index out = 0;
  const double most = direction.cwiseAbs().maxCoeff();
  while (std::fabs(direction[out]) < kAlike * most) ++out;
  return out;
}

Pose first_frame(const RoughPlace& roughly, const PlaceSettings& settings) {
  const Body body = settings.body;
  const bool wheel = body == Body::wheel;
  const Axis& axis = roughly.rough.axis;
  Vec3 along = axis.direction, out = wheel ? any_perpendicular(along) : outwards(roughly);
  if (!wheel && settings.up) out = *settings.up - along * along.dot(*settings.up);
  if (!(out.norm() > 0.1))
    throw Error(ErrorKind::configuration, "the upward direction that was given runs along the rail");
  out.normalize();
  if (settings.forward && along.dot(*settings.forward) < 0.0) along = -along;
  if (!settings.forward && !wheel && along[nearest_axis(along)] < 0.0) along = -along;
  const Vec3 origin = wheel
                          ? Vec3(axis.point + axis.direction * axis.direction.dot(roughly.elements.centre - axis.point))
                          : roughly.elements.centre;
  return frame_of(body, origin, along, out);
}

Placement place(std::span<const Vec3> points, std::span<const std::uint8_t> keep, const RoughPlace& roughly,
                const PlaceSettings& settings) {
  const Body body = settings.body;
  const bool wheel = body == Body::wheel;
  const std::vector<Vec3> used = even_sample(points, keep, roughly.elements.centre, roughly.elements.size, kMostUsed);
  Pose X_CS = first_frame(roughly, settings);

  Placement found;
  RefinedAxis refined;
  Mat3 covariance = Mat3::Zero();  // of the match
  KnownOfSection known;
  known.error.setConstant(kInfinity);
  constexpr double kRadiusKnown = 0.05e-3, kContradicts = 5.0;
  // the radius of the section at its datum, if it does not contradict the one that was given
  const auto know_radius = [&](const Vec2& datum) {
    found.radius_error = radius_error(refined, datum.x());
    if (!settings.radius) return;
    known.y = datum.x();
    known.lacking[0] = *settings.radius - datum.y();
    if (std::fabs(known.lacking[0]) < kContradicts * std::hypot(found.radius_error, kRadiusKnown))
      known.error[0] = kRadiusKnown;
  };
  // the rail's roll changes what its section looks like from outside: placed, then looked at again
  const int rounds = wheel ? 1 : 2;
  for (int round = 0; round < rounds; ++round) {
    refined = refine_axis(used, body, X_CS);
    X_CS = refined.X_CS;
    if (settings.nominal) {
      const auto matched = [&] {
        return match_nominal(refined.fit.section, *settings.nominal, body, settings.forward.has_value(),
                             wheel ? std::vector<Vec2>{} : across(used, body, X_CS));
      };
      SectionMatch match = matched();
      if (match.turn) {
        // a section that agrees with the nominal one tells the direction of the axle where a short arc hardly does
        know_radius(match.turn->datum);
        known.lacking[1] = match.turned ? match.turn->angle : -match.turn->angle;
        known.error[1] = match.turn->error;
        use_known(refined, known, used);
        X_CS = refined.X_CS;
        match = matched();
        found.radius_error = radius_error(refined, match.turn->datum.x());
      }
      if (round + 1 == rounds) covariance = match_covariance(refined.fit.section, *settings.nominal, body, match);
      if (match.turned) X_CS = turned(X_CS);
      Pose to_new;  // from the present frame to the nominal one
      to_new.rotation = wheel ? Mat3::Identity() : rotation_x(match.roll);
      to_new.origin = wheel ? Vec3(0.0, match.shift.x(), 0.0) : Vec3(0.0, match.shift.x(), -match.shift.y());
      X_CS = X_CS * to_new.inverse();
      found.nominal_radius = wheel ? -match.shift.y() : 0.0;
      const bool was_turned = found.match && found.match->turned;
      found.match = match;
      found.match->turned = match.turned != was_turned;
    } else {
      // the flange is the side that reaches farther out
      const Section& seen = refined.fit.section;
      const bool flange_last = wheel && !settings.forward &&
                               seen.at(0.25 * seen.length()).position.y() < seen.at(0.75 * seen.length()).position.y();
      if (wheel) {
        const double y =
            std::clamp(flange_last ? seen.y_max() - kDatum : seen.y_min() + kDatum, seen.y_min(), seen.y_max());
        know_radius({y, seen.v_at(y)});
        use_known(refined, known, used);
        X_CS = refined.X_CS;
        found.radius_error = radius_error(refined, y);
      }
      if (flange_last) {
        X_CS = turned(X_CS);
        const Section& s = refined.fit.section;
        std::vector<Vec2> mirrored;
        for (double at = s.length(); at >= 0.0; at -= 0.5e-3)
          mirrored.emplace_back(-s.at(at).position.x(), s.at(at).position.y());
        refined.fit.section = Section(mirrored);
      }
      const Reference reference = own_reference(refined.fit.section, body);
      X_CS = X_CS *
             Pose{wheel ? Vec3(0.0, -reference.shift.x(), 0.0) : Vec3(0.0, -reference.shift.x(), reference.shift.y()),
                  Mat3::Identity()};
      found.nominal_radius = wheel ? settings.radius.value_or(-reference.shift.y()) : 0.0;
    }
  }
  std::vector<Vec2> section = across(used, body, X_CS);
  std::optional<double> beside_back;  // how far the datum is from where the back of a flange has it
  if (wheel) {
    // a worn flange fits the nominal one best where it is not
    measured::SectionPoints seen = with_back(outline(section), section, found.nominal_radius);
    measured::Understanding understood = measured::understand(seen, {measured::Turn::no, measured::Turn::no});
    found.moved_by_back = understood.shift_y;
    found.doubts = std::move(understood.doubts);
    if (const auto& back = understood.wheel.back_y) beside_back = *back + kDatum;
    if (auto doubt = missing_flange(understood.wheel, settings.nominal.has_value()))
      found.doubts.push_back(*std::move(doubt));
    X_CS = X_CS * Pose{Vec3(0.0, -found.moved_by_back, 0.0), Mat3::Identity()};
    for (Vec2& p : section) p.x() += found.moved_by_back;
  } else if (auto doubt = missing_sides(section, settings.nominal.has_value())) {
    found.doubts.push_back(*std::move(doubt));
  }
  constexpr double kReach = 5e-3, kKnots = 4e-3;
  const SectionFit fit = fit_section(outline(section), section, kReach, kKnots);
  found.X_CS = X_CS;
  found.section = fit.section;
  found.scatter = fit.scale;
  found.undamaged = refined.undamaged;
  found.position_error = refined.position_error;
  found.direction_error = refined.direction_error;
  found.iterations = refined.iterations;
  if (!wheel) {
    found.errors = errors_of_match(covariance);
    return found;
  }
  found.arc = arc_of(used, {X_CS.origin, X_CS.rotation.col(1)});
  constexpr double kMostRadius = 0.5e-3, kMostDirection = 5e-3;
  if (!(found.radius_error < kMostRadius) || !(found.direction_error < kMostDirection))
    throw Error(
        ErrorKind::input_data,
        fmt::format("the scanned arc of {:.0f} degrees is too short to find the axle: it leaves the radius "
                    "uncertain by {:.2g} mm and the direction of the axle by {:.2g} mrad (standard errors)",
                    found.arc * 180.0 / std::numbers::pi, 1e3 * found.radius_error, 1e3 * found.direction_error),
        {}, kKnowMore);
  found.errors = errors_of_wheel(
      found, beside_back ? std::hypot(*beside_back, found.scatter) : std::sqrt(std::max(0.0, covariance(0, 0))));
  return found;
}

}  // namespace treadmark::scans
