// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/line_effects.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::vehicle {

/// A path frame that moves along, and its derivatives by the distance, in its own axes.
struct LineEffects::Frame {
  Pose X_LT;
  Vec3 along, along_first;  ///< d origin / ds and its derivative as a vector of components
  Vec3 turn, turn_first;
  double sine = 0.0, cosine = 1.0;  ///< of the cant angle

  explicit Frame(const PathPoint& p) : X_LT(p.X_LT()), turn(p.turn()), turn_first(p.turn_first()) {
    const double phi = p.cant_angle.value, rate = p.cant_angle.first, rise = p.height.first;
    sine = std::sin(phi), cosine = std::cos(phi);
    along = {1.0, rise * sine, rise * cosine};
    along_first = {0.0, p.height.second * sine + rise * rate * cosine, p.height.second * cosine - rise * rate * sine};
  }

  /// Velocity of a point that is fixed in the frame, by the distance.
  Vec3 velocity(const Vec3& point) const { return along + turn.cross(point); }
  Vec3 acceleration(const Vec3& point, const Travel& t) const {
    const Vec3 by_distance = velocity(point);
    return t.speed * t.speed * (along_first + turn_first.cross(point) + turn.cross(by_distance)) +
           t.acceleration * by_distance;
  }
};

namespace {

constexpr double kSamePoint = 1e-6;  // in time, of torques and so on [s]

/// Small rotation that a matrix stands for.
Vec3 rotation_vector(const Mat3& r) { return 0.5 * Vec3(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)); }

void add(Vector& force, const std::array<int, kFreedoms>& coordinate, const Vec3& linear, const Vec3& moment) {
  for (int f = 0; f < kFreedoms; ++f)
    if (const int c = coordinate[static_cast<std::size_t>(f)]; c >= 0) force[c] += f < 3 ? linear[f] : moment[f - 3];
}

/// A coupler pulls along x of the frame at its point, not along that of a body whose axes are seen from there.
void add_aside(const Multibody::Body& body, const Vec3& point, const Mat3& axes, double sign,
               std::vector<std::pair<int, double>>& direction) {
  const Vec3 linear = sign * (axes.transpose() * Vec3::UnitX() - Vec3::UnitX());
  const Vec3 moment = (point - body.position).cross(linear);
  for (int f = 0; f < kFreedoms; ++f)
    if (const int c = body.coordinate[static_cast<std::size_t>(f)]; c >= 0)
      direction.emplace_back(c, f < 3 ? linear[f] : moment[f - 3]);
}

}  // namespace

LineEffects::LineEffects(const Multibody& system, LineSetup setup)
    : setup_(std::move(setup)),
      size_(system.size()),
      bodies_(system.bodies),
      links_(system.links),
      stretches_(system.stretches),
      leanings_(system.leanings),
      wheelsets_(system.wheelsets),
      columns_(system.elements.columns) {
  for (const Multibody::Body& b : bodies_) mass_ += b.mass;
  coupler_columns_.resize(links_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].vehicle < 0)
      coupler_columns_.at(static_cast<std::size_t>(columns_[i].link)).push_back(static_cast<int>(i));
  for (const CharacteristicForce& c : system.characteristics) stops_.emplace_back(c.link, c.freedom);
  for (const AxleTorque& torque : setup_.torques) {
    const auto fail = [&](std::string message) {
      throw Error(ErrorKind::configuration, std::move(message), torque.where);
    };
    if (torque.wheelset < 0 || static_cast<std::size_t>(torque.wheelset) >= wheelsets_.size())
      fail(fmt::format("there is no wheelset {} to drive", torque.wheelset + 1));
    const int axle = wheelsets_[static_cast<std::size_t>(torque.wheelset)].coordinate[4];
    if (axle < 0) fail(fmt::format("wheelset {} cannot be driven, it is not free in pitch", torque.wheelset + 1));
    int reaction = -1;
    if (torque.reaction != kGround) {
      const auto body = ranges::find(bodies_, torque.reaction, &Multibody::Body::name);
      if (body == bodies_.end()) fail(fmt::format("there is no body '{}' to hold a motor", torque.reaction));
      reaction = body->coordinate[4];
    }
    torque_on_.emplace_back(axle, reaction);
  }
  place_motions(system);
  gather_points();
  if (setup_.path) check_curves();
}

