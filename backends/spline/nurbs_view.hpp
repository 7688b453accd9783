// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/nurbs_leaf.hpp"
#include "treadmark/backends/spline/nurbs_net.hpp"

namespace treadmark::spline {

/// A hit of a line: patch, parameters -1/2 .. 1/2 in it, height and slopes.
struct NurbsHit {
  int iu = 0, iv = 0;
  double s = 0.0, t = 0.0;
  double z = 0.0, dzdx = 0.0, dzdy = 0.0;
  bool hides_others = false;
};

/// The half of a wheel that faces a plane: heights of at least the nearest to the axle, which are linear in x and y. All of a rail.
struct FacingHalf {
  bool all = true;
  double c = 0.0, x = 0.0, y = 0.0;
  Vec3 outwards = Vec3::Zero();  ///< part of the normal square to the axle, surface frame

  FacingHalf(const Pose& X_SP, Facing facing);
  double lowest(double at_x, double at_y) const { return c + x * at_x + y * at_y; }
  /// All of a box is turned away.
  bool away(const ControlBox& box) const {
    return !all && box.z.high < c + (x * box.x + y * box.y).low - 1e-9;
  }
};

/// The surface seen from a plane over a rectangle. Candidates are patches whose boxes lie over it, sorted into bins; a patch
/// is turned into the plane frame, and divided into regular leaves, when a line first comes near. Every candidate that
/// could hold a hit further out is looked at, so that the hit returned is the outermost one. One object serves one thread.
class NurbsView {
 public:
  NurbsView(const NurbsNet& net, const Pose& X_SP, const Rectangle& rectangle, Facing facing);

  /// Outermost hit of the line through (x, y). exact: slopes and parameters to rounding. all: look for hidden ones, too.
  bool hit(double x, double y, bool exact, bool all, NurbsHit& out);

 private:
  struct Candidate {
    Interval x, y;
    double outer;  // no hit of it lies further out; heights times side_
    int iu, iv;
    int first_leaf = -1, last_leaf = -1;
  };
  struct Leaf {
    NurbsLeaf leaf;
    double outer;
    double s, t, size;  // middle and size in the patch
    int rough = -1;     // not regular: its Bezier points
  };
  // The last hit, from which the next one is guessed.
  struct Track {
    int leaf = -1;
    double x = 0.0, y = 0.0;
    LeafRoot root;
    double bend_s = 0.0, bend_t = 0.0;
  };
  struct Search {
    double x, y;
    bool exact, all;
    NurbsHit& out;
    bool found = false;
    double best = 0.0, first_z = 0.0;
    int leaf = -1;
    LeafRoot root{}, guessed{};
  };

  void sort_into_bins();
  void prepare(Candidate& candidate);
  void divide(const BezierPatch& part, double s, double t, double size, int depth);
  bool hidden(const ControlBox& box) const;
  void look_into(int leaf, const Candidate& candidate, Search& search);
  void look_closer(const BezierPatch& part, double s, double t, double size, int depth, const Candidate& candidate, Search& search);
  void take(const LeafRoot& root, double s, double t, double size, const Candidate& candidate, Search& search) const;
  void follow(const Search& search);

  const NurbsNet& net_;
  Pose X_SP_;
  Rectangle rectangle_;
  FacingHalf half_;
  double side_;
  std::vector<Candidate> candidates_;  // outermost first
  std::vector<Leaf> leaves_;
  std::vector<BezierPatch> rough_;
  int bins_x_ = 1, bins_y_ = 1;
  double per_x_ = 0.0, per_y_ = 0.0;
  std::vector<int> bin_begin_, binned_;
  Track track_;
};

}  // namespace treadmark::spline
