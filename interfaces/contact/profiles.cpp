// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/backends/spline/slices/slice_surface.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/roots.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/log.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"

namespace treadmark::contact {
namespace {

constexpr int kGood = 0, kNotFound = 2, kBroken = 3;  // of profiles, as callers ask for them

double radius_for(const Problem& p, Body body) {
  if (body == Body::wheel) return p.given.wheel_rail.wheelset.nominal_radius;
  constexpr int kOnRoller = 4;
  return p.flags[CNTC_ic_config] >= kOnRoller ? p.given.roller_radius.value_or(0.0) : 0.0;
}

/// make(): the surface.
template <class Make>
void take(Problem& p, Body body, std::string name, double radius, Make&& make) {
  GivenProfile& slot = p.profile(body);
  slot = {};
  slot.code = kBroken;
  slot.name = std::move(name);
  auto built = std::make_shared<const NaturalSurface>(make());
  slot.spec = built->spec;
  if (const auto* points = std::get_if<Profile>(&slot.spec->shape)) slot.curve = spline::fit_profile(*points);
  slot.built = std::move(built);
  slot.built_radius = radius;
  slot.code = kGood;
}

io::ProfileOptions options_of(const Problem& p, std::span<const int> ints, std::span<const double> reals) {
  require_finite(reals, "rparam");
  const auto whole = [&](std::size_t i, int otherwise) { return i < ints.size() ? ints[i] : otherwise; };
  const auto real = [&](std::size_t i, double otherwise) { return i < reals.size() ? reals[i] : otherwise; };
  constexpr double kUnitOfElement = 5e-4, kDegree = std::numbers::pi / 180.0, kLeastZigzag = std::numbers::pi / 4.0;
  io::ProfileOptions o;
  o.mirror_y = whole(2, 0) == 1 ? 1 : 0;
  o.placement = io::ProfileOptions::Placement::reference;
  o.mirror_z = std::clamp(whole(3, 0), -1, 1);
  o.error_handling = whole(4, 0);
  o.scale = real(0, 1.0);
  if (o.scale <= kUnitOfElement) o.scale = p.units.length / kMillimetre;
  SmoothingOptions& s = o.smoothing = {};
  s.method = static_cast<SmoothingOptions::Method>(std::clamp(whole(5, 0), 0, 2));
  const bool wavelength = s.method != SmoothingOptions::Method::spline;
  s.strength = std::max(real(1, 0.0), 0.0) * (wavelength ? kMillimetre : kMillimetre * kMillimetre * kMillimetre);
  o.max_omit = real(2, 0.5);
  o.zigzag_threshold = std::max(real(3, 150.0 * kDegree), kLeastZigzag);
  s.kink_high = real(4, 30.0 * kDegree);
  s.kink_low = real(5, s.kink_high / 5.0);
  s.kink_width = reals.size() > 6 ? reals[6] * p.units.length : 2e-3;
  return o;
}

Body body_of_file(const std::filesystem::path& file, std::span<const int> ints) {
  const int type = ints.empty() ? -1 : std::clamp(ints[0], -1, 1);
  if (type >= 0) return type == 1 ? Body::wheel : Body::rail;
  const std::string extension = io::extension_of(file);
  return extension == ".prw" || extension == ".whl" || extension == ".slcw" ? Body::wheel : Body::rail;
}

void give_file(Problem& p, const std::string& name, std::span<const int> ints, std::span<const double> reals) {
  io::GeometryFile file;
  file.file = io::resolve_name(folders().work, name);
  file.options = options_of(p, ints, reals);
  file.open_seam = io::is_slices_file(file.file);  // as .inp files have it
  io::SurfaceSource source;
  const Body body = body_of_file(file.file, ints);
  source.geometry = std::move(file);
  give_profile(p, body, source);
}

void give_points(Problem& p, std::span<const double> values, std::span<const int> ints, std::span<const double> reals) {
  const Body body = ints.empty() || ints[0] >= 1 ? Body::wheel : Body::rail;
  const io::ProfileOptions options = options_of(p, ints, reals);
  const char* name = body == Body::wheel ? "wheel profile of the caller" : "rail profile of the caller";
  const double radius = radius_for(p, body);
  std::string lines;
  take(p, body, name, radius, [&] {
    require_finite(values, "values");
    for (std::size_t i = 0; i + 1 < values.size(); i += 2)
      fmt::format_to(std::back_inserter(lines), "{:.17g} {:.17g}\n", values[i], values[i + 1]);
    SurfaceSpec spec;
    spec.body = body;
    (body == Body::wheel ? spec.nominal_radius : spec.roller_radius) = radius;
    spec.shape = io::parse_profile(lines, name, io::ProfileFormat::two_column, body, options);
    return create_natural(std::move(spec));
  });
  GivenProfile& slot = p.profile(body);
  slot.points = std::move(lines);
  slot.source.geometry = io::GeometryFile{{}, options};
}

}  // namespace

void give_profile(Problem& p, Body body, const io::SurfaceSource& source) {
  const std::filesystem::path file = std::get<io::GeometryFile>(source.geometry).file;
  const double radius = radius_for(p, body);
  take(p, body, file.string(), radius, [&] {
    std::error_code ignored;
    if (!std::filesystem::exists(io::profile_file(file), ignored)) p.profile(body).code = kNotFound;
    return app::read_surface(source, body, radius);
  });
  p.profile(body).source = source;
  log(Detail::calls, fmt::format("read the {} profile {}", body_name(body), file.string()));
}

wheelrail::Geometry surfaces(Problem& p, const io::WheelRailCase& input) {
  for (const Body body : {Body::rail, Body::wheel}) {
    GivenProfile& slot = p.profile(body);
    const char* word = body_name(body);
    if (slot.code != kGood)
      throw Refusal{CNTC_err_profil, slot.name.empty()
                                         ? fmt::format("there is no {} profile", word)
                                         : fmt::format("the {} profile {} could not be read", word, slot.name)};
    const double radius = app::profile_radius(input, body);
    if (slot.built_radius == radius) continue;
    try {
      SurfaceSpec spec = *slot.spec;
      (body == Body::wheel ? spec.nominal_radius : spec.roller_radius) = radius;
      slot.built = std::make_shared<const NaturalSurface>(create_natural(std::move(spec)));
      slot.built_radius = radius;
    } catch (const Error& error) {
      throw Refusal{CNTC_err_profil, error.what()};
    }
  }
  if (std::holds_alternative<SliceSet>(p.rail.spec->shape) && input.track.gauge_based)
    throw Refusal{CNTC_err_profil, "a rail given by slices has no gauge point: GAUGHT must not be positive"};
  const NaturalSurface &rail = *p.rail.built, &wheel = *p.wheel.built;
  return {rail.surface, wheel.surface, rail.constant_profile() && !input.roller, wheel.constant_profile()};
}

namespace {

/// What cntc_getprofilevalues is asked for.
struct Asked {
  int task = 0, sampling = 0;
  Body body = Body::rail;
  double step = 1e-3;                     ///< [m]
  double at = 0.0, from = 0.0, to = 0.0;  ///< c1, c2
  std::size_t room = 0;                   ///< numbers that fit into the answer
};

constexpr double kMostPoints = 1e6;

/// Where a profile is sampled, along its curve.
std::vector<double> sampled_arc_lengths(const GivenProfile& profile, const Asked& asked) {
  const spline::ProfileSpline& curve = *profile.curve;
  const auto breaks = curve.breaks();
  if (asked.sampling < 0) return spline::arc_length(std::get<Profile>(profile.spec->shape));
  std::vector<double> s;
  if (asked.sampling == 1 && asked.step >= 1e-7) {
    const double count = std::floor((curve.end() - curve.begin()) / asked.step);
    if (count > kMostPoints) throw Refusal{CNTC_err_input, "there would be too many points"};
    for (int i = 0; i <= static_cast<int>(count); ++i) s.push_back(curve.begin() + i * asked.step);
    return s;
  }
  const int parts = asked.sampling >= 2 ? std::min(asked.sampling, 100) : 1;
  if (parts * static_cast<double>(breaks.size()) > kMostPoints)
    throw Refusal{CNTC_err_input, "there would be too many points"};
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    for (int i = 0; i < parts; ++i) s.push_back(breaks[k] + (breaks[k + 1] - breaks[k]) * i / parts);
  s.push_back(breaks.back());
  return s;
}

std::vector<Vec2> sampled_points(const GivenProfile& profile, const Asked& asked) {
  std::vector<Vec2> out;
  if (asked.sampling < 0) {
    const Profile& points = std::get<Profile>(profile.spec->shape);
    for (std::size_t i = 0; i < points.y.size(); ++i) out.emplace_back(points.y[i], points.z[i]);
    return out;
  }
  for (const double s : sampled_arc_lengths(profile, asked)) out.push_back(profile.curve->position(s));
  return out;
}

/// Pose of the profile's axes in the track's, for points whose y is already that of the side.
Pose placed(Problem& p, Body body) {
  const auto of = [&](const wheelrail::Placement& x) { return body == Body::wheel ? x.X_TW : x.X_TR; };
  if (p.solution) return of(p.solution->placement);
  const io::Case c = compose(p);
  const auto& input = std::get<io::WheelRailCase>(c.content);
  const wheelrail::Geometry geometry = surfaces(p, input);
  wheelrail::Problem problem = app::to_problem(input, geometry.round_wheel);
  const bool left = problem.side == Side::left;
  if (left) problem = wheelrail::mirrored(std::move(problem));
  wheelrail::PairSolution solution;
  solution.placement = wheelrail::place(geometry, problem);
  return of(left ? wheelrail::mirrored(std::move(solution)).placement : solution.placement);
}

bool is_left(const Problem& p) { return p.flags[CNTC_ic_config] % 4 == 0; }

/// y of all points, then z [mm].
std::vector<double> in_columns(const std::vector<Vec2>& points) {
  std::vector<double> out;
  for (int k = 0; k < 2; ++k)
    for (const Vec2& point : points) out.push_back(point[k] / kMillimetre);
  return out;
}

std::vector<double> gauge_values(Problem& p) {
  const Track& t = p.given.wheel_rail.track;
  const wheelrail::GaugePoint gauge = wheelrail::gauge_point(*p.rail.built->surface, t.cant, t);
  const Vec3 marker = placed(p, Body::rail).origin;
  const double l = p.units.length, z = gauge.z_top + t.gauge_height;
  return {gauge.y / l, z / l, marker.y() / l, marker.z() / l, gauge.y / l, z / l};
}

/// A surface of slices: a point at (u, v) in the axes of the profile.
class Variable {
 public:
  Variable(const Surface& surface, double radius) : radius_(radius) {
    rail_ = dynamic_cast<const spline::SliceRail*>(&surface);
    wheel_ = dynamic_cast<const spline::SliceWheel*>(&surface);
    if (rail_ == nullptr && wheel_ == nullptr)
      throw Refusal{CNTC_err_input, "the task is for variable profiles (slices), the profile is one"};
  }
  int positions() const { return rail_ != nullptr ? rail_->net().positions() : wheel_->net().positions(); }
  Vec3 point(double u, double v) const {
    if (rail_ != nullptr) return rail_->point(u, v);
    return wheel_->point(u, v) - Vec3(0.0, 0.0, radius_);
  }
  /// Where y has the value, at this u; NaN: nowhere.
  double v_at(double u, double y) const {
    double before = point(u, 1.0).y();
    for (int k = 2; k <= positions(); ++k) {
      const double after = point(u, k).y();
      if ((before - y) * (after - y) <= 0.0) {
        constexpr int kHalvings = 50;
        const bool rising = after > before;
        return bisect(
                   k - 1.0, k, [&](double v) { return (point(u, v).y() < y) == rising; }, kHalvings)
            .middle();
      }
      before = after;
    }
    return kNaN;
  }

