// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "treadmark/backends/spline/thb/knot_line.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// A cell of a hierarchy: the intervals of its level.
struct ThbCell {
  int level = 0, iu = 0, iv = 0;
  friend bool operator==(const ThbCell&, const ThbCell&) = default;
};

/// Bernstein coefficients of a polynomial over a cell: b[i][j], i along u, j along v; 0 .. degree of them count.
using ThbPiece = std::array<std::array<Vec3, kMostDegree + 1>, kMostDegree + 1>;

/// A part of the parameters.
struct ThbRange {
  double u0, u1, v0, v1;
};
/// The same polynomials with the Bernstein coefficients of another range.
ThbPiece over_range(const ThbPiece& piece, int degree_u, int degree_v, const ThbRange& from, const ThbRange& to);

/// Truncated hierarchical B-splines (Giannelli, Juettler and Speleers 2012): tensor splines of level 0 in which some
/// cells are divided into those of level 1, and so on. A function of a level counts if all of its support lies in cells
/// that are divided to that level, and not all of it in such that are divided further; where it overlaps functions that
/// are finer it is truncated, so that the sum of all is 1. Use: divide, then settle, then the rest, which is
/// const and thread-safe.
class ThbSpace {
 public:
  struct Level {
    KnotLine u, v;
  };
  /// Errors: Error(input_data) if there is no level, or one does not hold the one before.
  explicit ThbSpace(std::vector<Level> levels);

  int levels() const { return static_cast<int>(levels_.size()); }
  const KnotLine& u(int level) const { return at(level).line.u; }
  const KnotLine& v(int level) const { return at(level).line.v; }

  /// Whether it is there: its parent is divided.
  bool exists(const ThbCell& cell) const;
  bool divided(const ThbCell& cell) const;
  ThbCell parent(const ThbCell& cell) const;
  /// Divides a cell, and others so that all neighbours of a cell of level l lie in cells of level l - 1 at least.
  void divide(const ThbCell& cell);
  /// Divides a cell of an existing one and nothing else. Errors: Error(input_data) if it does not exist or is of the
  /// last level.
  void divide_alone(const ThbCell& cell);
  /// Numbers functions and cells.
  void settle();

  /// Of a hierarchy from elsewhere, which need not be made by divide: each level that has cells has a function.
  /// Errors: Error(input_data) that names the level.
  void require_support() const;

  std::size_t functions() const { return functions_; }
  /// Those that are not divided, level by level.
  const std::vector<ThbCell>& cells() const { return cells_; }
  /// The one that holds (u, v), clamped to the ends.
  ThbCell cell_at(double u, double v) const;
  /// The function's level, and those of both directions.
  struct Function {
    int level, u, v;
  };
  Function function(std::size_t number) const;

  /// A function over a cell by its Bernstein coefficients.
  struct Column {
    std::size_t function;
    std::array<double, std::size_t{kMostDegree + 1} * (kMostDegree + 1)> b;  ///< index = 4 i + j, i along u
  };
  /// Those that do not vanish over a cell.
  std::vector<Column> columns(const ThbCell& cell) const;
  /// Calls use(function) for these, and maybe for some that finer ones replace there.
  template <class Use>
  void each_function(const ThbCell& cell, const Use& use) const {
    for (ThbCell on = cell;; on = parent(on)) {
      for_window(on, [&](int, int, std::size_t n) { use(n); });
      if (on.level == 0) return;
    }
  }
  /// A spline of this space over a cell. not_truncated: coefficients are those of the functions as they are, which do
  /// not sum to 1 (Kraft 1997).
  ThbPiece piece(const ThbCell& cell, const std::vector<Vec3>& coefficients, bool not_truncated = false) const;

  /// The coefficients of a spline that lies in this space, known by its polynomials: piece_of(cell) for cells that are
  /// not divided. A truncated function keeps the coefficient that the level's own spline has (Giannelli, Juettler and
  /// Speleers 2014), so each is a blossom of the polynomial over one cell of its support.
  template <class PieceOf>
  std::vector<Vec3> coefficients(const PieceOf& piece_of) const {
    std::vector<Vec3> out(functions_, Vec3::Zero());
    std::vector<char> known(functions_, 0);
    for (const ThbCell& cell : cells_) {
      const ThbPiece piece = piece_of(cell);
      for_window(cell, [&](int ku, int kv, std::size_t number) {
        if (known[number]) return;
        known[number] = 1;
        out[number] = coefficient(cell, ku, kv, piece);
      });
    }
    return out;
  }

  /// Of this space, finer: the coefficients of the same spline there. The levels must be the same.
  std::vector<Vec3> refined(const std::vector<Vec3>& coefficients, const ThbSpace& finer) const;

  ThbRange range(const ThbCell& cell) const;
  std::size_t memory_bytes() const;

 private:
  using Matrix = std::array<KnotWeights, kMostDegree + 1>;  // row: function over the child, or Bernstein coefficient
  struct Direction {
    std::vector<int> parent;       // of each interval, in the level before
    std::vector<int> first_child;  // of each interval of the level before, and one more
    std::vector<Matrix> from_parent, to_bernstein;
  };
  struct LevelData {
    explicit LevelData(Level l) : line(std::move(l)) {}
    Level line;
    Direction along_u, along_v;
    std::vector<bool> divided;
    std::vector<std::uint64_t> active;  // increasing
    std::vector<std::size_t> row;       // of each function along u: where its own begin there; and the end
    std::size_t first = 0;              // number of the first function
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  const LevelData& at(int level) const { return levels_[static_cast<std::size_t>(level)]; }
  static Direction direction(const KnotLine& line, const KnotLine* coarser);
  std::size_t index(const ThbCell& cell) const;
  std::uint64_t key(int level, int fu, int fv) const;
  std::size_t number(int level, int fu, int fv) const;
  // All of the function's support lies in cells of its level.
  bool inside(int level, int fu, int fv) const;
  std::vector<ThbCell> path(const ThbCell& cell) const;  // from its ancestor of level 0
  Vec3 coefficient(const ThbCell& cell, int ku, int kv, const ThbPiece& piece) const;
  // use(ku, kv, number) for functions of the cell's own level that count.
  template <class Use>
  void for_window(const ThbCell& cell, const Use& use) const {
    const KnotLine &lu = u(cell.level), &lv = v(cell.level);
    for (int ku = 0; ku <= lu.degree(); ++ku)
      for (int kv = 0; kv <= lv.degree(); ++kv) {
        const std::size_t n = number(cell.level, lu.function(cell.iu, ku), lv.function(cell.iv, kv));
        if (n != kNone) use(ku, kv, n);
      }
  }
  std::vector<LevelData> levels_;
  std::vector<ThbCell> cells_;
  std::size_t functions_ = 0;
};

}  // namespace treadmark::spline
