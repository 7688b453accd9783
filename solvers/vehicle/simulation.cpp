// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/simulation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/vehicle/wheel_loop.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kSafety = 0.9, kLeastFactor = 0.2, kMostFactor = 2.0;
/// Step lengths change only where it is worth a new factorisation.
constexpr double kWorthShortening = 0.95, kWorthGrowing = 1.25;
constexpr std::uint32_t kStateFormat = 6;

double step_factor(double error, double tolerance) {
  if (!(error > 0.0)) return kMostFactor;
  const double factor = std::clamp(kSafety * std::cbrt(tolerance / error), kLeastFactor, kMostFactor);
  return factor > kWorthShortening && factor < kWorthGrowing ? 1.0 : factor;
}

double energy_of_elements(const Multibody& s, const Motion& motion, const std::optional<LineState>& line) {
  Vector displacement = s.elements.of(motion.state.q);
  if (line) displacement += line->element_stretch;
  return s.elements.energy(displacement, motion.element_memory);
}

EnergyBalance energy_of(const Multibody& s, const Motion& motion, const std::vector<ContactReaction>& reactions,
                        const std::optional<LineState>& line) {
  const SystemState& state = motion.state;
  EnergyBalance e;
  e.mechanical = 0.5 * state.v.dot(s.mass.cwiseProduct(state.v)) + 0.5 * state.q.dot(s.times(s.stiffness, state.q)) -
                 s.weight.dot(state.q);
  if (line) e.mechanical += line->spring_energy - line->spring.dot(state.q);
  double stops = 0.0;
  characteristic_forces(s, state.q, &stops, line ? &line->stop_offsets : nullptr);
  e.mechanical += stops;
  if (s.elements.size() > 0) e.mechanical += energy_of_elements(s, motion, line);
  for (const ContactReaction& r : reactions) e.elastic += r.elastic_energy;
  return e;
}

/// Forces of the bump stops times what the line stretches them by between two times.
double work_on_stops(const Multibody& s, const Vector& q, const LineState& at, const LineState& from,
                     const LineState& to) {
  double work = 0.0;
  for (std::size_t i = 0; i < s.characteristics.size(); ++i) {
    const CharacteristicForce& c = s.characteristics[i];
    work += value_at(c.curve, displacement(s, c, q) + at.stop_offsets[i]).force *
            (to.stop_offsets[i] - from.stop_offsets[i]);
  }
  return work;
}

/// Work of a line on a vehicle between two instants, by the trapezoidal rule: forces that are none of stretched
/// springs and dampers, and what stretches those.
struct LineWork {
  double dampers = 0.0;  ///< dissipated beside what the rates of the coordinates say
  double work = 0.0;
};
LineWork line_work(const Multibody& s, const SystemState& from, const LineState& before, const SystemState& to,
                   const LineState& after) {
  const double h = to.time - from.time;
  const Vector moved = to.q - from.q;
  const auto other = [](const LineState& l) { return Vector(l.force - l.spring - l.damper); };
  LineWork w;
  w.dampers = 0.5 * h * (before.damper_power + after.damper_power) - moved.dot(before.damper + after.damper);
  w.work = 0.5 * moved.dot(other(before) + other(after) - before.damper - after.damper) +
           0.5 * h * (before.damper_power + after.damper_power) -
           0.5 * (from.q + to.q).dot(after.spring - before.spring) + after.spring_energy - before.spring_energy +
           0.5 * (work_on_stops(s, from.q, before, before, after) + work_on_stops(s, to.q, after, before, after));
  return w;
}

void put(ByteWriter& out, const Vector& v) {
  out.put(std::span<const double>(v.data(), static_cast<std::size_t>(v.size())));
}

void get(ByteReader& in, Vector& v, Eigen::Index size) {
  std::vector<double> values;
  in.get(values);
  if (static_cast<Eigen::Index>(values.size()) != size)
    throw Error(ErrorKind::input_data, "a saved state belongs to another vehicle", {}, "start anew");
  v = Eigen::Map<const Vector>(values.data(), size);
}

}  // namespace

