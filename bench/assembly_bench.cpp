/// The assembly of exchange areas and the product with them on the Cornell box, each beside what
/// the machine could do at best: Embree's raw rate on the very same rays, and the read bandwidth.

#include <benchmark/benchmark.h>

#include <array>
#include <map>
#include <numeric>
#include <vector>

#include "io/scene/scene_file.h"
#include "radiosity/exchange/pair_kernel.h"
#include "radiosity/exchange/visible_fraction.h"
#include "radiosity/radiosity.h"
#include "radiosity/visibility/embree.h"
#include "study/study.h"

namespace {

using namespace radiosity;
using study::Study;

const Study& cornell_box(long n_patches) {
  static std::map<long, Study> boxes;
  if (!boxes.contains(n_patches)) {
    boxes.emplace(n_patches, study::assemble(io::read_scene(RADIOSITY_SCENES "/cornell-box.json"),
                                             {.patches = {.n_patches = n_patches}}));
  }
  return boxes.at(n_patches);
}

void assembly(benchmark::State& state) {
  const Study& box = cornell_box(state.range(0));
  const auto n = static_cast<double>(box.mesh.size());
  std::int64_t rays = 0;
  for (auto _ : state) {
    const auto transport = make_transport(box.mesh, box.visibility);
    rays += transport->report().rays;
    benchmark::DoNotOptimize(transport.get());
  }
  const auto runs = static_cast<double>(state.iterations());
  state.counters["pairs/s"] =
      benchmark::Counter(runs * n * (n - 1) / 2, benchmark::Counter::kIsRate);
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
  state.counters["bytes/2N²"] = static_cast<double>(box.transport->bytes()) / (2 * n * n);
}
BENCHMARK(assembly)->Arg(1000)->Arg(4000)->Unit(benchmark::kMillisecond)->UseRealTime();

struct Packet {
  SegmentPacket segments;
  std::int32_t i;
  std::int32_t j;
};

/// The packets that the first undecided pairs of the box's rows are sampled with.
const std::vector<Packet>& undecided_packets(const Study& box) {
  static std::map<const Study*, std::vector<Packet>> all;
  std::vector<Packet>& packets = all[&box];
  const PreparedMesh prepared(box.mesh);
  const PairKernel kernel(prepared, 1e-9);
  for (Index i = 0; packets.size() < 20000 && i < box.mesh.size(); i += 7) {
    const Eigen::VectorXd error = rows_of(*box.transport).row_error(i);
    for (Index j = i + 1; j < box.mesh.size(); ++j) {
      if (error[j] == 0 || kernel.in_front(i, j) != Blocking::all ||
          kernel.in_front(j, i) != Blocking::all) {
        continue;
      }
      const auto a = static_cast<std::int32_t>(i);
      const auto b = static_cast<std::int32_t>(j);
      const SampledPair pair{
          prepared.polygons[i], prepared.planes[i], prepared.polygons[j], prepared.planes[j], a, b};
      SegmentSampler sampler(pair, pair_seed(0, a, b));
      for (int k = 0; k < 2; ++k) packets.push_back({sampler.next().segments, a, b});
    }
  }
  return packets;
}

void ray_stage(benchmark::State& state) {
  const Study& box = cornell_box(state.range(0));
  const std::vector<Packet>& packets = undecided_packets(box);
  for (auto _ : state) {
    std::uint32_t sum = 0;
    for (const Packet& packet : packets) {
      sum += box.visibility.blocked(packet.segments, packet.i, packet.j);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.counters["rays/s"] = benchmark::Counter(
      static_cast<double>(state.iterations() * packets.size() * Visibility::kPacket),
      benchmark::Counter::kIsRate);
}
BENCHMARK(ray_stage)->Arg(1000)->Arg(4000)->Unit(benchmark::kMillisecond);

/// The same triangles in a plain Embree scene.
RTCScene make_embree_scene(RTCDevice device, const PatchMesh& mesh) {
  std::vector<std::array<unsigned, 3>> triangles;
  for (const auto& corner : mesh.corners) {
    for (int k = 2; k < (corner[3] < 0 ? 3 : 4); ++k) {
      triangles.push_back({static_cast<unsigned>(corner[0]), static_cast<unsigned>(corner[k - 1]),
                           static_cast<unsigned>(corner[k])});
    }
  }
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.vertices.size()));
  for (const Vec3& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(vertex[axis]);
  }
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                          triangles.size());
  std::copy(triangles.begin(), triangles.end(), static_cast<std::array<unsigned, 3>*>(indices));
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

RTCRay16 make_rays(const SegmentPacket& segments, const Eigen::Vector3f& center) {
  RTCRay16 rays{};
  for (int k = 0; k < Visibility::kPacket; ++k) {
    rays.org_x[k] = segments.from[0][k] + center.x();
    rays.org_y[k] = segments.from[1][k] + center.y();
    rays.org_z[k] = segments.from[2][k] + center.z();
    rays.dir_x[k] = segments.to[0][k] - segments.from[0][k];
    rays.dir_y[k] = segments.to[1][k] - segments.from[1][k];
    rays.dir_z[k] = segments.to[2][k] - segments.from[2][k];
    rays.tnear[k] = 1e-5F;
    rays.tfar[k] = 1 - 1e-5F;
    rays.mask[k] = ~0U;
  }
  return rays;
}

void embree_alone(benchmark::State& state) {
  const Study& box = cornell_box(state.range(0));
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = make_embree_scene(device, box.mesh);
  std::vector<RTCRay16> prepared;
  for (const Packet& packet : undecided_packets(box))
    prepared.push_back(make_rays(packet.segments, box.visibility.center().cast<float>()));
  alignas(64) std::array<int, Visibility::kPacket> valid;
  valid.fill(-1);
  std::vector<RTCRay16> rays;
  for (auto _ : state) {
    state.PauseTiming();
    rays = prepared;
    state.ResumeTiming();
    radiosity::EmbreeContext context;
    radiosity::init_context(context);
    for (RTCRay16& packet : rays) {
      radiosity::occluded16(valid.data(), scene, context, false, packet);
    }
    benchmark::ClobberMemory();
  }
  state.counters["rays/s"] = benchmark::Counter(
      static_cast<double>(state.iterations() * prepared.size() * Visibility::kPacket),
      benchmark::Counter::kIsRate);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
BENCHMARK(embree_alone)->Arg(1000)->Arg(4000)->Unit(benchmark::kMillisecond);

void product(benchmark::State& state) {
  const Study& box = cornell_box(state.range(0));
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(box.mesh.size(), state.range(1));
  for (auto _ : state) {
    const Eigen::MatrixXd y = box.transport->apply(x);
    benchmark::DoNotOptimize(y.data());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * box.transport->bytes()));
}
BENCHMARK(product)
    ->Args({4000, 1})
    ->Args({4000, 3})
    ->Args({4000, 16})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void read_bandwidth(benchmark::State& state) {
  const Study& box = cornell_box(state.range(0));
  const std::vector<float> data(box.transport->bytes() / sizeof(float), 1.0F);
  constexpr std::ptrdiff_t kParts = 64;
  for (auto _ : state) {
    std::array<float, kParts> sums{};
    parallel_for(kParts, [&](std::ptrdiff_t part) {
      const auto size = static_cast<std::ptrdiff_t>(data.size());
      const Eigen::Map<const Eigen::VectorXf> slice(
          data.data() + size * part / kParts, size * (part + 1) / kParts - size * part / kParts);
      sums[part] = slice.sum();
    });
    benchmark::DoNotOptimize(sums);
  }
  state.SetBytesProcessed(
      static_cast<std::int64_t>(state.iterations() * data.size() * sizeof(float)));
}
BENCHMARK(read_bandwidth)->Arg(4000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
