// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "treadmark/backends/mesh/prepared_mesh.hpp"

namespace treadmark::mesh {

/// First hits of parallel rays in single precision; what it finds is where to start looking in double precision.
class RayScene {
 public:
  static constexpr int kPacket = 8;
  struct Packet {
    alignas(32) std::array<float, kPacket> x, y, z;  ///< where the rays start, local [m]
    int count = 0;
  };

  virtual ~RayScene() = default;

  /// Triangle that each ray meets first, kNone if there is none. Thread-safe.
  virtual void first_hits(const Packet& rays, const std::array<float, 3>& direction,
                          std::array<std::uint32_t, kPacket>& triangles) const = 0;

  /// What the library says that it holds.
  virtual std::size_t memory_bytes() const = 0;
};

/// By Embree, with a reference to the triangles; null in builds and FMUs without it, where the hierarchy does as well.
std::unique_ptr<const RayScene> ray_scene(const PreparedMesh& mesh);

}  // namespace treadmark::mesh
