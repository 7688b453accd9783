// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/interfaces/c/many.hpp"
#include "treadmark/io/cases/validate_case.hpp"
#include "treadmark/solvers/wheelrail/pair_state.hpp"

namespace treadmark::c {
namespace {

/// The case, checked once after each change.
template <class Content>
const Content& checked(const tm_case* c, const char* kind) {
  require(c != nullptr, "case must not be null");
  const auto* content = std::get_if<Content>(&c->content->content);
  require(content != nullptr, kind);
  if (!c->checked) {
    io::validate_case(*c->content);
    c->checked = true;
  }
  return *content;
}

/// The solution, and how the computation ended.
template <class Solve>
tm_status solve_into(tm_solution** out, Solve&& solve) noexcept {
  Status end = Status::ok;
  const tm_status status = make(out, [&] {
    auto made = std::make_unique<tm_solution>();
    end = solve(*made);
    return made;
  });
  return status == TM_OK ? status_of(end) : status;
}

wheelrail::Geometry geometry_of(const tm_surface& rail, const tm_surface& wheel) {
  require(rail.natural->spec.body == Body::rail && wheel.natural->spec.body == Body::wheel,
          "a rail and a wheel are needed, in this order");
  return {rail.represented.surface, wheel.represented.surface,
          rail.natural->constant_profile() && rail.natural->spec.roller_radius == 0.0,
          wheel.natural->constant_profile()};
}

/// Where the wheel stands follows from the radius of the case, where its surface is from its own.
void require_radii(const tm_pair& p, const io::WheelRailCase& given) {
  constexpr double kRounding = 1e-9;
  const auto same = [](double a, double b) { return std::abs(a - b) <= kRounding * std::abs(a); };
  if (p.wheel_radius == 0.0) return;
  if (!same(p.wheel_radius, app::profile_radius(given, Body::wheel)))
    throw Error(ErrorKind::configuration, "the nominal radius of the case is not that of the wheel", {},
                fmt::format("set wheelset.nominal_radius to {} m", p.wheel_radius));
  if (!same(p.roller_radius, app::profile_radius(given, Body::rail)))
    throw Error(ErrorKind::configuration, "the roller of the case is not that of the rail's surface", {},
                "make the surface of this case (tm_surface_of_case)");
}

/// Heights of some sections of rail and wheel [m].
const std::vector<double>& samples_of(const tm_pair& p) {
  if (!p.samples.empty()) return p.samples;
  constexpr int kSections = 6, kPoints = 33;
  constexpr double kWidest = 1.0;  // [m], of bounds that may be infinite
  std::vector<double> samples;
  for (const Surface* surface : {p.geometry.rail.get(), p.geometry.wheel.get()}) {
    const Box3 box = surface->bounds();
    const auto between = [&](int axis, double share) {
      const double low = std::max(box.min[axis], -kWidest), high = std::min(box.max[axis], kWidest);
      return low + share * (high - low);
    };
    for (int k = 0; k < kSections; ++k) {
      const bool rail = surface->facing() == Facing::up;
      Pose X_SP;
      if (!rail) X_SP.rotation = rotation_y(k);
      std::vector<Vec2> points;
      for (int i = 0; i < kPoints; ++i)
        points.emplace_back(rail ? between(0, (k + 0.5) / kSections) : 0.0, between(1, (i + 0.5) / kPoints));
      std::vector<double> z(points.size());
      surface->heights_at(X_SP, points, {z, {}, {}});
      samples.insert(samples.end(), z.begin(), z.end());
    }
  }
  return p.samples = std::move(samples);
}

bool are_same(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kSame = 1e-9;  // [m]
  return ranges::equal(a, b,
                       [](double x, double y) { return std::abs(x - y) < kSame || (std::isnan(x) && std::isnan(y)); });
}

}  // namespace

const io::WheelRailCase& checked_for(const tm_pair& pair, const tm_case* c) {
  const auto& given = checked<io::WheelRailCase>(c, "the case is one of a patch");
  require_radii(pair, given);
  return given;
}

}  // namespace treadmark::c

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_pair_create(const tm_surface* rail, const tm_surface* wheel, tm_pair** out) {
  return make(out, [&] {
    require(rail != nullptr && wheel != nullptr, "rail and wheel must not be null");
    const wheelrail::Geometry geometry = geometry_of(*rail, *wheel);
    return std::make_unique<tm_pair>(tm_pair{geometry, wheelrail::Pair(geometry), wheel->natural->spec.nominal_radius,
                                             rail->natural->spec.roller_radius});
  });
}

