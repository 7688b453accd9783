// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/vehicle/multibody.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/vehicle/train.hpp"

namespace treadmark::vehicle {

namespace {

constexpr int kRotations = 3;             // freedoms from here on are rotations
constexpr double kAtmosphere = 101325.0;  // [Pa]
constexpr const char* kFreedomNames[] = {"x", "y", "z", "roll", "pitch", "yaw"};

/// A bending mode in one plane.
struct PlacedMode {
  const BendingMode* mode;
  Freedom plane;  ///< x or z
  int coordinate;
};

struct PlacedBody {
  BodySpec spec;
  std::array<int, kFreedoms> coordinate;
  bool axle_boxes = false;  ///< springs do not follow its pitch
  bool fixed_while_preloading = false;
  const FlexibleAxle* axle = nullptr;
  std::vector<PlacedMode> bending = {};
  std::vector<Multibody::Wheelset::Elastic> elastic = {};
};

/// Motion of the axle's section at y per unit of a bending mode's coordinate.
SixValues section_motion(const FlexibleAxle& axle, const PlacedMode& placed, double y) {
  const AxleDeflection at = deflection_at(axle, *placed.mode, y);
  SixValues motion{};
  if (placed.plane == Freedom::z) {
    motion[2] = at.displacement;
    motion[3] = at.slope;
  } else {
    motion[0] = at.displacement;
    motion[5] = -at.slope;
  }
  return motion;
}

/// A direction in which a spring or damper acts: relative displacement of b against a by the coordinates.
using Direction = std::vector<std::pair<int, double>>;

class Assembly {
 public:
  Assembly(const VehicleModel& vehicle, const std::optional<TrackModel>& track, double speed, double gravity)
      : speed_(speed), gravity_(gravity) {
    for (const BodySpec& body : vehicle.bodies) add_body(body, body.name, Vec3::Zero());
    for (const WheelsetSpec& w : vehicle.wheelsets) {
      PlacedBody& body = find(w.body, {});
      body.axle_boxes = body.fixed_while_preloading = true;
    }
    const std::size_t bodies = bodies_.size();
    const int vehicles = vehicle_count(vehicle);
    for (int v = 0; v < vehicles; ++v) add_vehicle(vehicle, track, v, bodies);
    for (std::size_t i = 0; i < bodies; ++i) {
      const PlacedBody& b = bodies_[i];
      system_.bodies.push_back({b.spec.name, b.spec.mass, b.spec.inertia, b.spec.position, b.coordinate, -1});
    }
    for (std::size_t i = 0; i < system_.wheelsets.size(); ++i)
      system_.bodies[static_cast<std::size_t>(system_.wheelsets[i].body)].wheelset = static_cast<int>(i);
    for (const CouplerSpec& coupler : vehicle.couplers) add_coupler(coupler);
    finish();
    add_pressures(vehicle.air_springs);
    system_.free_along = runs_free(vehicle);
  }

  Multibody take() { return std::move(system_); }

 private:
  struct Stop {
    Direction direction;
    const BumpStopSpec* spec;
    int link;
  };

  /// One vehicle of a train, so that its coordinates follow each other. bodies: number of those above the rails.
  void add_vehicle(const VehicleModel& train, const std::optional<TrackModel>& track, int number, std::size_t bodies) {
    const int first = static_cast<int>(inertia_.size());
    const auto own = [&](const auto& part) { return vehicle_of(part) == number; };
    for (std::size_t i = 0; i < bodies; ++i)
      if (bodies_[i].spec.vehicle == number) add_coordinates(i);
    for (const WheelsetSpec& w : train.wheelsets)
      if (PlacedBody& body = find(w.body, {}); w.axle && body.spec.vehicle == number) add_modes(*w.axle, body);
    for (const SpringSpec& spring : train.springs)
      if (own(spring)) add_spring(spring, "", Vec3::Zero());
    for (const BumpStopSpec& stop : train.bump_stops)
      if (own(stop)) add_stop(stop);
    for (const AirSpringSpec& air : train.air_springs)
      if (own(air)) add_air_spring(air);
    for (const DamperCurveSpec& damper : train.damper_curves)
      if (own(damper)) add_damper_curve(damper);
    for (const DryFrictionSpec& friction : train.frictions)
      if (own(friction)) add_friction(friction);
    for (std::size_t i = 0; i < train.wheelsets.size(); ++i)
      if (find(train.wheelsets[i].body, {}).spec.vehicle == number) add_wheelset(train.wheelsets[i], track, i);
    system_.vehicles.push_back({first, static_cast<int>(inertia_.size()) - first});
    if (system_.vehicles.back().size == 0)
      throw Error(ErrorKind::configuration, fmt::format("nothing moves in vehicle {} of the train", number + 1));
  }

  /// Which vehicle a part is in that connects bodies. Unknown bodies are refused by who looks for them next.
  template <class Part>
  int vehicle_of(const Part& part) const {
    const auto of = [&](const std::string& name) {
      const auto found = by_name_.find(name);
      return found == by_name_.end() ? -1 : bodies_[found->second].spec.vehicle;
    };
    const int a = of(part.body_a), b = of(part.body_b);
    if (a >= 0 && b >= 0 && a != b)
      throw Error(ErrorKind::configuration,
                  fmt::format("'{}' connects '{}' and '{}' of two vehicles", part.name, part.body_a, part.body_b),
                  part.where, "only couplers do");
    return std::max({a, b, 0});
  }

