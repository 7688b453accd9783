// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/solvers/vehicle/contact_element.hpp"

namespace treadmark::vehicle {

/// A rail that holds the back of the flange along a stretch, fixed to the running rail of its side.
struct CheckRail {
  double from = 0.0, to = 0.0;  ///< along the rail [m]
  double face_y = 0.0;          ///< guiding face, from the middle of the track [m]; > 0
  double depth = 0.0;           ///< where the flange touches it, below the rail tops [m]
  double stiffness = 0.0;       ///< lateral [N/m]; > 0
  double damping = 0.0;         ///< in parallel [N s/m]
  double friction = 0.0;        ///< coefficient
  double flare_length = 0.0;    ///< at both ends [m], over which the face recedes with the square
  double flare = 0.0;           ///< by so much [m]
};

/// Place and shape of the wheel against it.
struct FlangeBack {
  double y = 0.0;       ///< of the back of the flange from the middle of the wheelset [m]; > 0
  double radius = 0.0;  ///< nominal one of the wheel [m]
  double rail_x = 0.0;  ///< place of the axle along the rail where it has travelled nothing [m]
};

/// The contact of a wheel, with a check rail beside it: a one-sided spring and damper below the axle with Coulomb
/// friction, which is smooth for sliding below 0.01 m/s.
class ContactWithCheckRail : public ContactElement {
 public:
  /// rail_marker: profile origin of the running rail at rest, track axes. Errors: Error(configuration).
  ContactWithCheckRail(std::shared_ptr<ContactElement> contact, wheelrail::Side side, const CheckRail& rail,
                       const FlangeBack& back, const Vec3& rail_marker);

  ContactReaction evaluate(const PairMotion& motion) override;
  bool settle(ContactReaction& evaluated) override { return contact_->settle(evaluated); }
  void accept() override { contact_->accept(); }
  bool costly() const override { return contact_->costly(); }
  double longest_travel() const override { return contact_->longest_travel(); }
  void save(ByteWriter& out) const override { contact_->save(out); }
  void restore(ByteReader& in) override { contact_->restore(in); }

 private:
  struct Face {
    bool there = false;
    double y = 0.0, slope = 0.0;
  };
  Face face_at(double x) const;

  std::shared_ptr<ContactElement> contact_;
  double side_;  ///< 1: right, -1: left
  CheckRail rail_;
  FlangeBack back_;
  Vec3 marker_;
};

}  // namespace treadmark::vehicle
