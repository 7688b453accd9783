// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"
#include "treadmark/solvers/vehicle/wheel_loop.hpp"
#include "treadmark/solvers/wheelrail/root_search.hpp"

namespace treadmark::vehicle {
namespace {

// Of pair coordinates: small against all that contact geometry changes over, large against rounding. Roll raises and
// sinks wheels by what height does: contact tables have kinks at their loads, and slopes of both sides must not mix.
constexpr double kSteps[kPairCoordinates] = {1e-6, 2e-6, 5e-8, 7e-8, 1e-6, 2e-6, 2e-6, 5e-8, 7e-8};
// Rates, over the speed.
constexpr double kRateSteps[kPairCoordinates] = {1e-6, 1e-6, 1e-6, 1e-6, 2e-6, 1e-6, 1e-6, 1e-6, 1e-6};

void displace(PairMotion& m, int coordinate, double by) {
  double* const place[] = {&m.wheelset.x,   &m.wheelset.y, &m.wheelset.z, &m.wheelset.roll, &m.wheelset.pitch,
                           &m.wheelset.yaw, &m.rail.y,     &m.rail.z,     &m.rail.roll};
  *place[coordinate] += by;
}

void accelerate(PairMotion& m, int coordinate, double by) {
  double* const place[] = {&m.wheelset_velocity.x,
                           &m.wheelset_velocity.y,
                           &m.wheelset_velocity.z,
                           &m.wheelset_velocity.roll,
                           &m.wheelset_velocity.pitch,
                           &m.wheelset_velocity.yaw,
                           &m.rail.vy,
                           &m.rail.vz,
                           &m.rail.vroll};
  *place[coordinate] += by;
}

PairVector force_at(const VehicleOnTrack& vehicle, std::size_t i, const PairMotion& m) {
  return generalised_force(vehicle.wheels[i].element->evaluate(m), m);
}

template <class Change>
PairVector slope(const VehicleOnTrack& vehicle, std::size_t i, const PairMotion& m, double step, Change&& change) {
  PairMotion low = m, high = m;
  change(low, -step);
  change(high, step);
  return (force_at(vehicle, i, high) - force_at(vehicle, i, low)) / (2.0 * step);
}

/// Stiffness of springs and, where they act, bump stops and dry friction.
Matrix stiffness_of_springs(const VehicleOnTrack& vehicle, const SystemState& state,
                            const std::optional<LineState>& line) {
  Matrix stiffness = vehicle.system.stiffness;
  for (std::size_t i = 0; i < vehicle.system.characteristics.size(); ++i) {
    const CharacteristicForce& c = vehicle.system.characteristics[i];
    const double offset = line ? line->stop_offsets[i] : 0.0;
    block_of(stiffness, vehicle.system.vehicles[static_cast<std::size_t>(c.vehicle)]) +=
        value_at(c.curve, displacement(vehicle.system, c, state.q) + offset).slope * c.direction *
        c.direction.transpose();
  }
  if (const ForceElements& elements = vehicle.system.elements; elements.size() > 0) {
    const Matrix directions = elements.directions(stiffness.rows());
    stiffness += directions.transpose() * vehicle.resting_elements(state, line).stiffness * directions;
  }
  return stiffness;
}

/// Solves for each part of a train that moves by itself.
class SolverByPart {
 public:
  /// ahead: see running_ahead.
  SolverByPart(const Multibody& system, const Matrix& slopes, const Vector& ahead) {
    for (const Multibody::Range& part : independent_parts(system, slopes, slopes)) {
      Matrix own = block_of(slopes, part);
      if (ahead.size() > 0) hold(system, part, ahead, own);
      parts_.emplace_back(part, own.fullPivLu());
    }
  }
  Vector solve(const Vector& right) const {
    Vector out(right.size());
    for (const auto& [part, lu] : parts_) part_of(out, part) = lu.solve(part_of(right, part));
    return out;
  }

