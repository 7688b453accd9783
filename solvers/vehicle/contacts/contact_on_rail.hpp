// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/vehicle/track/loaded_rail.hpp"

namespace treadmark::vehicle {

/// A contact on a rail that bends: it gives way below the wheel, vertically and, on tracks with RailSideways, sideways
/// and in roll, beside what the body of its track does, which must not move there itself. Until an instant has been
/// accepted the rail is at rest under the load. Afterwards the contact is evaluated once at a predicted deflection and
/// brought to agreement with the rail by its tangents; ContactReaction::corrected says by how much, and what forces of
/// other wheels on the rail add. Friction of its reactions contains the rail's; the energies of the rail are with its
/// first wheel. The wheel feels the rail's slope.
class ContactOnRail : public ContactElement {
 public:
  /// wheel: of the rail, whose wheels all have such a contact. tolerance: what force and deflection at rest may differ
  /// by, over the load. marker: profile origin of the rail at rest, in the middle of its top, track axes [m]. radius:
  /// nominal one of the wheel [m].
  ContactOnRail(std::shared_ptr<ContactElement> contact, std::shared_ptr<LoadedRail> rail, std::size_t wheel,
                double tolerance, const Vec3& marker, double radius);

  ContactReaction evaluate(const PairMotion& motion) override;
  bool settle(ContactReaction& reaction) override;
  void accept() override;
  bool costly() const override { return contact_->costly(); }
  double longest_travel() const override { return contact_->longest_travel(); }
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

 private:
  /// How contact and rail answer about what was evaluated last, linearised. Forces are those on the motions of the
  /// rail's top.
  struct Tangents {
    struct Patch {
      Vec3 on_rail, on_wheel;          ///< the contact from the rail's marker and from the wheelset's centre
      Vec3 normal, aside;              ///< motion of the contact on the rail in contact axes by those of the top
      Vec3 wheel_normal, wheel_aside;  ///< of it on the wheel by y, z and roll of the wheelset
    };
    std::vector<Patch> patches;
    Mat3 stiffness = Mat3::Zero(), damping = Mat3::Zero();              ///< of the contact, by the top's motions, rates
    Mat3 wheel_stiffness = Mat3::Zero(), wheel_damping = Mat3::Zero();  ///< by those of the wheelset
    double creep_force = 0.0,
           share = 1.0;            ///< lateral, all patches [N]; what evaluations at a time make the damping steeper by
    std::vector<double> slip;      ///< lateral, of each patch [m/s]
    Mat3 by_force = Mat3::Zero();  ///< what forces lose as they themselves move the rail
    Mat3 together = Mat3::Identity();  ///< forces in agreement with the rail over those without
  };
  /// What was found at a time, and how it goes on: linear in the motions and in time.
  struct Found {
    double time = 0.0;
    Vec3 force = Vec3::Zero();  ///< in agreement with the rail
    /// Motions y, z and roll of the wheelset and of the rail's top, and rates.
    Vec3 wheel = Vec3::Zero(), wheel_rate = Vec3::Zero(), rail = Vec3::Zero(), rail_rate = Vec3::Zero();
    Vec3 normal = Vec3::Zero();                             ///< of the forces, what friction has no part in
    Vec3 drift = Vec3::Zero();                              ///< of the force without motion, as shapes roll by [N/s]
    Mat3 stiffness = Mat3::Zero(), damping = Mat3::Zero();  ///< as in Tangents
    Mat3 wheel_stiffness = Mat3::Zero(), wheel_damping = Mat3::Zero();  ///< as there
    template <class Visit>
    static void each_number(auto& found, Visit&& visit) {
      visit(found.time);
      for (auto* v :
           {&found.force, &found.wheel, &found.wheel_rate, &found.rail, &found.rail_rate, &found.normal, &found.drift})
        for (Eigen::Index i = 0; i < v->size(); ++i) visit(v->data()[i]);
      for (auto* m : {&found.stiffness, &found.damping, &found.wheel_stiffness, &found.wheel_damping})
        for (Eigen::Index i = 0; i < m->size(); ++i) visit(m->data()[i]);
    }
  };
  struct Trial {
    Found found;
    Tangents tangents;
    LoadedRail::Answer answer;
  };
  ContactReaction at_rest(const PairMotion& motion);
  ContactReaction moving(const PairMotion& motion);
  Vec3 predicted_force(const PairMotion& motion, const LoadedRail::Answer& answer) const;
  Tangents tangents_of(const ContactReaction& reaction, const PairMotion& motion,
                       const LoadedRail::Answer& answer) const;
  void agree(ContactReaction& reaction, const PairMotion& motion, const LoadedRail::Answer& answer,
             const Vec3& predicted, Tangents tangents);
  Vec3 drift_with(double time, const Vec3& off, bool touching) const;
  /// Whether this time has been evaluated before.
  bool is_again(double time) const { return trial_ && trial_->found.time == time; }
  /// Of the wheels of a rail the first one speaks for it.
  bool speaks_for_rail() const { return wheel_ == 0; }

  std::shared_ptr<ContactElement> contact_;
  std::shared_ptr<LoadedRail> rail_;
  std::size_t wheel_;
  double tolerance_;
  Vec3 marker_;
  double radius_;
  std::optional<Trial> trial_;
  Found last_;  ///< accepted
};

}  // namespace treadmark::vehicle