void check(const SimulationSettings& s) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw Error(ErrorKind::configuration, fmt::format("{} must be positive and finite", what));
  };
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  require(positive(s.duration), "the duration");
  require(positive(s.position_tolerance), "the tolerance of positions");
  require(positive(s.max_step) && positive(s.min_step), "the longest and the shortest step");
  if (s.min_step > s.max_step)
    throw Error(ErrorKind::configuration,
                fmt::format("the shortest step of {:.6g} us exceeds the longest one of {:.6g} us", s.min_step * 1e6,
                            s.max_step * 1e6));
  require(positive(s.first_step), "the first step");
  require(positive(s.max_travel), "the travel of a step");
  require(positive(s.event_tolerance), "the tolerance of events");
}

Simulation::Simulation(VehicleOnTrack vehicle, const SystemState& start, const SimulationSettings& settings)
    : vehicle_(std::make_unique<VehicleOnTrack>(std::move(vehicle))),
      settings_(settings),
      scheme_(*vehicle_, settings.step) {
  check(settings);
  if (vehicle_->maps.size() != vehicle_->wheels.size())
    throw Error(ErrorKind::configuration, "the wheels are not connected");
  reactions_ = evaluate_wheels(*vehicle_, start);
  for (std::size_t i = 0; i < reactions_.size(); ++i)
    if (is_unsolved(reactions_[i]))
      throw Error(ErrorKind::numerical,
                  fmt::format("{} cannot be solved at the start: {}", vehicle_->wheels[i].name, reactions_[i].message));
  for (const WheelOnRail& wheel : vehicle_->wheels) wheel.element->accept();
  motion_ = scheme_.start(start, reactions_);
  next_step_ = std::min(settings.first_step, settings.max_step);
  line_ = vehicle_->line_state(start.time);
  energy_ = energy_at_start_ = energy_of(vehicle_->system, motion_, reactions_, line_);
}

double Simulation::element_stretch(int column) const {
  double sum = line_ ? line_->element_stretch[column] : 0.0;
  for (const auto& [c, factor] : vehicle_->system.elements.columns[static_cast<std::size_t>(column)].direction)
    sum += factor * motion_.state.q[c];
  return sum;
}

double Simulation::longest_step() const {
  double travel = settings_.max_travel;
  for (const WheelOnRail& wheel : vehicle_->wheels) travel = std::min(travel, wheel.element->longest_travel());
  return std::min({settings_.max_step, travel / vehicle_->travel(motion_.state.time).speed,
                   settings_.duration - motion_.state.time});
}

Step Simulation::attempt(double length) {
  check_cancelled();
  Step step = scheme_.take(motion_, length);
  counts_.evaluations += std::max(1, step.iterations);
  return step;
}

bool Simulation::changes_contact(const Step& step) const {
  for (std::size_t i = 0; i < reactions_.size(); ++i)
    if ((reactions_[i].least_gap < 0.0) != (step.reactions[i].least_gap < 0.0)) return true;
  return false;
}

/// Shortens a step to the first change of contact in it (regula falsi of the gap, Illinois variant); ends just behind
/// the change.
Step Simulation::locate_event(const Step& step, double length) {
  constexpr int kMostTrials = 40;
  std::size_t wheel = 0;
  double earliest = 2.0;
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    const double before = reactions_[i].least_gap, after = step.reactions[i].least_gap;
    if ((before < 0.0) == (after < 0.0)) continue;
    const double share = before / (before - after);
    if (share < earliest) earliest = share, wheel = i;
  }
  double low = 0.0, high = length, gap_low = reactions_[wheel].least_gap, gap_high = step.reactions[wheel].least_gap;
  const bool was_touching = gap_low < 0.0;
  int last_side = 0;
  for (int trial = 0; trial < kMostTrials && high - low > settings_.event_tolerance; ++trial) {
    double share = gap_low == gap_high ? 0.5 : gap_low / (gap_low - gap_high);
    if (!(share > 0.0 && share < 1.0)) share = 0.5;
    const double h = low + std::clamp(share, 0.02, 0.98) * (high - low);
    Step shorter = attempt(h);
    if (!shorter.converged) break;
    const double gap = shorter.reactions[wheel].least_gap;
    if ((gap < 0.0) == was_touching) {
      low = h, gap_low = gap;
      if (last_side == -1) gap_high *= 0.5;
      last_side = -1;
    } else {
      high = h, gap_high = gap;
      if (last_side == 1) gap_low *= 0.5;
      last_side = 1;
    }
  }
  // Elements keep what they evaluate last.
  return attempt(high);
}

