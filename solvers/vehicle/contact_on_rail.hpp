// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/vehicle/loaded_rail.hpp"

namespace treadmark::vehicle {

/// A contact on a rail that bends: it gives way vertically below the wheel, beside what the body of its track does,
/// which must not move vertically itself. Until an instant has been accepted the rail is at rest under the load.
/// Afterwards the contact is evaluated once at a predicted deflection and brought to agreement with the rail by its
/// tangent; ContactReaction::corrected says by how much, and what forces of other wheels on the rail add. Friction of
/// its reactions contains the rail's; the energies of the rail are with its first wheel. The wheel feels the rail's
/// slope.
class ContactOnRail : public ContactElement {
 public:
  /// wheel: of the rail, whose wheels all have such a contact. tolerance: what force and deflection at rest may differ
  /// by, over the load.
  ContactOnRail(std::shared_ptr<ContactElement> contact, std::shared_ptr<LoadedRail> rail, std::size_t wheel,
                double tolerance);

  ContactReaction evaluate(const PairMotion& motion) override;
  bool settle(ContactReaction& reaction) override;
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
    double softening = 1.0;  ///< stiffness of the contact over that
    LoadedRail::Answer answer;
  };
  ContactReaction at_rest(const PairMotion& motion);
  ContactReaction moving(const PairMotion& motion);
  double predicted_force(const PairMotion& motion) const;
  /// Of the wheels of a rail the first one speaks for it.
  bool speaks_for_rail() const { return wheel_ == 0; }

  std::shared_ptr<ContactElement> contact_;
  std::shared_ptr<LoadedRail> rail_;
  std::size_t wheel_;
  double tolerance_;
  std::optional<Trial> trial_;
};

}  // namespace treadmark::vehicle
