// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/chosen_contact.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/vehicle/contacts/switched_contact.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kLeastWear = 3e-4, kLeastLoad = 0.1;
constexpr double kGoOver = 0.05, kRecheck = 10.0;  // [m]
constexpr double kCalm = 0.7, kCalmLength = 0.5;   // of the tolerance, [m]

TableDeviation larger(const TableDeviation& a, const TableDeviation& b) {
  return {std::max(a.force, b.force), std::max(a.wear, b.wear)};
}

}  // namespace

TableDeviation table_error(const ContactReaction& table, const ContactReaction& full, double speed, double least) {
  const double scale = std::max(full.normal_force, least),
               equal = table.normal_force > 0.0 ? full.normal_force / table.normal_force : 0.0;
  const double force = (equal * table.on_rail.force - full.on_rail.force).norm(),
               normal = 0.5 * std::abs(table.normal_force - full.normal_force),
               wear = std::abs(equal * table.frictional_power - full.frictional_power),
               least_wear = kLeastWear * scale * std::abs(speed);
  return {std::max(force, normal) / scale, wear / std::max(full.frictional_power, least_wear)};
}

ChosenContact::ChosenContact(std::shared_ptr<FullContact> full, std::shared_ptr<ContactElement> table,
                             ChoiceSettings settings)
    : full_(std::move(full)), table_(std::move(table)), settings_(std::move(settings)) {
  if (!full_ || !table_) throw Error(ErrorKind::configuration, "a contact that is chosen lacks an element");
  const ChoiceSettings& s = settings_;
  for (const double value : {s.tolerance.force, s.tolerance.wear, s.usual_load, s.full_travel})
    if (!(value > 0.0) || !std::isfinite(value))
      throw Error(ErrorKind::configuration, "tolerances, load and steps of a contact that is chosen must be positive");
}

void ChosenContact::begin() {
  begun_ = true;
  full_now_ = must_be_full(at_);
}

double ChosenContact::share(double x) const {
  const double gone_over = smooth_share((x - since_) / kGoOver);
  return full_now_ ? gone_over : 1.0 - gone_over;
}

double ChosenContact::excess(const TableDeviation& error) const {
  return std::max(error.force / settings_.tolerance.force, error.wear / settings_.tolerance.wear);
}

/// So far ahead that forces have gone over where the rail is another one.
bool ChosenContact::must_be_full(double x) const {
  const double place = settings_.rail_x + x;
  return ranges::any_of(settings_.always_full, [place](const auto& stretch) {
    return place >= stretch.first - 1.5 * kGoOver && place <= stretch.second;
  });
}

double ChosenContact::longest_travel() const {
  if (!begun_) return kInfinity;
  if (full_now_ || at_ - since_ < kGoOver) return settings_.full_travel;
  double ahead = table_->longest_travel();
  for (const auto& stretch : settings_.always_full)
    if (const double way = stretch.first - 1.5 * kGoOver - settings_.rail_x - at_; way > 0.0)
      ahead = std::min(ahead, way);
  return std::max(settings_.full_travel, ahead);
}

ContactReaction ChosenContact::evaluate(const PairMotion& motion) {
  tried_ = {motion, table_->evaluate(motion), begun_ ? share(motion.wheelset.x) : 0.0, {}, false};
  const bool no_table = is_unsolved(tried_.table);
  if (begun_ && no_table && !tried_.table.derailed) tried_.share = 1.0;
  ContactReaction out = tried_.table;
  tried_.error = error_;
  if (tried_.share > 0.0 && !tried_.table.derailed) {
    ContactReaction full = full_->evaluate(motion);
    if (is_unsolved(full)) return full;
    tried_.error = no_table
                       ? TableDeviation{kNaN, kNaN}
                       : table_error(tried_.table, full, motion.wheelset_velocity.x, kLeastLoad * settings_.usual_load);
    tried_.compared = true;
    if (tried_.share < 1.0) {
      out = mixed(tried_.table, full, tried_.share);
    } else {
      out = std::move(full);
      out.full_share = 1.0;
    }
  }
  out.table_error = tried_.error.force;
  out.table_wear_error = tried_.error.wear;
  return out;
}