 private:
  const spline::SliceRail* rail_;
  const spline::SliceWheel* wheel_;
  double radius_;
};

/// x of all points, then y, then z [mm]; what is missing is 999.
std::vector<double> in_columns(const std::vector<Vec3>& points) {
  constexpr double kMiss = 999.0;
  std::vector<double> out;
  for (int k = 0; k < 3; ++k)
    for (const Vec3& point : points) out.push_back(point.allFinite() ? point[k] / kMillimetre : kMiss);
  return out;
}

std::vector<double> variable_values(Problem& p, const GivenProfile& profile, const Asked& asked) {
  const Variable surface(*profile.built->surface, asked.body == Body::wheel ? profile.built_radius : 0.0);
  constexpr int kAtU = 6, kAtV = 7;
  // u of a rail is a length in mm, of a wheel an angle; v counts positions across.
  const double u_unit = asked.body == Body::rail ? kMillimetre : 1.0, last = surface.positions();
  std::vector<Vec3> points;
  if (asked.task == 2) {
    for (double v = 1.0; v <= last; ++v) points.push_back(surface.point(asked.at * u_unit, v));
    const Pose X_T = placed(p, asked.body);
    std::vector<Vec2> out;
    for (const Vec3& point : points) {
      if (!point.allFinite()) continue;
      const Vec3 in_track = X_T.apply({0.0, is_left(p) ? -point.y() : point.y(), point.z()});
      out.emplace_back(in_track.y(), in_track.z());
    }
    return in_columns(out);
  }
  const double step = asked.step / kMillimetre, count = std::floor((asked.to - asked.from) / step);
  if (!(count >= 0.0 && count <= kMostPoints)) throw Refusal{CNTC_err_input, "the range of samples is wrong"};
  for (int i = 0; i <= static_cast<int>(count); ++i) {
    const double c = asked.from + i * step;
    const double u = (asked.task == kAtU ? asked.at : c) * u_unit;
    const double v = asked.task == kAtU ? c : asked.task == kAtV ? asked.at : surface.v_at(u, asked.at * kMillimetre);
    const bool there = v >= 1.0 && v <= last;
    points.push_back(there ? surface.point(u, v) : Vec3::Constant(kNaN));
  }
  if (asked.room == 1) return {static_cast<double>(points.size())};
  return in_columns(points);
}

std::vector<double> profile_values(Problem& p, const Asked& asked) {
  const GivenProfile& profile = p.profile(asked.body);
  if (asked.task == -1)
    return {profile.code == kGood ? 0.0 : double{CNTC_err_profil}, static_cast<double>(profile.code)};
  if (profile.code != kGood) throw Refusal{CNTC_err_profil, "the profile has not been read"};
  const bool slices = std::holds_alternative<SliceSet>(profile.spec->shape);
  if ((asked.task >= 6 && asked.task <= 8) || (slices && asked.task == 2)) return variable_values(p, profile, asked);
  if (!profile.curve || asked.task < 0 || asked.task > 5)
    throw Refusal{CNTC_err_input, fmt::format("there is no task {} for this profile", asked.task)};
  switch (asked.task) {
    case 0:
      return {static_cast<double>(sampled_arc_lengths(profile, asked).size())};
    case 1:
      return in_columns(sampled_points(profile, asked));
    case 2: {
      const Pose X_T = placed(p, asked.body);
      std::vector<Vec2> points = sampled_points(profile, asked);
      for (Vec2& point : points) {
        const Vec3 in_track = X_T.apply({0.0, is_left(p) ? -point.x() : point.x(), point.y()});
        point = {in_track.y(), in_track.z()};
      }
      return in_columns(points);
    }
    case 3:
      if (asked.body == Body::wheel) throw Refusal{CNTC_err_input, "a wheel has no gauge point"};
      return gauge_values(p);
    default: {
      std::vector<double> out = sampled_arc_lengths(profile, asked);
      for (double& s : out) s = asked.task == 4 ? s / kMillimetre : profile.curve->inclination(s);
      return out;
    }
  }
}

}  // namespace
}  // namespace treadmark::contact

