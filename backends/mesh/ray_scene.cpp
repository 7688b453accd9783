// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/ray_scene.hpp"

#include <algorithm>
#include <atomic>
#include <limits>

#include "treadmark/backends/mesh/embree_version.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::mesh {

namespace {

struct EmbreeHandles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::atomic<std::ptrdiff_t> bytes{0};

  EmbreeHandles() = default;
  ~EmbreeHandles() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  EmbreeHandles(const EmbreeHandles&) = delete;
  EmbreeHandles& operator=(const EmbreeHandles&) = delete;
};

bool count_bytes(void* total, ssize_t bytes, bool) {
  static_cast<std::atomic<std::ptrdiff_t>*>(total)->fetch_add(bytes);
  return true;
}

/// What Embree asks while it builds, on any of its threads.
bool goes_on(void* token, double) { return !static_cast<const CancellationToken*>(token)->requested(); }

void require(bool fine, RTCDevice device, const std::string& name) {
  if (fine && (!device || rtcGetDeviceError(device) == RTC_ERROR_NONE)) return;
  throw Error(ErrorKind::numerical, "Embree could not take the mesh '" + name + "'", {}, "is there enough memory?");
}

class EmbreeScene final : public RayScene {
 public:
  explicit EmbreeScene(const PreparedMesh& mesh);

  void first_hits(const Packet& rays, const std::array<float, 3>& direction,
                  std::array<std::uint32_t, kPacket>& triangles) const override;
  std::size_t memory_bytes() const override {
    return sizeof *this + static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, lib_.bytes.load()));
  }

 private:
  std::uint32_t first_hit(const Packet& rays, const std::array<float, 3>& direction) const;

  EmbreeHandles lib_;
};

EmbreeScene::EmbreeScene(const PreparedMesh& mesh) {
  lib_.device = rtcNewDevice(nullptr);
  require(lib_.device != nullptr, nullptr, mesh.name);
  rtcSetDeviceMemoryMonitorFunction(lib_.device, count_bytes, &lib_.bytes);
  lib_.scene = rtcNewScene(lib_.device);
  // what it finds is looked at again: memory and time of building count for more than its last per cents
  rtcSetSceneFlags(lib_.scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
  rtcSetSceneBuildQuality(lib_.scene, RTC_BUILD_QUALITY_LOW);
  RTCGeometry geometry = rtcNewGeometry(lib_.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(Corners), mesh.triangles.size());
  if (vertices) {
    for (const Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(v[k]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(lib_.scene, geometry);
  }
  rtcReleaseGeometry(geometry);
  require(vertices != nullptr, lib_.device, mesh.name);
  if (const CancellationToken* token = current_cancellation())
    rtcSetSceneProgressMonitorFunction(lib_.scene, goes_on, const_cast<CancellationToken*>(token));
  rtcCommitScene(lib_.scene);
  check_cancelled();
  rtcSetSceneProgressMonitorFunction(lib_.scene, nullptr, nullptr);
  require(true, lib_.device, mesh.name);
}

void EmbreeScene::first_hits(const Packet& rays, const std::array<float, 3>& direction,
                             std::array<std::uint32_t, kPacket>& triangles) const {
  if (rays.count == 1) {
    triangles[0] = first_hit(rays, direction);
    return;
  }
  alignas(32) int valid[kPacket];
  RTCRayHit8 packet;
  for (int k = 0; k < kPacket; ++k) {
    const auto from = static_cast<std::size_t>(std::min(k, rays.count - 1));
    valid[k] = k < rays.count ? -1 : 0;
    packet.ray.org_x[k] = rays.x[from];
    packet.ray.org_y[k] = rays.y[from];
    packet.ray.org_z[k] = rays.z[from];
    packet.ray.dir_x[k] = direction[0];
    packet.ray.dir_y[k] = direction[1];
    packet.ray.dir_z[k] = direction[2];
    packet.ray.tnear[k] = 0.0f;
    packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
    packet.ray.time[k] = 0.0f;
    packet.ray.mask[k] = ~0u;
    packet.ray.id[k] = 0;
    packet.ray.flags[k] = 0;
    packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  embree_hits(lib_.scene, valid, packet);
  for (std::size_t k = 0; k < kPacket; ++k)
    triangles[k] = packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID ? kNone : packet.hit.primID[k];
}

/// One ray alone, as beams of a scanner are.
std::uint32_t EmbreeScene::first_hit(const Packet& rays, const std::array<float, 3>& direction) const {
  RTCRayHit one;
  one.ray.org_x = rays.x[0];
  one.ray.org_y = rays.y[0];
  one.ray.org_z = rays.z[0];
  one.ray.dir_x = direction[0];
  one.ray.dir_y = direction[1];
  one.ray.dir_z = direction[2];
  one.ray.tnear = 0.0f;
  one.ray.tfar = std::numeric_limits<float>::infinity();
  one.ray.time = 0.0f;
  one.ray.mask = ~0u;
  one.ray.id = 0;
  one.ray.flags = 0;
  one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  one.hit.primID = RTC_INVALID_GEOMETRY_ID;
  one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree_hit(lib_.scene, one);
  return one.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kNone : one.hit.primID;
}

}  // namespace

std::unique_ptr<const RayScene> ray_scene(const PreparedMesh& mesh) { return std::make_unique<EmbreeScene>(mesh); }

}  // namespace treadmark::mesh
