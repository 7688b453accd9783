// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/surfaces/sampled_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::app {

namespace {

/// A surface and the cases that used it.
struct Use {
  const UsedBody* body;
  bool left;
  std::vector<io::CaseResult*> cases;
};

std::vector<Use> distinct(std::span<io::CaseResult> cases, std::span<const UsedBodies> used,
                          UsedBody UsedBodies::*which) {
  std::vector<Use> out;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const UsedBody& body = used[i].*which;
    if (!cases[i].bodies || body.surface == nullptr) continue;
    auto known = ranges::find_if(out, [&](const Use& u) {
      return u.body->surface == body.surface && u.body->radius == body.radius && u.left == used[i].left;
    });
    if (known == out.end()) known = out.insert(out.end(), Use{&body, used[i].left, {}});
    known->cases.push_back(&cases[i]);
  }
  return out;
}

/// Where a body was touched, or would have been.
std::vector<double> contacts_of(const Use& use, const std::vector<double>& wheel_radii) {
  std::vector<double> out;
  for (std::size_t i = 0; i < use.cases.size(); ++i) {
    const io::CaseResult& c = *use.cases[i];
    const Pose& X_TB = use.body->body == Body::wheel ? c.bodies->X_TA : c.bodies->X_TS;
    const auto add = [&](const Vec3& p_T) {
      const double u = station_of(*use.body, X_TB.apply_inverse(p_T));
      if (std::isfinite(u)) out.push_back(u);
    };
    for (const io::PatchResult& p : c.patches)
      if (p.has_reference) add({p.x_tr, p.y_tr, p.z_tr});
    if (c.patches.empty()) add(c.bodies->X_TA.origin + wheel_radii[i] * Vec3::UnitZ());
  }
  return out;
}

/// As the other side of the track has it.
void mirror(io::SampledSurface& s) {
  for (double& y : s.y) y = -y;
  const auto turn = [&](std::vector<double>& list) {
    for (auto row = list.begin(); row != list.end(); row += s.nv) std::reverse(row, row + s.nv);
  };
  for (auto* list : {&s.x, &s.y, &s.z, &s.deviation}) turn(*list);
}

}  // namespace

std::vector<io::SampledSurface> sample_surfaces(std::span<io::CaseResult> cases, std::span<const UsedBodies> used) {
  std::vector<io::SampledSurface> out;
  std::map<const io::CaseResult*, double> radius;
  for (std::size_t i = 0; i < cases.size(); ++i) radius[&cases[i]] = used[i].wheel.radius;
  for (const auto which : {&UsedBodies::wheel, &UsedBodies::rail}) {
    int number = 0;
    for (const Use& use : distinct(cases, used, which)) {
      std::vector<double> radii;
      for (const io::CaseResult* c : use.cases) radii.push_back(radius.at(c));
      const std::vector<double> contacts = contacts_of(use, radii);
      if (contacts.empty()) continue;
      try {
        io::SampledSurface surface = sample_body(*use.body, contacts);
        if (use.left) mirror(surface);
        surface.name = fmt::format("{}_{}", surface.body, ++number);
        for (io::CaseResult* c : use.cases)
          (use.body->body == Body::wheel ? c->wheel_surface : c->rail_surface) = surface.name;
        out.push_back(std::move(surface));
      } catch (const Error&) {
        // The results are good without a picture of it.
      }
    }
  }
  return out;
}

std::vector<UsedBodies> used_bodies(const io::CaseFile& file, std::span<const io::CaseResult> cases,
                                    SurfaceStore& store) {
  std::map<int, const io::WheelRailCase*> inputs;
  for (const io::Case& c : file.cases) inputs[c.number] = std::get_if<io::WheelRailCase>(&c.content);
  const SampledRegions all = sampled_regions(file);
  std::vector<UsedBodies> out;
  for (const io::CaseResult& result : cases) {
    UsedBodies& used = out.emplace_back();
    const auto found = inputs.find(result.number);
    if (found == inputs.end() || found->second == nullptr) continue;
    const io::WheelRailCase& input = *found->second;
    used.left = input.side == Side::left;
    const SampledRegions regions = regions_of(input, all);
    const auto body = [&](const StoredSurface& s, bool constant, double size) {
      UsedBody one{s.body(), s.represented.surface, nullptr, constant, size};
      if (!s.represented.resampled) return one;
      const bool roller = s.body() == Body::rail && size > 0.0;  // its region is one of arc lengths
      one.beyond = s.natural->surface;
      one.low = s.represented.region.u_min / (roller ? size : 1.0);
      one.high = s.represented.region.u_max / (roller ? size : 1.0);
      return one;
    };
    const double wheel_radius = profile_radius(input, Body::wheel), rail_radius = profile_radius(input, Body::rail);
    const StoredSurface& wheel = store.get(input.wheel, Body::wheel, wheel_radius, regions.wheel);
    const StoredSurface& rail = store.get(input.rail, Body::rail, rail_radius, regions.rail);
    used.wheel = body(wheel, wheel.constant_profile(), wheel_radius);
    used.rail = body(rail, rail.constant_profile() && !input.roller, rail_radius);
  }
  return out;
}

