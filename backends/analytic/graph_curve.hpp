// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/analytic/arc_graph.hpp"
#include "treadmark/backends/analytic/chord_tree.hpp"
#include "treadmark/backends/analytic/wheels/wheel_lanes.hpp"

namespace treadmark::analytic {

/// Bounds of a curve over an interval; slopes may be infinite.
struct CurveRange {
  double h_min = 0.0, h_max = 0.0;
  double dh_min = 0.0, dh_max = 0.0;
};

/// A polynomial in t = (x - middle)/half over [x_min, x_max].
struct PolynomialGraph {
  static constexpr int kTerms = 9;
  double x_min = 0.0, x_max = 0.0;
  double middle = 0.0, half = 1.0;
  double c[kTerms] = {};

  /// From coefficients of powers of x, moved to the middle of the interval in extended precision: powers of a far
  /// away origin cancel badly.
  static PolynomialGraph from_powers(double x_min, double x_max, const std::vector<double>& coefficients);

  double height_and_slope(double x, double& slope) const;
  Jet jet(double x) const;
  CurveRange range(double a, double b) const;
};

/// A wheel profile z(y) [m] made of arcs, lines and polynomials side by side. Tiny steps between pieces are kept as
/// they are.
class GraphCurve {
 public:
  /// Pieces in increasing order, each beginning where its neighbour ends.
  void append(const ArcGraph& arc);
  void append(const PolynomialGraph& polynomial);

  double y_min() const { return starts_.front(); }
  double y_max() const { return ends_.back(); }
  int piece_count() const { return static_cast<int>(starts_.size()); }
  double piece_start(int piece) const { return starts_[static_cast<std::size_t>(piece)]; }
  double piece_end(int piece) const { return ends_[static_cast<std::size_t>(piece)]; }

  /// Piece that holds y, searched from a first guess; y outside belongs to the first or last piece.
  int find(double y, int guess) const {
    const int last = piece_count() - 1;
    int i = guess;
    while (i < last && y > ends_[static_cast<std::size_t>(i)]) ++i;
    while (i > 0 && y < starts_[static_cast<std::size_t>(i)]) --i;
    return i;
  }
  double start_height() const { return height(y_min(), 0); }
  double end_height() const { return height(y_max(), piece_count() - 1); }
  double height(double y, int piece) const {
    double slope;
    return height_and_slope(y, piece, slope);
  }
  double height_and_slope(double y, int piece, double& slope) const {
    const Entry& e = entries_[static_cast<std::size_t>(piece)];
    return e.polynomial < 0 ? arcs_[static_cast<std::size_t>(e.arc)].height_and_slope(y, slope)
                            : polynomials_[static_cast<std::size_t>(e.polynomial)].height_and_slope(y, slope);
  }
  Jet jet(double y, int piece) const;

  PieceLanes lanes(int piece) const;

  /// Rigorous bounds over [a, b], clipped to the curve.
  CurveRange range(double a, double b) const;

  /// Chords that keep to the curve within kChordOff, from its first to its last point.
  static constexpr double kChordOff = 1e-6;  ///< [m]
  std::vector<Chord> chords() const;

 private:
  Chord chord(double a, double b, int piece) const;
  struct Entry {
    int arc = -1, polynomial = -1;
  };
  std::vector<double> starts_, ends_;
  std::vector<Entry> entries_;
  std::vector<ArcGraph> arcs_;
  std::vector<PolynomialGraph> polynomials_;
};

}  // namespace treadmark::analytic
