#include "renderers/raytrace/ray_index.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <mutex>
#include <utility>
#include <vector>

#include "terrain/error.h"

namespace terrabench {
namespace {

RTCDevice new_device() {
  RTCDevice device = rtcNewDevice(nullptr);
  if (device != nullptr) return device;
  throw environment_error(
      fmt::format("no ray tracing device (Embree error {})", static_cast<int>(rtcGetDeviceError(nullptr))),
      "Embree",
      "this needs a processor with SSE2 and Debian's libembree3-3; otherwise use --renderer osmesa");
}

// The device of all indices that share one, from the first to the last of them.
struct SharedDevice {
  RTCDevice device = new_device();
  SharedDevice() = default;
  ~SharedDevice() { rtcReleaseDevice(device); }
  SharedDevice(const SharedDevice&) = delete;
  SharedDevice& operator=(const SharedDevice&) = delete;

  static std::shared_ptr<SharedDevice> get(RTCMemoryMonitorFunction monitor) {
    static std::mutex mutex;
    static std::weak_ptr<SharedDevice> last;
    const std::lock_guard lock(mutex);
    std::shared_ptr<SharedDevice> device = last.lock();
    if (device == nullptr) {
      last = device = std::make_shared<SharedDevice>();
      rtcSetDeviceMemoryMonitorFunction(device->device, monitor, nullptr);
    }
    return device;
  }
};

}  // namespace

// Owns what Embree holds. Geometries attached to the top scene have their placement's number as their id.
struct RayIndex::Embree {
  std::shared_ptr<SharedDevice> shared;  // null: the device is its own
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> prototypes;     // per mesh; null if no placement moves it
  std::vector<RTCGeometry> geometries;  // per mesh; null if it has no triangles
  std::atomic<std::int64_t> bytes{0};

  // Without a shared device, it has its own.
  explicit Embree(std::size_t meshes, std::shared_ptr<SharedDevice> = nullptr);
  ~Embree();
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void check() const;  // throws what Embree's last call on this thread reported
  RTCScene new_scene() const;
  void index(std::size_t mesh, const TriangleMesh&, bool moved);
  void place(std::uint32_t id, const MeshPlacement&);
  void commit(RTCScene) const;

  // Embree calls it before it allocates and after it frees; false makes the build fail.
  static bool count(void* self, ssize_t bytes, bool /*post*/) {
    auto& embree = *static_cast<Embree*>(self);
    embree.bytes.fetch_add(bytes, std::memory_order_relaxed);
    return true;
  }
  // The index that this thread builds on the shared device, whose monitor does not know the index.
  static thread_local Embree* building;
  static bool count_shared(void* /*self*/, ssize_t bytes, bool post) {
    return building == nullptr || count(building, bytes, post);
  }
  static bool keep_building(void* /*self*/, double /*done*/) { return !Progress::interrupted(); }
};

thread_local RayIndex::Embree* RayIndex::Embree::building = nullptr;

RayIndex::Embree::Embree(std::size_t meshes, std::shared_ptr<SharedDevice> with)
    : shared(std::move(with)),
      device(shared == nullptr ? new_device() : shared->device),
      prototypes(meshes),
      geometries(meshes) {
  if (shared == nullptr) rtcSetDeviceMemoryMonitorFunction(device, count, this);
}

RayIndex::Embree::~Embree() {
  if (top != nullptr) rtcReleaseScene(top);
  for (RTCScene scene : prototypes) {
    if (scene != nullptr) rtcReleaseScene(scene);
  }
  for (RTCGeometry geometry : geometries) {
    if (geometry != nullptr) rtcReleaseGeometry(geometry);
  }
  if (shared == nullptr) rtcReleaseDevice(device);
}

void RayIndex::Embree::check() const {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_CANCELLED || Progress::interrupted()) {
    throw Error(ExitCode::kInterrupted, "interrupted", "ray tracing", "");
  }
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw environment_error("not enough memory to index the triangles", "ray tracing",
                            "use fewer triangles, or instances instead of copies");
  }
  throw environment_error(fmt::format("Embree error {}", static_cast<int>(error)), "ray tracing",
                          "check Debian's libembree3-3, or use --renderer osmesa");
}

RTCScene RayIndex::Embree::new_scene() const {
  RTCScene scene = rtcNewScene(device);
  if (scene == nullptr) check();
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // no ray slips through a shared edge
  return scene;
}