tm_status tm_pair_of_case(const tm_case* c, tm_pair** out) {
  if (out != nullptr) *out = nullptr;
  tm_surface *rail = nullptr, *wheel = nullptr;
  tm_status status = tm_surface_of_case(c, TM_RAIL, &rail);
  if (status == TM_OK) status = tm_surface_of_case(c, TM_WHEEL, &wheel);
  if (status == TM_OK) status = tm_pair_create(rail, wheel, out);
  tm_surface_free(rail);
  tm_surface_free(wheel);
  return status;
}

tm_status tm_pair_solve(tm_pair* p, const tm_case* c, tm_solution** out) {
  return solve_into(out, [&](tm_solution& made) {
    require(p != nullptr, "pair must not be null");
    const auto& given = checked_for(*p, c);
    made.input = c->content;
    made.geometry = p->geometry;
    const auto before = p->pair.save();
    try {
      made.pair = p->pair.solve(app::to_problem(given, p->geometry.round_wheel));
    } catch (...) {
      p->pair.restore(before);
      throw;
    }
    return made.pair->status;
  });
}

tm_status tm_pair_reset(tm_pair* p) {
  return guarded([&] {
    require(p != nullptr, "pair must not be null");
    p->pair.reset();
  });
}

tm_status tm_pair_save(const tm_pair* p, tm_state** out) {
  return make(out, [&] {
    require(p != nullptr, "pair must not be null");
    return std::make_unique<tm_state>(tm_state{p->pair.save(), samples_of(*p)});
  });
}

tm_status tm_pair_restore(tm_pair* p, const tm_state* s) {
  return guarded([&] {
    require(p != nullptr && s != nullptr, "pair and state must not be null");
    if (!are_same(s->samples, samples_of(*p)))
      throw Error(ErrorKind::configuration, "the state is that of a pair of other surfaces", {},
                  "restore it into a pair of the same ones, or start anew");
    p->pair.restore(s->state);
  });
}

void tm_pair_free(tm_pair* p) { delete p; }

tm_status tm_state_to_bytes(const tm_state* s, void* buffer, size_t* size) {
  return guarded([&] {
    require(s != nullptr && size != nullptr, "state and size must not be null");
    ByteWriter out;
    wheelrail::write(s->state, out);
    out.put(s->samples);
    const std::size_t room = std::exchange(*size, out.bytes().size());
    if (buffer == nullptr) return;
    require(room >= out.bytes().size(), "the buffer is too small");
    std::memcpy(buffer, out.bytes().data(), out.bytes().size());
  });
}

tm_status tm_state_from_bytes(const void* bytes, size_t size, tm_state** out) {
  return make(out, [&] {
    require(bytes != nullptr, "bytes must not be null");
    ByteReader in({static_cast<const std::byte*>(bytes), size});
    auto state = std::make_unique<tm_state>(tm_state{wheelrail::read_state(in), {}});
    in.get(state->samples);
    if (!in.at_end()) refuse_saved_state("more bytes than it has");
    return state;
  });
}

void tm_state_free(tm_state* s) { delete s; }

tm_status tm_patch_create(tm_patch** out) {
  return make(out, [] { return std::make_unique<tm_patch>(); });
}

tm_status tm_patch_solve(tm_patch* p, const tm_case* c, tm_solution** out) {
  return solve_into(out, [&](tm_solution& made) {
    require(p != nullptr, "patch must not be null");
    const auto& given = checked<io::BasicCase>(c, "the case is one of a wheel on a rail");
    made.input = c->content;
    try {
      made.result = p->sequence.solve(given);
    } catch (const Error&) {
      throw;
    } catch (...) {  // ended in the middle of the work
      p->sequence = {};
      throw;
    }
    return made.result->status;
  });
}

void tm_patch_free(tm_patch* p) { delete p; }

}  // extern "C"