 private:
  /// Where vehicles that are free stand along the track changes no force, so that slopes leave it open. Displacements
  /// are held by forces in proportion to masses, which Balance::let_run takes out again.
  static void hold(const Multibody& system, const Multibody::Range& part, const Vector& ahead, Matrix& slopes) {
    constexpr double kHold = 1e3;  // acceleration by displacement, so that the sum is of the order of springs [1/s2]
    const Vector along = part_of(ahead, part), inertia = along.cwiseProduct(part_of(system.mass, part));
    for (int i = 0; i < part.size; ++i)
      if (system.coordinates[static_cast<std::size_t>(part.first + i)].freedom == Freedom::x)
        slopes.col(i) += kHold * along[i] * inertia;
  }

  std::vector<std::pair<Multibody::Range, Eigen::FullPivLU<Matrix>>> parts_;
};

/// Wheelsets roll freely: of their pitch the rate is sought, and the angle stays.
class Balance {
 public:
  Balance(const VehicleOnTrack& vehicle)
      : vehicle_(vehicle),
        system_(vehicle.system),
        line_(vehicle.line_state(0.0)),
        ahead_(running_ahead(vehicle.system)) {
    for (const Multibody::Wheelset& w : system_.wheelsets)
      if (w.coordinate[4] >= 0) rolling_.push_back(w.coordinate[4]);
    scale_ = *ranges::max_element(system_.wheelset_load);
    if (!(scale_ > 0.0)) throw Error(ErrorKind::configuration, "the wheelsets carry no load");
  }

  SystemState start() const {
    SystemState state{0.0, Vector::Zero(system_.size()), Vector::Zero(system_.size())};
    if (line_) settle(state);
    // Wheels into the rails as deep as their load takes, by the order of magnitude.
    constexpr double kHertz = 1e11;  // [N/m^1.5]
    for (std::size_t set = 0; set < system_.wheelsets.size(); ++set) {
      std::optional<double> gap;
      for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
        if (vehicle_.wheels[i].wheelset != static_cast<int>(set)) continue;
        const ContactReaction reaction = vehicle_.wheels[i].element->evaluate(vehicle_.motion(i, state));
        const double one = reaction.least_gap + reaction.give;
        gap = gap ? std::max(*gap, one) : one;
      }
      state.q[system_.wheelsets[set].coordinate[2]] +=
          *gap + std::pow(0.5 * system_.wheelset_load[set] / kHertz, 2.0 / 3.0);
    }
    return state;
  }

  /// Imbalance of all coordinates. False: a wheel does not touch, or a contact cannot be solved.
  bool imbalance(const SystemState& state, Vector& r, std::vector<ContactReaction>& reactions, std::string& why) const {
    r = without_contact(state);
    reactions = evaluate_wheels(vehicle_, state);
    for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
      const PairMotion m = vehicle_.motion(i, state);
      const ContactReaction& reaction = reactions[i];
      if (reaction.status != Status::ok || !(reaction.normal_force > 0.0)) {
        why = fmt::format("{}: {}", vehicle_.wheels[i].name,
                          reaction.message.empty() ? "the wheel does not touch the rail" : reaction.message);
        return false;
      }
      vehicle_.add_force(i, generalised_force(reaction, m), r);
    }
    let_run(r);
    return true;
  }

  /// The coordinate that is farthest from its balance.
  const std::string& most(const Vector& r) const { return system_.coordinates[worst(r)].name; }
  double measure(const Vector& r) const { return share(r, worst(r)); }

  /// What solves for steps of the unknowns by the derivative of -imbalance.
  SolverByPart jacobian(const SystemState& state, double coarseness) const {
    LinearSystem system = linearised_system(vehicle_, state, coarseness);
    for (const int c : rolling_) system.stiffness.col(c) = system.damping.col(c);
    return {system_, system.stiffness, ahead_};
  }

