// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "treadmark/solvers/vehicle/contacts/full_contact.hpp"

namespace treadmark::vehicle {

/// What the contact of a table is wrong by in one motion, against the contact in full.
struct TableDeviation {
  /// Of the force on the rail at equal normal force, or half of that of the normal force at equal height where that is
  /// more, over the normal force.
  double force = 0.0;
  /// Of the wear number at equal normal force, over that of the full contact or 0.0003 of the normal force (16 N below
  /// a passenger vehicle), where that is more.
  double wear = 0.0;
};
/// speed [m/s]; least: normal force that counts at least [N].
TableDeviation table_error(const ContactReaction& table, const ContactReaction& full, double speed, double least);

struct ChoiceSettings {
  TableDeviation tolerance{0.03, 0.1};                 ///< of the table
  double usual_load = 0.0;                             ///< of the wheel [N]; > 0
  double full_travel = 1e-3;                           ///< of a step with the full contact [m]
  std::vector<std::pair<double, double>> always_full;  ///< places along the rail, increasing [m]
  double rail_x = 0.0;     ///< place of the axle along the rail where it has travelled nothing [m]
  FrictionAlong friction;  ///< that varies, as both contacts have it
};

/// A contact from a table where that agrees with the contact in full, in full elsewhere. Motions are sorted by place
/// across the rail, roll, yaw, load, creep forces and friction: in the first one of each sort, and after 10 m at the
/// latest, the full contact is solved beside the table, which says how wrong the table is. Beyond the tolerance forces
/// go over into those of the full contact over 50 mm, and back once the table has agreed within 0.7 of it over 0.5 m,
/// if it was within the tolerance in all motions of the sort. Where the table has no solution the full contact takes
/// its place at once. What has been found belongs to the wheel: the same run makes the same choices.
class ChosenContact : public ContactElement {
 public:
  /// Errors: Error(configuration) without elements or with settings that make no sense.
  ChosenContact(std::shared_ptr<FullContact> full, std::shared_ptr<ContactElement> table, ChoiceSettings settings);

  /// Until then it is the table: what finds an equilibrium asks for motions that do not occur.
  void begin();

  ContactReaction evaluate(const PairMotion& motion) override;
  void accept() override;
  bool costly() const override { return full_now_; }
  double longest_travel() const override;
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

 private:
  using Sort = std::array<int, 7>;
  struct Tried {
    PairMotion motion;
    ContactReaction table;
    double share = 0.0;    ///< of the full contact
    TableDeviation error;  ///< where that was solved
    bool compared = false;
  };
  double share(double x) const;
  double excess(const TableDeviation& error) const;
  bool must_be_full(double x) const;
  Sort sort_of(const Tried& tried) const;
  /// Error of the motion accepted last, as known; notes what is new.
  void learn();
  void change(bool full, double x);

  std::shared_ptr<FullContact> full_;
  std::shared_ptr<ContactElement> table_;
  ChoiceSettings settings_;
  Tried tried_;
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  bool begun_ = false, full_now_ = false;
  bool was_full_ = false;  ///< the instant accepted last used the full contact
  double at_ = 0.0, since_ = kNever, probed_ = kNever, restless_ = kNever;  ///< distances travelled [m]
  TableDeviation error_;                                                    ///< of the instant accepted last
  std::map<Sort, TableDeviation> worst_;
};

}  // namespace treadmark::vehicle
