// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/loaded_rail.hpp"

#include <span>
#include <utility>

#include <Eigen/LU>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

LoadedRail::LoadedRail(MovingRail rail, const std::vector<double>& loads)
    : rail_(std::move(rail)),
      load_(Eigen::Map<const Eigen::VectorXd>(loads.data(), static_cast<Eigen::Index>(loads.size()))),
      pressed_(loads.size()) {
  if (rail_.forces() != load_.size())
    throw Error(ErrorKind::configuration, "a rail needs one load for each of its wheels");
  for (const double load : loads)
    if (!(load > 0.0)) throw Error(ErrorKind::configuration, "the load of a wheel on a rail must be positive");
  last_.force = before_.force = load_;
}

Eigen::VectorXd LoadedRail::pressed() const {
  Eigen::VectorXd force(index(pressed_.size()));
  for (std::size_t i = 0; i < pressed_.size(); ++i) force[index(i)] = pressed_[i].force;
  return force;
}

/// Until something is settled for this time, what goes on from the instants before.
Eigen::VectorXd LoadedRail::counted_on(double time) const {
  if (trial_ && trial_->time == time) return trial_->force;
  if (!(last_.time > before_.time)) return last_.force;
  const double share = (time - last_.time) / (last_.time - before_.time);
  return (last_.force + share * (last_.force - before_.force)).cwiseMax(0.0);
}

LoadedRail::Answer LoadedRail::at_rest(std::size_t wheel) const {
  const Eigen::Index i = index(wheel);
  Answer a;
  a.counted_on = trial_ ? trial_->force : load_;
  a.counted_on[i] = 0.0;
  a.free = rail_.compliance_at_rest().row(i).dot(a.counted_on) + rail_.dips_at_rest()[i];
  a.compliance = rail_.compliance_at_rest()(i, i);
  return a;
}

LoadedRail::Answer LoadedRail::after(std::size_t wheel, double time) {
  const Eigen::Index i = index(wheel);
  {
    // The first wheel that comes solves for all.
    const std::lock_guard lock(solving_);
    rail_.after(time);
  }
  Answer a;
  a.counted_on = counted_on(time);
  a.counted_on[i] = 0.0;
  const MovingRail::Answer &deflection = rail_.deflections(), &rate = rail_.rates();
  a.free = deflection.free[i] + deflection.compliance.row(i).dot(a.counted_on);
  a.compliance = deflection.compliance(i, i);
  a.rate = rate.free[i] + rate.compliance.row(i).dot(a.counted_on);
  a.rate_by_force = rate.compliance(i, i);
  return a;
}

double LoadedRail::slope(std::size_t wheel, double force, const Answer& answer) const {
  Eigen::VectorXd forces = answer.counted_on;
  forces[index(wheel)] = force;
  return rail_.slope(index(wheel), forces);
}

const Eigen::MatrixXd& LoadedRail::compliance() const {
  return started_ ? rail_.deflections().compliance : rail_.compliance_at_rest();
}

double LoadedRail::missed(std::size_t wheel, const Answer& answer) const {
  const Eigen::Index i = index(wheel);
  Eigen::VectorXd off = pressed() - answer.counted_on;
  off[i] = 0.0;
  return compliance().row(i).dot(off);
}

/// Forces agree where each has changed by what the others' changes deflect its place: (1 + K C) F = F' + K C F'' by the
/// forces F' that were found counting on F'', C without its diagonal.
void LoadedRail::settle(double time) {
  const Eigen::Index n = load_.size();
  const Eigen::VectorXd before = started_ ? counted_on(time) : trial_ ? trial_->force : load_;
  Eigen::MatrixXd coupling = compliance();
  for (Eigen::Index i = 0; i < n; ++i) {
    coupling(i, i) = 0.0;
    coupling.row(i) *= pressed_[static_cast<std::size_t>(i)].stiffness;
  }
  const Eigen::VectorXd right = pressed() + coupling * before;
  trial_ = Instant{time, (Eigen::MatrixXd::Identity(n, n) + coupling).partialPivLu().solve(right).cwiseMax(0.0)};
}

void LoadedRail::accept(double time) {
  const Instant now{time, pressed()};
  if (started_)
    rail_.accept(now.force);
  else
    rail_.begin(now.force);
  before_ = started_ ? last_ : now;
  last_ = now;
  started_ = true;
  trial_.reset();
}

void LoadedRail::save(ByteWriter& out) const {
  out.put(started_);
  for (const Instant* instant : {&last_, &before_}) {
    out.put(instant->time);
    out.put(std::span<const double>(instant->force.data(), static_cast<std::size_t>(instant->force.size())));
  }
  rail_.save(out);
}

void LoadedRail::restore(ByteReader& in) {
  in.get(started_);
  for (Instant* instant : {&last_, &before_}) {
    in.get(instant->time);
    std::vector<double> force;
    in.get(force);
    if (force.size() != pressed_.size())
      throw Error(ErrorKind::input_data, "a saved state belongs to a rail with other wheels", {}, "start anew");
    instant->force = Eigen::Map<const Eigen::VectorXd>(force.data(), static_cast<Eigen::Index>(force.size()));
  }
  trial_.reset();
  rail_.restore(in);
}

}  // namespace treadmark::vehicle
