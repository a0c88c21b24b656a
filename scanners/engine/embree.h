// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Embree 4 (Debian 13) or 3 (Debian 12): what differs between them is in this file alone.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace standpoint {

// What goes along with rays. A filter of hits is given the address of the context, which is that of the query: who
// needs more in a filter puts the query first in a struct of its own.
struct RayQuery {
  enum class Rays { single, coherent };

#if RTC_VERSION_MAJOR >= 4
  explicit RayQuery(Rays rays) {
    rtcInitRayQueryContext(&context);
    if (rays == Rays::coherent) flags = RTC_RAY_QUERY_FLAG_COHERENT;
  }
  RTCIntersectArguments arguments() {
    RTCIntersectArguments result;
    rtcInitIntersectArguments(&result);
    result.flags = flags;
    result.context = &context;
    return result;
  }
  void trace(RTCScene scene, RTCRayHit& ray) {
    auto with = arguments();
    rtcIntersect1(scene, &ray, &with);
  }
  void trace(const int* valid, RTCScene scene, RTCRayHit8& rays) {
    auto with = arguments();
    rtcIntersect8(valid, scene, &rays, &with);
  }
  void trace(const int* valid, RTCScene scene, RTCRayHit16& rays) {
    auto with = arguments();
    rtcIntersect16(valid, scene, &rays, &with);
  }

  RTCRayQueryContext context;
  RTCRayQueryFlags flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
#else
  explicit RayQuery(Rays rays) {
    rtcInitIntersectContext(&context);
    if (rays == Rays::coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  void trace(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &context, &ray); }
  void trace(const int* valid, RTCScene scene, RTCRayHit8& rays) { rtcIntersect8(valid, scene, &context, &rays); }
  void trace(const int* valid, RTCScene scene, RTCRayHit16& rays) { rtcIntersect16(valid, scene, &context, &rays); }

  RTCIntersectContext context;
#endif
};

}  // namespace standpoint
