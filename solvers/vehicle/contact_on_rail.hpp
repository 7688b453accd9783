// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/vehicle/moving_rail.hpp"

namespace treadmark::vehicle {

/// A contact on a rail that bends: it gives way vertically below the wheel, beside what the body of its track does,
/// which must not move vertically itself. Until an instant has been accepted the rail is at rest under the load.
/// Energies and friction of its reactions contain the rail's; the wheel feels the rail's slope.
class ContactOnRail : public ContactElement {
 public:
  /// load: of the wheel at rest, to which tolerance refers, what force and deflection may differ by [N].
  ContactOnRail(std::shared_ptr<ContactElement> contact, MovingRail rail, double load, double tolerance);

  ContactReaction evaluate(const PairMotion& motion) override;
  void accept() override;
  bool costly() const override { return contact_->costly(); }
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

 private:
  std::shared_ptr<ContactElement> contact_;
  MovingRail rail_;
  double load_, tolerance_;
  bool started_ = false;
  double force_ = 0.0, deflection_ = 0.0;             ///< as evaluated last
  double accepted_force_ = 0.0, force_before_ = 0.0;  ///< at the last two instants
};

}  // namespace treadmark::vehicle