  void add_body(const BodySpec& spec, const std::string& name, const Vec3& offset) {
    PlacedBody body{spec, {}, false, false};
    body.spec.name = name;
    body.spec.position += offset;
    if (!by_name_.emplace(name, bodies_.size()).second)
      throw Error(ErrorKind::configuration, fmt::format("there are two bodies '{}'", name), spec.where);
    bodies_.push_back(std::move(body));
  }

  void add_coordinates(std::size_t index) {
    PlacedBody& body = bodies_[index];
    const BodySpec& spec = body.spec;
    for (int f = 0; f < kFreedoms; ++f) {
      const auto i = static_cast<std::size_t>(f);
      body.coordinate[i] = -1;
      if (!spec.free[i]) continue;
      const double inertia = f < kRotations ? spec.mass : spec.inertia[f - kRotations];
      if (!(inertia > 0.0))
        throw Error(ErrorKind::configuration,
                    fmt::format("body '{}' has no positive {} but may move in {}", spec.name,
                                f < kRotations ? "mass" : "moment of inertia", kFreedomNames[i]),
                    spec.where);
      body.coordinate[i] =
          add_coordinate(static_cast<int>(index), static_cast<Freedom>(f), spec.name + '.' + kFreedomNames[i], inertia);
    }
  }

  int add_coordinate(int body, Freedom freedom, std::string name, double inertia) {
    system_.coordinates.push_back({body, freedom, std::move(name),
                                   static_cast<int>(freedom) < kRotations ? 1.0 : kHalfGauge, false,
                                   static_cast<int>(system_.vehicles.size())});
    inertia_.push_back(inertia);
    return static_cast<int>(inertia_.size()) - 1;
  }

  /// Coordinates of a flexible wheelset's modes, with their own springs and dampers.
  void add_modes(const FlexibleAxle& axle, PlacedBody& body) {
    check_flexible(axle, body.spec);
    body.axle = &axle;
    // scale: displacement or rotation that a unit of the mode is worth.
    const auto add = [&](const std::string& name, Freedom freedom, double mass, double stiffness, double damping,
                         double scale) {
      const int body_index = system_.coordinates[static_cast<std::size_t>(body.coordinate[0])].body;
      const int c = add_coordinate(body_index, freedom, body.spec.name + '.' + name, mass);
      system_.coordinates.back().elastic = true;
      system_.coordinates.back().arm *= scale;
      terms_.push_back({{{c, 1.0}}, stiffness, false, -1, freedom});
      if (damping > 0.0) terms_.push_back({{{c, 1.0}}, damping, true, -1, freedom});
      body.elastic.push_back({c, {}});
      return c;
    };
    int number = 0;
    for (const BendingMode& m : axle.bending) {
      ++number;
      for (const Freedom plane : {Freedom::z, Freedom::x}) {
        const std::string name = fmt::format("bending{}_{}", number, plane == Freedom::z ? "vertical" : "horizontal");
        double scale = 0.0;
        for (const double w : m.shape) scale = std::max(scale, std::abs(w));
        for (const double slope : m.slope) scale = std::max(scale, kHalfGauge * std::abs(slope));
        body.bending.push_back({&m, plane, add(name, plane, m.mass, m.stiffness, m.damping, scale)});
        for (const std::size_t side : {0u, 1u}) {
          const double y = (side == 0 ? -0.5 : 0.5) * axle.wheel_distance;
          SixValues motion = section_motion(axle, body.bending.back(), y);
          // The rigid wheel's motion, taken on to the centre of the wheelset.
          motion[0] += motion[5] * y;
          motion[2] -= motion[3] * y;
          body.elastic.back().motion[side] = motion;
        }
      }
    }
    number = 0;
    for (const TorsionMode& m : axle.torsion) {
      const double scale = std::max(std::abs(m.wheel_rotation[0]), std::abs(m.wheel_rotation[1]));
      add(fmt::format("torsion{}", ++number), Freedom::pitch, m.inertia, m.stiffness, m.damping, scale);
      for (const std::size_t side : {0u, 1u}) body.elastic.back().motion[side][4] = m.wheel_rotation[side];
    }
  }

  static void check_flexible(const FlexibleAxle& axle, const BodySpec& spec) {
    check_axle(axle);
    for (int f = 0; f < kFreedoms; ++f)
      if (!spec.free[static_cast<std::size_t>(f)])
        throw Error(ErrorKind::configuration,
                    fmt::format("the wheelset '{}' with the flexible axle '{}' cannot move in {}", spec.name, axle.name,
                                kFreedomNames[f]),
                    spec.where, "the modes are those of a free wheelset: make it free in all directions");
    constexpr double kRounding = 1.0 + 1e-9;
    if (2.0 * axle.wheel_polar_inertia > kRounding * spec.inertia.y())
      throw Error(ErrorKind::configuration,
                  fmt::format("the two wheels of axle '{}' have {:.6g} kg m2 about it, the whole wheelset '{}' {:.6g}",
                              axle.name, 2.0 * axle.wheel_polar_inertia, spec.name, spec.inertia.y()),
                  axle.where);
  }

  PlacedBody& find(const std::string& name, const SourcePosition& where) {
    const auto found = by_name_.find(name);
    if (found == by_name_.end())
      throw Error(ErrorKind::configuration, fmt::format("there is no body '{}'", name), where);
    return bodies_[found->second];
  }

