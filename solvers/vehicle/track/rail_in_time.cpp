// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/rail_in_time.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "treadmark/core/constants.hpp"

namespace treadmark::vehicle {
namespace {

/// A moment at one point would leave a kink in the twist of the rail, which coordinates at nodes feel as it passes
/// them: creep would jump [m].
constexpr double kSpread = 0.02;
/// What is deflected between nodes lies on springs and dampers: it follows forces with this time constant, that of
/// waves over half an element [s].
constexpr double kFollows = 1e-5;

void add_rail_state(ByteWriter& out, const Eigen::VectorXd& v) {
  out.put(std::span<const double>(v.data(), static_cast<std::size_t>(v.size())));
}

/// Adds forces at places to those of coordinates.
void spread(const std::vector<RailOnSeats::Place>& places, const RailInTime::Column& forces, RailInTime::Column& f) {
  Eigen::Index i = 0;
  for (const RailOnSeats::Place& place : places)
    for (Eigen::Index m = 0; m < place.value.cols(); ++m) place.spread(m, forces[i++], f);
}

/// Twice the energy of what is deflected beyond the coordinates.
double beyond(const std::vector<RailOnSeats::Place>& places, const RailInTime::Column& forces) {
  double sum = 0.0;
  Eigen::Index first = 0;
  for (const RailOnSeats::Place& place : places) {
    const auto own = forces.segment(first, place.value.cols());
    sum += own.dot(place.own_compliance * own);
    first += place.value.cols();
  }
  return sum;
}

}  // namespace

RailScheme RailScheme::of(double spectral_radius) {
  RailScheme s;
  s.alpha = -(1.0 - spectral_radius) / (1.0 + spectral_radius);
  s.beta = 0.25 * (1.0 - s.alpha) * (1.0 - s.alpha);
  s.gamma = 0.5 - s.alpha;
  return s;
}

void RailInTime::look_at(const FlexibleTrack& part) {
  rail_ = std::make_unique<const RailOnSeats>(part, plane_, kSpread);
  factors_of_ = -1.0;
  trial_ = {};
  end_ = {};
}

std::vector<RailOnSeats::Place> RailInTime::at(const std::vector<double>& places) const {
  std::vector<RailOnSeats::Place> all;
  all.reserve(places.size());
  for (const double x : places) all.push_back(rail_->place(x));
  return all;
}

void RailInTime::rest(const std::vector<double>& places, double speed) {
  // Where forces have come from slowly. Those of dampers are in balance, too, or else the first step would lose energy.
  constexpr double kStep = 1e-3;
  BandedSymmetric<double> k = rail_->stiffness();
  k.factorise();
  const Eigen::Index per = motions_of_top(), forces = per * static_cast<Eigen::Index>(places.size());
  place_at_rest_ = at(places);
  unit_q_ = unit_v_ = Columns::Zero(rail_->size(), forces);
  compliance_at_rest_ = rates_at_rest_ = Columns::Zero(forces, forces);
  for (Eigen::Index j = 0; j < forces; ++j) {
    const double x = places[static_cast<std::size_t>(j / per)];
    const auto under = [&](double place, const Column& dampers) {
      Column q = -dampers;
      rail_->place(place).spread(j % per, 1.0, q);
      k.solve(q);
      return q;
    };
    const Column none = Column::Zero(rail_->size());
    const Column v = speed / (2.0 * kStep) * (under(x + kStep, none) - under(x - kStep, none));
    unit_v_.col(j) = v;
    unit_q_.col(j) = under(x, rail_->damping().times(v));
    for (Eigen::Index i = 0; i < forces; ++i) {
      const RailOnSeats::Place& here = place_at_rest_[static_cast<std::size_t>(i / per)];
      compliance_at_rest_(i, j) = here.along(i % per, unit_q_.col(j));
      rates_at_rest_(i, j) = here.along(i % per, unit_v_.col(j));
      if (i / per != j / per) continue;
      compliance_at_rest_(i, j) += here.own_compliance(i % per, j % per);
      rates_at_rest_(i, j) += 0.5 * speed * here.own_slope(i % per, j % per);
    }
  }
  begin(Column::Zero(forces));
}

void RailInTime::begin(const Column& forces) {
  force_ = followed_ = followed_before_ = forces;
  length_before_ = 0.0;
  q_ = unit_q_ * forces;
  v_ = unit_v_ * forces;
  a_ = Column::Zero(rail_->size());
  trial_ = {};
  end_ = {};
}

RailInTime::Moved RailInTime::moved_at_rest(const Column& forces) const {
  const Column q = unit_q_ * forces, v = unit_v_ * forces;
  return {0.5 * (rail_->stiffness().form(q) + beyond(place_at_rest_, forces) + rail_->mass().form(v)),
          rail_->damping().form(v)};
}

void RailInTime::factorise(double h) {
  if (factors_of_ == h) return;
  factors_ = rail_->mass();
  const double of_damping = (1.0 + scheme_.alpha) * scheme_.gamma * h,
               of_stiffness = (1.0 + scheme_.alpha) * scheme_.beta * h * h;
  for (std::size_t i = 0; i < factors_.values().size(); ++i)
    factors_.values()[i] += of_damping * rail_->damping().values()[i] + of_stiffness * rail_->stiffness().values()[i];
  factors_.factorise();
  factors_of_ = h;
  by_unit_.clear();
}

/// Accelerations by a unit force there, for the length of a step in use.
const RailInTime::Column& RailInTime::by_unit(int coordinate) {
  Column& column = by_unit_[coordinate];
  if (column.size() == 0) {
    column = Column::Zero(rail_->size());
    column[coordinate] = 1.0 + scheme_.alpha;
    factors_.solve(column);
  }
  return column;
}

void RailInTime::step(double h, const std::vector<double>& before, const std::vector<double>& now,
                      const std::vector<double>& speeds) {
  const auto& [alpha, beta, gamma] = scheme_;
  end_ = {};
  Trial& t = trial_;
  t = {};
  t.place = at(now);
  t.before = at(before);
  t.length = h;
  t.of_q = beta * h * h;
  t.of_v = gamma * h;
  t.known_q = q_ + h * v_ + (0.5 - beta) * h * h * a_;
  t.known_v = v_ + (1.0 - gamma) * h * a_;
  if (h > 0.0) {
    factorise(h);
    Column forces = Column::Zero(rail_->size());
    spread(t.before, force_, forces);
    t.free = rail_->damping().times(alpha * v_ - (1.0 + alpha) * t.known_v) +
             rail_->stiffness().times(alpha * q_ - (1.0 + alpha) * t.known_q) - alpha * forces;
    factors_.solve(t.free);
    for (const RailOnSeats::Place& place : t.place) {
      auto& columns = t.unit.emplace_back();
      for (Eigen::Index i = 0; i < place.value.rows(); ++i)
        columns.push_back(&by_unit(place.coordinate[static_cast<std::size_t>(i)]));
    }
  } else {
    t.free = a_;
  }
  // Backward differences of second order, or friction would lack work; of first order where a step is far longer than
  // the one before, whose differences tell nothing then.
  constexpr double kMostRatio = 2.0;
  const bool goes_on = length_before_ > 0.0 && h <= kMostRatio * length_before_;
  const double ratio = goes_on ? h / length_before_ : 0.0, of_end = (1.0 + 2.0 * ratio) / (1.0 + ratio);
  t.follows = h / (h + of_end * kFollows);
  t.known_followed = kFollows / (h + of_end * kFollows) *
                     ((1.0 + ratio) * followed_ - ratio * ratio / (1.0 + ratio) * followed_before_);
  const Eigen::Index per = motions_of_top(), forces = force_.size();
  t.motion = t.rate = {Column::Zero(forces), Columns::Zero(forces, forces)};
  for (Eigen::Index i = 0; i < forces; ++i) {
    const RailOnSeats::Place& here = t.place[static_cast<std::size_t>(i / per)];
    const double free = here.along(i % per, t.free);
    t.motion.free[i] = here.along(i % per, t.known_q) + t.of_q * free;
    t.rate.free[i] = here.along(i % per, t.known_v) + t.of_v * free;
    for (Eigen::Index j = 0; j < forces; ++j) {
      const auto other = static_cast<std::size_t>(j / per);
      double by_force = 0.0;
      for (std::size_t l = 0; !t.unit.empty() && l < t.unit[other].size(); ++l)
        by_force +=
            t.place[other].value(static_cast<Eigen::Index>(l), j % per) * here.along(i % per, *t.unit[other][l]);
      t.motion.compliance(i, j) = t.of_q * by_force;
      t.rate.compliance(i, j) = t.of_v * by_force;
      if (i / per != j / per) continue;
      // What lies between nodes is moved as the force changes and, by half, as the place does: the other half is the
      // slope there.
      const double own = here.own_compliance(i % per, j % per),
                   by_place = 0.5 * speeds[static_cast<std::size_t>(i / per)] * here.own_slope(i % per, j % per);
      t.motion.compliance(i, j) += own * t.follows;
      t.motion.free[i] += own * t.known_followed[j];
      t.rate.compliance(i, j) += own * (1.0 - t.follows) / kFollows + by_place * t.follows;
      t.rate.free[i] += (by_place - own / kFollows) * t.known_followed[j];
    }
  }
}

double RailInTime::rise(Eigen::Index place, Eigen::Index motion, const Column& forces) const {
  const Trial& t = trial_;
  const RailOnSeats::Place &here = t.place[static_cast<std::size_t>(place)],
                           &before = t.before[static_cast<std::size_t>(place)];
  const auto between = [&](const RailOnSeats::Place& where) {
    const auto along = [&](const auto& q) { return where.along(motion, q); };
    double a = along(t.free);
    for (std::size_t p = 0, j = 0; p < t.unit.size(); ++p)
      for (Eigen::Index m = 0; m < motions_of_top(); ++m, ++j)
        for (std::size_t l = 0; l < t.unit[p].size(); ++l)
          a += forces[static_cast<Eigen::Index>(j)] * t.place[p].value(static_cast<Eigen::Index>(l), m) *
               along(*t.unit[p][l]);
    return 0.5 * (along(q_) + along(t.known_q) + t.of_q * a);
  };
  // What is moved beyond the coordinates is elastic: half of it yields no work where it only moves along.
  const Eigen::Index per = motions_of_top();
  const double further = 0.25 * (here.own_compliance - before.own_compliance)
                                    .row(motion)
                                    .dot((followed_ + followed(forces)).segment(place * per, per));
  return between(here) - between(before) + further;
}

const RailInTime::End& RailInTime::end(const Column& forces) {
  if (end_.forces.size() == forces.size() && end_.forces == forces) return end_;
  const Trial& t = trial_;
  end_.forces = forces;
  end_.a = t.free;
  for (std::size_t p = 0, j = 0; p < t.unit.size(); ++p) {
    const auto per = static_cast<std::size_t>(motions_of_top());
    for (std::size_t l = 0; l < t.unit[p].size(); ++l) {
      double force = 0.0;
      for (std::size_t m = 0; m < per; ++m)
        force += forces[static_cast<Eigen::Index>(j + m)] *
                 t.place[p].value(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(m));
      end_.a += force * *t.unit[p][l];
    }
    j += per;
  }
  end_.q = t.known_q + t.of_q * end_.a;
  end_.v = t.known_v + t.of_v * end_.a;
  return end_;
}

RailInTime::Moved RailInTime::moved(const Column& forces) {
  const End& e = end(forces);
  Moved m;
  const Column now = followed(forces);
  m.energy = 0.5 * (rail_->mass().form(e.v) + rail_->stiffness().form(e.q) + beyond(trial_.place, now));
  if (trial_.length > 0.0)
    m.dissipated = (rail_->damping().form(e.q - q_) + kFollows * beyond(trial_.place, now - followed_)) / trial_.length;
  return m;
}

void RailInTime::accept(const Column& forces) {
  end(forces);
  q_.swap(end_.q);
  v_.swap(end_.v);
  a_.swap(end_.a);
  followed_before_ = std::exchange(followed_, followed(forces));
  force_ = forces;
  length_before_ = trial_.length;
  end_ = {};
}

void RailInTime::move_on(int bay_elements) {
  const Eigen::Index bay = RailOnSeats::bay_coordinates(plane_, bay_elements), rest = q_.size() - bay;
  // A step between what still moves and what is taken up at rest would give energy.
  constexpr Eigen::Index kCalmedBays = 10;
  const Eigen::Index calmed = std::min(kCalmedBays * bay, rest / 4);
  for (Column* column : {&q_, &v_, &a_}) {
    Column kept = column->tail(rest);
    for (Eigen::Index i = 0; i < calmed; ++i) {
      const double s = std::cos(0.5 * kPi * static_cast<double>(i + 1) / static_cast<double>(calmed));
      kept[rest - calmed + i] *= s * s;
    }
    column->head(rest) = kept;
    column->tail(bay).setZero();
  }
}

void RailInTime::save(ByteWriter& out) const {
  for (const Column* column : {&force_, &followed_, &followed_before_, &q_, &v_, &a_}) add_rail_state(out, *column);
  out.put(length_before_);
}

bool RailInTime::restore(ByteReader& in) {
  for (Column* column : {&force_, &followed_, &followed_before_, &q_, &v_, &a_}) {
    std::vector<double> values;
    in.get(values);
    if (static_cast<Eigen::Index>(values.size()) != column->size()) return false;
    *column = Eigen::Map<const Column>(values.data(), column->size());
  }
  in.get(length_before_);
  trial_ = {};
  end_ = {};
  return true;
}

}  // namespace treadmark::vehicle
