#include "radiosity/visibility/visibility.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/embree.h"
#include "radiosity/visibility/scaled_patches.h"

namespace radiosity {
namespace {

// Embree computes in float, on patches that were scaled for it.

/// Roundings of a segment's end and of a corner in its plane, added up.
constexpr double kEndRounding = 5e-7;

/// Patches from which on packets of coherent rays gain, by 10 to 20 %; in tiny scenes they lose.
constexpr Index kLarge = 512;

struct Device {
  RTCDevice handle = rtcNewDevice("set_affinity=0");
  Device() = default;
  ~Device() { rtcReleaseDevice(handle); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
};

struct EmbreeScene {
  RTCScene handle;
  explicit EmbreeScene(RTCDevice device) : handle(rtcNewScene(device)) {}
  ~EmbreeScene() { rtcReleaseScene(handle); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
};

}  // namespace

struct Visibility::Implementation {
  explicit Implementation(const PatchMesh& mesh);

  void attach(RayTriangles& some, RTCFilterFunctionN filter);
  [[nodiscard]] std::int32_t patch_of(unsigned geometry, unsigned triangle) const {
    return triangles[geometry].patch[triangle];
  }
  /// The first hit between two distances in scaled coordinates.
  [[nodiscard]] std::optional<Hit> first_hit(const Vec3& origin, const Vec3& direction,
                                             std::int32_t source, RTCFilterFunctionN filter,
                                             double from, double to) const;

  Device device;
  EmbreeScene scene{device.handle};
  ScaledPatches patches;
  /// By Embree's number of their geometry; the second: needles.
  std::array<RayTriangles, 2> triangles;
  bool is_large = false;  // so that packets are traced faster than their rays one by one
};

namespace {

/// What the filter function needs to know about the rays under way.
struct FilterContext {
  EmbreeContext embree;  // must come first: Embree hands back a pointer to it
  const Visibility::Implementation* visibility;
  std::int32_t source;
  std::int32_t target;
  const float* end;  // of segments: per ray
};

}  // namespace

void Visibility::Implementation::attach(RayTriangles& some, RTCFilterFunctionN filter) {
  RTCGeometry geometry = rtcNewGeometry(device.handle, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto fill = [&](RTCBufferType type, RTCFormat format, auto& items) {
    void* buffer =
        rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(items[0]), items.size());
    std::copy(items.begin(), items.end(), static_cast<decltype(items.data())>(buffer));
    items = {};
  };
  fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, some.vertices);
  fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, some.corners);
  rtcSetGeometryOccludedFilterFunction(geometry, filter);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene.handle, geometry, static_cast<unsigned>(&some - triangles.data()));
  rtcReleaseGeometry(geometry);
}