void LineEffects::gather_points() {
  const auto take = [this](const std::vector<double>& times) {
    points_.insert(points_.end(), times.begin(), times.end());
  };
  take(setup_.speed.time);
  for (const AxleTorque& torque : setup_.torques) take(torque.time);
  for (const BodyForce& force : setup_.forces) take(force.time);
  for (const SpringMotion& motion : setup_.spring_motions) take(motion.time);
  for (const RailShift& shift : setup_.rail_shifts) take(shift.time);
  ranges::sort(points_);
  const auto near = [](double one, double next) { return next - one < kSamePoint; };
  points_.erase(std::unique(points_.begin(), points_.end(), near), points_.end());
}

double LineEffects::step_within(double time, double step) const {
  if (setup_.stays) return step;
  const auto next = std::upper_bound(points_.begin(), points_.end(), time + 0.5 * kSamePoint);
  if (next == points_.end() || !(*next < time + step)) return step;
  const bool in_short_piece = next != points_.begin() && *next - *(next - 1) < step,
             before_one = next + 1 != points_.end() && *(next + 1) < time + step;
  return in_short_piece || before_one ? *next - time : step;
}

void LineEffects::check_curves() const {
  double reach = 0.0;
  for (const Multibody::Link& link : links_)
    for (const int body : {link.a, link.b})
      if (body >= 0)
        reach = std::max(reach, std::abs(bodies_[static_cast<std::size_t>(body)].position.x() - link.point.x()));
  for (const LayoutElement& e : setup_.path->layout().elements) {
    const double curvature = std::max(std::abs(e.curvature.from), std::abs(e.curvature.to));
    if (reach * curvature > kLargestAngle)
      throw Error(ErrorKind::configuration,
                  fmt::format("a curve of {:.6g} m is too tight for this vehicle: bodies connected {:.4g} m from their "
                              "middle turn by more than {:g} rad against each other",
                              1.0 / curvature, reach, kLargestAngle),
                  e.where, "the motion of bodies is linear in their rotation; give a wider curve");
    const double widening =
        std::max(std::abs(e.gauge.from - setup_.gauge_at_rest), std::abs(e.gauge.to - setup_.gauge_at_rest));
    if (widening > kLargestWidening)
      throw Error(ErrorKind::configuration,
                  fmt::format("the gauge of the line differs by {:.4g} mm from the {:.6g} mm of the rails",
                              1e3 * widening, 1e3 * setup_.gauge_at_rest),
                  e.where, "gauge_mm of [layout] and of [track] belong together");
  }
}

namespace {

Vector unit_on_body(const Multibody& system, const Multibody::Body& body, const BodyForce& f) {
  Vector out = Vector::Zero(system.size());
  const int d = static_cast<int>(f.direction);
  const Vec3 linear = d < 3 ? Vec3(Vec3::Unit(d)) : Vec3(Vec3::Zero());
  Vec3 moment = d < 3 ? Vec3(Vec3::Zero()) : Vec3(Vec3::Unit(d - 3));
  if (f.point) moment += (*f.point - body.position).cross(linear);
  // Axle boxes, which the point of a wheelset is on, do not turn with the axle.
  if (d < 3 && body.wheelset >= 0) moment.y() = 0.0;
  add(out, body.coordinate, linear, moment);
  return out;
}

Vector unit_on_rails(const Multibody& system, const BodyForce& f) {
  constexpr std::array kOfRail{Freedom::y, Freedom::z, Freedom::roll};
  const auto at = static_cast<std::size_t>(ranges::find(kOfRail, f.direction) - kOfRail.begin());
  Vector out = Vector::Zero(system.size());
  for (std::size_t set = 0; set < system.wheelsets.size(); ++set) {
    if (f.wheelset && static_cast<std::size_t>(*f.wheelset) != set) continue;
    const int rail = *f.left ? system.wheelsets[set].left_rail : system.wheelsets[set].right_rail;
    const int c = rail < 0 || at == kOfRail.size() ? -1 : system.rails[static_cast<std::size_t>(rail)].coordinate[at];
    if (c < 0)
      throw Error(
          ErrorKind::configuration,
          fmt::format("the {} rail below wheelset {} has no motion of its own in the direction of the force on it",
                      *f.left ? "left" : "right", set + 1),
          f.where, "a lumped track (simulation.track) says how rails move, in y, z and roll");
    out[c] = 1.0;
  }
  return out;
}

}  // namespace