  /// Displacement of the body's point along (or rotation about) an axis.
  void add_point(const std::string& name, const std::string& suffix, const SourcePosition& where, const Vec3& point,
                 int freedom, double sign, Direction& direction) {
    if (name == kGround) return;
    const PlacedBody& body = find(name + suffix, where);
    const auto add = [&](int f, double factor) {
      if (f == static_cast<int>(Freedom::pitch) && body.axle_boxes) return;
      const int c = body.coordinate[static_cast<std::size_t>(f)];
      if (c >= 0 && factor != 0.0) direction.emplace_back(c, sign * factor);
    };
    add(freedom, 1.0);
    if (freedom >= kRotations) return;
    const Vec3 arm = point - body.spec.position, axis = Vec3::Unit(freedom);
    for (int r = 0; r < 3; ++r) add(kRotations + r, Vec3::Unit(r).cross(arm).dot(axis));
  }

  /// The same of the axle box at a point of a wheelset that bends. Twisting does not move boxes.
  void add_bending(const std::string& name, const std::string& suffix, const SourcePosition& where, const Vec3& point,
                   int freedom, double sign, Direction& direction) {
    if (name == kGround) return;
    const PlacedBody& body = find(name + suffix, where);
    for (const PlacedMode& placed : body.bending) {
      const Vec3 arm = point - body.spec.position;
      const std::vector<double>& places = body.axle->places;
      if (arm.y() < places.front() || arm.y() > places.back())
        throw Error(ErrorKind::configuration,
                    fmt::format("the shapes of axle '{}' go from y = {:.6g} to {:.6g} m, but '{}' is held at {:.6g} m",
                                body.axle->name, places.front(), places.back(), name, arm.y()),
                    where, "give the shapes at the axle boxes too");
      const SixValues motion = section_motion(*body.axle, placed, arm.y());
      double factor = motion[static_cast<std::size_t>(freedom)];
      const Vec3 from_section(arm.x(), 0.0, arm.z());
      if (freedom < kRotations)
        for (int r = 0; r < 3; ++r)
          factor += motion[kRotations + static_cast<std::size_t>(r)] *
                    Vec3::Unit(r).cross(from_section).dot(Vec3::Unit(freedom));
      if (factor != 0.0) direction.emplace_back(placed.coordinate, sign * factor);
    }
  }

  Direction relative(const std::string& a, const std::string& b, const std::string& suffix, const SourcePosition& where,
                     const Vec3& point, int freedom) {
    Direction direction;
    add_point(a, suffix, where, point, freedom, -1.0, direction);
    add_point(b, suffix, where, point, freedom, 1.0, direction);
    add_bending(a, suffix, where, point, freedom, -1.0, direction);
    add_bending(b, suffix, where, point, freedom, 1.0, direction);
    return direction;
  }

  void add_spring(const SpringSpec& spring, const std::string& suffix, const Vec3& offset) {
    const Vec3 point = spring.position + offset;
    const int link = suffix.empty() ? add_link(spring.body_a, spring.body_b, point, spring.name) : -1;
    for (int f = 0; f < kFreedoms; ++f) {
      const auto i = static_cast<std::size_t>(f);
      const double k = spring.stiffness[i], c = spring.damping[i], series = spring.damper_stiffness[i];
      if (k < 0.0 || c < 0.0 || series < 0.0)
        throw Error(ErrorKind::configuration,
                    fmt::format("spring '{}' has a negative stiffness or damping in {}", spring.name, kFreedomNames[i]),
                    spring.where);
      if (k == 0.0 && c == 0.0) continue;
      const Direction direction = relative(spring.body_a, spring.body_b, suffix, spring.where, point, f);
      if (k > 0.0) terms_.push_back({direction, k, false, link, static_cast<Freedom>(f)});
      if (c == 0.0) continue;
      if (series == 0.0) {
        terms_.push_back({direction, c, true, link, static_cast<Freedom>(f)});
        continue;
      }
      // Spring to the damper's inner end, which the damper ties to body a.
      add_in_series(direction, series, c, spring.name + suffix, link, static_cast<Freedom>(f));
    }
  }

  /// Of the vehicle that is being added.
  void add_column(ElementColumn column) {
    column.vehicle = static_cast<int>(system_.vehicles.size());
    system_.elements.columns.push_back(std::move(column));
  }

  /// The coordinate of the inner end.
  int add_in_series(Direction direction, double stiffness, double damping, const std::string& name, int link,
                    Freedom freedom) {
    const int inner =
        add_coordinate(-1, freedom, name + ".damper_" + kFreedomNames[static_cast<std::size_t>(freedom)], 0.0);
    direction.emplace_back(inner, -1.0);
    terms_.push_back({std::move(direction), stiffness, false, link, freedom});
    terms_.push_back({{{inner, 1.0}}, damping, true, -1, freedom});
    return inner;
  }

  void add_stop(const BumpStopSpec& stop) {
    stops_.push_back(
        {relative(stop.body_a, stop.body_b, "", stop.where, stop.position, static_cast<int>(stop.direction)), &stop,
         add_link(stop.body_a, stop.body_b, stop.position)});
  }

