// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/vehicle/moving_rail.hpp"

namespace treadmark::vehicle {

/// A contact on a rail that bends: it gives way vertically below the wheel, beside what the body of its track does,
/// which must not move vertically itself. Until an instant has been accepted the rail is at rest under the load.
/// Afterwards the contact is evaluated once at a predicted deflection and brought to agreement with the rail by its
/// tangent; ContactReaction::corrected says by how much. Energies and friction of its reactions contain the rail's; the
/// wheel feels the rail's slope.
class ContactOnRail : public ContactElement {
 public:
  /// load: of the wheel at rest, to which tolerance refers, what force and deflection at rest may differ by [N].
  ContactOnRail(std::shared_ptr<ContactElement> contact, MovingRail rail, double load, double tolerance);

  ContactReaction evaluate(const PairMotion& motion) override;
  void accept() override;
  bool costly() const override { return contact_->costly(); }
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

 private:
  /// What was evaluated last.
  struct Trial {
    double time = 0.0;
    double force = 0.0;      ///< in agreement with the rail [N]
    double height = 0.0;     ///< of the wheel above the contact, up to a constant, z down [m]
    double contact_y = 0.0;  ///< [m]
    double stiffness = 0.0;  ///< of contact and rail together [N/m]
  };
  struct Instant {
    double time = 0.0, force = 0.0;
  };
  ContactReaction at_rest(const PairMotion& motion);
  ContactReaction moving(const PairMotion& motion);
  double predicted_force(const PairMotion& motion) const;

  std::shared_ptr<ContactElement> contact_;
  MovingRail rail_;
  double load_, tolerance_;
  bool started_ = false;
  Instant last_, before_;  ///< accepted
  std::optional<Trial> trial_;
};

}  // namespace treadmark::vehicle
