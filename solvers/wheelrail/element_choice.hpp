// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

/// Elements that a patch gets where they are chosen: at least kLeastAcross from edge to edge through the place of its
/// largest pressure, along and across. Along the longer of the two they are at most kLongestElement times as long as
/// they are wide, as far as kMostAcross allow it. No side is shorter than kShortestElement.
constexpr int kLeastAcross = 20, kMostAcross = 64;
constexpr double kLongestElement = 4.0, kShortestElement = 1e-5;

/// Whether a problem's elements are chosen, not only asked to be: in contacts that leave nothing but start values to a
/// later instant. Damping, transient rolling and shifts need one raster, search grids other than refined dx, ds.
bool chooses_elements(const Problem& problem);

/// Whether a force may ask for another height of the wheelset than that of its state.
bool height_sought(const Problem& problem);

/// Sides of the elements of one patch [m].
struct ElementSize {
  double dx = 0.0, ds = 0.0;
};

/// For a contact of this length and width [m] where it presses most. Sides are 0.1 mm times 1, 1.25 or 1.6 and a power
/// of two, so that a little more load leaves them alone and a patch of twice the size has as many elements. longest: of
/// a side [m], as far as kMostAcross allow it.
ElementSize elements_for(double length, double width, double longest);

/// The elements of the patches of one instant while the height of the wheel is being sought: few ones, from where the
/// undeformed bodies interpenetrate, until learn() has seen a contact. Where sizes are given few ones are whole
/// multiples of them.
class ElementChoice {
 public:
  /// known: about at which height forces balance, so that elements of given size are those from the first.
  ElementChoice(const Geometry& geometry, const Problem& problem, bool known);

  /// Whether sizes are chosen.
  bool active() const { return active_; }
  /// Whether the elements are few ones, made to look at a contact and to learn from it.
  bool few() const { return rough_ || (active_ && rounds_ == 0); }
  /// What interpenetrates, before its elements are laid: small contacts have few enough as they are given.
  void expect(std::span<const detection::ContactPatch> regions);
  /// Forces are to be balanced at another place, or to another accuracy: elements may be chosen as often again.
  void begin_balance();
  /// Elements of a patch with this contact angle [rad]. They stay with the patches that overlap it; one that has grown
  /// to more than twice the size is looked at anew, as long as elements may be chosen again.
  ElementSize of(const detection::ContactPatch& region, double angle);
  /// Chooses by what is in contact. False: nothing changes, or it has changed often enough.
  bool learn(std::span<const PatchSolution* const> patches);
  /// Whether the last learn() left contact on few elements that had only been laid to look at it.
  bool few_stay() const { return few_stay_; }

 private:
  struct Kept {
    Rectangle box;  ///< where the bodies interpenetrate, in T [m]
    ElementSize size;
    bool chosen = false;  ///< by a contact, not only to look at one
  };
  ElementSize told(ElementSize size) const;
  ElementSize first(double length, double width) const;
  bool coarse(const PatchSolution& patch) const;
  bool only_looked_at(const PatchSolution& patch) const;

  Discretisation given_;
  bool active_ = false, rough_ = false, few_stay_ = false;
  double longest_;
  int rounds_ = 0;
  std::vector<Kept> kept_;
};

}  // namespace treadmark::wheelrail
