// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "treadmark/backends/levelset/cell.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/solid_shape.hpp"

namespace treadmark::levelset {

/// How far nodes lie beyond the rim of an open surface, in voxels, negative within; one for each block of distances.
/// A block without values lies within everywhere.
using RimBlocks = std::vector<std::vector<float>>;

/// What the rim's distance is cut off at, and so what it is in blocks without one [voxels].
inline constexpr float kFarFromRim = 4.0f;

/// A plane in the coordinates of the lattice: everything in voxels.
struct LatticeView {
  Vec3 origin;     ///< of the plane
  Mat3 rotation;   ///< its axes in the lattice
  double inwards;  ///< 1: lines run along the plane's z, into a rail; -1: against it, into a wheel

  LatticeView(const DistanceGrid& grid, const Pose& X_SP, Facing facing)
      : origin(grid.place.apply_inverse(X_SP.origin) / grid.voxel),
        rotation(grid.place.rotation.transpose() * X_SP.rotation),
        inwards(facing == Facing::up ? 1.0 : -1.0) {}

  /// The point so deep inwards over (x, y).
  Vec3 at(double x, double y, double depth) const { return origin + rotation * Vec3(x, y, inwards * depth); }
};

/// Where a line meets the surface.
struct Crossing {
  std::uint32_t block = 0;
  std::array<int, 3> cell{};                               ///< its node in the block
  double depth = std::numeric_limits<double>::infinity();  ///< inwards [voxels]
  bool enters = false;                                     ///< the material; else it leaves it
  bool found() const { return depth < std::numeric_limits<double>::infinity(); }
};

/// Distances from a surface as a triquadratic B-spline in a narrow band, smooth to the first derivative and of order 3.
/// Its own copy of the values, whatever they came from. A cell that may hold a zero by the hull of its coefficients is
/// marked; nowhere else is anything ever found, so nothing is missed. Immutable, thread-safe.
class DistanceField {
 public:
  /// rim: empty where the surface is closed. Errors: Error(input_data) where the band is too narrow for the splines, or
  /// there is no surface in it.
  explicit DistanceField(DistanceGrid grid, const RimBlocks& rim = {});

  /// Name, place and voxel; its blocks are empty.
  const DistanceGrid& grid() const { return grid_; }
  /// Box of the marked cells in the lattice.
  Vec3 low() const { return low_; }
  Vec3 high() const { return high_; }
  std::size_t memory_bytes() const;

  /// Cells that were read last, so that neighbouring lines read them once. For one thread.
  class Reader {
   public:
    explicit Reader(const DistanceField& field) : field_(field) {}
    const Coefficients& distances(std::uint32_t block, const std::array<int, 3>& cell);
    const Coefficients& rim(std::uint32_t block, const std::array<int, 3>& cell);

   private:
    const DistanceField& field_;
    std::uint64_t last_ = ~0ull, last_rim_ = ~0ull;
    Coefficients values_{}, rim_values_{};
  };

  /// A block that lines over a rectangle may meet, and how deep it begins there.
  struct Candidate {
    double depth;
    std::uint32_t block;
  };
  /// Those over the rectangle [voxels], nearest first.
  void candidates(const LatticeView& view, const Rectangle& r, std::vector<Candidate>& out) const;

  /// The first crossing over (x, y) [voxels] among the candidates that is deeper than `beyond`.
  Crossing first_crossing(Reader& reader, const LatticeView& view, const std::vector<Candidate>& candidates, double x,
                          double y, double beyond = -std::numeric_limits<double>::infinity()) const;

  /// The node of a cell in the lattice.
  Vec3 node(std::uint32_t block, const std::array<int, 3>& cell) const {
    const auto& first = blocks_[block].first;
    return {static_cast<double>(first[0] + cell[0]), static_cast<double>(first[1] + cell[1]),
            static_cast<double>(first[2] + cell[2])};
  }

  /// Least and greatest depth at which lines over the rectangle [voxels] can enter; false: they cannot.
  bool depths(const LatticeView& view, const Rectangle& r, double& least, double& greatest) const;

 private:
  struct Block {
    std::array<std::int32_t, 3> first{};
    std::array<std::int32_t, 27> around{};  ///< neighbouring blocks, [9 i + 3 j + k], -1: none; the middle is itself
    std::int32_t rim = -1;
    std::array<std::uint64_t, 8> marked{};
  };
  /// What is known of the marked cells of a block: distance = normal . place + constant + [low, high], and gradients
  /// differ from the normal by at most turn.
  struct Slab {
    Vec3 normal = Vec3::Zero();
    double constant = 0.0, low = 0.0, high = 0.0, turn = 0.0;
  };
  struct Node {
    Vec3 centre, half;
    std::uint32_t right = 0;  ///< the left one follows; 0: a leaf
    std::uint32_t block = 0;
    Slab slab{};
  };

  template <class Values>
  void read(const Values& values_of, std::uint32_t block, const std::array<int, 3>& cell, float missing,
            Coefficients& out) const;
  void gather(std::uint32_t block, const std::array<int, 3>& cell, Coefficients& out) const;
  void gather_rim(std::uint32_t block, const std::array<int, 3>& cell, Coefficients& out) const;
  void connect();
  void mark(const std::vector<DistanceGrid::Block>& given, std::uint32_t block, std::size_t& torn);
  void grow_tree(std::vector<Node>& leaves, std::size_t from, std::size_t to);
  void meet(Reader& reader, const LatticeView& view, std::uint32_t block, double x, double y, double beyond,
            Crossing& best) const;
  template <class Each>
  void each_over(const LatticeView& view, const Rectangle& r, const Each& each) const;

  DistanceGrid grid_;
  std::vector<Block> blocks_;
  std::vector<std::array<float, DistanceGrid::kNodes>> values_, rims_;
  std::vector<Node> nodes_;
  Vec3 low_, high_;
};

}  // namespace treadmark::levelset