/// Motions that differ little: the first three say where, then how hard, then which way forces of friction act, and how
/// much of it there is.
ChosenContact::Sort ChosenContact::sort_of(const Tried& tried) const {
  constexpr double kAside = 5e-4, kRoll = 5e-3, kYaw = 2e-3, kLoad = 0.5, kCreep = 0.05,
                   kFriction = 0.05;  // [m], [rad], octaves, -
  const auto bin = [](double value, double width) { return to_whole<int>(std::floor(value / width)); };
  const PairMotion& m = tried.motion;
  Sort sort{bin(m.wheelset.y - m.rail.y, kAside), bin(m.wheelset.roll - m.rail.roll, kRoll), bin(m.wheelset.yaw, kYaw)};
  const double normal = tried.table.normal_force;
  if (!(normal > 0.0)) {
    sort[3] = std::numeric_limits<int>::min();  // no contact
    return sort;
  }
  sort[3] = bin(std::log2(normal / settings_.usual_load), kLoad);
  sort[4] = bin(tried.table.longitudinal_creep_force / normal, kCreep);
  sort[5] = bin(tried.table.lateral_creep_force / normal, kCreep);
  FrictionLaw law;  // any, where it does not vary
  settings_.friction.put(law, m.wheelset.x);
  sort[6] = bin(law.static_friction(), kFriction);
  return sort;
}

void ChosenContact::learn() {
  const Sort sort = sort_of(tried_);
  auto known = worst_.find(sort);
  if (!tried_.compared && (known == worst_.end() || at_ - probed_ >= kRecheck)) {
    static const std::atomic<bool> kWhole{false};  // the step has been taken: its contacts are accepted all or none
    const CancellationScope scope(&kWhole);
    const ContactReaction full = full_->evaluate(tried_.motion);
    if (!is_unsolved(full)) {  // else the next instant asks again
      probed_ = at_;
      tried_.compared = true;
      tried_.error =
          table_error(tried_.table, full, tried_.motion.wheelset_velocity.x, kLeastLoad * settings_.usual_load);
    }
  }
  if (tried_.compared) {
    if (known == worst_.end()) known = worst_.emplace(sort, tried_.error).first;
    known->second = larger(known->second, tried_.error);
    error_ = tried_.error;
  } else {
    error_ = known != worst_.end() ? known->second : TableDeviation{kNaN, kNaN};
  }
}

void ChosenContact::change(bool full, double x) {
  full_now_ = full;
  since_ = restless_ = x;
}

void ChosenContact::accept() {
  table_->accept();
  const bool is_full = tried_.share > 0.0;
  if (is_full)
    full_->accept();
  else if (was_full_)
    full_->forget();
  was_full_ = is_full;
  at_ = tried_.motion.wheelset.x;
  if (!begun_) return;
  if (is_unsolved(tried_.table)) {
    error_ = tried_.error;
    if (!full_now_ || share(at_) < 1.0) change(true, at_ - kGoOver);
    restless_ = at_;
    return;
  }
  learn();
  if (at_ - since_ < kGoOver) return;
  const auto known = worst_.find(sort_of(tried_));
  const double worst = known == worst_.end() ? 0.0 : excess(known->second);
  const bool must = must_be_full(at_);
  if (!full_now_) {
    if (must || worst > 1.0) change(true, at_);
    return;
  }
  if (must || worst > 1.0 || excess(error_) > kCalm) restless_ = at_;
  // To the table only where that leaves the way to go back.
  if (at_ - restless_ >= kCalmLength && !must_be_full(at_ + kGoOver)) change(false, at_);
}

namespace {

template <class Visit>
void each_number(auto& error, Visit&& visit) {
  visit(error.force), visit(error.wear);
}

}  // namespace

void ChosenContact::save(ByteWriter& out) const {
  for (const bool value : {begun_, full_now_, was_full_}) out.put(value);
  for (const double value : {at_, since_, probed_, restless_}) out.put(value);
  each_number(error_, [&](double value) { out.put(value); });
  out.put(worst_.size());
  for (const auto& [sort, error] : worst_) {
    for (const int value : sort) out.put(value);
    each_number(error, [&](double value) { out.put(value); });
  }
  full_->save(out);
  table_->save(out);
}

void ChosenContact::restore(ByteReader& in) {
  for (bool* value : {&begun_, &full_now_, &was_full_}) in.get(*value);
  for (double* value : {&at_, &since_, &probed_, &restless_}) in.get(*value);
  each_number(error_, [&](double& value) { in.get(value); });
  worst_.clear();
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    Sort sort{};
    for (int& value : sort) in.get(value);
    each_number(worst_[sort], [&](double& value) { in.get(value); });
  }
  full_->restore(in);
  table_->restore(in);
}

}  // namespace treadmark::vehicle
