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

void add_rail_state(ByteWriter& out, const Eigen::VectorXd& v) {
  out.put(std::span<const double>(v.data(), static_cast<std::size_t>(v.size())));
}

}  // namespace

MovingRail::MovingRail(const FlexibleTrack& track, double speed, double start, double spectral_radius, double length)
    : track_(track), speed_(speed) {
  const RailOnSeats whole(track);  // refuses what makes no sense
  track_.bay_elements = std::min(track.bay_elements, kMostBayElements);
  constexpr double kFarthest = 1e6;  // [m]
  if (!(speed > 0.0) || !std::isfinite(speed))
    throw Error(ErrorKind::configuration, "the speed along a rail must be positive");
  if (!(std::abs(start) <= kFarthest))
    throw Error(ErrorKind::configuration, "a rail begins within 1000 km of the middle of its seats");
  if (!(spectral_radius >= 0.5 && spectral_radius <= 1.0))
    throw Error(ErrorKind::configuration, "the spectral radius must lie between 0.5 and 1");
  alpha_ = -(1.0 - spectral_radius) / (1.0 + spectral_radius);
  beta_ = 0.25 * (1.0 - alpha_) * (1.0 - alpha_);
  gamma_ = 0.5 - alpha_;
  start_ = whole.middle() + start;

  constexpr double kFewest = 20.0, kMost = 1e4;
  const std::vector<RailSeat>& seats = track.seats;
  const double bay = (seats.back().x - seats.front().x) / static_cast<double>(seats.size() - 1);
  if (!(length > 0.0 && length <= kMost * bay))
    throw Error(ErrorKind::configuration, "the part of a rail that is looked at has a length of at most 10000 bays");
  seats_ = static_cast<std::int64_t>(std::max(kFewest, std::ceil(length / bay)));

  std::int64_t before = 0;  // seat before the start
  while (seat(before).x > start_) --before;
  while (seat(before + 1).x <= start_) ++before;
  look_from(before - (seats_ - 1) / 2);
  // Where it has come from slowly. Forces of dampers are in balance, too, or else the first step would lose energy.
  constexpr double kStep = 1e-3;
  BandedSymmetric<double> k = rail_->stiffness();
  k.factorise();
  const RailOnSeats::Place place = rail_->place(start_);
  const auto under = [&](const RailOnSeats::Place& at, const Column& dampers) {
    Column q = spread(at) - dampers;
    k.solve(q);
    return q;
  };
  const Column none = Column::Zero(rail_->size());
  unit_v_ =
      speed_ / (2.0 * kStep) * (under(rail_->place(start_ + kStep), none) - under(rail_->place(start_ - kStep), none));
  unit_q_ = under(place, rail_->damping().times(unit_v_));
  compliance_at_rest_ = along(place, place.value, unit_q_) + place.own_compliance;
  energy_at_rest_ = 0.5 * (rail_->stiffness().form(unit_q_) + place.own_compliance + rail_->mass().form(unit_v_));
  power_at_rest_ = rail_->damping().form(unit_v_);
  q_ = v_ = a_ = Column::Zero(rail_->size());

  // A step between what still moves and what is taken up at rest would give energy.
  constexpr Eigen::Index kCalmedBays = 10;
  const Eigen::Index bay_size = 2 * track_.bay_elements + 1, rest = rail_->size() - bay_size,
                     calmed = std::min(kCalmedBays * bay_size, rest / 4);
  calm_ = Column::Ones(rest);
  for (Eigen::Index i = 0; i < calmed; ++i) {
    const double s = std::cos(0.5 * kPi * static_cast<double>(i + 1) / static_cast<double>(calmed));
    calm_[rest - calmed + i] = s * s;
  }
}

/// Also those that continue the track.
RailSeat MovingRail::seat(std::int64_t index) const {
  const std::vector<RailSeat>& seats = track_.seats;
  const auto last = static_cast<std::int64_t>(seats.size()) - 1;
  if (index >= 0 && index <= last) return seats[static_cast<std::size_t>(index)];
  RailSeat beyond = index < 0 ? seats.front() : seats.back();
  if (index < 0)
    beyond.x += static_cast<double>(index) * (seats[1].x - seats[0].x);
  else
    beyond.x += static_cast<double>(index - last) * (beyond.x - seats[seats.size() - 2].x);
  return beyond;
}

/// Makes the part that begins with this seat the one that is looked at.
void MovingRail::look_from(std::int64_t first_seat) {
  first_seat_ = first_seat;
  FlexibleTrack part = track_;
  part.seats.clear();
  for (std::int64_t i = 0; i < seats_; ++i) part.seats.push_back(seat(first_seat + i));
  part.absorbing_bays = std::min(track_.absorbing_bays, static_cast<int>(seats_ / 4));
  rail_ = std::make_unique<const RailOnSeats>(part);
  next_place_ = seat(first_seat + (seats_ - 1) / 2 + 1).x;
  factors_of_ = -1.0;
  trial_.reset();
}

MovingRail::Column MovingRail::spread(const RailOnSeats::Place& place) const {
  Column f = Column::Zero(rail_->size());
  for (std::size_t i = 0; i < 4; ++i) f[place.coordinate[i]] += place.value[static_cast<Eigen::Index>(i)];
  return f;
}

double MovingRail::along(const RailOnSeats::Place& place, const BeamVector& by, const Column& q) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += by[static_cast<Eigen::Index>(i)] * q[place.coordinate[i]];
  return sum;
}

