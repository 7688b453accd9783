// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/pair_step.hpp"
#include "treadmark/solvers/wheelrail/rail_memory.hpp"

namespace treadmark::wheelrail {
namespace {

using kalker::Quantity;

[[noreturn]] void refuse_neighbours(const char* message, const char* advice) {
  throw Error(ErrorKind::configuration, message, {}, advice);
}

/// What forces of a patch follow from, or how it changes with a parameter.
struct PatchState {
  std::vector<double> gap;  ///< on elements that go along with the contact plane [m]
  Vec3 origin = Vec3::Zero();
  double angle = 0.0, reference_s = 0.0;
  double xi = 0.0, eta = 0.0, phi = 0.0, velocity = 0.0;
  double friction = 0.0;

  PatchState& add(double factor, const PatchState& other) {
    gap.resize(other.gap.size());
    for (std::size_t i = 0; i < gap.size(); ++i) gap[i] += factor * other.gap[i];
    origin += factor * other.origin;
    for (double PatchState::*number : {&PatchState::angle, &PatchState::reference_s, &PatchState::xi, &PatchState::eta,
                                       &PatchState::phi, &PatchState::velocity, &PatchState::friction})
      this->*number += factor * other.*number;
    return *this;
  }
};
using PairState = std::vector<PatchState>;

void add_change(PairState& to, double factor, const PairState& other) {
  to.resize(other.size());
  for (std::size_t k = 0; k < to.size(); ++k) to[k].add(factor, other[k]);
}

/// PatchNumbers of a patch that follow from its state, by derivatives that are found once for all parameters.
constexpr std::array kNumbers{Quantity::force_n,  Quantity::max_pressure,   Quantity::middle_x,
                              Quantity::middle_y, Quantity::elastic_energy, Quantity::force_x,
                              Quantity::force_y,  Quantity::moment_n,       Quantity::frictional_power};
constexpr std::size_t place_of(Quantity quantity) {
  return static_cast<std::size_t>(std::find(kNumbers.begin(), kNumbers.end(), quantity) - kNumbers.begin());
}
using PatchNumbers = std::array<double, kNumbers.size()>;
double number_of(const PatchNumbers& numbers, Quantity quantity) { return numbers[place_of(quantity)]; }

/// A problem of the right-hand side with its surfaces.
struct Given {
  Problem problem;
  Geometry geometry;
};

class Tangents {
 public:
  Tangents(Given given, const detection::BodyPair& bodies, const PairSolution& solution,
           std::vector<kalker::ContactSolver>& solvers)
      : given_(std::move(given)), bodies_(bodies), solution_(solution) {
    given_.problem.state.velocity.pitch = solution.pitch_rate;
    while (solvers.size() < solution.patches.size()) solvers.emplace_back();
    for (std::size_t k = 0; k < solution.patches.size(); ++k) {
      const PatchSolution& patch = solution.patches[k];
      deepest_.push_back(static_cast<std::size_t>(
          std::min_element(patch.distance.begin(), patch.distance.end(),
                           [](double a, double b) { return a < b || (std::isnan(b) && !std::isnan(a)); }) -
          patch.distance.begin()));
      kalker::ContactProblem problem = contact_problem_of(given_.problem, patch);
      problem.sub_patches.count = static_cast<int>(patch.region.parts.size());
      auto& gradients = gradients_.emplace_back();
      for (const Quantity number : kNumbers) {
        gradients.push_back(solvers[k].gradient(problem, patch.contact, number));
        note(gradients.back().report);
      }
    }
    if (!balanced()) return;
    constexpr double kStep = 5e-8;  // [m], of penetrations of some hundredths of a millimetre
    std::optional<PairState> lower = state(given_, bodies_, solution.z + kStep),
                             higher = state(given_, bodies_, solution.z - kStep);
    if (!lower || !higher) {
      fail();
      return;
    }
    add_change(by_height_, 0.5 / kStep, *lower);
    add_change(by_height_, -0.5 / kStep, *higher);
    stiffness_ = vertical(by_height_);
    if (!(stiffness_ > 0.0)) fail();
  }

  bool balanced() const { return given_.problem.vertical_force.has_value(); }

