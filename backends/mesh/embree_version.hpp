// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

// All in which versions 3 and 4 of Embree differ for us. For ray_scene.cpp alone.

#if TREADMARK_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace treadmark::mesh {

/// Eight rays side by side; valid: -1 of those that count.
inline void embree_hits(RTCScene scene, const int* valid, RTCRayHit8& rays) {
#if TREADMARK_EMBREE_MAJOR == 4
  RTCIntersectArguments how;
  rtcInitIntersectArguments(&how);
  how.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &rays, &how);
#else
  RTCIntersectContext how;
  rtcInitIntersectContext(&how);
  how.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &how, &rays);
#endif
}

/// One ray that has nothing to do with the one before.
inline void embree_hit(RTCScene scene, RTCRayHit& ray) {
#if TREADMARK_EMBREE_MAJOR == 4
  rtcIntersect1(scene, &ray);
#else
  RTCIntersectContext how;
  rtcInitIntersectContext(&how);
  rtcIntersect1(scene, &how, &ray);
#endif
}

}  // namespace treadmark::mesh