  /// Gives every wheelset, held where it is, the rate at which no moment turns it. Wheels that touch far from their
  /// nominal circle slip so much at the nominal rate that their forces hardly change with it, and Newton's method finds
  /// no way. False: a wheel does not touch.
  bool let_roll(SystemState& state) const {
    constexpr double kFirst = 1e-3, kReach = 0.2, kResolution = 1e-9;  // of the nominal rate
    constexpr double kBalanced = 1e-4;                                 // of the wheelset's load
    for (const Multibody::Wheelset& w : system_.wheelsets) {
      const int c = w.coordinate[4];
      if (c < 0) continue;
      const double rate = vehicle_.speed / w.nominal_radius;
      wheelrail::RootSearch search(
          {.tolerance = kBalanced * scale_ * system_.coordinates[static_cast<std::size_t>(c)].arm,
           .first_step = kFirst * rate,
           .reach = kReach * rate,
           .resolution = kResolution * rate});
      for (;;) {
        Vector r;
        std::vector<ContactReaction> reactions;
        std::string why;
        if (!imbalance(state, r, reactions, why)) return false;
        // a wheelset that turns too fast is slowed down
        if (search.add(state.v[c], -r[c]) != wheelrail::RootSearch::State::search) break;
        state.v[c] = search.next();
      }
    }
    return true;
  }

  /// Of a state in motion what the balance is sought from.
  SystemState standing(SystemState state) const {
    const Vector rates = state.v;
    state.time = 0.0;
    state.v.setZero();
    for (const int c : rolling_) {
      state.q[c] = 0.0;
      state.v[c] = rates[c];
    }
    return state;
  }

  SystemState moved(SystemState state, const Vector& step) const {
    const Vector held = state.q;
    state.q += step;
    for (const int c : rolling_) {
      state.q[c] = held[c];
      state.v[c] += step[c];
    }
    return state;
  }

 private:
  /// Vehicles that are free along the track cannot bear what their wheels take: all masses gain and lose speed by it,
  /// and the rest is in balance.
  void let_run(Vector& r) const {
    if (ahead_.size() == 0) return;
    const Vector inertia = ahead_.cwiseProduct(system_.mass);
    r -= ahead_.dot(r) / ahead_.dot(inertia) * inertia;
  }
  double share(const Vector& r, std::size_t i) const {
    return std::abs(r[static_cast<Eigen::Index>(i)]) / (scale_ * system_.coordinates[i].arm);
  }
  std::size_t worst(const Vector& r) const {
    std::size_t most = 0;
    for (std::size_t i = 1; i < system_.coordinates.size(); ++i)
      if (share(r, i) > share(r, most)) most = i;
    return most;
  }

  Vector without_contact(const SystemState& state) const {
    Vector r = system_.weight;
    for (const Multibody::Range& vehicle : system_.vehicles) {
      auto own = part_of(r, vehicle);
      own.noalias() -= block_of(system_.stiffness, vehicle) * part_of(state.q, vehicle);
      own.noalias() -= block_of(system_.damping, vehicle) * part_of(state.v, vehicle);
    }
    r += vehicle_.other_forces(state, line_);
    if (line_) r += line_->force;
    if (const ForceElements& elements = system_.elements; elements.size() > 0) {
      const Vector force = vehicle_.resting_elements(state, line_).force;
      r += elements.on_coordinates(force, system_.size());
      if (line_) line_->add_couplers_aside(force, 1.0, r);
    }
    return r;
  }

  /// Balances all bodies on wheelsets that are held. In a tight curve a long car stands far inside of its place on the
  /// line, off which its springs would throw wheels over the rails.
  void settle(SystemState& state) const {
    constexpr int kMost = 50;
    constexpr double kSettled = 1e-9;  // [m]
    const auto sprung_in = [&](const Multibody::Range& part) {
      std::vector<Eigen::Index> sprung;
      for (Eigen::Index i = part.first; i < part.first + part.size; ++i) {
        const int body = system_.coordinates[static_cast<std::size_t>(i)].body;
        if (ranges::find(system_.wheelsets, body, &Multibody::Wheelset::body) == system_.wheelsets.end())
          sprung.push_back(i);
      }
      return sprung;
    };
    for (int i = 0; i < kMost; ++i) {
      const Vector all = without_contact(state);
      const Matrix stiffness = stiffness_of_springs(vehicle_, state, line_);
      double most = 0.0;
      for (const Multibody::Range& part : independent_parts(system_, stiffness, stiffness)) {
        const std::vector<Eigen::Index> sprung = sprung_in(part);
        if (sprung.empty()) continue;
        const Matrix k = stiffness(sprung, sprung);
        const Vector r = all(sprung), step = k.completeOrthogonalDecomposition().solve(r);
        state.q(sprung) += step;
        most = std::max(most, step.cwiseAbs().maxCoeff());
      }
      if (!(most > kSettled)) return;
    }
  }