void Simulation::accept(Step step) {
  const VehicleOnTrack& vehicle = *vehicle_;
  const SystemState& from = motion_.state;
  const SystemState& to = step.end.state;
  const double h = to.time - from.time;
  const Vector moved = to.q - from.q;
  std::optional<LineState> line = vehicle.line_state(to.time);
  EnergyBalance e = energy_of(vehicle.system, step.end, step.reactions, line);
  double dampers = moved.dot(vehicle.system.times(vehicle.system.dissipation, moved)) / h;
  if (line) {
    const LineWork w = line_work(vehicle.system, from, *line_, to, *line);
    dampers += w.dampers;
    e.line = energy_.line + w.work;
  }
  if (const ForceElements& elements = vehicle.system.elements; elements.size() > 0) {
    const Vector force = 0.5 * (motion_.element_force + step.end.element_force);
    const double by_line = line ? force.dot(line->element_stretch - line_->element_stretch) : 0.0;
    e.line += by_line;
    if (line && !line->couplers_aside.empty()) {
      Vector aside = Vector::Zero(moved.size());
      line_->add_couplers_aside(motion_.element_force, 0.5, aside);
      line->add_couplers_aside(step.end.element_force, 0.5, aside);
      e.line += moved.dot(aside);
    }
    dampers +=
        force.dot(elements.of(moved)) + by_line -
        (energy_of_elements(vehicle.system, step.end, line) - energy_of_elements(vehicle.system, motion_, line_));
  }
  e.dampers = energy_.dampers + dampers;
  e.contact_work = energy_.contact_work;
  e.drive = energy_.drive;
  e.friction = energy_.friction;
  e.turnover = energy_.turnover + std::abs(dampers);
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const PairVector force = 0.5 * (motion_.contact_force[i] + step.end.contact_force[i]);
    const double work = force.dot(vehicle.on_pair(i, moved));
    const double drive = vehicle.line ? -0.5 * h *
                                            (motion_.contact_force[i].dot(vehicle.travelling(i, from)) +
                                             step.end.contact_force[i].dot(vehicle.travelling(i, to)))
                                      : -h * vehicle.speed * (force[0] - force[4] / vehicle.radius(i));
    e.contact_work += work;
    e.drive += drive;
    e.friction += 0.5 * h * (reactions_[i].frictional_power + step.reactions[i].frictional_power);
    e.turnover += std::abs(work) + std::abs(drive);
  }
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    const bool before = reactions_[i].least_gap < 0.0, after = step.reactions[i].least_gap < 0.0;
    if (before != after) events_.push_back({to.time, i, after});
  }
  energy_ = e;
  line_ = std::move(line);
  motion_ = std::move(step.end);
  reactions_ = std::move(step.reactions);
  ++counts_.steps;
}

void Simulation::advance() {
  if (finished()) return;
  const double next_step = next_step_;
  const Counts counts = counts_;
  try {
    take_step();
  } catch (const Cancelled&) {
    // as if the step had not been tried
    next_step_ = next_step;
    counts_ = counts;
    throw;
  }
}