  void add_damper_curve(const DamperCurveSpec& damper) {
    Direction direction =
        relative(damper.body_a, damper.body_b, "", damper.where, damper.position, static_cast<int>(damper.direction));
    int link = add_link(damper.body_a, damper.body_b, damper.position);
    DamperCurve curve{damper.name, system_.elements.size(), {damper.velocity, damper.force}, 0.0};
    if (damper.series_stiffness > 0.0) {
      // The inner end, which has no mass, needs a linear damper: as much as there is at all speeds.
      curve.linear = least_slope(curve.whole);
      if (!(curve.linear > 0.0))
        throw Error(ErrorKind::configuration,
                    fmt::format("the force of damper '{}' with a spring in series must increase", damper.name),
                    damper.where);
      const int inner = add_in_series(std::move(direction), damper.series_stiffness, curve.linear, damper.name, link,
                                      damper.direction);
      direction = {{inner, 1.0}};
      link = -1;
    }
    add_column({std::move(direction), link, damper.direction});
    system_.elements.dampers.push_back(std::move(curve));
  }

  void add_air_spring(const AirSpringSpec& spec) {
    constexpr double kDensityByPressure = 1.0 / (287.0 * 293.0);  // of air at 20 degrees Celsius [kg/J]
    const auto positive = [](double v) { return v > 0.0 && std::isfinite(v); };
    if (!positive(spec.load) || !positive(spec.area) || !positive(spec.bellows) || !(spec.exponent >= 1.0) ||
        (spec.reservoir > 0.0 && (!positive(spec.orifice) || !positive(spec.loss))))
      throw Error(
          ErrorKind::configuration,
          fmt::format("air spring '{}' needs a load, an area, a volume, and an orifice with a loss where it has "
                      "a reservoir",
                      spec.name),
          spec.where);
    constexpr int kZ = static_cast<int>(Freedom::z);
    const Direction direction = relative(spec.body_a, spec.body_b, "", spec.where, spec.position, kZ);
    const int link = add_link(spec.body_a, spec.body_b, spec.position, spec.name);
    AirSpring air{spec.name, system_.elements.size(), spec.area, spec.bellows, spec.reservoir, spec.exponent};
    const double pressure = kAtmosphere + spec.load / spec.area;
    air.linear = spec.exponent * pressure * spec.area * spec.area / (spec.bellows + spec.reservoir);
    if (spec.reservoir > 0.0) {
      const double hole = 0.25 * kPi * spec.orifice * spec.orifice;
      air.resistance = 0.5 * spec.loss * kDensityByPressure * pressure / (hole * hole);
    }
    terms_.push_back({direction, air.linear, false, link, Freedom::z});
    add_column({direction, link, Freedom::z});
    system_.elements.air_springs.push_back(std::move(air));
  }

  /// Which way air springs are compressed, and their pressures: known once springs bear their preloads.
  void add_pressures(const std::vector<AirSpringSpec>& specs) {
    for (std::size_t i = 0; i < specs.size(); ++i) {
      AirSpring& air = system_.elements.air_springs[i];
      ElementColumn& column = system_.elements.columns[static_cast<std::size_t>(air.column)];
      const double preload = system_.links[static_cast<std::size_t>(column.link)].preload;
      constexpr double kNothing = 1e-6;  // of the load that it was given
      if (!(std::abs(preload) > kNothing * specs[i].load))
        throw Error(ErrorKind::configuration, fmt::format("nothing lies on air spring '{}'", air.name), specs[i].where);
      air.pressure = kAtmosphere + std::abs(preload) / air.area;
      if (preload < 0.0) continue;  // b lies on a: it is compressed as b comes down
      column.arm = -1.0;
      for (auto& [c, factor] : column.direction) factor = -factor;
    }
  }

  static double least_slope(const ForceCurve& curve) {
    double least = value_at(curve, 0.0).slope;
    for (std::size_t i = 0; i + 1 < curve.at.size(); ++i)
      least = std::min(least, (curve.force[i + 1] - curve.force[i]) / (curve.at[i + 1] - curve.at[i]));
    return least;
  }

  void add_friction(const DryFrictionSpec& spec) {
    ForceElements& elements = system_.elements;
    DryFriction friction{
        spec.name,         elements.size(),  0,
        spec.stiffness,    spec.damping,     {spec.coefficient, spec.coefficient_back.value_or(spec.coefficient)},
        spec.static_ratio, spec.normal_force};
    const int link = add_link(spec.body_a, spec.body_b, spec.position);
    for (int f = 0; f < kFreedoms; ++f) {
      if (!spec.directions[static_cast<std::size_t>(f)]) continue;
      ElementColumn column{relative(spec.body_a, spec.body_b, "", spec.where, spec.position, f), link,
                           static_cast<Freedom>(f), f < kRotations ? 1.0 : spec.arm};
      for (auto& [c, factor] : column.direction) factor *= column.arm;
      add_column(std::move(column));
      ++friction.directions;
    }
    if (!(spec.stiffness > 0.0) || friction.directions < 1 || friction.directions > 2)
      throw Error(ErrorKind::configuration,
                  fmt::format("friction '{}' needs one or two directions and a positive stiffness", spec.name),
                  spec.where);
    elements.frictions.push_back(std::move(friction));
    if (!spec.load_of.empty()) loads_.push_back({elements.frictions.size() - 1, &spec});
  }