  const VehicleOnTrack& vehicle_;
  const Multibody& system_;
  std::optional<LineState> line_;  ///< at the start
  Vector ahead_;                   ///< see running_ahead
  std::vector<int> rolling_;
  double scale_ = 1.0;
};

/// For forces that jump: steps by slopes over wide differences, which pass over the jumps, whether the imbalance falls
/// or not; share: of each step that is gone. The nearest state on the way is kept.
void step_over_jumps(const Balance& balance, double coarseness, double share, double enough, Equilibrium& found) {
  constexpr int kSteps = 12;
  constexpr double kShortest = 0.1;
  Equilibrium now = found;
  Vector r;
  std::string why;
  if (!balance.imbalance(now.state, r, now.reactions, why)) return;
  const SolverByPart slopes = balance.jacobian(now.state, coarseness);
  for (int i = 0; i < kSteps && found.residual > enough; ++i) {
    const Vector step = slopes.solve(r);
    double gone = share;
    SystemState next = balance.moved(now.state, gone * step);
    while (!balance.imbalance(next, r, now.reactions, why)) {
      if ((gone *= 0.5) < kShortest) return;
      next = balance.moved(now.state, gone * step);
    }
    now.state = next;
    now.residual = balance.measure(r);
    now.iterations = ++found.iterations;
    if (now.residual < found.residual) found = now;
  }
}

}  // namespace

PairTangent linearised(const VehicleOnTrack& vehicle, std::size_t i, const SystemState& state, double coarseness,
                       bool all) {
  const PairMotion m = vehicle.motion(i, state);
  PairTangent t;
  for (int c = 0; c < kPairCoordinates; ++c) {
    if (!all && vehicle.maps[i].row(c).isZero(0.0)) continue;
    t.stiffness.col(c) = -slope(vehicle, i, m, coarseness * kSteps[c],
                                [c](PairMotion& changed, double by) { displace(changed, c, by); });
    t.damping.col(c) = -slope(vehicle, i, m, coarseness * kRateSteps[c] * vehicle.speed,
                              [c](PairMotion& changed, double by) { accelerate(changed, c, by); });
  }
  return t;
}

LinearSystem linearised_system(const VehicleOnTrack& vehicle, const SystemState& state, double coarseness) {
  const std::optional<LineState> line = vehicle.line_state(state.time);
  LinearSystem system{stiffness_of_springs(vehicle, state, line), vehicle.system.damping};
  if (const ForceElements& elements = vehicle.system.elements; elements.size() > 0) {
    const Matrix directions = elements.directions(system.damping.rows());
    system.damping += directions.transpose() * vehicle.resting_elements(state, line).damping * directions;
  }
  std::vector<PairTangent> tangents(vehicle.wheels.size());
  for_each_wheel(vehicle, [&](std::size_t i) { tangents[i] = linearised(vehicle, i, state, coarseness); });
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const PairTangent& t = tangents[i];
    block_of(system.stiffness, vehicle.range(i)) += vehicle.maps[i].transpose() * t.stiffness * vehicle.maps[i];
    block_of(system.damping, vehicle.range(i)) += vehicle.maps[i].transpose() * t.damping * vehicle.maps[i];
  }
  return system;
}

