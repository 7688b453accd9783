// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/solvers/vehicle/contacts/full_contact.hpp"

namespace treadmark::vehicle {

/// 0 to 1 between t = 0 and 1, with continuous slope.
double smooth_share(double t);
/// Both contacts in one, forces mixed linearly. share: of the full one.
ContactReaction mixed(const ContactReaction& table, const ContactReaction& full, double share);

/// Where a wheel's contact is found in full, by the place along the rail.
struct FullStretch {
  double from = 0.0, to = 0.0;  ///< [m]; may be infinite, else at least two blends apart
  double blend = 0.05;  ///< over this length within both ends table and full contact go over into each other [m]
  double rail_x = 0.0;  ///< place of the axle along the rail where it has travelled nothing [m]

  /// Of the full contact, 0 to 1 with continuous slope, where the axle has travelled x.
  double share(double travelled) const;
};

/// A contact in full along a stretch of the rail, from a table elsewhere. Forces are mixed linearly where they go over
/// into each other. Transient rolling begins anew, steadily, at each entry of the stretch.
class SwitchedContact : public ContactElement {
 public:
  /// Errors: Error(configuration) without elements, or for a stretch that is too short.
  SwitchedContact(std::shared_ptr<FullContact> full, std::shared_ptr<ContactElement> table, const FullStretch& stretch);

  ContactReaction evaluate(const PairMotion& motion) override;
  void accept() override;
  bool costly() const override { return true; }
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

 private:
  std::shared_ptr<FullContact> full_;
  std::shared_ptr<ContactElement> table_;
  FullStretch stretch_;
  double tried_ = 0.0;     ///< share of the full contact as evaluated last
  bool was_full_ = false;  ///< the instant accepted last used the full contact
};

}  // namespace treadmark::vehicle
