// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/moving_rail.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

void require_equal_bays(const FlexibleTrack& track) {
  const std::vector<RailSeat>& seats = track.seats;
  const auto refuse = [](const char* message, const char* advice) {
    throw Error(ErrorKind::configuration, message, {}, advice);
  };
  constexpr std::size_t kLeast = 20;
  if (seats.size() < kLeast) refuse("a wheel needs at least 20 sleepers below it", "make seats.count larger");
  const double bay = seats[1].x - seats[0].x;
  for (std::size_t i = 1; i < seats.size(); ++i) {
    const RailSeat &a = seats[i - 1], &b = seats[i];
    const bool equal = a.pad_stiffness == b.pad_stiffness && a.pad_damping == b.pad_damping &&
                       a.sleeper_mass == b.sleeper_mass && a.bed_stiffness == b.bed_stiffness &&
                       a.bed_damping == b.bed_damping && std::abs((b.x - a.x) / bay - 1.0) < 1e-9;
    if (!equal)
      refuse("a wheel moves along a track of equal sleepers at equal distances only", "make all of them equal");
  }
}

void add_rail_state(ByteWriter& out, const Eigen::VectorXd& v) {
  out.put(std::span<const double>(v.data(), static_cast<std::size_t>(v.size())));
}

}  // namespace

MovingRail::MovingRail(const FlexibleTrack& track, double speed, double start, double spectral_radius)
    : rail_(track), speed_(speed), start_(start) {
  require_equal_bays(track);
  if (!(speed > 0.0) || !std::isfinite(speed) || !std::isfinite(start))
    throw Error(ErrorKind::configuration, "the speed along a rail must be positive");
  if (!(spectral_radius >= 0.5 && spectral_radius <= 1.0))
    throw Error(ErrorKind::configuration, "the spectral radius must lie between 0.5 and 1");
  alpha_ = -(1.0 - spectral_radius) / (1.0 + spectral_radius);
  beta_ = 0.25 * (1.0 - alpha_) * (1.0 - alpha_);
  gamma_ = 0.5 - alpha_;
  bay_ = rail_.middle_bay();
  first_ = rail_.middle() - 0.5 * bay_;
  bay_size_ = 2 * track.bay_elements + 1;
  q_ = v_ = a_ = Column::Zero(rail_.size());

  // A step between what still moves and what is taken up at rest would give energy.
  constexpr Eigen::Index kCalmedBays = 10;
  const Eigen::Index rest = rail_.size() - bay_size_, calmed = std::min(kCalmedBays * bay_size_, rest / 4);
  calm_ = Column::Ones(rest);
  for (Eigen::Index i = 0; i < calmed; ++i) {
    const double s = std::cos(0.5 * kPi * static_cast<double>(i + 1) / static_cast<double>(calmed));
    calm_[rest - calmed + i] = s * s;
  }
}

/// Without what the window has moved on, the place at time 0 lies in the middle bay.
double MovingRail::window_place(double time) const {
  const double from_first = start_ + 0.5 * bay_;
  const double in_bay = from_first - bay_ * std::floor(from_first / bay_);
  return first_ + in_bay + (speed_ * time - windows_ * bay_);
}

MovingRail::Column MovingRail::spread(const RailOnSeats::Place& place) const {
  Column f = Column::Zero(rail_.size());
  for (std::size_t i = 0; i < 4; ++i) f[place.coordinate[i]] += place.value[static_cast<Eigen::Index>(i)];
  return f;
}

double MovingRail::along(const RailOnSeats::Place& place, const BeamVector& by, const Column& q) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += by[static_cast<Eigen::Index>(i)] * q[place.coordinate[i]];
  return sum;
}

MovingRail::Answer MovingRail::at_rest() const { return {0.0, rail_.receptance(window_place(0.0), 0.0).real()}; }

const BandedSymmetric<double>& MovingRail::factors(double h) {
  if (factors_of_ == h) return factors_;
  factors_ = rail_.mass();
  const double of_damping = (1.0 + alpha_) * gamma_ * h, of_stiffness = (1.0 + alpha_) * beta_ * h * h;
  for (std::size_t i = 0; i < factors_.values().size(); ++i)
    factors_.values()[i] += of_damping * rail_.damping().values()[i] + of_stiffness * rail_.stiffness().values()[i];
  factors_.factorise();
  factors_of_ = h;
  return factors_;
}

