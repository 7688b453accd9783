// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"
#include "treadmark/solvers/vehicle/contacts/creep_table.hpp"

namespace treadmark::vehicle {

/// Fast force element of a round wheel on a prismatic straight rail: a nonlinear Hertzian spring from a table
/// (ElasticContact), creepages of the rigid bodies' exact velocities, creep forces of the linear theory with saturation
/// (creep_law) or of the exact theory (creep_table). The coefficient of friction is the law's static one. Yaw counts in
/// the creepages and in where the force acts along the rail, not in the heights: a yawed flange that touches ahead of
/// or behind the axle is taken to touch no sooner. Where the table ends, the wheel stands on the tip of its flange or
/// its tread has left the rail: Status::failed, derailed. It has no memory: accept() does nothing, and there is nothing
/// to save.
class TableContact : public ContactElement {
 public:
  /// creep: where creep forces are taken from; null: the linear theory. Errors: Error(configuration) without a table of
  /// the contact, and for a material that the table of creep forces is not of.
  TableContact(std::shared_ptr<const ContactTable> table, wheelrail::Side side,
               std::shared_ptr<const CreepTable> creep = nullptr);

  ContactReaction evaluate(const PairMotion& motion) override;
  void accept() override {}
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

 private:
  ContactReaction evaluate_right_hand(const PairMotion& motion);

  std::shared_ptr<const ContactTable> table_;
  std::shared_ptr<const CreepTable> creep_;
  wheelrail::Side side_;
  wheelrail::Problem problem_;  ///< the table's, with the motion at hand
  CombinedMaterial material_;
};

}  // namespace treadmark::vehicle
