// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::mesh {

struct RayScene::Library {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::atomic<std::ptrdiff_t> bytes{0};

  ~Library() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

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

}  // namespace

RayScene::RayScene(const PreparedMesh& mesh) : library_(std::make_unique<Library>()) {
  Library& lib = *library_;
  lib.device = rtcNewDevice(nullptr);
  require(lib.device != nullptr, nullptr, mesh.name);
  rtcSetDeviceMemoryMonitorFunction(lib.device, count_bytes, &lib.bytes);
  lib.scene = rtcNewScene(lib.device);
  // what it finds is looked at again: memory and time of building count for more than its last per cents
  rtcSetSceneFlags(lib.scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
  rtcSetSceneBuildQuality(lib.scene, RTC_BUILD_QUALITY_LOW);
  RTCGeometry geometry = rtcNewGeometry(lib.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(Corners), mesh.triangles.size());
  if (vertices) {
    for (const Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(v[k]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(lib.scene, geometry);
  }
  rtcReleaseGeometry(geometry);
  require(vertices != nullptr, lib.device, mesh.name);
  if (const CancellationToken* token = current_cancellation())
    rtcSetSceneProgressMonitorFunction(lib.scene, goes_on, const_cast<CancellationToken*>(token));
  rtcCommitScene(lib.scene);
  check_cancelled();
  rtcSetSceneProgressMonitorFunction(lib.scene, nullptr, nullptr);
  require(true, lib.device, mesh.name);
}

RayScene::~RayScene() = default;

void RayScene::first_hits(const Packet& rays, const std::array<float, 3>& direction,
                          std::array<std::uint32_t, kPacket>& triangles) const {
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
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, library_->scene, &context, &packet);
  for (std::size_t k = 0; k < kPacket; ++k)
    triangles[k] = packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID ? kNone : packet.hit.primID[k];
}

std::size_t RayScene::memory_bytes() const {
  return sizeof(Library) + static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, library_->bytes.load()));
}

}  // namespace treadmark::mesh