void MovingRail::factorise(double h) {
  if (factors_of_ == h) return;
  factors_ = rail_->mass();
  const double of_damping = (1.0 + alpha_) * gamma_ * h, of_stiffness = (1.0 + alpha_) * beta_ * h * h;
  for (std::size_t i = 0; i < factors_.values().size(); ++i)
    factors_.values()[i] += of_damping * rail_->damping().values()[i] + of_stiffness * rail_->stiffness().values()[i];
  factors_.factorise();
  factors_of_ = h;
  by_unit_.clear();
}

/// Accelerations by a unit force there, for the length of a step in use.
const MovingRail::Column& MovingRail::by_unit(int coordinate) {
  Column& column = by_unit_[coordinate];
  if (column.size() == 0) {
    column = Column::Zero(rail_->size());
    column[coordinate] = 1.0;
    factors_.solve(column);
  }
  return column;
}

MovingRail::Answer MovingRail::after(double time) {
  if (!trial_ || trial_->time != time) {
    Trial t;
    t.time = time;
    // Differences of times vary in their last digits, which are not worth a factorisation.
    const double h = static_cast<float>(time - time_);
    t.place = rail_->place(place_at(time));
    t.length = h;
    t.before = rail_->place(place_at(time_));
    t.of_q = beta_ * h * h;
    t.of_v = gamma_ * h;
    t.known_q = q_ + h * v_ + (0.5 - beta_) * h * h * a_;
    t.known_v = v_ + (1.0 - gamma_) * h * a_;
    if (h > 0.0) {
      factorise(h);
      t.free = rail_->damping().times(alpha_ * v_ - (1.0 + alpha_) * t.known_v) +
               rail_->stiffness().times(alpha_ * q_ - (1.0 + alpha_) * t.known_q) - alpha_ * force_ * spread(t.before);
      factors_.solve(t.free);
      t.unit = Column::Zero(rail_->size());
      for (std::size_t i = 0; i < 4; ++i)
        t.unit += (1.0 + alpha_) * t.place.value[static_cast<Eigen::Index>(i)] * by_unit(t.place.coordinate[i]);
    } else {
      t.free = a_;
      t.unit = Column::Zero(rail_->size());
    }
    const auto answer = [&](const BeamVector& by, const Column& known, double of) {
      return Answer{along(t.place, by, known) + of * along(t.place, by, t.free), of * along(t.place, by, t.unit)};
    };
    t.deflection = answer(t.place.value, t.known_q, t.of_q);
    t.deflection.compliance += t.place.own_compliance;
    const Answer slope = answer(t.place.slope, t.known_q, t.of_q);
    t.rate = answer(t.place.value, t.known_v, t.of_v);
    t.rate.free += speed_ * slope.free;
    t.rate.compliance += speed_ * (slope.compliance + t.place.own_compliance_slope);
    trial_ = std::move(t);
  }
  return trial_->deflection;
}

double MovingRail::rate(double force) const { return trial_->rate.free + trial_->rate.compliance * force; }

MovingRail::Moved MovingRail::moved(double force) const {
  const Trial& t = *trial_;
  const Column a = t.free + force * t.unit, q = t.known_q + t.of_q * a, v = t.known_v + t.of_v * a;
  Moved m;
  m.energy = 0.5 * (rail_->mass().form(v) + rail_->stiffness().form(q) + t.place.own_compliance * force * force);
  if (t.length > 0.0) {
    const Column between = 0.5 * (q_ + q);
    // What is deflected beyond the coordinates is elastic: half of it yields no work where it only moves along.
    const double beyond = 0.25 * (force_ + force) * (t.place.own_compliance - t.before.own_compliance);
    m.slope = (along(t.place, t.place.value, between) - along(t.before, t.before.value, between) + beyond) /
              (speed_ * t.length);
    m.power = rail_->damping().form((q - q_) / t.length);
  }
  return m;
}

void MovingRail::begin(double force) {
  time_ = 0.0;
  force_ = force;
  q_ = force * unit_q_;
  v_ = force * unit_v_;
  a_ = Column::Zero(rail_->size());
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
  while (place_at(time_) >= next_place_) move_on();
}

void MovingRail::move_on() {
  const Eigen::Index bay = 2 * track_.bay_elements + 1, rest = q_.size() - bay;
  for (Column* column : {&q_, &v_, &a_}) {
    const Column kept = column->tail(rest).cwiseProduct(calm_);
    column->head(rest) = kept;
    column->tail(bay).setZero();
  }
  look_from(first_seat_ + 1);
}

void MovingRail::save(ByteWriter& out) const {
  for (const double value : {time_, force_}) out.put(value);
  out.put(first_seat_);
  for (const Column* column : {&q_, &v_, &a_}) add_rail_state(out, *column);
}

void MovingRail::restore(ByteReader& in) {
  constexpr std::int64_t kFarthest = 1'000'000'000;  // [seats]
  const auto foreign = [] {
    throw Error(ErrorKind::input_data, "a saved state belongs to another track", {}, "start anew");
  };
  for (double* value : {&time_, &force_}) in.get(*value);
  const auto first = in.get<std::int64_t>();
  if (!(std::abs(first) < kFarthest)) foreign();
  look_from(first);
  for (Column* column : {&q_, &v_, &a_}) {
    std::vector<double> values;
    in.get(values);
    if (static_cast<Eigen::Index>(values.size()) != q_.size()) foreign();
    *column = Eigen::Map<const Column>(values.data(), q_.size());
  }
  trial_.reset();
}

}  // namespace treadmark::vehicle