/// Forces from outside, springs and rails that are moved.
void LineEffects::place_motions(const Multibody& system) {
  const auto fail = [](std::string message, const SourcePosition& where) {
    throw Error(ErrorKind::configuration, std::move(message), where);
  };
  for (const BodyForce& f : setup_.forces) {
    const auto body = ranges::find(bodies_, f.body, &Multibody::Body::name);
    if (body == bodies_.end() && (!f.body.empty() || !f.left))
      fail(fmt::format("there is no body '{}' for a force to act on", f.body), f.where);
    force_by_.push_back(body == bodies_.end() ? unit_on_rails(system, f) : unit_on_body(system, *body, f));
    // That of a free run counts in its speed, also on bodies that move at that.
    if (force_by_.back().isZero(0.0) && !(setup_.free_run && f.direction == Freedom::x))
      throw Error(ErrorKind::configuration,
                  fmt::format("a force or moment on '{}' does nothing: the body is not free in that direction", f.body),
                  f.where, "add the direction to its `free`, or leave the force out");
  }
  for (const SpringMotion& m : setup_.spring_motions) {
    const auto link = ranges::find(links_, m.spring, &Multibody::Link::spring);
    if (link == links_.end()) fail(fmt::format("there is no spring '{}' to move", m.spring), m.where);
    if ((link->a < 0) == (link->b < 0))
      fail(fmt::format("spring '{}' cannot be moved, it does not end at \"ground\"", m.spring), m.where);
    moved_.push_back({static_cast<std::size_t>(link - links_.begin()), link->a < 0 ? -1.0 : 1.0,
                      LimitedSpline(m.time, m.displacement)});
  }
  for (const RailShift& shift : setup_.rail_shifts) shifts_.emplace_back(shift.time, shift.displacement);
}

LineEffects::Frame LineEffects::frame(double x, const Travel& travel) const {
  return Frame(setup_.path->at(setup_.start + travel.distance + x));
}

PathPoint LineEffects::point(double time) const {
  const double s = setup_.start + travel(time).distance;
  if (setup_.path) return setup_.path->at(s);
  PathPoint straight;
  straight.distance = s;
  straight.gauge.value = setup_.gauge_at_rest;
  return straight;
}

void LineState::add_couplers_aside(const Vector& element_force, double times, Vector& sum) const {
  for (const Aside& aside : couplers_aside)
    for (const auto& [c, factor] : aside.direction) sum[c] -= times * factor * element_force[aside.column];
}

LineState LineEffects::state(double time) const {
  const Travel now = travel(time);
  LineState out;
  out.spring = out.damper = out.spring_rate = out.force = Vector::Zero(size_);
  out.stop_offsets.assign(stops_.size(), 0.0);
  add_inertia(out, now);
  out.element_stretch = out.element_rate = Vector::Zero(static_cast<Eigen::Index>(columns_.size()));
  if (setup_.path || !moved_.empty()) add_links(out, now, clock(time));
  for (std::size_t i = 0; i < torque_on_.size(); ++i) {
    const double torque = torque_at(setup_.torques[i], clock(time));
    out.force[torque_on_[i].first] -= torque;
    if (torque_on_[i].second >= 0) out.force[torque_on_[i].second] += torque;
  }
  for (std::size_t i = 0; i < force_by_.size(); ++i)
    out.force += force_at(setup_.forces[i], clock(time)) * force_by_[i];
  out.force += out.spring + out.damper;
  return out;
}

Vec3 LineEffects::felt_acceleration(const Vec3& place, double time) const {
  const Travel now = travel(time);
  const double climbed = setup_.free_run ? climbing(place.x(), now) : 0.0;
  if (!setup_.path) return {now.acceleration + climbed, 0.0, 0.0};
  const Frame f = frame(place.x(), now);
  Vec3 felt = f.acceleration({0.0, place.y(), place.z()}, now) - setup_.gravity * Vec3(0.0, f.sine, f.cosine - 1.0);
  if (setup_.free_run) felt.x() += climbed;
  return felt;
}

Vec3 LineEffects::frame_spin(double x, double time) const {
  if (!setup_.path) return Vec3::Zero();
  const Travel now = travel(time);
  return now.speed * frame(x, now).turn;
}

/// Of the gradient at a place of the vehicle in a free run [m/s2].
double LineEffects::climbing(double x, const Travel& travel) const {
  return setup_.gravity * gradient_at(*setup_.free_run, setup_.start + travel.distance + x);
}

/// Of gradient and resistance on a body at a place of the vehicle, over its mass [m/s2].
double LineEffects::held_back(double x, const Travel& travel) const {
  return climbing(x, travel) + resistance_at(*setup_.free_run, travel.speed) / mass_;
}