namespace {

/// The contact elements as they were, whatever happens in between.
class KeptElements {
 public:
  explicit KeptElements(const VehicleOnTrack& vehicle) : vehicle_(vehicle) {
    for (const WheelOnRail& wheel : vehicle.wheels) wheel.element->save(bytes_);
  }
  ~KeptElements() {
    ByteReader in(bytes_.bytes());
    for (const WheelOnRail& wheel : vehicle_.wheels) wheel.element->restore(in);
  }
  KeptElements(const KeptElements&) = delete;
  KeptElements& operator=(const KeptElements&) = delete;

 private:
  const VehicleOnTrack& vehicle_;
  ByteWriter bytes_;
};

/// A vehicle that runs, but stays at its place on the line.
VehicleOnTrack staying(VehicleOnTrack vehicle) {
  LineSetup setup = vehicle.line->setup();
  setup.stays = true;
  vehicle.line = std::make_shared<const LineEffects>(vehicle.system, std::move(setup));
  return vehicle;
}

/// From the state that was found. slopes: of contacts that cost less, by which steps are made as long as they halve the
/// imbalance; null: none.
void iterate(const Balance& balance, const EquilibriumSettings& settings, Equilibrium& found, std::string& why,
             const Balance* slopes = nullptr) {
  Vector r;
  found.residual = std::numeric_limits<double>::infinity();
  if (!balance.imbalance(found.state, r, found.reactions, why)) return;
  found.residual = balance.measure(r);
  const int most = found.iterations + settings.max_iterations;
  constexpr double kWider = 10.0, kWidest = 100.0;
  double coarseness = 1.0;
  for (; found.residual > settings.tolerance && found.iterations < most; ++found.iterations) {
    const Vector step = (slopes ? *slopes : balance).jacobian(found.state, coarseness).solve(r);
    constexpr double kShortest = 1e-3;
    const double before = found.residual;
    bool better = false;
    for (double share = 1.0; share > kShortest && !better; share *= 0.5) {
      const SystemState trial = balance.moved(found.state, share * step);
      Vector r_trial;
      std::vector<ContactReaction> reactions;
      if (!balance.imbalance(trial, r_trial, reactions, why)) continue;
      const double residual = balance.measure(r_trial);
      if (!(residual < found.residual)) continue;
      better = true;
      found.state = trial;
      found.residual = residual;
      found.reactions = std::move(reactions);
      r = r_trial;
    }
    if (slopes) {
      if (!(found.residual < 0.5 * before)) slopes = nullptr;
      continue;
    }
    // Slopes over wider differences pass over jumps of the forces.
    if (!better && (coarseness *= kWider) > kWidest) break;
  }
  for (const auto& [wide, share] : {std::pair{20.0, 1.0}, {20.0, 0.4}, {100.0, 0.4}})
    if (found.residual > settings.acceptable) step_over_jumps(balance, wide, share, settings.tolerance, found);
}

/// Lets the vehicle run in until Newton's method finds the balance from where it has come: it steers as it would in a
/// curve of that kind without end.
void run_in(const VehicleOnTrack& vehicle, const Balance& balance, const EquilibriumSettings& settings,
            Equilibrium& found, std::string& why) {
  constexpr double kLength = 15.0, kStep = 5e-3;  // [m], [s]
  constexpr int kPieces = 8;
  const KeptElements kept(vehicle);
  SimulationSettings run;
  run.duration = kPieces * kLength / vehicle.speed;
  run.position_tolerance = 1e-6;
  run.max_step = kStep;
  run.first_step = 1e-5;
  run.max_travel = 0.1;
  run.step.spectral_radius = 0.5;
  try {
    Simulation simulation(staying(vehicle), balance.start(), run);
    for (int piece = 1; piece <= kPieces && found.residual > settings.acceptable; ++piece) {
      while (!simulation.finished() && simulation.state().time * vehicle.speed < piece * kLength) simulation.advance();
      if (!simulation.derailed().empty()) {
        why = simulation.derailed();
        return;
      }
      Equilibrium now;
      now.state = balance.standing(simulation.state());
      now.iterations = found.iterations;
      iterate(balance, settings, now, why);
      found.iterations = now.iterations;
      if (now.residual < found.residual) found = std::move(now);
    }
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::numerical) throw;
    why = e.message();
  }
}

