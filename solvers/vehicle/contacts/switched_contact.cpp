// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/switched_contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {

double smooth_share(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

ContactReaction mixed(const ContactReaction& table, const ContactReaction& full, double share) {
  ContactReaction out = full.normal_force > 0.0 ? full : table;
  out.doubts = full.doubts;
  out.full_share = share;
  for (auto value : {&ContactReaction::lateral_creep_force, &ContactReaction::longitudinal_creep_force,
                     &ContactReaction::normal_force, &ContactReaction::least_gap, &ContactReaction::elastic_energy,
                     &ContactReaction::frictional_power, &ContactReaction::check_force})
    out.*value = share * (full.*value) + (1.0 - share) * (table.*value);
  for (auto load : {&ContactReaction::on_rail, &ContactReaction::on_wheelset}) {
    (out.*load).force = share * (full.*load).force + (1.0 - share) * (table.*load).force;
    (out.*load).moment = share * (full.*load).moment + (1.0 - share) * (table.*load).moment;
  }
  out.tangents.clear();
  for (const auto& [from, weight] : {std::pair{&full, share}, std::pair{&table, 1.0 - share}})
    for (PatchTangent t : from->tangents) {
      for (double* value : {&t.stiffness_n, &t.damping_x, &t.damping_s, &t.normal_force}) *value *= weight;
      out.tangents.push_back(t);
    }
  return out;
}

double FullStretch::share(double travelled) const {
  const double x = rail_x + travelled;
  return smooth_share((x - from) / blend) * smooth_share((to - x) / blend);
}

SwitchedContact::SwitchedContact(std::shared_ptr<FullContact> full, std::shared_ptr<ContactElement> table,
                                 const FullStretch& stretch)
    : full_(std::move(full)), table_(std::move(table)), stretch_(stretch) {
  if (!full_ || !table_) throw Error(ErrorKind::configuration, "a contact that changes over lacks an element");
  if (!(stretch.blend > 0.0) || !(stretch.to - stretch.from > 1.999 * stretch.blend))
    throw Error(ErrorKind::configuration, "the stretch of a full contact is too short to go over into it and back");
}

ContactReaction SwitchedContact::evaluate(const PairMotion& motion) {
  tried_ = stretch_.share(motion.wheelset.x);
  if (tried_ <= 0.0) return table_->evaluate(motion);
  const ContactReaction full = full_->evaluate(motion);
  if (tried_ >= 1.0 || is_unsolved(full)) return full;
  const ContactReaction table = table_->evaluate(motion);
  return is_unsolved(table) ? table : mixed(table, full, tried_);
}

void SwitchedContact::accept() {
  if (tried_ < 1.0) table_->accept();
  if (tried_ > 0.0)
    full_->accept();
  else if (was_full_)
    full_->forget();
  was_full_ = tried_ > 0.0;
}

void SwitchedContact::save(ByteWriter& out) const {
  out.put(was_full_);
  full_->save(out);
  table_->save(out);
}

void SwitchedContact::restore(ByteReader& in) {
  in.get(was_full_);
  full_->restore(in);
  table_->restore(in);
}

}  // namespace treadmark::vehicle
