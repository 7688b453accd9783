// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/moving_rail.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

void add_rail_state(ByteWriter& out, const Eigen::VectorXd& v) {
  out.put(std::span<const double>(v.data(), static_cast<std::size_t>(v.size())));
}

/// Of a column of coordinates at a place.
template <class Coordinates>
double along(const RailOnSeats::Place& place, const BeamVector& by, const Coordinates& q) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += by[static_cast<Eigen::Index>(i)] * q[place.coordinate[i]];
  return sum;
}

}  // namespace

MovingRail::MovingRail(const FlexibleTrack& track, double speed, const std::vector<double>& start,
                       double spectral_radius, double length)
    : track_(track), speed_(speed) {
  const RailOnSeats whole(track);  // refuses what makes no sense
  track_.bay_elements = std::min(track.bay_elements, kMostBayElements);
  constexpr double kFarthest = 1e6;  // [m]
  if (!(speed > 0.0) || !std::isfinite(speed))
    throw Error(ErrorKind::configuration, "the speed along a rail must be positive");
  if (start.empty()) throw Error(ErrorKind::configuration, "nothing moves along a rail");
  for (const double one : start) {
    if (!(std::abs(one) <= kFarthest))
      throw Error(ErrorKind::configuration, "a rail begins within 1000 km of the middle of its seats");
    start_.push_back(whole.middle() + one);
  }
  if (!(spectral_radius >= 0.5 && spectral_radius <= 1.0))
    throw Error(ErrorKind::configuration, "the spectral radius must lie between 0.5 and 1");
  alpha_ = -(1.0 - spectral_radius) / (1.0 + spectral_radius);
  beta_ = 0.25 * (1.0 - alpha_) * (1.0 - alpha_);
  gamma_ = 0.5 - alpha_;

  constexpr double kFewest = 20.0, kMost = 1e4;
  const std::vector<RailSeat>& seats = track.seats;
  const double bay = (seats.back().x - seats.front().x) / static_cast<double>(seats.size() - 1);
  std::vector<double> ordered = start_;
  std::ranges::sort(ordered);
  last_start_ = ordered.front();
  const double reach = ordered.back() - last_start_;
  if (!(length > 0.0 && length + reach <= kMost * bay))
    throw Error(ErrorKind::configuration, "the part of a rail that is looked at has a length of at most 10000 bays");
  double longest_bay = 0.0;
  for (std::size_t i = 1; i < seats.size(); ++i) longest_bay = std::max(longest_bay, seats[i].x - seats[i - 1].x);
  for (std::size_t i = 1; i < ordered.size(); ++i)
    if (!(ordered[i] - ordered[i - 1] > longest_bay / track_.bay_elements))
      throw Error(ErrorKind::configuration,
                  fmt::format("two wheels on one rail are {:.6g} m apart, not more than an element of the rail is long",
                              ordered[i] - ordered[i - 1]),
                  {}, "give the rail more elements in a bay (seats.bay_elements), at most 8 are used");
  seats_about_ = static_cast<std::int64_t>(std::max(kFewest, std::ceil(length / bay)));
  // As many more as the forces reach over where seats are closest.
  std::int64_t within = 0, front = 0;
  for (std::int64_t i = 0; reach > 0.0 && i < static_cast<std::int64_t>(seats.size()); ++i) {
    while (seat(front).x < seat(i).x + reach) ++front;
    within = std::max(within, front - i);
  }
  seats_ = seats_about_ + within;

  std::int64_t before = 0;  // seat before the hindmost force
  while (seat(before).x > last_start_) --before;
  while (seat(before + 1).x <= last_start_) ++before;
  look_from(before - (seats_about_ - 1) / 2);
  // Where they have come from slowly. Forces of dampers are in balance, too, or else the first step would lose energy.
  constexpr double kStep = 1e-3;
  BandedSymmetric<double> k = rail_->stiffness();
  k.factorise();
  const auto under = [&](double at, const Column& dampers) {
    Column q = -dampers;
    spread(rail_->place(at), 1.0, q);
    k.solve(q);
    return q;
  };
  const Column none = Column::Zero(rail_->size());
  const std::vector<RailOnSeats::Place> place = places_at(0.0);
  unit_q_ = unit_v_ = Columns::Zero(rail_->size(), forces());
  own_at_rest_ = force_ = Forces::Zero(forces());
  compliance_at_rest_ = Eigen::MatrixXd::Zero(forces(), forces());
  for (Eigen::Index j = 0; j < forces(); ++j) {
    const double at = start_[static_cast<std::size_t>(j)];
    const Column v = speed_ / (2.0 * kStep) * (under(at + kStep, none) - under(at - kStep, none));
    unit_v_.col(j) = v;
    unit_q_.col(j) = under(at, rail_->damping().times(v));
    own_at_rest_[j] = place[static_cast<std::size_t>(j)].own_compliance;
    for (Eigen::Index i = 0; i < forces(); ++i) {
      const RailOnSeats::Place& here = place[static_cast<std::size_t>(i)];
      compliance_at_rest_(i, j) = along(here, here.value, unit_q_.col(j));
    }
    compliance_at_rest_(j, j) += own_at_rest_[j];
  }
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
  const double begin = part.seats[0].x - 0.5 * (part.seats[1].x - part.seats[0].x),
               end = part.seats.back().x + 0.5 * (part.seats.back().x - part.seats[part.seats.size() - 2].x);
  std::erase_if(part.joints, [&](const RailJoint& joint) { return !(joint.x >= begin && joint.x <= end); });
  part.absorbing_bays = std::min(track_.absorbing_bays, static_cast<int>(seats_about_ / 4));
  rail_ = std::make_unique<const RailOnSeats>(part);
  next_place_ = seat(first_seat + (seats_about_ - 1) / 2 + 1).x;
  factors_of_ = -1.0;
  trial_.reset();
}

