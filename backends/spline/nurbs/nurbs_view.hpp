// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/backends/spline/nurbs/nurbs_leaf.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"

namespace treadmark::spline {

/// A hit of a line: patch, parameters -1/2 .. 1/2 in it, height and slopes.
struct NurbsHit {
  int iu = 0, iv = 0;
  double s = 0.0, t = 0.0;
  double z = 0.0, dzdx = 0.0, dzdy = 0.0;
  bool hides_others = false;
};

/// The half of a wheel that faces a plane: heights of at least the nearest to the axle, which are linear in x and y.
/// All of a rail.
struct FacingHalf {
  bool all = true;
  bool none = false;  ///< the plane looks along the axle
  double c = 0.0, x = 0.0, y = 0.0;
  Vec3 outwards = Vec3::Zero();  ///< part of the normal square to the axle, surface frame

  FacingHalf(const Pose& X_SP, Facing facing);
  double lowest(double at_x, double at_y) const { return c + x * at_x + y * at_y; }
  /// All of a box is turned away.
  bool away(const ControlBox& box) const { return !all && box.z.high < c + (x * box.x + y * box.y).low - 1e-9; }
};

/// The same for the kernels.
ViewArrays view_arrays(const Pose& X_SP, const FacingHalf& half);

struct PatchIndex {
  int iu, iv;
};

/// Calls use(iu, iv, low, high) for patches that may be seen over a rectangle, with the corners of their boxes in the
/// frame of the plane.
template <class Use>
void for_patches_over(const NurbsNet& net, const Pose& X_SP, const Rectangle& r, const FacingHalf& half,
                      const Use& use) {
  using nurbs_limits::kSlack;
  if (half.none || !(r.x_max >= r.x_min && r.y_max >= r.y_min)) return;
  const Mat3 turn = X_SP.rotation.transpose(), spread = turn.cwiseAbs();
  const Vec3 shift = turn * X_SP.origin, outwards_size = half.outwards.cwiseAbs();
  Vec3 c, h;
  net.visit(
      [&](const Vec3& centre, const Vec3& half_size) {
        c = turn * centre - shift;
        h = spread * half_size;
        h.array() += kSlack;
        if (c.x() - h.x() > r.x_max || c.x() + h.x() < r.x_min || c.y() - h.y() > r.y_max || c.y() + h.y() < r.y_min)
          return false;
        return half.all || half.outwards.dot(centre) + outwards_size.dot(half_size) >= -kSlack;
      },
      [&](int iu, int iv, const Vec3&, const Vec3&) { use(iu, iv, Vec3(c - h), Vec3(c + h)); });
}

/// The surface seen from a plane over a rectangle. Candidates are patches whose boxes lie over it, sorted into bins; a
/// patch is turned into the plane frame, and divided into regular leaves, when a line first comes near. Every candidate
/// that could hold a hit further out is looked at, so that the hit returned is the outermost one. One object serves one
/// thread.
class NurbsView {
 public:
  NurbsView(const NurbsNet& net, const Pose& X_SP, const Rectangle& rectangle, Facing facing);
  /// Of some patches only.
  NurbsView(const NurbsNet& net, const Pose& X_SP, const Rectangle& rectangle, Facing facing,
            std::span<const PatchIndex> patches);
  ~NurbsView();
  NurbsView(const NurbsView&) = delete;
  NurbsView& operator=(const NurbsView&) = delete;

  /// Outermost hit of the line through (x, y). exact: slopes and parameters to rounding. all: look for hidden ones,
  /// too.
  bool hit(double x, double y, bool exact, bool all, NurbsHit& out);
  /// Adds hits of all points of a tile to those that it holds.
  void hit_tile(const ViewArrays& view, const TileArrays& tile);

 private:
  struct Candidate {
    Interval x, y;
    double outer;  // no hit of it lies further out; heights times side_
    int iu, iv;
    int first_leaf = -1, last_leaf = -1;
  };
  // Middle and size of a part of a patch.
  struct PatchPart {
    double s = 0.0, t = 0.0, size_s = 1.0, size_t = 1.0;
    int halvings = 0;
    PatchPart half(bool of_u, bool upper) const;
  };
  struct Leaf {
    NurbsLeaf leaf;
    double outer;
    PatchPart part;
    int rough = -1;  // not regular: its Bezier points
  };
  // Memory that the next view of the same thread takes over.
  struct Room {
    std::vector<Candidate> candidates;  // outermost first
    std::vector<Leaf> leaves;
    std::vector<BezierPatch> rough;
    std::vector<int> bin_begin, bin_fill, binned;
  };
  static Room& spare_room();
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
    double best = 0.0;
    int leaf = -1;
    int parts_left = 20'000;  // bounds the time of a line that runs along a fold
    LeafRoot root{}, guessed{};
  };

  struct Empty {};
  NurbsView(const NurbsNet& net, const Pose& X_SP, const Rectangle& rectangle, Facing facing, Empty);
  void sort_into_bins();
  void prepare(Candidate& candidate);
  void divide(const BezierPatch& bezier, const PatchPart& part);
  bool hidden(const ControlBox& box) const;
  void look_into(int leaf, const Candidate& candidate, Search& search);
  void look_closer(const BezierPatch& bezier, const PatchPart& part, const Candidate& candidate, Search& search);
  void take(const LeafRoot& root, const PatchPart& part, const Candidate& candidate, Search& search) const;
  void follow(const Search& search);

  const NurbsNet& net_;
  Pose X_SP_;
  Rectangle rectangle_;
  FacingHalf half_;
  double side_;
  Room room_;
  std::vector<Candidate>& candidates_ = room_.candidates;
  std::vector<Leaf>& leaves_ = room_.leaves;
  std::vector<BezierPatch>& rough_ = room_.rough;
  std::vector<int>&bin_begin_ = room_.bin_begin, &bin_fill_ = room_.bin_fill, &binned_ = room_.binned;
  int bins_x_ = 1, bins_y_ = 1;
  double per_x_ = 0.0, per_y_ = 0.0;
  Track track_;
};

}  // namespace treadmark::spline