using namespace treadmark::contact;

void cntc_setprofileinputfname(int* ire, const char* fname, int* len_fname, int* nints, int* iparam, int* nreals,
                               double* rparam) {
  on_problem("cntc_setprofileinputfname", ire, nullptr, For::rail, [&](Active& a) {
    give_file(a.problem, text(fname, len_fname, "fname"), array(iparam, nints, "iparam"),
              array(rparam, nreals, "rparam"));
  });
}

void cntc_setprofileinputvalues(int* ire, int* npoint, double* values, int* nints, int* iparam, int* nreals,
                                double* rparam) {
  on_problem("cntc_setprofileinputvalues", ire, nullptr, For::rail, [&](Active& a) {
    constexpr int kMostGiven = 1000000;
    const int points = need(npoint, "npoint");
    if (points > kMostGiven) throw Refusal{CNTC_err_input, "a profile has too many points"};
    const int count = 2 * points;
    give_points(a.problem, array(values, &count, "values"), array(iparam, nints, "iparam"),
                array(rparam, nreals, "rparam"));
  });
}

void cntc_getprofilevalues(int* ire, int* itask, int* nints, int* iparam, int* nreals, double* rparam, int* lenarr,
                           double* values) {
  on_problem("cntc_getprofilevalues", ire, nullptr, For::rail, [&](Active& a) {
    const auto ints = array(iparam, nints, "iparam");
    const auto reals = array(rparam, nreals, "rparam");
    require_finite(reals, "rparam");
    const auto out = room(values, lenarr, "values");
    const auto real = [&](std::size_t i, double otherwise) { return i < reals.size() ? reals[i] : otherwise; };
    Asked asked;
    asked.task = need(itask, "itask");
    asked.body = !ints.empty() && ints[0] == 1 ? treadmark::Body::wheel : treadmark::Body::rail;
    asked.sampling = ints.size() > 1 ? ints[1] : 0;
    asked.step = real(0, 1.0) * treadmark::kMillimetre;
    asked.at = real(1, 0.0), asked.from = real(2, 0.0), asked.to = real(3, 0.0);
    asked.room = out.size();
    fill(out, profile_values(a.problem, asked));
  });
}

void cntc_getprofilevalues_new(int* ire, int* itask, int* nints, int* iparam, int* nreals, double* rparam, int* lenarr,
                               double* values) {
  cntc_getprofilevalues(ire, itask, nints, iparam, nreals, rparam, lenarr, values);
}