/// From wheelsets that turn freely where they stand.
void start_rolling(const Balance& balance, const EquilibriumSettings& settings, Equilibrium& found, std::string& why) {
  Equilibrium now;
  now.state = balance.start();
  if (!balance.let_roll(now.state)) return;
  now.iterations = found.iterations;
  iterate(balance, settings, now, why);
  found.iterations = now.iterations;
  if (now.residual < found.residual) found = std::move(now);
}

/// Where forces are left out of balance; empty: nothing is known of them.
std::string where_most(const Balance& balance, const Equilibrium& found, std::vector<ContactReaction>& reactions) {
  Vector r;
  std::string why;
  return balance.imbalance(found.state, r, reactions, why) ? ", most along " + balance.most(r) : "";
}

/// What is known of a balance that was not found.
std::string what_remains(const VehicleOnTrack& vehicle, const Balance& balance, const Equilibrium& found) {
  std::vector<ContactReaction> reactions;
  std::string text = where_most(balance, found, reactions);
  if (text.empty()) return text;
  for (std::size_t i = 0; i < reactions.size(); ++i)
    text += fmt::format("{} {} touches at y = {:.4g} mm", i == 0 ? ";" : ",", vehicle.wheels[i].name,
                        reactions[i].contact_y * kMilli);
  return text;
}

/// The same of one that is near. Contacts that are solved element by element cost much.
std::string why_forces_remain(const VehicleOnTrack& vehicle, const Balance& balance, const Equilibrium& found) {
  if (ranges::any_of(vehicle.wheels, [](const WheelOnRail& wheel) { return wheel.element->costly(); }))
    return ": those of full contacts jump with their elements";
  std::vector<ContactReaction> reactions;
  return where_most(balance, found, reactions);
}

/// From the balance of the same vehicle with simpler contacts, where that leads there.
std::optional<Equilibrium> from_easy(const Balance& balance, const VehicleOnTrack& easy,
                                     const EquilibriumSettings& settings) {
  try {
    Equilibrium near = find_equilibrium(easy, settings);
    if (near.report.status != Status::ok) return std::nullopt;
    const Balance slopes(easy);
    std::string why;
    iterate(balance, settings, near, why, &slopes);
    near.report = {};
    if (near.residual <= settings.acceptable) return near;
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::numerical) throw;
  }
  return std::nullopt;
}

}  // namespace

Equilibrium find_equilibrium(const VehicleOnTrack& vehicle, const EquilibriumSettings& settings,
                             const VehicleOnTrack* easy) {
  const Balance balance(vehicle);
  if (easy)
    if (auto near = from_easy(balance, *easy, settings)) return *near;
  Equilibrium found;
  found.state = balance.start();
  Vector r;
  std::string why;
  if (!balance.imbalance(found.state, r, found.reactions, why)) {
    found.report = {Status::failed, 0, found.residual, "no start for the static equilibrium: " + why};
    return found;
  }
  iterate(balance, settings, found, why);
  if (found.residual > settings.acceptable && vehicle.line && vehicle.line->setup().path)
    run_in(vehicle, balance, settings, found, why);
  if (found.residual > settings.doubtful) start_rolling(balance, settings, found, why);
  if (found.residual > settings.doubtful)
    found.report = {
        Status::not_converged, found.iterations, found.residual,
        fmt::format("the static equilibrium was not found: forces of {:.2g} of a wheelset's load remain{}{}{}",
                    found.residual, what_remains(vehicle, balance, found), why.empty() ? "" : "; ", why)};
  else if (found.residual > settings.acceptable)
    found.report.message =
        fmt::format("in the static equilibrium forces of {:.2g} of a wheelset's load remain out of balance{}",
                    found.residual, why_forces_remain(vehicle, balance, found));
  return found;
}

}  // namespace treadmark::vehicle
