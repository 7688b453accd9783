// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/pair_step.hpp"
#include "treadmark/solvers/wheelrail/placement_change.hpp"
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

/// How a number of a solution changes with what PatchState and PatchNumbers say of a patch.
struct PatchWeights {
  PatchNumbers numbers{};
  Vec3 origin = Vec3::Zero();
  double angle = 0.0, reference_s = 0.0;
  double xi = 0.0, eta = 0.0, phi = 0.0, velocity = 0.0;
  double approach = 0.0;
};
struct NumberWeights {
  std::vector<PatchWeights> patches;
  double z = 0.0;
};

/// A problem of the right-hand side with its surfaces.
struct Given {
  Problem problem;
  Geometry geometry;
};

class Tangents {
 public:
  Tangents(Given given, const detection::BodyPair& bodies, const PairSolution& solution)
      : given_(std::move(given)), bodies_(bodies), solution_(solution) {
    given_.problem.state.velocity.pitch = solution.pitch_rate;
    for (const PatchSolution& patch : solution.patches)
      deepest_.push_back(static_cast<std::size_t>(
          std::min_element(patch.distance.begin(), patch.distance.end(),
                           [](double a, double b) { return a < b || (std::isnan(b) && !std::isnan(a)); }) -
          patch.distance.begin()));
  }