void LineEffects::add_inertia(LineState& out, const Travel& travel) const {
  for (const Multibody::Body& b : bodies_) {
    Vec3 force(-b.mass * travel.acceleration, 0.0, 0.0), moment = Vec3::Zero(), spin = Vec3::Zero();
    if (setup_.path) {
      const Frame f = frame(b.position.x(), travel);
      const Vec3 centre(0.0, b.position.y(), b.position.z());
      force = b.mass * (setup_.gravity * Vec3(0.0, f.sine, f.cosine - 1.0) - f.acceleration(centre, travel));
      spin = travel.speed * f.turn;
      const Vec3 rate = travel.speed * travel.speed * f.turn_first + travel.acceleration * f.turn;
      moment = -b.inertia.cwiseProduct(rate) - spin.cross(b.inertia.cwiseProduct(spin));
    }
    if (setup_.free_run) force.x() -= b.mass * held_back(b.position.x(), travel);
    if (b.wheelset >= 0) {
      // Angular momentum about the axle, -I V / R, turns along with the frame and changes with the speed.
      const double by_speed = -b.inertia.y() / wheelsets_[static_cast<std::size_t>(b.wheelset)].nominal_radius;
      moment -= by_speed * Vec3(-travel.speed * spin.z(), travel.acceleration, travel.speed * spin.x());
    }
    add(out.force, b.coordinate, force, moment);
  }
}

void LineEffects::add_links(LineState& out, const Travel& travel, double time) const {
  std::vector<std::array<double, kFreedoms>> stretch(links_.size()), rate(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Multibody::Link& link = links_[i];
    const auto place_of = [&](int body) {
      return body >= 0 ? bodies_[static_cast<std::size_t>(body)].position.x() : link.point.x();
    };
    const double xa = place_of(link.a), xb = place_of(link.b);
    if (!setup_.path || xa == xb) continue;
    const Frame here = frame(link.point.x(), travel), at_a = frame(xa, travel), at_b = frame(xb, travel);
    const auto arm = [&](double x) { return Vec3(link.point.x() - x, link.point.y(), link.point.z()); };
    const Mat3 to_here = here.X_LT.rotation.transpose();
    const Mat3 a = to_here * at_a.X_LT.rotation, b = to_here * at_b.X_LT.rotation;  // axes of both, seen here
    const Vec3 apart = to_here * (at_b.X_LT.apply(arm(xb)) - at_a.X_LT.apply(arm(xa)));
    const Vec3 apart_rate = b * at_b.velocity(arm(xb)) - a * at_a.velocity(arm(xa)) - here.turn.cross(apart);
    const Vec3 turned = rotation_vector(b * a.transpose()), turned_rate = b * at_b.turn - a * at_a.turn;
    for (int d = 0; d < 3; ++d) {
      const auto j = static_cast<std::size_t>(d);
      stretch[i][j] = apart[d], stretch[i][j + 3] = turned[d];
      rate[i][j] = travel.speed * apart_rate[d], rate[i][j + 3] = travel.speed * turned_rate[d];
    }
    // Preloads lie along the mean of both frames; balance has them along z of each body.
    const Vec3 tilt = 0.5 * (rotation_vector(a) + rotation_vector(b));
    const Vec3 along = Vec3(Vec3::UnitZ() + tilt.cross(Vec3::UnitZ())).normalized();
    const auto add_preload = [&](int body, const Mat3& axes, double sign) {
      if (body < 0) return;
      const Multibody::Body& on = bodies_[static_cast<std::size_t>(body)];
      const Vec3 force = sign * link.preload * (axes.transpose() * along - Vec3::UnitZ());
      Vec3 moment = (link.point - on.position).cross(force);
      if (on.wheelset >= 0) moment.y() = 0.0;
      add(out.force, on.coordinate, force, moment);
    };
    add_preload(link.a, a, -1.0);
    add_preload(link.b, b, 1.0);
    for (const int column : coupler_columns_[i]) {
      LineState::Aside& aside = out.couplers_aside.emplace_back(LineState::Aside{column, {}});
      add_aside(bodies_[static_cast<std::size_t>(link.a)], link.point, a, -1.0, aside.direction);
      add_aside(bodies_[static_cast<std::size_t>(link.b)], link.point, b, 1.0, aside.direction);
    }
  }
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const auto freedom = static_cast<std::size_t>(setup_.spring_motions[i].direction);
    const Along at = moved_[i].motion.at(time);
    stretch[moved_[i].link][freedom] += moved_[i].sign * at.value;
    rate[moved_[i].link][freedom] += moved_[i].sign * (setup_.stays ? 0.0 : at.first);
  }
  for (const Multibody::Stretch& s : stretches_) {
    const auto link = static_cast<std::size_t>(s.link), freedom = static_cast<std::size_t>(s.freedom);
    const double by = stretch[link][freedom], by_rate = rate[link][freedom];
    if (by == 0.0 && by_rate == 0.0) continue;
    for (const auto& [c, factor] : s.direction) {
      if (s.damper) {
        out.damper[c] -= s.value * factor * by_rate;
      } else {
        out.spring[c] -= s.value * factor * by;
        out.spring_rate[c] -= s.value * factor * by_rate;
      }
    }
    if (s.damper)
      out.damper_power += s.value * by_rate * by_rate;
    else
      out.spring_energy += 0.5 * s.value * by * by;
  }
  for (const Multibody::Leaning& l : leanings_) {
    const auto link = static_cast<std::size_t>(l.link), freedom = static_cast<std::size_t>(l.freedom);
    for (const auto& [c, factor] : l.turn) {
      out.spring[c] -= l.value * factor * stretch[link][freedom];
      out.spring_rate[c] -= l.value * factor * rate[link][freedom];
    }
  }
  for (std::size_t i = 0; i < stops_.size(); ++i)
    out.stop_offsets[i] =
        stretch[static_cast<std::size_t>(stops_[i].first)][static_cast<std::size_t>(stops_[i].second)];
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const ElementColumn& c = columns_[i];
    if (c.link < 0) continue;
    const auto link = static_cast<std::size_t>(c.link), freedom = static_cast<std::size_t>(c.freedom);
    out.element_stretch[static_cast<Eigen::Index>(i)] = c.arm * stretch[link][freedom];
    out.element_rate[static_cast<Eigen::Index>(i)] = c.arm * rate[link][freedom];
  }
}

