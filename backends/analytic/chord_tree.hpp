// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace treadmark::analytic {

/// A chord of a plane curve (y, h): the part of the curve that belongs to it lies within `off` of the chord.
struct Chord {
  double y_a = 0.0, h_a = 0.0, y_b = 0.0, h_b = 0.0;
  double off = 0.0;
};

/// Distance of the middle of an arc from its chord; less than half a circle.
inline double sagitta(double curvature, double chord) {
  const double sine = std::min(1.0, 0.5 * std::fabs(curvature) * chord);
  return 0.5 * chord * sine / (1.0 + std::sqrt((1.0 - sine) * (1.0 + sine)));
}

/// A plane curve as a tree of chords, from one chord of the whole to chords that keep to the curve within a micrometre
/// or so. Answers how far a mapped image of the curve reaches over a window, with rigorous bounds.
class ChordTree {
 public:
  ChordTree() = default;
  /// In the order of the curve, each beginning where its neighbour ends.
  explicit ChordTree(const std::vector<Chord>& leaves);

  /// An image of a point of the plane: v across, t along the direction in which the greatest is wanted.
  struct Image {
    double v, t;
  };

  /// Upper bound of t over the images with v in [v_low, v_high] of the curve's points with y in [y_low, y_high];
  /// -infinity if there are none. Chords less than `coarse` from their curves are not divided further. map(y, h): image
  /// of a point; map.off(chord): how far the image of the curve may lie from that of the chord, whose ends are joined
  /// by a line; map.look_early: whether v excludes much that y does not.
  template <class Map>
  double greatest(const Map& map, double y_low, double y_high, double v_low, double v_high, double coarse) const {
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < nodes_.size();) {
      const Node& n = nodes_[i];
      if (n.y_high < y_low || n.y_low > y_high) {
        i = n.next;
        continue;
      }
      const bool divide = n.chord.off > coarse && n.next > i + 1;
      if (divide && !map.look_early) {
        ++i;
        continue;
      }
      const Image a = map(n.chord.y_a, n.chord.h_a), b = map(n.chord.y_b, n.chord.h_b);
      const double off = map.off(n.chord), low = v_low - off, high = v_high + off;
      if (std::max(a.v, b.v) < low || std::min(a.v, b.v) > high || std::max(a.t, b.t) + off <= best) {
        i = n.next;
        continue;
      }
      if (divide) {
        ++i;
        continue;
      }
      best = std::max(best, clipped(a, b, low, high) + off);
      i = n.next;
    }
    return best;
  }

  std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  // In pre-order: the first half of a node follows it, `next` leads past both halves.
  struct Node {
    Chord chord;
    double y_low, y_high;
    std::size_t next;
  };

  /// Greatest t on the part of a line with v in [low, high], which is not empty.
  static double clipped(const Image& a, const Image& b, double low, double high) {
    const auto at = [&](const Image& end) {
      const double v = std::clamp(end.v, low, high);
      if (v == end.v) return end.t;
      const double along = std::clamp((v - a.v) / (b.v - a.v), 0.0, 1.0);
      return a.t + along * (b.t - a.t);
    };
    return std::max(at(a), at(b));
  }

  void build(const std::vector<Chord>& leaves, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
};

}  // namespace treadmark::analytic