void Simulation::take_step() {
  double h = std::min(next_step_, longest_step());
  if (vehicle_->line) h = vehicle_->line->step_within(motion_.state.time, h);
  Step step;
  for (;;) {
    step = attempt(h);
    const bool good = step.converged && step.position_error <= settings_.position_tolerance;
    if (good) break;
    ++counts_.rejected;
    const double factor =
        step.converged ? std::min(0.8, step_factor(step.position_error, settings_.position_tolerance)) : 0.3;
    const bool shortest = !(h * factor >= settings_.min_step && h * factor > 0.0);  // no number either
    constexpr double kNear = 1e-5;                                                  // [s]
    if (step.derailed && (shortest || h <= kNear)) {
      derailed_ = step.why_not;
      return;
    }
    if (shortest)
      throw Error(ErrorKind::numerical,
                  fmt::format("the step became shorter than {:.3g} s at t = {:.9g} s: {}", settings_.min_step,
                              motion_.state.time,
                              step.converged ? "the error of positions stays above the tolerance" : step.why_not),
                  {}, "look at the forces before this time; a larger tolerance or a finer grid may help");
    h *= factor;
  }
  next_step_ = h * step_factor(step.position_error, settings_.position_tolerance);
  if (changes_contact(step)) step = locate_event(step, h);
  for (const WheelOnRail& wheel : vehicle_->wheels) wheel.element->accept();
  accept(std::move(step));
}

void Simulation::save(ByteWriter& out) const {
  out.put(kStateFormat);
  out.put(motion_.state.time);
  for (const Vector* v : {&motion_.state.q, &motion_.state.v, &motion_.a, &motion_.a_before, &motion_.unbalanced,
                          &motion_.element_force, &motion_.element_memory})
    put(out, *v);
  out.put(motion_.step_before);
  out.put(next_step_);
  for (const PairVector& f : motion_.contact_force) put(out, f);
  for (const ContactReaction& r : reactions_)
    for (const double value : {r.least_gap, r.frictional_power, r.elastic_energy, r.normal_force}) out.put(value);
  out.put(events_.size());
  for (const ContactEvent& e : events_) out.put(e.time), out.put(e.wheel), out.put(e.regained);
  for (const EnergyBalance* e : {&energy_, &energy_at_start_})
    for (const double value :
         {e->mechanical, e->dampers, e->contact_work, e->drive, e->line, e->friction, e->elastic, e->turnover})
      out.put(value);
  out.put(counts_.steps), out.put(counts_.rejected), out.put(counts_.evaluations);
  for (const WheelOnRail& wheel : vehicle_->wheels) wheel.element->save(out);
}

void Simulation::restore(ByteReader& in) {
  if (in.get<std::uint32_t>() != kStateFormat)
    throw Error(ErrorKind::input_data, "a saved state is of another version", {}, "start anew");
  const Eigen::Index n = vehicle_->system.size();
  Motion m;
  in.get(m.state.time);
  for (Vector* v : {&m.state.q, &m.state.v, &m.a, &m.a_before, &m.unbalanced}) get(in, *v, n);
  get(in, m.element_force, motion_.element_force.size());
  get(in, m.element_memory, motion_.element_memory.size());
  in.get(m.step_before);
  in.get(next_step_);
  for (std::size_t i = 0; i < vehicle_->wheels.size(); ++i) {
    Vector f;
    get(in, f, kPairCoordinates);
    m.contact_force.emplace_back(f);
  }
  motion_ = std::move(m);
  for (ContactReaction& r : reactions_)
    for (double* value : {&r.least_gap, &r.frictional_power, &r.elastic_energy, &r.normal_force}) in.get(*value);
  events_.clear();
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    ContactEvent& e = events_.emplace_back();
    in.get(e.time), in.get(e.wheel), in.get(e.regained);
    if (e.wheel >= vehicle_->wheels.size())
      throw Error(ErrorKind::input_data, "a saved state belongs to another vehicle", {}, "start anew");
  }
  for (EnergyBalance* e : {&energy_, &energy_at_start_})
    for (double* value :
         {&e->mechanical, &e->dampers, &e->contact_work, &e->drive, &e->line, &e->friction, &e->elastic, &e->turnover})
      in.get(*value);
  in.get(counts_.steps), in.get(counts_.rejected), in.get(counts_.evaluations);
  line_ = vehicle_->line_state(motion_.state.time);
  derailed_.clear();
  for (const WheelOnRail& wheel : vehicle_->wheels) wheel.element->restore(in);
}

}  // namespace treadmark::vehicle
