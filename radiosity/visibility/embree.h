#pragma once

// Embree 3 and 4 take what belongs to a query in different ways; here they are one.

#if RADIOSITY_EMBREE >= 4

#include <embree4/rtcore.h>

namespace radiosity {

using EmbreeContext = RTCRayQueryContext;

inline constexpr RTCSceneFlags kQueryFilter = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void init_context(EmbreeContext& context) { rtcInitRayQueryContext(&context); }

/// `context` must be the first member of what the filter casts it to.
inline void intersect1(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter,
                       RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.filter = filter;
  if (filter != nullptr) arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
  rtcIntersect1(scene, &ray, &arguments);
}

/// Calls only the filters of the geometries.
inline void occluded16(const int* valid, RTCScene scene, EmbreeContext& context, bool is_coherent,
                       RTCRay16& rays) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  if (is_coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &rays, &arguments);
}

}  // namespace radiosity

#else

#include <embree3/rtcore.h>

namespace radiosity {

using EmbreeContext = RTCIntersectContext;

inline constexpr RTCSceneFlags kQueryFilter = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void init_context(EmbreeContext& context) { rtcInitIntersectContext(&context); }

/// `context` must be the first member of what the filter casts it to.
inline void intersect1(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter,
                       RTCRayHit& ray) {
  context.filter = filter;
  rtcIntersect1(scene, &context, &ray);
}

/// Calls only the filters of the geometries.
inline void occluded16(const int* valid, RTCScene scene, EmbreeContext& context, bool is_coherent,
                       RTCRay16& rays) {
  if (is_coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
}

}  // namespace radiosity

#endif