  /// Friction in a coupler is pressed by its spring.
  void add_coupler(const CouplerSpec& spec) {
    const PlacedBody &rear = find(spec.rear, spec.where), &front = find(spec.front, spec.where);
    if (rear.spec.vehicle == front.spec.vehicle)
      throw Error(ErrorKind::configuration,
                  fmt::format("the coupler '{}' connects two bodies of one vehicle", spec.name), spec.where);
    if (spec.travel.size() < 2 || spec.travel.size() != spec.force.size() || !(spec.slack >= 0.0) ||
        (spec.friction > 0.0 && !(spec.friction_stiffness > 0.0)))
      throw Error(ErrorKind::configuration,
                  fmt::format("coupler '{}' needs a force at each of two travels or more, a free play that is not "
                              "negative, and with friction its stiffness",
                              spec.name),
                  spec.where);
    constexpr int kX = static_cast<int>(Freedom::x);
    ElementColumn column{{}, add_link(spec.rear, spec.front, spec.position), Freedom::x, 1.0, -1};
    add_point(spec.rear, "", spec.where, spec.position, kX, -1.0, column.direction);
    add_point(spec.front, "", spec.where, spec.position, kX, 1.0, column.direction);
    ForceElements& elements = system_.elements;
    Coupler coupler{spec.name, elements.size(), {spec.travel, spec.force}, spec.damping};
    for (double& at : coupler.spring.at) at += 0.5 * spec.slack;
    elements.columns.push_back(column);
    if (spec.friction > 0.0) {
      coupler.friction = elements.size();
      DryFriction friction{spec.name, elements.size(), 1, spec.friction_stiffness, 0.0, {spec.friction, spec.friction}};
      friction.load = coupler.column;
      friction.by_load = 1.0;
      friction.stop = coupler.spring;
      elements.columns.push_back(std::move(column));
      elements.frictions.push_back(std::move(friction));
    }
    elements.couplers.push_back(std::move(coupler));
  }

  /// What presses frictions: known once springs bear their preloads.
  void add_loads() {
    for (const Load& load : loads_) {
      DryFriction& friction = system_.elements.frictions[load.friction];
      const DryFrictionSpec& spec = *load.spec;
      const auto fail = [&](std::string_view what) {
        throw Error(ErrorKind::configuration, fmt::format("friction '{}': {} '{}'", spec.name, what, spec.load_of),
                    spec.where, "load_of names a spring that bears a load at rest, or a bump stop");
      };
      friction.load = system_.elements.size();
      const int vehicle = system_.elements.columns[static_cast<std::size_t>(friction.first)].vehicle;
      const auto spring = std::find_if(system_.links.begin(), system_.links.end(),
                                       [&](const Multibody::Link& l) { return l.spring == spec.load_of; });
      if (spring == system_.links.end()) {
        const auto stop =
            std::find_if(stops_.begin(), stops_.end(), [&](const Stop& s) { return s.spec->name == spec.load_of; });
        if (stop == stops_.end()) fail("there is no spring or bump stop");
        friction.by_load = spec.load_share;
        friction.stop = ForceCurve{stop->spec->displacement, stop->spec->force, stop->spec->odd};
        system_.elements.columns.push_back({stop->direction, stop->link, stop->spec->direction, 1.0, vehicle});
        continue;
      }
      const int link = static_cast<int>(spring - system_.links.begin());
      const auto term = std::find_if(terms_.begin(), terms_.end(), [&](const Term& t) {
        return !t.damper && t.link == link && t.freedom == Freedom::z;
      });
      if (term == terms_.end() || spring->preload == 0.0) fail("nothing lies on spring");
      // The force on b along z is preload - stiffness * stretch.
      friction.normal_force += spec.load_share * std::abs(spring->preload);
      friction.by_load = -std::copysign(spec.load_share * term->value, spring->preload);
      system_.elements.columns.push_back({term->direction, link, Freedom::z, 1.0, vehicle});
    }
  }

  /// Errors about names come from who looks for its bodies next.
  int add_link(const std::string& a, const std::string& b, const Vec3& point, const std::string& spring = {}) {
    const auto index = [&](const std::string& name) {
      const auto found = by_name_.find(name);
      return found == by_name_.end() ? -1 : static_cast<int>(found->second);
    };
    system_.links.push_back({index(a), index(b), point, 0.0, spring});
    return static_cast<int>(system_.links.size()) - 1;
  }

  void add_wheelset(const WheelsetSpec& spec, const std::optional<TrackModel>& track, std::size_t number) {
    const PlacedBody& body = find(spec.body, {});
    if (system_.wheelsets.size() != number)
      throw Error(ErrorKind::configuration, "the wheelsets of a train are not in the order of its vehicles");
    Multibody::Wheelset w{body.coordinate,   spec.nominal_radius, -1, -1, static_cast<int>(by_name_.at(spec.body)),
                          body.spec.vehicle, body.elastic};
    const Vec3 below(body.spec.position.x(), 0.0, 0.0);
    if (track) {
      const std::string suffix = '@' + std::to_string(number + 1);
      for (const BodySpec& b : track->bodies) {
        add_body(b, b.name + suffix, below);
        add_coordinates(bodies_.size() - 1);
      }
      for (const SpringSpec& spring : track->springs) add_spring(spring, suffix, below);
      const auto rail = [&](const std::string& name) {
        if (name.empty()) return -1;
        const PlacedBody& r = find(name + suffix, {});
        system_.rails.push_back({{r.coordinate[1], r.coordinate[2], r.coordinate[3]}, r.spec.position - below});
        return static_cast<int>(system_.rails.size()) - 1;
      };
      w.left_rail = rail(track->left_rail);
      w.right_rail = rail(track->right_rail);
    }
    system_.wheelsets.push_back(w);
  }