MovingRail::Answer MovingRail::after(double time) {
  if (!trial_ || trial_->time != time) {
    Trial t;
    t.time = time;
    const double h = time - time_;
    t.place = rail_.place(window_place(time));
    t.of_q = beta_ * h * h;
    t.of_v = gamma_ * h;
    t.known_q = q_ + h * v_ + (0.5 - beta_) * h * h * a_;
    t.known_v = v_ + (1.0 - gamma_) * h * a_;
    if (h > 0.0) {
      const BandedSymmetric<double>& f = factors(h);
      const RailOnSeats::Place before = rail_.place(window_place(time_));
      t.free = alpha_ * (rail_.damping().times(v_) + rail_.stiffness().times(q_)) - alpha_ * force_ * spread(before) -
               (1.0 + alpha_) * (rail_.damping().times(t.known_v) + rail_.stiffness().times(t.known_q));
      f.solve(t.free);
      t.unit = (1.0 + alpha_) * spread(t.place);
      f.solve(t.unit);
    } else {
      t.free = a_;
      t.unit = Column::Zero(rail_.size());
    }
    const auto answer = [&](const BeamVector& by, const Column& known, double of) {
      return Answer{along(t.place, by, known) + of * along(t.place, by, t.free), of * along(t.place, by, t.unit)};
    };
    t.deflection = answer(t.place.value, t.known_q, t.of_q);
    t.deflection.compliance += t.place.own_compliance;
    t.slope = answer(t.place.slope, t.known_q, t.of_q);
    t.rate = answer(t.place.value, t.known_v, t.of_v);
    t.rate.free += speed_ * t.slope.free;
    t.rate.compliance += speed_ * (t.slope.compliance + t.place.own_compliance_slope);
    // The rest bends with the force, which yields no work where it only moves along.
    t.slope.compliance += 0.5 * t.place.own_compliance_slope;
    trial_ = std::move(t);
  }
  return trial_->deflection;
}

double MovingRail::rate(double force) const { return trial_->rate.free + trial_->rate.compliance * force; }

MovingRail::Moved MovingRail::moved(double force) const {
  const Trial& t = *trial_;
  const Column a = t.free + force * t.unit, q = t.known_q + t.of_q * a, v = t.known_v + t.of_v * a;
  Moved m;
  m.slope = t.slope.free + t.slope.compliance * force;
  m.energy = 0.5 * v.dot(rail_.mass().times(v)) + 0.5 * q.dot(rail_.stiffness().times(q)) +
             0.5 * t.place.own_compliance * force * force;
  m.power = v.dot(rail_.damping().times(v));
  return m;
}

void MovingRail::begin(double force) {
  time_ = windows_ = 0.0;
  force_ = force;
  BandedSymmetric<double> k = rail_.stiffness();
  k.factorise();
  const auto under = [&](double by) {
    Column q = force * spread(rail_.place(window_place(0.0) + by));
    k.solve(q);
    return q;
  };
  // Where it has come from slowly.
  constexpr double kStep = 1e-3;
  q_ = under(0.0);
  v_ = speed_ / (2.0 * kStep) * (under(kStep) - under(-kStep));
  a_ = Column::Zero(rail_.size());
  trial_.reset();
}

void MovingRail::accept(double force) {
  const Trial& t = *trial_;
  const Column a = t.free + force * t.unit;
  q_ = t.known_q + t.of_q * a;
  v_ = t.known_v + t.of_v * a;
  a_ = a;
  time_ = t.time;
  force_ = force;
  trial_.reset();
  while (window_place(time_) >= first_ + bay_) move_window();
}

void MovingRail::move_window() {
  windows_ += 1.0;
  const Eigen::Index rest = q_.size() - bay_size_;
  for (Column* column : {&q_, &v_, &a_}) {
    const Column kept = column->tail(rest).cwiseProduct(calm_);
    column->head(rest) = kept;
    column->tail(bay_size_).setZero();
  }
}

void MovingRail::save(ByteWriter& out) const {
  for (const double value : {time_, force_, windows_}) out.put(value);
  for (const Column* column : {&q_, &v_, &a_}) add_rail_state(out, *column);
}

void MovingRail::restore(ByteReader& in) {
  for (double* value : {&time_, &force_, &windows_}) in.get(*value);
  for (Column* column : {&q_, &v_, &a_}) {
    std::vector<double> values;
    in.get(values);
    if (static_cast<Eigen::Index>(values.size()) != q_.size())
      throw Error(ErrorKind::input_data, "a saved state belongs to another track", {}, "start anew");
    *column = Eigen::Map<const Column>(values.data(), q_.size());
  }
  trial_.reset();
}

}  // namespace treadmark::vehicle