namespace {

std::int32_t hit_patch(const RTCFilterFunctionNArguments* arguments, unsigned k) {
  const auto* context = reinterpret_cast<const FilterContext*>(arguments->context);
  return context->visibility->patch_of(RTCHitN_geomID(arguments->hit, arguments->N, k),
                                       RTCHitN_primID(arguments->hit, arguments->N, k));
}

/// Embree found something in the way: reject it where it belongs to the segment's own ends.
void reject_own_ends(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const FilterContext*>(arguments->context);
  const auto* implementation = context->visibility;
  for (unsigned k = 0; k < arguments->N; ++k) {
    if (arguments->valid[k] == 0) continue;
    const std::int32_t patch = hit_patch(arguments, k);
    if (implementation->patches.ignores(patch, context->source, context->target))
      arguments->valid[k] = 0;
  }
}

/// Embree found a needle in the way: reject it where it belongs to the segment's own ends or its
/// plane, in double precision, is not between them.
void reject_misplaced(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const FilterContext*>(arguments->context);
  const auto* implementation = context->visibility;
  const unsigned n = arguments->N;
  for (unsigned k = 0; k < n; ++k) {
    if (arguments->valid[k] == 0) continue;
    const std::int32_t patch = hit_patch(arguments, k);
    const HalfSpace& plane = implementation->patches.plane(patch);
    RTCRayN* ray = arguments->ray;
    const Vec3 start(RTCRayN_org_x(ray, n, k), RTCRayN_org_y(ray, n, k), RTCRayN_org_z(ray, n, k));
    const Vec3 along(RTCRayN_dir_x(ray, n, k), RTCRayN_dir_y(ray, n, k), RTCRayN_dir_z(ray, n, k));
    const double distance = (plane.offset - plane.normal.dot(start)) / plane.normal.dot(along);
    const bool is_between = distance > static_cast<double>(RTCRayN_tnear(ray, n, k)) &&
                            distance < static_cast<double>(context->end[RTCRayN_id(ray, n, k)]);
    if (!is_between || implementation->patches.ignores(patch, context->source, context->target)) {
      arguments->valid[k] = 0;
    }
  }
}

/// Passes over patches that turn their back on the ray and have no other side. Single rays only.
void reject_backs(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const FilterContext*>(arguments->context);
  const Vec3 direction(RTCRayN_dir_x(arguments->ray, arguments->N, 0),
                       RTCRayN_dir_y(arguments->ray, arguments->N, 0),
                       RTCRayN_dir_z(arguments->ray, arguments->N, 0));
  if (context->visibility->patches.is_back(hit_patch(arguments, 0), direction))
    arguments->valid[0] = 0;
}

void reject_own_ends_and_backs(const RTCFilterFunctionNArguments* arguments) {
  reject_own_ends(arguments);
  if (arguments->valid[0] != 0) reject_backs(arguments);
}

FilterContext make_context(const Visibility::Implementation& implementation, std::int32_t source,
                           std::int32_t target) {
  FilterContext context{};
  init_context(context.embree);
  context.visibility = &implementation;
  context.source = source;
  context.target = target;
  return context;
}

/// How the rays of a packet are cut short at both ends: so that they neither start nor end within
/// `lift` of the planes that their ends lie in. Nothing in these planes can then be in the way, and
/// Embree need not ask back for each hit.
struct Trim {
  float scale;
  float end_gap;
  float lift;
  Eigen::Vector3f source_normal;
  Eigen::Vector3f target_normal;
};

__attribute__((target_clones("arch=x86-64-v3", "default"))) void make_rays(
    const SegmentPacket& segments, const Trim& trim, RTCRay16& rays,
    std::array<int, Visibility::kPacket>& valid) {
  const float ax = trim.source_normal.x();
  const float ay = trim.source_normal.y();
  const float az = trim.source_normal.z();
  const float bx = trim.target_normal.x();
  const float by = trim.target_normal.y();
  const float bz = trim.target_normal.z();
  for (int k = 0; k < Visibility::kPacket; ++k) {
    const float x = (segments.to[0][k] - segments.from[0][k]) * trim.scale;
    const float y = (segments.to[1][k] - segments.from[1][k]) * trim.scale;
    const float z = (segments.to[2][k] - segments.from[2][k]) * trim.scale;
    const float length = std::sqrt(x * x + y * y + z * z);
    const float start = trim.lift * length / std::abs(ax * x + ay * y + az * z);
    const float end = trim.lift * length / std::abs(bx * x + by * y + bz * z);
    const float near = start > trim.end_gap ? start : trim.end_gap;
    const float far = length - (end > trim.end_gap ? end : trim.end_gap);
    rays.org_x[k] = segments.from[0][k] * trim.scale;
    rays.org_y[k] = segments.from[1][k] * trim.scale;
    rays.org_z[k] = segments.from[2][k] * trim.scale;
    rays.dir_x[k] = x / length;
    rays.dir_y[k] = y / length;
    rays.dir_z[k] = z / length;
    rays.tnear[k] = near;
    rays.tfar[k] = far;
    rays.time[k] = 0;
    rays.mask[k] = ~0U;  // Debian's Embree tests masks: an unset one misses everything
    rays.id[k] = static_cast<unsigned>(k);
    rays.flags[k] = 0;
    valid[k] = near < far ? -1 : 0;
  }
}

}  // namespace

Visibility::Implementation::Implementation(const PatchMesh& mesh)
    : patches(mesh), triangles(patches.triangles(mesh)), is_large(mesh.size() > kLarge) {
  rtcSetSceneFlags(scene.handle, RTC_SCENE_FLAG_ROBUST | kQueryFilter);
  rtcSetSceneBuildQuality(scene.handle, RTC_BUILD_QUALITY_HIGH);
  if (!triangles[0].patch.empty()) attach(triangles[0], nullptr);
  if (!triangles[1].patch.empty()) attach(triangles[1], reject_misplaced);
  rtcCommitScene(scene.handle);
}

Visibility::Visibility(const PatchMesh& mesh)
    : implementation_(std::make_unique<Implementation>(WholeMesh(mesh).mesh())) {}
Visibility::~Visibility() = default;
Visibility::Visibility(Visibility&&) noexcept = default;
Visibility& Visibility::operator=(Visibility&&) noexcept = default;

const Vec3& Visibility::center() const { return implementation_->patches.center(); }