  /// Of a direction whose coordinates are all of one vehicle: over these.
  CharacteristicForce spread(const Stop& stop) const {
    CharacteristicForce out{{},
                            {stop.spec->displacement, stop.spec->force, stop.spec->odd},
                            stop.link,
                            stop.spec->direction,
                            vehicle_of(*stop.spec)};
    const Multibody::Range& vehicle = system_.vehicles[static_cast<std::size_t>(out.vehicle)];
    out.direction = Vector::Zero(vehicle.size);
    for (const auto& [c, factor] : stop.direction) out.direction[c - vehicle.first] += factor;
    return out;
  }

  void finish() {
    const auto n = static_cast<Eigen::Index>(inertia_.size());
    system_.mass = Eigen::Map<const Vector>(inertia_.data(), n);
    system_.stiffness = Matrix::Zero(n, n);
    system_.dissipation = Matrix::Zero(n, n);
    for (const Term& term : terms_) {
      Matrix& target = term.damper ? system_.dissipation : system_.stiffness;
      for (const auto& [i, a] : term.direction)
        for (const auto& [j, b] : term.direction) target(i, j) += term.value * a * b;
    }
    system_.damping = system_.dissipation;
    for (const Multibody::Wheelset& w : system_.wheelsets) couple_roll_and_yaw(w);
    for (const Multibody::Wheelset& w : system_.wheelsets)
      if (!w.elastic.empty()) couple_bending(w);
    for (const Stop& stop : stops_) system_.characteristics.push_back(spread(stop));
    balance_weight();
    add_loads();
    for (std::size_t link = 0; link < system_.links.size(); ++link) let_lean(link);
  }

  /// Angular momentum of a wheel set that turns with -V/R about an axle which rolls and yaws.
  void couple_roll_and_yaw(const Multibody::Wheelset& w) {
    const int roll = w.coordinate[3], yaw = w.coordinate[5];
    if (roll < 0 || yaw < 0) return;
    const PlacedBody& body =
        bodies_[static_cast<std::size_t>(system_.coordinates[static_cast<std::size_t>(roll)].body)];
    const double momentum = body.spec.inertia.y() * -speed_ / w.nominal_radius;
    system_.damping(roll, yaw) -= momentum;
    system_.damping(yaw, roll) += momentum;
  }

  /// The same of wheels whose axle bends: each turns with its own roll and yaw. What is between them has been counted.
  void couple_bending(const Multibody::Wheelset& w) {
    const int roll = w.coordinate[3], yaw = w.coordinate[5];
    const PlacedBody& body =
        bodies_[static_cast<std::size_t>(system_.coordinates[static_cast<std::size_t>(roll)].body)];
    const double momentum = body.axle->wheel_polar_inertia * -speed_ / w.nominal_radius;
    for (const std::size_t side : {0u, 1u}) {
      Direction rolls{{roll, 1.0}}, yaws{{yaw, 1.0}};
      for (const Multibody::Wheelset::Elastic& mode : w.elastic) {
        rolls.emplace_back(mode.coordinate, mode.motion[side][3]);
        yaws.emplace_back(mode.coordinate, mode.motion[side][5]);
      }
      for (const auto& [i, a] : rolls)
        for (const auto& [j, b] : yaws) {
          if (i == roll && j == yaw) continue;
          system_.damping(i, j) -= momentum * a * b;
          system_.damping(j, i) += momentum * a * b;
        }
    }
  }

  bool is_sprung(Eigen::Index i) const {
    const int body = system_.coordinates[static_cast<std::size_t>(i)].body;
    return body < 0 || !bodies_[static_cast<std::size_t>(body)].fixed_while_preloading;
  }

  /// Displacements q by which the springs of a vehicle bear the weights.
  void bear(const Multibody::Range& vehicle, const Vector& weight, Vector& q) const {
    std::vector<Eigen::Index> sprung;
    for (Eigen::Index i = vehicle.first; i < vehicle.first + vehicle.size; ++i)
      if (is_sprung(i)) sprung.push_back(i);
    // Inner ends of dampers and directions without springs bear nothing.
    const Matrix k = system_.stiffness(sprung, sprung);
    const Vector borne = sprung.empty() ? Vector() : Vector(k.completeOrthogonalDecomposition().solve(weight(sprung)));
    const Vector left = weight(sprung) - k * borne;
    for (Eigen::Index i = 0; i < left.size(); ++i)
      if (std::abs(left[i]) > 1e-6 * (1.0 + weight.cwiseAbs().maxCoeff()))
        throw Error(
            ErrorKind::configuration,
            fmt::format("nothing bears the weight at {}",
                        system_.coordinates[static_cast<std::size_t>(sprung[static_cast<std::size_t>(i)])].name),
            {}, "a spring is missing");
    for (std::size_t i = 0; i < sprung.size(); ++i) q[sprung[i]] = borne[static_cast<Eigen::Index>(i)];
  }