  /// more and less: what is given with the parameter changed by the step.
  PairNeighbours beside(const PairParameter& parameter, const Given& more, const Given& less, double step) const {
    PairNeighbours out;
    out.step = step;
    out.report = report_;
    if (report_.status != Status::ok) return out;
    const double z = solution_.z;
    const auto height = [&](const Given& g) { return balanced() ? z : g.problem.state.position.z; };
    std::optional<PairState> above = state(more, bodies_of(more), height(more)),
                             below = state(less, bodies_of(less), height(less));
    if (!above || !below) {
      out.report.status = Status::failed;
      out.report.message = "contact comes or goes where the number changes: there is no derivative";
      return out;
    }
    PairState change;
    add_change(change, 0.5 / step, *above);
    add_change(change, -0.5 / step, *below);
    if (parameter.shape_of) out.heights = take_heights(parameter, {more, *above}, {less, *below}, step, change);
    double dz = 0.5 / step * (height(more) - height(less));
    if (balanced()) {
      const double load = 0.5 / step * (*more.problem.vertical_force - *less.problem.vertical_force);
      dz = (load - vertical(change)) / stiffness_;
      add_change(change, dz, by_height_);
    }
    out.more = neighbour(more, change, step, z + step * dz);
    out.less = neighbour(less, change, -step, z - step * dz);
    return out;
  }

 private:
  void note(const Report& found) {
    if (report_.status == Status::ok) report_ = found;
  }
  void fail() {
    report_.status = Status::failed;
    report_.message = "contact comes or goes with the height of the wheel: there are no derivatives";
  }

  detection::BodyPair bodies_of(const Given& given) const {
    const Geometry& g = given.geometry;
    detection::BodyPair bodies = bodies_;
    bodies.rail = g.rail.get();
    if (g.wheel == given_.geometry.wheel) return bodies;
    bodies.wheel = g.wheel.get();
    bodies.wheel_profile = detection::whole_profile(*g.wheel);
    bodies.wheel_lines = nullptr;
    return bodies;
  }

  /// With the wheelset at height z; nothing where fewer patches are found.
  std::optional<PairState> state(const Given& given, const detection::BodyPair& bodies, double z) const {
    const Problem& p = given.problem;
    RailMemory memory(*given.geometry.rail);
    std::vector<kalker::ContactSolver> none;
    PhaseTimes times;
    const Instant before;
    PairStep step(given.geometry, p, before, none, none, times, bodies, memory);
    if (!step.place(0.0)) return std::nullopt;
    std::vector<LaidPatch> laid = step.lay(z, solution_.patches);
    if (laid.size() < solution_.patches.size()) return std::nullopt;
    PairState out;
    for (std::size_t k = 0; k < laid.size(); ++k) {
      const detection::ContactFrame& frame = laid[k].frame;
      PatchState& s = out.emplace_back();
      s.gap = std::move(laid[k].gap);
      s.origin = frame.X_TC.origin, s.angle = frame.angle, s.reference_s = laid[k].reference_s;
      const ContactKinematics motion = contact_kinematics(p, step.placement(), frame.X_TC, -s.gap[deepest_[k]]);
      s.xi = motion.xi, s.eta = motion.eta, s.phi = motion.phi, s.velocity = motion.velocity;
      s.friction = friction_at(p.friction_inclination, p.friction_laws, frame.angle, p.friction).static_friction();
    }
    return out;
  }

  struct Changed {
    const Given& given;
    const PairState& state;
  };

  /// Gaps of the surfaces as they are, over the planes and with the bodies placed as they are with a number changed: a
  /// rail whose top or gauge point moves is placed elsewhere.
  std::vector<std::vector<double>> gaps_moved(const Changed& changed) const {
    Problem p = changed.given.problem;
    if (balanced()) p.state.position.z = solution_.z;
    const Placement placed = place(changed.given.geometry, p);
    detection::BodyPair bodies = bodies_;
    bodies.X_TR = placed.X_TS, bodies.X_TW = placed.X_TA;
    std::vector<std::vector<double>> gaps;
    for (std::size_t k = 0; k < changed.state.size(); ++k) {
      const PatchState& s = changed.state[k];
      detection::UndeformedDistance u =
          detection::undeformed_distance(bodies, {s.origin, rotation_x(s.angle)}, solution_.patches[k].grid);
      for (double& h : u.distance) h -= u.approach;
      gaps.push_back(std::move(u.distance));
    }
    return gaps;
  }

  /// Gaps as they change with the heights over planes that stay, and with planes and bodies that move while surfaces
  /// stay; where heights are differenced, gaps are as they were.
  HeightsBy take_heights(const PairParameter& parameter, const Changed& above, const Changed& below, double step,
                         PairState& change) const {
    if (bodies_.distance_mesh || given_.problem.solver.conventions == Conventions::contact)
      return HeightsBy::differences;
    const bool rail = *parameter.shape_of == Facing::up;
    const Surface& surface = rail ? *given_.geometry.rail : *given_.geometry.wheel;
    const Pose X_ST = (rail ? solution_.placement.X_TS : solution_.placement.X_TA).inverse();
    std::vector<std::vector<double>> by(change.size());
    for (std::size_t k = 0; k < change.size(); ++k) {
      const PatchSolution& patch = solution_.patches[k];
      by[k].resize(patch.grid.size());
      if (surface.heights_by(parameter.shape, {X_ST * patch.frame.X_TC, patch.grid}, by[k]) != HeightsBy::exact)
        return HeightsBy::differences;
    }
    const std::vector<std::vector<double>> more = gaps_moved(above), less = gaps_moved(below);
    for (std::size_t k = 0; k < change.size(); ++k)
      for (std::size_t i = 0; i < by[k].size(); ++i)
        change[k].gap[i] = (rail ? by[k][i] : -by[k][i]) + 0.5 / step * (more[k][i] - less[k][i]);
    return HeightsBy::exact;
  }