WheelOnLine LineEffects::wheel(std::size_t wheelset, wheelrail::Side side, double time) const {
  WheelOnLine out;
  out.travel = travel(time);
  const double speed = out.travel.speed;
  const auto body = static_cast<std::size_t>(wheelsets_[wheelset].body);
  const double s = setup_.start + out.travel.distance + bodies_[body].position.x();
  const bool left = side == wheelrail::Side::left;
  Along y, z, cross;
  if (setup_.path) {
    const PathPoint p = setup_.path->at(s);
    out.spin = speed * p.turn();
    out.curvature = p.turn().z();
    const double half = left ? -0.5 : 0.5;
    y = {half * (p.gauge.value - setup_.gauge_at_rest), half * p.gauge.first, half * p.gauge.second};
  }
  if (setup_.irregularities) {
    const RailOffsets rails = setup_.irregularities->at(s);
    const Along &by_y = left ? rails.left_y : rails.right_y, &by_z = left ? rails.left_z : rails.right_z;
    y.value += by_y.value, y.first += by_y.first, y.second += by_y.second;
    z = by_z;
    cross = {rails.right_z.value - rails.left_z.value, rails.right_z.first - rails.left_z.first, 0.0};
  }
  out.rail = {y.value,         z.value,         cross.value / setup_.base,
              speed * y.first, speed * z.first, speed * cross.first / setup_.base};
  for (std::size_t i = 0; i < shifts_.size(); ++i) {
    const RailShift& shift = setup_.rail_shifts[i];
    if (shift.wheelset && static_cast<std::size_t>(*shift.wheelset) != wheelset) continue;
    if (shift.left && *shift.left != left) continue;
    const Along at = shifts_[i].at(clock(time));
    const double speed_of = setup_.stays ? 0.0 : at.first;
    (shift.direction == Freedom::y ? out.rail.y : out.rail.z) += at.value;
    (shift.direction == Freedom::y ? out.rail.vy : out.rail.vz) += speed_of;
  }
  out.rail_yaw = y.first;
  out.curvature += y.second;
  return out;
}

Vector LineEffects::gyroscopic_change(const Vector& rates, double time) const {
  Vector force = Vector::Zero(size_);
  const double more = travel(time).speed - setup_.speed.speed.front();
  if (more == 0.0) return force;
  for (const Multibody::Wheelset& w : wheelsets_) {
    const int roll = w.coordinate[3], yaw = w.coordinate[5];
    if (roll < 0 || yaw < 0) continue;
    const double momentum = -bodies_[static_cast<std::size_t>(w.body)].inertia.y() * more / w.nominal_radius;
    force[roll] += momentum * rates[yaw];
    force[yaw] -= momentum * rates[roll];
  }
  return force;
}

}  // namespace treadmark::vehicle