  /// Springs bear the weight of what is not a wheelset; the rest is left to the wheelsets' contact.
  void balance_weight() {
    const Eigen::Index n = system_.mass.size();
    Vector weight = Vector::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Coordinate& c = system_.coordinates[static_cast<std::size_t>(i)];
      if (c.body >= 0 && c.freedom == Freedom::z && !c.elastic)
        weight[i] = inertia_[static_cast<std::size_t>(i)] * gravity_;
    }
    Vector q = Vector::Zero(n);
    for (const Multibody::Range& vehicle : system_.vehicles) bear(vehicle, weight, q);
    system_.weight = weight - system_.stiffness * q;
    for (Eigen::Index i = 0; i < n; ++i)
      if (is_sprung(i)) system_.weight[i] = 0.0;
    for (const Term& term : terms_) {
      if (term.link < 0) continue;
      const auto link = static_cast<std::size_t>(term.link);
      if (!term.damper && term.freedom == Freedom::z)
        for (const auto& [c, factor] : term.direction) system_.links[link].preload -= term.value * factor * q[c];
      system_.stretches.push_back({term.link, term.freedom, term.direction, term.value, term.damper});
    }
    for (const Multibody::Wheelset& w : system_.wheelsets) {
      const int z = w.coordinate[2];
      if (z < 0) throw Error(ErrorKind::configuration, "a wheelset must be free to move in z");
      system_.wheelset_load.push_back(system_.weight[z]);
    }
  }

  /// Second order of the potential of a link's preload P, which acts on b along z': -P z' . (x_b - x_a).
  void let_lean(std::size_t number) {
    const Multibody::Link& link = system_.links[number];
    const double preload = link.preload;
    if (preload == 0.0) return;
    const auto add_arm = [&](int index, double force) {
      if (index < 0) return;
      const PlacedBody& body = bodies_[static_cast<std::size_t>(index)];
      const double below = link.point.z() - body.spec.position.z();
      for (const Freedom f : {Freedom::roll, Freedom::pitch}) {
        const int c = body.coordinate[static_cast<std::size_t>(f)];
        if (c < 0 || (f == Freedom::pitch && body.axle_boxes)) continue;
        system_.stiffness(c, c) += force * below;
      }
    };
    add_arm(link.a, -preload);
    add_arm(link.b, preload);
    // z' = z + turn x z.
    add_leaning(number, Freedom::x, Freedom::pitch, -preload);
    add_leaning(number, Freedom::y, Freedom::roll, preload);
  }

  void add_leaning(std::size_t number, Freedom aside, Freedom turn, double value) {
    const Multibody::Link& link = system_.links[number];
    Multibody::Leaning leaning{static_cast<int>(number), aside, {}, {}, value};
    const auto holds_pitch = [&](int index) {
      return index >= 0 && bodies_[static_cast<std::size_t>(index)].axle_boxes && turn == Freedom::pitch;
    };
    for (const auto& [index, other, sign] : {std::tuple{link.a, link.b, -1.0}, {link.b, link.a, 1.0}}) {
      if (index < 0) continue;
      const std::string& name = bodies_[static_cast<std::size_t>(index)].spec.name;
      // What does not turn with an axle is held by what it is on.
      const double share = holds_pitch(index) ? 0.0 : holds_pitch(other) ? 1.0 : 0.5;
      add_point(name, "", {}, link.point, static_cast<int>(aside), sign, leaning.direction);
      if (share == 0.0) continue;
      add_point(name, "", {}, link.point, static_cast<int>(turn), share, leaning.turn);
    }
    for (const auto& [i, a] : leaning.turn)
      for (const auto& [j, b] : leaning.direction) {
        system_.stiffness(i, j) += value * a * b;
        system_.stiffness(j, i) += value * a * b;
      }
    if (!leaning.turn.empty()) system_.leanings.push_back(std::move(leaning));
  }

  struct Term {
    Direction direction;
    double value;
    bool damper;
    int link;  ///< -1: nothing above the rails
    Freedom freedom;
  };
  double speed_, gravity_;
  Multibody system_;
  std::vector<double> inertia_;
  std::vector<PlacedBody> bodies_;
  std::map<std::string, std::size_t> by_name_;
  std::vector<Term> terms_;
  std::vector<Stop> stops_;
  struct Load {
    std::size_t friction;
    const DryFrictionSpec* spec;
  };
  std::vector<Load> loads_;
};

}  // namespace

Multibody assemble(const VehicleModel& vehicle, const std::optional<TrackModel>& track, double speed, double gravity) {
  if (vehicle.wheelsets.empty()) throw Error(ErrorKind::configuration, "the vehicle has no wheelset");
  return Assembly(vehicle, track, speed, gravity).take();
}

Vector running_ahead(const Multibody& system) {
  if (!system.free_along) return {};
  Vector way = Vector::Zero(system.size());
  for (const Multibody::Body& b : system.bodies)
    if (b.coordinate[0] >= 0) way[b.coordinate[0]] = 1.0;
  for (const Multibody::Wheelset& w : system.wheelsets)
    if (w.coordinate[0] >= 0 && w.coordinate[4] >= 0) way[w.coordinate[4]] = -1.0 / w.nominal_radius;
  return way;
}

Vector Multibody::times(const Matrix& matrix, const Vector& v) const {
  Vector out(v.size());
  for (const Range& r : vehicles) part_of(out, r).noalias() = block_of(matrix, r) * part_of(v, r);
  return out;
}