  PatchNumbers numbers(std::size_t k, const PatchState& change) const {
    const double deeper = -change.gap[deepest_[k]];
    PatchNumbers out{};
    for (std::size_t q = 0; q < out.size(); ++q) {
      const kalker::Gradient& by = gradients_[k][q];
      double sum = by.by_load * deeper;
      // the undeformed distance is the gap over the deepest element
      for (std::size_t i = 0; i < by.by_gap.size(); ++i)
        if (by.by_gap[i] != 0.0) sum += by.by_gap[i] * (change.gap[i] + deeper);
      sum += by.by_creepage[0] * change.xi + by.by_creepage[1] * change.eta + by.by_creepage[2] * change.phi;
      out[q] = sum + by.by_friction * change.friction;
    }
    const PatchSolution& patch = solution_.patches[k];
    if (patch.kinematics.velocity > 0.0)
      out[place_of(Quantity::frictional_power)] +=
          patch.contact.frictional_power / patch.kinematics.velocity * change.velocity;
    return out;
  }

  /// Of the vertical force.
  double vertical(const PairState& change) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < change.size(); ++k) {
      const kalker::ContactSolution& c = solution_.patches[k].contact;
      const double angle = solution_.patches[k].frame.angle, sine = std::sin(angle), cosine = std::cos(angle);
      const PatchNumbers by = numbers(k, change[k]);
      sum += sine * number_of(by, Quantity::force_y) + cosine * number_of(by, Quantity::force_n);
      sum += (cosine * c.force_y - sine * c.force_n) * change[k].angle;
    }
    return sum;
  }

  PairSolution neighbour(const Given& given, const PairState& change, double amount, double z) const {
    PairSolution out;
    Problem p = given.problem;
    p.state.position.z = out.z = z;
    out.pitch_rate = solution_.pitch_rate;
    out.placement = place(given.geometry, p);
    for (std::size_t k = 0; k < change.size(); ++k)
      out.patches.push_back(
          neighbour(solution_.patches[k], change[k], numbers(k, change[k]), amount, -change[k].gap[deepest_[k]]));
    resolve_loads(out);
    return out;
  }

  static PatchSolution neighbour(const PatchSolution& patch, const PatchState& change, const PatchNumbers& by,
                                 double amount, double deeper) {
    PatchSolution out;
    out.region = patch.region, out.grid = patch.grid, out.id = patch.id, out.came_from = patch.came_from;
    out.frame.angle = patch.frame.angle + amount * change.angle;
    out.frame.X_TC = {patch.frame.X_TC.origin + amount * change.origin, rotation_x(out.frame.angle)};
    out.region.x = out.frame.X_TC.origin.x(), out.region.y = out.frame.X_TC.origin.y();
    out.region.inclination = out.frame.angle;
    out.reference_s = patch.reference_s + amount * change.reference_s;
    out.approach = patch.approach + amount * deeper;
    ContactKinematics& motion = out.kinematics = patch.kinematics;
    motion.xi += amount * change.xi, motion.eta += amount * change.eta, motion.phi += amount * change.phi;
    motion.velocity += amount * change.velocity;

    const kalker::ContactSolution& from = patch.contact;
    kalker::ContactSolution& c = out.contact;
    c.elements_contact = from.elements_contact, c.elements_adhesion = from.elements_adhesion;
    c.elements_slip = from.elements_slip;
    c.rolling_step = from.rolling_step;
    c.creepage = from.creepage;
    c.creepage.xi = motion.xi, c.creepage.eta = motion.eta, c.creepage.phi = motion.phi;
    c.approach = out.approach;
    const auto moved = [&](double value, Quantity number) { return value + amount * number_of(by, number); };
    c.force_n = moved(from.force_n, Quantity::force_n);
    c.force_x = moved(from.force_x, Quantity::force_x), c.force_y = moved(from.force_y, Quantity::force_y);
    c.moment_x = c.force_n * moved(from.moment_x / from.force_n, Quantity::middle_y);
    c.moment_y = -c.force_n * moved(-from.moment_y / from.force_n, Quantity::middle_x);
    c.moment_n = moved(from.moment_n, Quantity::moment_n);
    c.max_pressure = moved(from.max_pressure, Quantity::max_pressure);
    c.elastic_energy = moved(from.elastic_energy, Quantity::elastic_energy);
    c.frictional_power = moved(from.frictional_power, Quantity::frictional_power);
    out.force_C = {c.force_x, c.force_y, c.force_n};
    out.moment_C = {c.moment_x, c.moment_y, c.moment_n};
    return out;
  }