void RayIndex::Embree::index(std::size_t mesh, const TriangleMesh& of, bool moved) {
  if (of.triangles() == 0) return;
  RTCGeometry geometry = geometries[mesh] = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (geometry == nullptr) check();
  // Embree reads 16 bytes at a position, past the end of the last of a shared array; hence a copy.
  void* const positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  sizeof(glm::vec3), of.positions.size());
  if (positions == nullptr) check();
  std::memcpy(positions, of.positions.data(), of.positions.size() * sizeof(glm::vec3));
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, of.indices.data(), 0,
                             3 * sizeof(std::uint32_t), of.triangles());
  rtcCommitGeometry(geometry);
  check();
  if (!moved) return;
  prototypes[mesh] = new_scene();
  rtcAttachGeometry(prototypes[mesh], geometry);
  commit(prototypes[mesh]);
}

void RayIndex::Embree::place(std::uint32_t id, const MeshPlacement& placement) {
  RTCGeometry triangles = geometries[placement.mesh];
  if (triangles == nullptr) return;
  if (placement.to_world == glm::mat4(1)) {
    rtcAttachGeometryByID(top, triangles, id);
    return;
  }
  RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  if (instance == nullptr) check();
  rtcSetGeometryInstancedScene(instance, prototypes[placement.mesh]);
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &placement.to_world);
  rtcCommitGeometry(instance);
  rtcAttachGeometryByID(top, instance, id);
  rtcReleaseGeometry(instance);  // the top scene holds it
}

// One thread builds: the order of triangles within a leaf, which decides between hits at equal distances,
// must not depend on the number of threads. Several meshes are built at once. rtcJoinCommitScene() would
// build in the device's own arena, with all threads.
void RayIndex::Embree::commit(RTCScene scene) const {
  rtcSetSceneProgressMonitorFunction(scene, keep_building, nullptr);
  tbb::task_arena alone(1);
  alone.execute([&] { rtcCommitScene(scene); });
  check();
}

namespace {

// Far enough from float's limits that Embree's products of coordinates stay finite.
constexpr float kFarthest = 1e18F;

bool usable(const glm::vec3& v) {
  return std::abs(v.x) < kFarthest && std::abs(v.y) < kFarthest && std::abs(v.z) < kFarthest;
}

// NaN compares false throughout.
bool usable(const Ray& ray) {
  return usable(ray.origin) && usable(ray.direction) && ray.direction != glm::vec3(0) && ray.near >= 0 &&
         ray.far >= ray.near;
}

void check_placement(const MeshPlacement& placement, std::size_t id, std::size_t meshes) {
  const glm::mat4& m = placement.to_world;
  bool finite = true;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) finite = finite && std::isfinite(m[c][r]);
  }
  const bool affine = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
  const float determinant = finite ? glm::determinant(glm::mat3(m)) : 0;
  const bool invertible = std::isfinite(determinant) && std::isfinite(1 / determinant);
  const std::string where = fmt::format("instance {}", id);
  if (placement.mesh >= meshes) {
    throw bad_input(fmt::format("mesh {} of {} does not exist", placement.mesh, meshes), where,
                    "name one of the meshes");
  }
  if (finite && affine && invertible) return;
  const char* const property = !finite ? "finite" : affine ? "invertible" : "affine";
  throw bad_input(fmt::format("the transform is not {}", property), where,
                  "use translations, rotations and scales other than zero");
}

// Nearest point of a triangle by the regions around it (Ericson 2005, Real-Time Collision Detection, §5.1.5).
float squared_distance(glm::vec3 p, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  const auto squared = [](glm::vec3 v) { return glm::dot(v, v); };
  const auto to_edge = [&](glm::vec3 from, glm::vec3 to) {
    const float length = squared(to - from);
    const float t = length > 0 ? std::clamp(glm::dot(p - from, to - from) / length, 0.0F, 1.0F) : 0;
    return squared(p - from - t * (to - from));
  };
  const glm::vec3 normal = glm::cross(b - a, c - a);
  const float area = squared(normal);
  if (area > 0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0 &&
      glm::dot(glm::cross(c - b, p - b), normal) >= 0 && glm::dot(glm::cross(a - c, p - c), normal) >= 0) {
    const float height = glm::dot(p - a, normal);
    return height * height / area;
  }
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

RTCRay to_embree(const Ray& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          ray.near,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0,
          ray.far,
          0xFFFFFFFF,
          0,
          0};
}

}  // namespace

