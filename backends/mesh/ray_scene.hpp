// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "treadmark/backends/mesh/prepared_mesh.hpp"

namespace treadmark::mesh {

/// First hits of parallel rays in single precision; what it finds is where to start looking in double precision.
/// All that knows the ray casting library is the one source file of this class.
class RayScene {
 public:
  static constexpr int kPacket = 8;
  struct Packet {
    alignas(32) std::array<float, kPacket> x, y, z;  ///< where the rays start, local [m]
    int count = 0;
  };

  /// Keeps a reference to the triangles.
  explicit RayScene(const PreparedMesh& mesh);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Triangle that each ray meets first, kNone if there is none. Thread-safe.
  void first_hits(const Packet& rays, const std::array<float, 3>& direction,
                  std::array<std::uint32_t, kPacket>& triangles) const;

  /// What the library says that it holds.
  std::size_t memory_bytes() const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace treadmark::mesh