std::uint32_t Visibility::blocked(const SegmentPacket& segments, std::int32_t source,
                                  std::int32_t target) const {
  const auto normal_of = [this](std::int32_t patch) {
    return Eigen::Vector3f(implementation_->patches.plane(patch).normal.cast<float>());
  };
  const Trim trim{static_cast<float>(implementation_->patches.scale()),
                  static_cast<float>(implementation_->patches.end_gap()),
                  static_cast<float>(implementation_->patches.coplanar() + kEndRounding),
                  normal_of(source), normal_of(target)};
  alignas(64) std::array<int, kPacket> valid;
  RTCRay16 rays;
  make_rays(segments, trim, rays, valid);
  FilterContext context = make_context(*implementation_, source, target);
  SegmentPacket::Lanes end;
  if (!implementation_->triangles[1].patch.empty()) {
    std::copy(std::begin(rays.tfar), std::end(rays.tfar), end.begin());
    context.end = end.data();
  }
  occluded16(valid.data(), implementation_->scene.handle, context.embree, implementation_->is_large,
             rays);
  std::uint32_t result = 0;
  for (int k = 0; k < kPacket; ++k) {
    const bool is_blocked = valid[k] != 0 && rays.tfar[k] < 0;  // Embree marks them with -inf
    result |= static_cast<std::uint32_t>(is_blocked) << static_cast<unsigned>(k);
  }
  return result;
}

std::uint32_t Visibility::blocked(std::span<const Vec3> from, std::span<const Vec3> to,
                                  std::int32_t source, std::int32_t target) const {
  assert(from.size() == to.size() && from.size() <= kPacket);
  if (from.empty()) return 0;
  SegmentPacket segments;
  for (std::size_t k = 0; k < kPacket; ++k) {
    const std::size_t given = std::min(k, from.size() - 1);
    const Vec3 start = from[given] - implementation_->patches.center();
    const Vec3 end = to[given] - implementation_->patches.center();
    for (int axis = 0; axis < 3; ++axis) {
      segments.from[axis][k] = static_cast<float>(start[axis]);
      segments.to[axis][k] = static_cast<float>(end[axis]);
    }
  }
  return blocked(segments, source, target) & ((1U << from.size()) - 1);
}

std::optional<Hit> Visibility::Implementation::first_hit(const Vec3& origin, const Vec3& direction,
                                                         std::int32_t source,
                                                         RTCFilterFunctionN filter, double from,
                                                         double to) const {
  const Vec3 start = patches.scaled(origin);
  const Vec3 unit = direction.normalized();
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(start.x());
  ray.ray.org_y = static_cast<float>(start.y());
  ray.ray.org_z = static_cast<float>(start.z());
  ray.ray.dir_x = static_cast<float>(unit.x());
  ray.ray.dir_y = static_cast<float>(unit.y());
  ray.ray.dir_z = static_cast<float>(unit.z());
  ray.ray.tnear = static_cast<float>(from);
  ray.ray.tfar = static_cast<float>(to);
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  FilterContext context = make_context(*this, source, -1);
  intersect1(scene.handle, context.embree, filter, ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  Hit hit;
  hit.patch = patch_of(ray.hit.geomID, ray.hit.primID);
  hit.distance = static_cast<double>(ray.ray.tfar) / patches.scale();
  hit.front = unit.dot(patches.plane(hit.patch).normal) < 0;
  if (const std::int32_t back = patches.twin(hit.patch); !hit.front && back >= 0) {
    hit.patch = back;
    hit.front = true;
  }
  return hit;
}

double Visibility::end_gap() const {
  return implementation_->patches.end_gap() / implementation_->patches.scale();
}

std::optional<Hit> Visibility::first_hit(const Vec3& origin, const Vec3& direction,
                                         std::int32_t source) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const Implementation& all = *implementation_;
  const double start = source >= 0 ? all.patches.end_gap() : 0;
  const auto hit = all.first_hit(origin, direction, source, reject_own_ends, start, kFar);
  if (!hit || hit->front) return hit;
  // Of walls back to back, which are one to the digits, the ray meets the one that faces it.
  const double cosine = direction.normalized().dot(all.patches.plane(hit->patch).normal);
  const double gap =
      2 * (all.patches.coplanar() + kEndRounding) / std::max(cosine, all.patches.end_gap());
  const double distance = hit->distance * all.patches.scale();
  const auto facing = all.first_hit(origin, direction, source, reject_own_ends_and_backs,
                                    std::max(start, distance - gap), distance + gap);
  return facing && all.patches.is_in_plane_of(facing->patch, hit->patch) ? facing : hit;
}

std::optional<Hit> Visibility::first_front_hit(const Vec3& origin, const Vec3& direction) const {
  return implementation_->first_hit(origin, direction, -1, reject_backs, 0,
                                    std::numeric_limits<double>::infinity());
}

}  // namespace radiosity