RayIndex::RayIndex(std::span<const TriangleMesh* const> meshes, std::span<const MeshPlacement> placements,
                   Progress* progress) {
  std::vector<std::uint8_t> moved(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) check_mesh(*meshes[m], fmt::format("mesh {}", m));
  for (std::size_t p = 0; p < placements.size(); ++p) {
    check_placement(placements[p], p, meshes.size());
    if (placements[p].to_world != glm::mat4(1)) moved[placements[p].mesh] = 1;
  }
  if (progress != nullptr) progress->begin("index triangles", meshes.size() + 1);
  embree_ = std::make_unique<Embree>(meshes.size());
  tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t m) {
    embree_->index(m, *meshes[m], moved[m] != 0);
    if (progress != nullptr) progress->advance();
  });
  embree_->top = embree_->new_scene();
  for (std::size_t p = 0; p < placements.size(); ++p) {
    embree_->place(static_cast<std::uint32_t>(p), placements[p]);
  }
  embree_->commit(embree_->top);
  if (progress != nullptr) {
    progress->advance();
    progress->end();
  }
}

RayIndex::RayIndex(const TriangleMesh& mesh, Progress* progress)
    : RayIndex(std::array{&mesh}, std::array{MeshPlacement{}}, progress) {}

RayIndex RayIndex::on_shared_device(const TriangleMesh& mesh) {
  check_mesh(mesh, "mesh 0");
  RayIndex result;
  result.embree_ = std::make_unique<Embree>(1, SharedDevice::get(Embree::count_shared));
  Embree& embree = *result.embree_;
  Embree::building = &embree;
  const std::shared_ptr<void> done(nullptr, [](void*) { Embree::building = nullptr; });
  embree.index(0, mesh, false);
  embree.top = embree.new_scene();
  embree.place(0, {});
  embree.commit(embree.top);
  return result;
}

RayIndex::RayIndex() = default;
RayIndex::~RayIndex() = default;
RayIndex::RayIndex(RayIndex&&) noexcept = default;
RayIndex& RayIndex::operator=(RayIndex&&) noexcept = default;

RayHit RayIndex::closest(const Ray& ray) const {
  if (!usable(ray)) return {};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = to_embree(ray);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->top, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const bool moved = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  return {query.ray.tfar, query.hit.u, query.hit.v, moved ? query.hit.instID[0] : query.hit.geomID,
          query.hit.primID};
}

bool RayIndex::occluded(const Ray& ray) const {
  if (!usable(ray)) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = to_embree(ray);
  rtcOccluded1(embree_->top, &context, &query);
  return query.tfar < 0;  // Embree's mark of a hit
}

void RayIndex::closest(std::span<const Ray> rays, std::span<RayHit> hits) const {
  constexpr std::size_t kGrain = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) hits[i] = closest(rays[i]);
  });
}

float RayIndex::distance(const glm::vec3& point, const TriangleMesh& mesh) const {
  struct Nearest {
    glm::vec3 point;
    const TriangleMesh& mesh;
    float rounding;
    float squared = std::numeric_limits<float>::infinity();
  } nearest{point, mesh, 1e-5F * glm::length(point)};
  const auto visit = [](RTCPointQueryFunctionArguments* at) {
    auto& nearest = *static_cast<Nearest*>(at->userPtr);
    const std::uint32_t* const k = &nearest.mesh.indices[3 * std::size_t{at->primID}];
    const std::vector<glm::vec3>& p = nearest.mesh.positions;
    const float squared = squared_distance(nearest.point, p[k[0]], p[k[1]], p[k[2]]);
    if (squared >= nearest.squared) return false;
    nearest.squared = squared;
    at->query->radius = std::sqrt(squared) + nearest.rounding;  // which so leaves no nearer one out
    return true;
  };
  RTCPointQuery query{point.x, point.y, point.z, 0, nearest.squared};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(embree_->top, &query, &context, visit, &nearest);
  return std::sqrt(nearest.squared);
}

std::uint64_t RayIndex::bytes() const {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, embree_->bytes.load()));
}

std::string RayIndex::embree_version() { return RTC_VERSION_STRING; }

}  // namespace terrabench