void add_surfaces(io::RunResult& run, const io::CaseFile& file, SurfaceStore& store) {
  run.sampled = sample_surfaces(run.cases, used_bodies(file, run.cases, store));
}

namespace {

constexpr double kSearchAngle = 0.2;  // of the contact search, to both sides [rad]
constexpr double kMarginAngle = 0.05;
constexpr double kHalfGauge = 0.8;  // lever arm of the yaw angle [m]

bool made_for_one_place(const std::string& backend) { return !backend.empty() && backend_of(backend).one_place; }

bool made_for_one_place(const io::SurfaceSource& source) {
  return made_for_one_place(source.backend) ||
         ranges::any_of(source.parts, [](const io::SurfaceSource& p) { return made_for_one_place(p.backend); });
}

}  // namespace

void RegionsOfCases::Interval::include(double middle, double half) {
  low = any ? std::min(low, middle - half) : middle - half;
  high = any ? std::max(high, middle + half) : middle + half;
  any = true;
}

void RegionsOfCases::add(const io::WheelRailCase& input) {
  const WheelsetState& w = input.state;
  const double turned = std::fabs(w.position.yaw) + std::fabs(w.wheel_offset.yaw);
  const double sideways = std::fabs(w.position.roll) + std::fabs(w.wheel_offset.roll) + std::fabs(input.track.cant);
  theta_.include(wrap_angle(-(w.position.pitch + w.wheel_offset.pitch)),
                 kSearchAngle + kMarginAngle + turned + 0.2 * sideways);
  x_.include(w.position.x + w.wheel_offset.x,
             (kSearchAngle + kMarginAngle) * input.wheelset.nominal_radius + kHalfGauge * turned);
}

SampledRegions RegionsOfCases::regions() const {
  SampledRegions regions;
  if (!x_.any) return regions;
  regions.rail.u_min = x_.low;
  regions.rail.u_max = x_.high;
  if (theta_.high - theta_.low < std::numbers::pi) {
    regions.wheel.u_min = theta_.low;
    regions.wheel.u_max = theta_.high;
  }
  return regions;
}

bool is_sampled(const io::SurfaceSource& source) {
  return (!source.backend.empty() && backend_of(source.backend).resample) ||
         ranges::any_of(source.parts, [](const io::SurfaceSource& part) { return is_sampled(part); });
}

SampledRegions sampled_regions(const io::CaseFile& file) {
  RegionsOfCases all;
  for (const io::Case& c : file.cases)
    if (const auto* input = std::get_if<io::WheelRailCase>(&c.content)) all.add(*input);
  return all.regions();
}

SampledRegions regions_of(const io::WheelRailCase& input, const SampledRegions& all) {
  SampledRegions out = all;
  const bool wheel = made_for_one_place(input.wheel), rail = made_for_one_place(input.rail);
  if (!wheel && !rail) return out;
  RegionsOfCases one;
  one.add(input);
  const SampledRegions own = one.regions();
  if (wheel) out.wheel = own.wheel;
  if (rail) out.rail = own.rail;
  return out;
}

void refuse_one_place(const io::SurfaceSource& source, const char* what) {
  if (made_for_one_place(source))
    throw Error(ErrorKind::configuration,
                fmt::format("the representation of this body is made for one place, {} takes in many", what),
                source.where, "choose another backend, see treadmark list backends");
}

conformance::Subject seen_body(const io::WheelRailCase& input, SurfaceStore& store, Body body, const Region& region) {
  const io::SurfaceSource& source = body == Body::wheel ? input.wheel : input.rail;
  const double radius = profile_radius(input, body), middle = 0.5 * (region.u_min + region.u_max);
  // of rollers regions are arc lengths
  const bool known = std::isfinite(middle) && (body == Body::wheel || radius == 0.0);
  return conformance::look_at(store.get(source, body, radius, region).represented.surface, known ? middle : 0.0,
                              source.backend);
}

conformance::Record hold_case(const io::CaseFile& file) {
  const io::WheelRailCase* input = first_wheelrail_case(file);
  if (input == nullptr)
    throw Error(ErrorKind::configuration, "there is no case of a wheel on a rail, so no surface", {file.path.string()});
  const SampledRegions regions = regions_of(*input, sampled_regions(file));
  SurfaceStore store;
  conformance::Record record;
  for (const Body body : {Body::wheel, Body::rail}) {
    conformance::Subject subject = seen_body(*input, store, body, body == Body::wheel ? regions.wheel : regions.rail);
    subject.brief = false;
    record.add(body == Body::wheel ? "wheel" : "rail", subject);
  }
  return record;
}

}  // namespace treadmark::app