std::vector<RailOnSeats::Place> MovingRail::places_at(double time) const {
  std::vector<RailOnSeats::Place> places;
  for (const double start : start_) places.push_back(rail_->place(place_at(start, time)));
  return places;
}

double MovingRail::dip(double x) const {
  double sum = 0.0;
  for (const RailJoint& joint : track_.joints) sum += joint.depth(x - joint.x);
  return sum;
}

double MovingRail::dip_slope(double x) const {
  double sum = 0.0;
  for (const RailJoint& joint : track_.joints) sum += joint.slope(x - joint.x);
  return sum;
}

MovingRail::Forces MovingRail::dips_at_rest() const {
  Forces dips(forces());
  for (std::size_t i = 0; i < start_.size(); ++i) dips[static_cast<Eigen::Index>(i)] = dip(start_[i]);
  return dips;
}

/// Adds a force there to those of coordinates.
void MovingRail::spread(const RailOnSeats::Place& place, double force, Column& f) const {
  for (std::size_t i = 0; i < 4; ++i) f[place.coordinate[i]] += force * place.value[static_cast<Eigen::Index>(i)];
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

const MovingRail::Answer& MovingRail::after(double time) {
  if (trial_ && trial_->time == time) return trial_->deflection;
  Trial t;
  t.time = time;
  // Differences of times vary in their last digits, which are not worth a factorisation.
  const double h = static_cast<float>(time - time_);
  t.place = places_at(time);
  t.length = h;
  t.before = places_at(time_);
  t.of_q = beta_ * h * h;
  t.of_v = gamma_ * h;
  t.known_q = q_ + h * v_ + (0.5 - beta_) * h * h * a_;
  t.known_v = v_ + (1.0 - gamma_) * h * a_;
  t.unit = Columns::Zero(rail_->size(), forces());
  if (h > 0.0) {
    factorise(h);
    Column before = Column::Zero(rail_->size());
    for (std::size_t j = 0; j < t.before.size(); ++j) spread(t.before[j], force_[static_cast<Eigen::Index>(j)], before);
    t.free = rail_->damping().times(alpha_ * v_ - (1.0 + alpha_) * t.known_v) +
             rail_->stiffness().times(alpha_ * q_ - (1.0 + alpha_) * t.known_q) - alpha_ * before;
    factors_.solve(t.free);
    for (std::size_t j = 0; j < t.place.size(); ++j)
      for (std::size_t i = 0; i < 4; ++i)
        t.unit.col(static_cast<Eigen::Index>(j)) +=
            (1.0 + alpha_) * t.place[j].value[static_cast<Eigen::Index>(i)] * by_unit(t.place[j].coordinate[i]);
  } else {
    t.free = a_;
  }
  t.deflection = t.rate = {Forces::Zero(forces()), Eigen::MatrixXd::Zero(forces(), forces())};
  for (Eigen::Index i = 0; i < forces(); ++i) {
    const RailOnSeats::Place& here = t.place[static_cast<std::size_t>(i)];
    const auto free = [&](const BeamVector& by, const Column& known, double of) {
      return along(here, by, known) + of * along(here, by, t.free);
    };
    const double x = place_at(start_[static_cast<std::size_t>(i)], time);
    t.deflection.free[i] = free(here.value, t.known_q, t.of_q) + dip(x);
    t.rate.free[i] =
        free(here.value, t.known_v, t.of_v) + speed_ * (free(here.slope, t.known_q, t.of_q) + dip_slope(x));
    for (Eigen::Index j = 0; j < forces(); ++j) {
      const double by_value = along(here, here.value, t.unit.col(j)), by_slope = along(here, here.slope, t.unit.col(j));
      t.deflection.compliance(i, j) = t.of_q * by_value;
      t.rate.compliance(i, j) = t.of_v * by_value + speed_ * t.of_q * by_slope;
    }
    t.deflection.compliance(i, i) += here.own_compliance;
    t.rate.compliance(i, i) += speed_ * here.own_compliance_slope;
  }
  trial_ = std::move(t);
  return trial_->deflection;
}

double MovingRail::slope(Eigen::Index place, const Forces& forces) const {
  const Trial& t = *trial_;
  if (!(t.length > 0.0)) return 0.0;
  const RailOnSeats::Place &here = t.place[static_cast<std::size_t>(place)],
                           &before = t.before[static_cast<std::size_t>(place)];
  // Along the place by its mean of the step.
  const auto between = [&](const RailOnSeats::Place& at) {
    double end = along(at, at.value, t.known_q) + t.of_q * along(at, at.value, t.free);
    for (Eigen::Index j = 0; j < forces.size(); ++j) end += t.of_q * forces[j] * along(at, at.value, t.unit.col(j));
    return 0.5 * (along(at, at.value, q_) + end);
  };
  // What is deflected beyond the coordinates is elastic: half of it yields no work where it only moves along.
  const double beyond = 0.25 * (force_[place] + forces[place]) * (here.own_compliance - before.own_compliance);
  const double start = start_[static_cast<std::size_t>(place)];
  const double into_dip = dip(place_at(start, t.time)) - dip(place_at(start, time_));
  return (between(here) - between(before) + beyond + into_dip) / (speed_ * t.length);
}

MovingRail::Moved MovingRail::moved(const Forces& forces) const {
  const Trial& t = *trial_;
  const Column a = t.free + t.unit * forces, q = t.known_q + t.of_q * a, v = t.known_v + t.of_v * a;
  double beyond = 0.0;
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    beyond += t.place[static_cast<std::size_t>(i)].own_compliance * forces[i] * forces[i];
  Moved m;
  m.energy = 0.5 * (rail_->mass().form(v) + rail_->stiffness().form(q) + beyond);
  if (t.length > 0.0) m.power = rail_->damping().form((q - q_) / t.length);
  return m;
}

MovingRail::Moved MovingRail::moved_at_rest(const Forces& forces) const {
  const Column q = unit_q_ * forces, v = unit_v_ * forces;
  const double beyond = own_at_rest_.dot(forces.cwiseAbs2());
  return {0.5 * (rail_->stiffness().form(q) + beyond + rail_->mass().form(v)), rail_->damping().form(v)};
}

void MovingRail::begin(const Forces& forces) {
  time_ = 0.0;
  force_ = forces;
  q_ = unit_q_ * forces;
  v_ = unit_v_ * forces;
  a_ = Column::Zero(rail_->size());
  trial_.reset();
}

void MovingRail::accept(const Forces& forces) {
  const Trial& t = *trial_;
  const Column a = t.free + t.unit * forces;
  q_ = t.known_q + t.of_q * a;
  v_ = t.known_v + t.of_v * a;
  a_ = a;
  time_ = t.time;
  force_ = forces;
  trial_.reset();
  while (place_at(last_start_, time_) >= next_place_) move_on();
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
  out.put(time_);
  out.put(first_seat_);
  for (const Column* column : {&force_, &q_, &v_, &a_}) add_rail_state(out, *column);
}

void MovingRail::restore(ByteReader& in) {
  constexpr std::int64_t kFarthest = 1'000'000'000;  // [seats]
  const auto foreign = [] {
    throw Error(ErrorKind::input_data, "a saved state belongs to another track", {}, "start anew");
  };
  in.get(time_);
  const auto first = in.get<std::int64_t>();
  if (!(std::abs(first) < kFarthest)) foreign();
  look_from(first);
  for (Column* column : {&force_, &q_, &v_, &a_}) {
    std::vector<double> values;
    in.get(values);
    if (static_cast<Eigen::Index>(values.size()) != column->size()) foreign();
    *column = Eigen::Map<const Column>(values.data(), column->size());
  }
  trial_.reset();
}

}  // namespace treadmark::vehicle
