// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"
#include "treadmark/solvers/vehicle/contacts/creep_table.hpp"
#include "treadmark/solvers/vehicle/contacts/friction_along.hpp"

namespace treadmark::vehicle {

class LocalContact;

/// Fast force element of a round wheel on a prismatic straight rail: a nonlinear Hertzian spring from a table
/// (ElasticContact), creepages of the rigid bodies' exact velocities, creep forces of the linear theory with saturation
/// (creep_law) or of the exact theory (creep_table). The coefficient of friction is the law's static one; the table
/// itself knows none, so that friction may vary along the rail. Yaw counts in the creepages and in where the force acts
/// along the rail, and in the heights of tables that have yaws; with others a yawed flange that touches ahead of or
/// behind the axle is taken to touch no sooner. What the table does not cover gives Status::failed; where one that
/// grows ends since the wheel stands on the tip of its flange or its tread has left the rail: derailed. Beyond the
/// greatest load contacts grow like Hertz's. It has no memory but its place, where friction varies.
class TableContact : public ContactElement {
 public:
  /// creep: where creep forces are taken from; null: the linear theory. friction: that varies, in place of the table's.
  /// Errors: Error(configuration) without a table of the contact, and for a material that the table of creep forces is
  /// not of.
  TableContact(std::shared_ptr<const ContactTable> table, wheelrail::Side side,
               std::shared_ptr<const CreepTable> creep = nullptr, FrictionAlong friction = {});

  ContactReaction evaluate(const PairMotion& motion) override;
  /// The same with the wheelset at the height at which the rail takes this vertical load > 0 [N], which wheelset_z of
  /// the reaction then is; motion.wheelset.z does not count. Status::not_converged where friction leaves none.
  ContactReaction under_load(PairMotion motion, double load);
  void accept() override { at_ = tried_; }
  double longest_travel() const override { return friction_.longest_travel(at_); }
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

 private:
  /// local: the table there, where it is known.
  ContactReaction evaluate_right_hand(const PairMotion& motion, const LocalContact* local = nullptr);

  std::shared_ptr<const ContactTable> table_;
  std::shared_ptr<const CreepTable> creep_;
  wheelrail::Side side_;
  wheelrail::Problem problem_;  ///< the table's, with the motion at hand
  CombinedMaterial material_;
  FrictionAlong friction_;
  double tried_ = 0.0, at_ = 0.0;  ///< travelled: as evaluated and as accepted last [m]
};

}  // namespace treadmark::vehicle