std::vector<Multibody::Range> independent_parts(const Multibody& system, const Matrix& one, const Matrix& other) {
  std::vector<Multibody::Range> parts;
  for (const Multibody::Range& r : system.vehicles) {
    const auto couples = [&](const Matrix& m) {
      const Eigen::Index before = r.first, rest = m.rows() - before;
      return !m.bottomLeftCorner(rest, before).isZero(0.0) || !m.topRightCorner(before, rest).isZero(0.0);
    };
    if (!parts.empty() && (couples(one) || couples(other)))
      parts.back().size += r.size;
    else
      parts.push_back(r);
  }
  return parts;
}

double displacement(const Multibody& system, const CharacteristicForce& force, const Vector& q) {
  return force.direction.dot(part_of(q, system.vehicles[static_cast<std::size_t>(force.vehicle)]));
}

Vector characteristic_forces(const Multibody& system, const Vector& q, double* energy,
                             const std::vector<double>* offsets) {
  Vector forces = Vector::Zero(q.size());
  for (std::size_t i = 0; i < system.characteristics.size(); ++i) {
    const CharacteristicForce& c = system.characteristics[i];
    const CurveValue value = value_at(c.curve, displacement(system, c, q) + (offsets ? offsets->at(i) : 0.0));
    part_of(forces, system.vehicles[static_cast<std::size_t>(c.vehicle)]) -= value.force * c.direction;
    if (energy) *energy += value.integral;
  }
  return forces;
}

Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic> pair_map(const Multibody& system, int wheelset,
                                                                 wheelrail::Side side, const Vec3& rail_marker) {
  Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic> map(static_cast<Eigen::Index>(kPairCoordinates),
                                                              system.mass.size());
  map.setZero();
  const Multibody::Wheelset& w = system.wheelsets.at(static_cast<std::size_t>(wheelset));
  for (int f = 0; f < kFreedoms; ++f)
    if (const int c = w.coordinate[static_cast<std::size_t>(f)]; c >= 0) map(f, c) = 1.0;
  for (const Multibody::Wheelset::Elastic& mode : w.elastic)
    for (int f = 0; f < kFreedoms; ++f)
      map(f, mode.coordinate) = mode.motion[side == wheelrail::Side::left ? 0 : 1][static_cast<std::size_t>(f)];
  const int index = side == wheelrail::Side::left ? w.left_rail : w.right_rail;
  if (index < 0) return map;
  const Multibody::Rail& rail = system.rails[static_cast<std::size_t>(index)];
  const Vec3 arm = rail_marker - rail.centre;
  const auto [y, z, roll] = rail.coordinate;
  if (y >= 0) map(6, y) = 1.0;
  if (z >= 0) map(7, z) = 1.0;
  if (roll >= 0) {
    map(6, roll) = -arm.z();
    map(7, roll) = arm.y();
    map(8, roll) = 1.0;
  }
  return map;
}

namespace {

/// Axes of the rates of roll, pitch and yaw: orientations are composed as roll, yaw, pitch.
struct WheelsetAxes {
  Vec3 roll = Vec3::UnitX(), pitch, yaw;
  explicit WheelsetAxes(const wheelrail::SixMotion& q) {
    const Mat3 rolled = rotation_x(q.roll);
    yaw = rolled.col(2);
    pitch = (rolled * rotation_z(q.yaw)).col(1);
  }
};

}  // namespace

PairVector generalised_force(const ContactReaction& reaction, const PairMotion& motion) {
  const WheelsetAxes axes(motion.wheelset);
  const auto& [force, moment] = reaction.on_wheelset;
  PairVector f;
  f << force, moment.dot(axes.roll), moment.dot(axes.pitch), moment.dot(axes.yaw), reaction.on_rail.force.y(),
      reaction.on_rail.force.z(), reaction.on_rail.moment.x();
  return f;
}

PairTangent pair_tangent(const ContactReaction& reaction, const PairMotion& motion, const Vec3& rail_marker,
                         double radius) {
  const WheelsetAxes axes(motion.wheelset);
  const Vec3 centre(0.0, motion.wheelset.y, motion.wheelset.z - radius);
  const Vec3 marker = rail_marker + Vec3(0.0, motion.rail.y, motion.rail.z);
  PairTangent tangent;
  for (const PatchTangent& patch : reaction.tangents) {
    // Displacement of the wheel at the contact against the rail, by the nine coordinates.
    Eigen::Matrix<double, 3, kPairCoordinates> relative = Eigen::Matrix<double, 3, kPairCoordinates>::Zero();
    const Vec3 arm = patch.X_TC.origin - centre;
    relative.leftCols<3>().setIdentity();
    relative.col(3) = axes.roll.cross(arm);
    relative.col(4) = axes.pitch.cross(arm);
    relative.col(5) = axes.yaw.cross(arm);
    relative.col(6) = -Vec3::UnitY();
    relative.col(7) = -Vec3::UnitZ();
    relative.col(8) = -Vec3::UnitX().cross(Vec3(patch.X_TC.origin - marker));
    const Eigen::Matrix<double, 3, kPairCoordinates> in_contact = patch.X_TC.rotation.transpose() * relative;
    const Vec3 stiffness(0.0, 0.0, patch.stiffness_n), damping(patch.damping_x, patch.damping_s, 0.0);
    tangent.stiffness += in_contact.transpose() * stiffness.asDiagonal() * in_contact;
    tangent.damping += in_contact.transpose() * damping.asDiagonal() * in_contact;
  }
  return tangent;
}

}  // namespace treadmark::vehicle