  Given given_;
  const detection::BodyPair& bodies_;
  const PairSolution& solution_;
  std::vector<std::size_t> deepest_;  ///< element of each patch
  std::vector<std::vector<kalker::Gradient>> gradients_;
  PairState by_height_;
  double stiffness_ = 0.0;
  Report report_;
};

/// Whether a problem differs in nothing but what derivatives follow. Of laws of friction that is the coefficient.
bool is_followed(const Problem& p, Problem changed) {
  if (changed.vertical_force.has_value() != p.vertical_force.has_value() ||
      changed.friction_laws.size() != p.friction_laws.size())
    return false;
  changed.track = p.track, changed.roller = p.roller, changed.wheelset = p.wheelset, changed.state = p.state;
  changed.vertical_force = p.vertical_force, changed.friction.kinetic = p.friction.kinetic;
  changed.friction_inclination = p.friction_inclination;
  for (std::size_t i = 0; i < p.friction_laws.size(); ++i)
    changed.friction_laws[i].kinetic = p.friction_laws[i].kinetic;
  return changed == p;
}

}  // namespace

std::vector<PairNeighbours> Pair::neighbours(const Problem& problem, const PairSolution& solution,
                                             std::span<const PairParameter> parameters) {
  if (solution.status != Status::ok || solution.patches.empty())
    refuse_neighbours("a solution that is not ok has no derivatives", "solve the problem first");
  const bool surface_loads =
      std::any_of(solution.patches.begin(), solution.patches.end(),
                  [](const PatchSolution& patch) { return patch.surface_loads || !patch.extra_slip_x.empty(); });
  if (problem.rail_springs || problem.longitudinal_force || problem.damping || surface_loads ||
      problem.reference_surface != ReferenceSurface::plane)
    refuse_neighbours(
        "rails on springs, a longitudinal force that is given, damping and slip or loads of the surfaces have no "
        "derivatives by what is given",
        "give positions and creepages, and take a plane");
  if (problem.regime != kalker::Regime::steady && problem.regime != kalker::Regime::frictionless)
    refuse_neighbours("contacts that go on from the instant before have no derivatives by what is given",
                      "take steady rolling");
  const bool left = problem.side == Side::left;
  const PairSolution right_hand = left ? mirrored(solution) : PairSolution{};
  const auto given = [&](Problem p, Geometry g) {
    return Given{left ? mirrored(std::move(p)) : std::move(p), std::move(g)};
  };
  const Tangents tangents(given(problem, geometry_), bodies_, left ? right_hand : solution, solvers_);

  std::vector<PairNeighbours> out(parameters.size());
  parallel_for(parameters.size(), [&](std::size_t i) {
    const PairParameter& parameter = parameters[i];
    const Surface* shaped = nullptr;
    double step = parameter.step;
    if (parameter.shape_of) {
      shaped = *parameter.shape_of == Facing::up ? geometry_.rail.get() : geometry_.wheel.get();
      const std::vector<ShapeParameter> shapes = shaped->parameters();
      if (parameter.shape >= shapes.size())
        refuse_neighbours("the surface has no such parameter", "ask it for its parameters first");
      step = shapes[parameter.shape].step;
    }
    if (!(step > 0.0)) refuse_neighbours("the step of a parameter must be positive", "give one");
    bool followed = true;
    const auto changed = [&](double amount) {
      Problem p = problem;
      p.state.velocity.pitch = solution.pitch_rate;
      Geometry g = geometry_;
      if (shaped != nullptr)
        (shaped == g.rail.get() ? g.rail : g.wheel) = shaped->changed(parameter.shape, amount);
      else
        parameter.change(amount, p, g);
      followed &= is_followed(problem, p);
      return given(std::move(p), std::move(g));
    };
    const Given more = changed(step), less = changed(-step);
    if (!followed) {
      out[i].report.status = Status::failed;
      out[i].report.message =
          "derivatives by this number are not known: they are by track, wheelset, position, velocities, vertical "
          "force, friction and shape";
      return;
    }
    try {
      out[i] = tangents.beside(parameter, more, less, step);
    } catch (const Error& e) {  // a surface ends where contact moves to: the other parameters have derivatives
      if (e.kind() != ErrorKind::numerical) throw;
      out[i].report.status = Status::failed;
      out[i].report.message = e.message();
    }
    if (!left || out[i].report.status != Status::ok) return;
    out[i].more = mirrored(std::move(out[i].more)), out[i].less = mirrored(std::move(out[i].less));
  });
  return out;
}

}  // namespace treadmark::wheelrail