  /// The linear systems of those numbers of patches that are wanted, and of the balance. To be called first.
  void solve(std::vector<kalker::ContactSolver>& solvers, std::array<bool, kNumbers.size()> wanted) {
    if (balanced()) wanted[place_of(Quantity::force_n)] = wanted[place_of(Quantity::force_y)] = true;
    while (solvers.size() < solution_.patches.size()) solvers.emplace_back();
    for (std::size_t k = 0; k < solution_.patches.size(); ++k) {
      const PatchSolution& patch = solution_.patches[k];
      kalker::ContactProblem problem = contact_problem_of(given_.problem, patch);
      problem.sub_patches.count = static_cast<int>(patch.region.parts.size());
      auto& gradients = gradients_.emplace_back(kNumbers.size());
      for (std::size_t q = 0; q < kNumbers.size(); ++q) {
        if (!wanted[q]) continue;
        gradients[q] = solvers[k].gradient(problem, patch.contact, kNumbers[q]);
        note(gradients[q].report);
      }
    }
    if (!balanced()) return;
    constexpr double kStep = 5e-8;  // [m], of penetrations of some hundredths of a millimetre
    std::optional<PairState> lower = state(given_, bodies_, solution_.z + kStep),
                             higher = state(given_, bodies_, solution_.z - kStep);
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

  /// Of each number.
  std::vector<HeightGradient> by_heights(std::size_t count, const Pair::Numbers& numbers,
                                         std::vector<kalker::ContactSolver>& solvers);

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
    const int iterations = report_.iterations + found.iterations;
    if (report_.status == Status::ok) report_ = found;
    report_.iterations = iterations;
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

  /// Where everything lies, and how patches change as their contact planes move.
  struct Laid {
    Placement placement;
    std::vector<LaidPatch> patches;
    std::vector<detection::ReferenceChange> references;
    std::vector<std::array<PatchState, 4>> by_plane;  ///< by x, y, z of its origin, and by its angle
    std::vector<PatchState> by_approach;
    std::string message;  ///< why it is not known; empty: it is
  };
  Laid laid() const;
  std::vector<NumberWeights> weights_of(std::size_t count, const Pair::Numbers& numbers) const;
  double applied(const PatchWeights& weights, std::size_t k, const PatchState& change) const;
  NumberWeights with_balance(NumberWeights weights) const;
  void add_patch(std::size_t k, const PatchWeights& weights, const Laid& laid, HeightGradient& out) const;
  void add_placement(std::size_t count, const Pair::Numbers& numbers, std::vector<HeightGradient>& out) const;

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

Tangents::Laid Tangents::laid() const {
  constexpr double kStep = 1e-6;  // [m], [rad]
  Laid out;
  const Problem& p = given_.problem;
  RailMemory memory(*given_.geometry.rail);
  std::vector<kalker::ContactSolver> none;
  PhaseTimes times;
  const Instant before;
  PairStep step(given_.geometry, p, before, none, none, times, bodies_, memory);
  if (step.place(0.0)) out.patches = step.lay(solution_.z, solution_.patches);
  if (out.patches.size() < solution_.patches.size()) {
    out.message = "contact comes or goes here: there are no derivatives";
    return out;
  }
  out.placement = step.placement();
  detection::BodyPair bodies = bodies_;
  bodies.X_TR = out.placement.X_TS, bodies.X_TW = out.placement.X_TA;
  for (std::size_t k = 0; k < out.patches.size(); ++k) {
    std::optional<detection::ReferenceChange> reference = step.reference_change(solution_.z, out.patches[k].region);
    if (!reference) {
      out.message =
          "where contact lies does not follow from heights in a way that is known: of this detector, of the deepest "
          "point, or of patches near each other whose planes turn towards each other";
      return out;
    }
    out.references.push_back(std::move(*reference));
    const detection::ContactFrame& frame = out.patches[k].frame;
    const auto state_at = [&](const Vec3& origin, double angle, double deeper) {
      PatchState s;
      s.origin = origin, s.angle = angle;
      const Pose X_TC{origin, rotation_x(angle)};
      const Vec2& reference_C = solution_.patches[k].reference_C;
      const Pose X_CP{{-reference_C.x(), -reference_C.y(), 0.0}, Mat3::Identity()};
      detection::UndeformedDistance u = detection::undeformed_distance(bodies, X_TC * X_CP, solution_.patches[k].grid);
      for (double& h : u.distance) h -= u.approach;
      s.gap = std::move(u.distance);
      const ContactKinematics motion = contact_kinematics(p, out.placement, X_TC, deeper - s.gap[deepest_[k]]);
      s.xi = motion.xi, s.eta = motion.eta, s.phi = motion.phi, s.velocity = motion.velocity;
      s.friction = friction_at(p.friction_inclination, p.friction_laws, angle, p.friction).static_friction();
      return s;
    };
    const auto rate = [&](const Vec3& way, double turn, double deeper) {
      const auto beside = [&](double by) {
        return state_at(frame.X_TC.origin + by * way, frame.angle + by * turn, by * deeper);
      };
      PatchState change;
      change.add(0.5 / kStep, beside(kStep)).add(-0.5 / kStep, beside(-kStep));
      return change;
    };
    auto& by_plane = out.by_plane.emplace_back();
    for (int m = 0; m < 3; ++m) by_plane[static_cast<std::size_t>(m)] = rate(Vec3::Unit(m), 0.0, 0.0);
    by_plane[3] = rate(Vec3::Zero(), 1.0, 0.0);
    out.by_approach.push_back(rate(Vec3::Zero(), 0.0, 1.0));
  }
  return out;
}

/// By solutions beside this one, which differ in one of all that forces and places are made of.
std::vector<NumberWeights> Tangents::weights_of(std::size_t count, const Pair::Numbers& numbers) const {
  constexpr double kPart = 1e-4, kLength = 1e-6, kLever = 1e-3;  // of numbers; [m] or [rad], [m]
  std::vector<NumberWeights> out(count);
  for (NumberWeights& one : out) one.patches.resize(solution_.patches.size());
  Problem p = given_.problem;
  p.state.position.z = solution_.z;
  const Placement placement = place(given_.geometry, p);
  // patch k changed by an amount, the wheelset lower by dz
  const auto solution_with = [&](std::size_t k, const PatchState& change, const PatchNumbers& by, double approach,
                                 double amount, double dz) {
    PairSolution s;
    s.z = solution_.z + dz, s.pitch_rate = solution_.pitch_rate, s.placement = placement;
    for (Pose* pose : {&s.placement.X_TWs, &s.placement.X_TW, &s.placement.X_TA}) pose->origin.z() += dz;
    for (std::size_t j = 0; j < solution_.patches.size(); ++j)
      s.patches.push_back(neighbour(solution_.patches[j], change, by, j == k ? amount : 0.0, approach));
    resolve_loads(s);
    return s;
  };
  std::vector<double> more(count), less(count);
  const auto rates = [&](const auto& solution_at, double step, const auto& put) {
    numbers(solution_at(step), more), numbers(solution_at(-step), less);
    for (std::size_t n = 0; n < count; ++n) put(out[n], (more[n] - less[n]) / (2.0 * step));
  };
  for (std::size_t k = 0; k < solution_.patches.size(); ++k) {
    const PatchSolution& patch = solution_.patches[k];
    const kalker::ContactSolution& c = patch.contact;
    const double force = std::max(1.0, std::abs(c.force_n)), speed = patch.kinematics.velocity;
    const PatchNumbers sizes{force,
                             std::max(1.0, c.max_pressure),
                             kLever,
                             kLever,
                             std::max(1e-6, c.elastic_energy),
                             force,
                             force,
                             kLever * force,
                             std::max(kLever * force * std::max(speed, kLever), std::abs(c.frictional_power))};
    for (std::size_t q = 0; q < kNumbers.size(); ++q) {
      PatchNumbers by{};
      by[q] = 1.0;
      rates([&](double amount) { return solution_with(k, {}, by, 0.0, amount, 0.0); }, kPart * sizes[q],
            [&](NumberWeights& to, double rate) { to.patches[k].numbers[q] = rate; });
    }
    const auto of_state = [&](double step, const auto& set, const auto& put) {
      PatchState change;
      set(change);
      rates([&](double amount) { return solution_with(k, change, {}, 0.0, amount, 0.0); }, step,
            [&](NumberWeights& to, double rate) { put(to.patches[k]) = rate; });
    };
    for (int m = 0; m < 3; ++m)
      of_state(
          kLength, [&](PatchState& s) { s.origin[m] = 1.0; }, [&](PatchWeights& w) -> double& { return w.origin[m]; });
    struct Row {
      double PatchState::*from;
      double PatchWeights::*to;
      double step;
    };
    const Row rows[] = {{&PatchState::angle, &PatchWeights::angle, kLength},
                        {&PatchState::reference_s, &PatchWeights::reference_s, kLength},
                        {&PatchState::xi, &PatchWeights::xi, kLength},
                        {&PatchState::eta, &PatchWeights::eta, kLength},
                        {&PatchState::phi, &PatchWeights::phi, kPart},
                        {&PatchState::velocity, &PatchWeights::velocity, kPart * std::max(speed, kLever)}};
    for (const Row& row : rows)
      of_state(
          row.step, [&](PatchState& s) { s.*row.from = 1.0; }, [&](PatchWeights& w) -> double& { return w.*row.to; });
    rates([&](double amount) { return solution_with(k, {}, {}, 1.0, amount, 0.0); }, kLength,
          [&](NumberWeights& to, double rate) { to.patches[k].approach = rate; });
  }
  rates([&](double amount) { return solution_with(0, {}, {}, 0.0, 0.0, amount); }, kLength,
        [&](NumberWeights& to, double rate) { to.z = rate; });
  return out;
}

double Tangents::applied(const PatchWeights& w, std::size_t k, const PatchState& change) const {
  const PatchNumbers by = numbers(k, change);
  double sum = -w.approach * change.gap[deepest_[k]] + w.origin.dot(change.origin) + w.angle * change.angle +
               w.xi * change.xi + w.eta * change.eta + w.phi * change.phi + w.velocity * change.velocity;
  for (std::size_t q = 0; q < by.size(); ++q) sum += w.numbers[q] * by[q];
  return sum;
}

/// The wheel comes down by what the patches carry too little.
NumberWeights Tangents::with_balance(NumberWeights weights) const {
  if (!balanced()) return weights;
  double by_height = weights.z;
  for (std::size_t k = 0; k < weights.patches.size(); ++k) by_height += applied(weights.patches[k], k, by_height_[k]);
  const double by_force = by_height / stiffness_;
  for (std::size_t k = 0; k < weights.patches.size(); ++k) {  // as vertical() has it
    const kalker::ContactSolution& c = solution_.patches[k].contact;
    const double angle = solution_.patches[k].frame.angle, sine = std::sin(angle), cosine = std::cos(angle);
    PatchWeights& w = weights.patches[k];
    w.numbers[place_of(Quantity::force_y)] -= by_force * sine;
    w.numbers[place_of(Quantity::force_n)] -= by_force * cosine;
    w.angle -= by_force * (cosine * c.force_y - sine * c.force_n);
  }
  return weights;
}

void Tangents::add_patch(std::size_t k, const PatchWeights& w, const Laid& laid, HeightGradient& out) const {
  const PatchSolution& patch = solution_.patches[k];
  const Grid2& grid = patch.grid;
  std::vector<double> by_gap(grid.size(), 0.0);
  double by_approach = w.approach, by_velocity = w.velocity;
  std::array<double, 3> by_creepage{w.xi, w.eta, w.phi};
  for (std::size_t q = 0; q < kNumbers.size(); ++q) {
    const kalker::Gradient& by = gradients_[k][q];
    const double weight = w.numbers[q];
    if (weight == 0.0 || by.by_gap.empty()) continue;
    double sum = by.by_load;
    for (std::size_t i = 0; i < by_gap.size(); ++i) by_gap[i] += weight * by.by_gap[i], sum += by.by_gap[i];
    by_approach += weight * sum;
    for (std::size_t m = 0; m < by_creepage.size(); ++m) by_creepage[m] += weight * by.by_creepage[m];
  }
  if (patch.kinematics.velocity > 0.0)
    by_velocity +=
        w.numbers[place_of(Quantity::frictional_power)] * patch.contact.frictional_power / patch.kinematics.velocity;
  const PatchState& deeper = laid.by_approach[k];
  by_approach += by_creepage[0] * deeper.xi + by_creepage[1] * deeper.eta + by_creepage[2] * deeper.phi +
                 by_velocity * deeper.velocity;
  by_gap[deepest_[k]] -= by_approach;  // which is how deep the deepest element lies

  std::array<double, 4> by_plane{};
  for (std::size_t m = 0; m < by_plane.size(); ++m) by_plane[m] = applied(w, k, laid.by_plane[k][m]);

  const Pose X_RT = laid.placement.X_TS.inverse(), X_WT = laid.placement.X_TA.inverse();
  const Pose& X_TC = laid.patches[k].frame.X_TC;
  const Pose X_TP = X_TC * Pose{{-patch.reference_C.x(), -patch.reference_C.y(), 0.0}, Mat3::Identity()};
  HeightWeights over_rail{X_RT * X_TP, {}, {}}, over_wheel{X_WT * X_TP, {}, {}};
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double by = by_gap[grid.index(ix, iy)];
      if (by == 0.0) continue;
      for (HeightWeights* to : {&over_rail, &over_wheel}) to->points_P.emplace_back(grid.x(ix), grid.y(iy));
      over_rail.weights.push_back(by), over_wheel.weights.push_back(-by);
    }
  out.rail_field.push_back(by_gap);
  for (double& by : by_gap) by = -by;
  out.wheel_field.push_back(std::move(by_gap));

  // the reference is where the search has it, and on the rail there
  const Vec2 reference = X_TC.origin.head<2>();
  double slope_x = 0.0, slope_y = 0.0;
  given_.geometry.rail->heights_at(X_RT, {&reference, 1}, {{}, {&slope_x, 1}, {&slope_y, 1}});
  const std::array<double, 3> by_reference{by_plane[0] + by_plane[2] * slope_x, by_plane[1] + by_plane[2] * slope_y,
                                           by_plane[3]};
  const auto searched = [&](const Pose& X_ST, const std::vector<detection::ReferenceChange::Place>& places) {
    HeightWeights some{X_ST, {}, {}};
    for (const detection::ReferenceChange::Place& place : places) {
      some.points_P.push_back(place.at_T);
      some.weights.push_back(by_reference[0] * place.by[0] + by_reference[1] * place.by[1] +
                             by_reference[2] * place.by[2]);
    }
    return some;
  };
  HeightWeights search_rail = searched(X_RT, laid.references[k].rail),
                search_wheel = searched(X_WT, laid.references[k].wheel);
  search_rail.points_P.push_back(reference), search_rail.weights.push_back(by_plane[2]);

  // each shared among the four elements round it
  const auto gather = [&](const HeightWeights& from, std::vector<double>& field) {
    const Vec3 n = X_TC.rotation.col(2);
    for (std::size_t i = 0; i < from.weights.size(); ++i) {
      const Vec2 aside = from.points_P[i] - reference;
      const double up = X_TC.origin.z() - (n.x() * aside.x() + n.y() * aside.y()) / n.z();
      const Vec3 at = X_TP.apply_inverse({from.points_P[i].x(), from.points_P[i].y(), up});
      const double x = (at.x() - grid.x0) / grid.dx, y = (at.y() - grid.y0) / grid.dy;
      if (!(x >= 0.0 && y >= 0.0 && x < grid.nx - 1 && y < grid.ny - 1)) continue;
      const int ix = to_whole<int>(x), iy = to_whole<int>(y);
      const double f = x - ix, g = y - iy, weight = from.weights[i] / n.z();
      field[grid.index(ix, iy)] += weight * (1.0 - f) * (1.0 - g);
      field[grid.index(ix + 1, iy)] += weight * f * (1.0 - g);
      field[grid.index(ix, iy + 1)] += weight * (1.0 - f) * g;
      field[grid.index(ix + 1, iy + 1)] += weight * f * g;
    }
  };
  gather(search_rail, out.rail_field.back()), gather(search_wheel, out.wheel_field.back());
  out.rail.push_back(std::move(over_rail)), out.rail.push_back(std::move(search_rail));
  out.wheel.push_back(std::move(over_wheel)), out.wheel.push_back(std::move(search_wheel));
}

/// A body that is placed by its shape moves with it as a whole.
void Tangents::add_placement(std::size_t count, const Pair::Numbers& numbers, std::vector<HeightGradient>& out) const {
  constexpr double kStep = 5e-8;  // [m]
  const PlacementChange change = placement_change(given_.geometry, given_.problem);
  std::vector<double> more(count), less(count);
  const auto add = [&](const std::vector<HeightWeights>& from, double& (*place_in)(Problem&),
                       std::vector<HeightWeights> HeightGradient::*to) {
    if (from.empty()) return;
    Given above = given_, below = given_;
    place_in(above.problem) += kStep, place_in(below.problem) -= kStep;
    const PairNeighbours found = beside({}, above, below, kStep);
    if (found.report.status == Status::ok) numbers(found.more, more), numbers(found.less, less);
    for (std::size_t n = 0; n < count; ++n) {
      if (found.report.status != Status::ok) {
        out[n].report = found.report;
        continue;
      }
      for (HeightWeights some : from) {
        for (double& weight : some.weights) weight *= (more[n] - less[n]) / (2.0 * kStep);
        (out[n].*to).push_back(std::move(some));
      }
    }
  };
  add(
      change.rail_y, [](Problem& p) -> double& { return p.track.dy; }, &HeightGradient::rail);
  add(
      change.rail_z, [](Problem& p) -> double& { return p.track.dz; }, &HeightGradient::rail);
  add(
      change.wheel_z, [](Problem& p) -> double& { return p.state.wheel_offset.z; }, &HeightGradient::wheel);
  if (change.message.empty()) return;
  for (HeightGradient& one : out) one.report.status = Status::failed, one.report.message = change.message;
}

std::vector<HeightGradient> Tangents::by_heights(std::size_t count, const Pair::Numbers& numbers,
                                                 std::vector<kalker::ContactSolver>& solvers) {
  const std::vector<NumberWeights> weights = weights_of(count, numbers);
  std::array<bool, kNumbers.size()> wanted{};
  for (const NumberWeights& number : weights)
    for (const PatchWeights& patch : number.patches)
      for (std::size_t q = 0; q < wanted.size(); ++q) wanted[q] = wanted[q] || patch.numbers[q] != 0.0;
  solve(solvers, wanted);
  std::vector<HeightGradient> out(count);
  const Laid base = laid();
  if (report_.status == Status::ok && !base.message.empty()) {
    report_.status = Status::failed;
    report_.message = base.message;
  }
  for (std::size_t n = 0; n < count; ++n) {
    HeightGradient& one = out[n];
    one.report = report_;
    if (report_.status != Status::ok) continue;
    const NumberWeights held = with_balance(weights[n]);
    const auto known = [](const PatchWeights& w) { return w.reference_s == 0.0; };
    if (!std::all_of(held.patches.begin(), held.patches.end(), known)) {
      one.report.status = Status::failed;
      one.report.message = "arc lengths along the rail have no derivatives by all that its shape follows from";
      continue;
    }
    for (std::size_t k = 0; k < held.patches.size(); ++k) add_patch(k, held.patches[k], base, one);
  }
  if (report_.status == Status::ok) add_placement(count, numbers, out);
  return out;
}

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

namespace {

void require_followed(const Problem& problem, const PairSolution& solution) {
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
}

}  // namespace

std::vector<HeightGradient> Pair::height_gradients(const Problem& problem, const PairSolution& solution,
                                                   std::size_t count, const Numbers& numbers) {
  require_followed(problem, solution);
  if (bodies_.distance_mesh || problem.solver.conventions == Conventions::contact)
    refuse_neighbours("distances by CONTACT's conventions have no derivatives by all heights",
                      "take Treadmark's conventions");
  const bool left = problem.side == Side::left;
  const PairSolution right_hand = left ? mirrored(solution) : PairSolution{};
  Tangents tangents({left ? mirrored(problem) : problem, geometry_}, bodies_, left ? right_hand : solution);
  const Numbers of_the_left = [&](const PairSolution& s, std::span<double> values) { numbers(mirrored(s), values); };
  std::vector<HeightGradient> out = tangents.by_heights(count, left ? of_the_left : numbers, solvers_);
  for (HeightGradient& one : out)
    for (auto* fields : {&one.rail_field, &one.wheel_field})
      for (std::size_t k = 0; left && k < fields->size(); ++k) reverse_rows((*fields)[k], solution.patches[k].grid);
  return out;
}

std::vector<PairNeighbours> Pair::neighbours(const Problem& problem, const PairSolution& solution,
                                             std::span<const PairParameter> parameters) {
  require_followed(problem, solution);
  const bool left = problem.side == Side::left;
  const PairSolution right_hand = left ? mirrored(solution) : PairSolution{};
  const auto given = [&](Problem p, Geometry g) {
    return Given{left ? mirrored(std::move(p)) : std::move(p), std::move(g)};
  };
  Tangents solved(given(problem, geometry_), bodies_, left ? right_hand : solution);
  std::array<bool, kNumbers.size()> all;
  all.fill(true);
  solved.solve(solvers_, all);
  const Tangents& tangents = solved;

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
