// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/loaded_rail.hpp"

#include <span>
#include <utility>

#include <Eigen/LU>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

LoadedRail::LoadedRail(MovingRail rail, const std::vector<double>& loads)
    : rail_(std::move(rail)), load_(Eigen::VectorXd::Zero(index(loads.size()))), pressed_(loads.size()) {
  if (rail_.places() != static_cast<Eigen::Index>(loads.size()))
    throw Error(ErrorKind::configuration, "a rail needs one load for each of its wheels");
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if (!(loads[i] > 0.0)) throw Error(ErrorKind::configuration, "the load of a wheel on a rail must be positive");
    load_[index(i) + 1] = loads[i];
  }
  last_.force = before_.force = load_;
}

Eigen::VectorXd LoadedRail::pressed() const {
  Eigen::VectorXd force(index(pressed_.size()));
  for (std::size_t i = 0; i < pressed_.size(); ++i) force.segment<3>(index(i)) = pressed_[i].force;
  return force;
}

/// Until something is settled for this time, what goes on from the instants before.
Eigen::VectorXd LoadedRail::counted_on(double time) const {
  if (trial_ && trial_->time == time) return trial_->force;
  if (!(last_.time > before_.time)) return last_.force;
  const double share = (time - last_.time) / (last_.time - before_.time);
  return held_down(last_.force + share * (last_.force - before_.force));
}

/// Wheels do not pull.
Eigen::VectorXd LoadedRail::held_down(Eigen::VectorXd forces) {
  for (Eigen::Index i = 0; i < forces.size(); i += MovingRail::kMotions)
    if (forces[i + 1] < 0.0) forces.segment<3>(i).setZero();
  return forces;
}

LoadedRail::Answer LoadedRail::answer(std::size_t wheel, const Eigen::VectorXd& counted_on,
                                      const MovingRail::Answer& motions, const MovingRail::Answer& rates) const {
  const Eigen::Index i = index(wheel);
  Answer a;
  a.counted_on = counted_on;
  a.counted_on.segment<3>(i).setZero();
  a.free = motions.free.segment<3>(i) + motions.compliance.middleRows<3>(i) * a.counted_on;
  a.compliance = motions.compliance.block<3, 3>(i, i);
  a.rate = rates.free.segment<3>(i) + rates.compliance.middleRows<3>(i) * a.counted_on;
  a.rate_by_force = rates.compliance.block<3, 3>(i, i);
  return a;
}

LoadedRail::Answer LoadedRail::at_rest(std::size_t wheel) const {
  return answer(wheel, trial_ ? trial_->force : load_, rail_.motions_at_rest(), rail_.rates_at_rest());
}

LoadedRail::Answer LoadedRail::after(std::size_t wheel, double time) {
  {
    // The first wheel that comes solves for all.
    const std::lock_guard lock(solving_);
    rail_.after(time);
  }
  return answer(wheel, counted_on(time), rail_.motions(), rail_.rates());
}

Vec3 LoadedRail::slope(std::size_t wheel, const Vec3& force, const Answer& answer) const {
  Eigen::VectorXd forces = answer.counted_on;
  forces.segment<3>(index(wheel)) = force;
  return rail_.slope(static_cast<Eigen::Index>(wheel), forces);
}

const Eigen::MatrixXd& LoadedRail::compliance() const {
  return (started_ ? rail_.motions() : rail_.motions_at_rest()).compliance;
}

Vec3 LoadedRail::missed(std::size_t wheel, const Answer& answer) const {
  Eigen::VectorXd off = pressed() - answer.counted_on;
  off.segment<3>(index(wheel)).setZero();
  return compliance().middleRows<3>(index(wheel)) * off;
}

/// Forces agree where each has changed by what the others' changes move its place by: (1 + K C) F = F' + K C F'' by the
/// forces F' that were found counting on F'', C without what is each wheel's own.
void LoadedRail::settle(double time) {
  const Eigen::Index n = load_.size();
  const Eigen::VectorXd before = started_ ? counted_on(time) : trial_ ? trial_->force : load_;
  Eigen::MatrixXd coupling = compliance();
  for (std::size_t w = 0; w < pressed_.size(); ++w) {
    const Eigen::Index i = index(w);
    coupling.block<3, 3>(i, i).setZero();
    coupling.middleRows<3>(i) = pressed_[w].stiffness * coupling.middleRows<3>(i).eval();
  }
  const Eigen::VectorXd right = pressed() + coupling * before;
  trial_ = Instant{time, held_down((Eigen::MatrixXd::Identity(n, n) + coupling).partialPivLu().solve(right))};
}

void LoadedRail::accept(double time) {
  const Instant now{time, pressed()};
  if (started_) {
    std::vector<double> ahead;
    for (std::size_t i = 0; i < pressed_.size(); ++i)
      ahead.push_back(pressed_[i].travelled - first_[i] - rail_.travelled(time));
    rail_.accept(now.force, ahead);
  } else {
    first_.clear();
    for (const Pressed& one : pressed_) first_.push_back(one.travelled);
    rail_.begin(now.force);
  }
  before_ = started_ ? last_ : now;
  last_ = now;
  started_ = true;
  trial_.reset();
}

void LoadedRail::save(ByteWriter& out) const {
  out.put(started_);
  out.put(std::span<const double>(first_));
  for (const Instant* instant : {&last_, &before_}) {
    out.put(instant->time);
    out.put(std::span<const double>(instant->force.data(), static_cast<std::size_t>(instant->force.size())));
  }
  rail_.save(out);
}

void LoadedRail::restore(ByteReader& in) {
  in.get(started_);
  in.get(first_);
  if (first_.size() != (started_ ? pressed_.size() : 0))
    throw Error(ErrorKind::input_data, "a saved state belongs to a rail with other wheels", {}, "start anew");
  for (Instant* instant : {&last_, &before_}) {
    in.get(instant->time);
    std::vector<double> force;
    in.get(force);
    if (static_cast<Eigen::Index>(force.size()) != load_.size())
      throw Error(ErrorKind::input_data, "a saved state belongs to a rail with other wheels", {}, "start anew");
    instant->force = Eigen::Map<const Eigen::VectorXd>(force.data(), static_cast<Eigen::Index>(force.size()));
  }
  trial_.reset();
  rail_.restore(in);
}

}  // namespace treadmark::vehicle
