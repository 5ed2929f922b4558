// The implicit surface on the hybrid paper's noise terrain: field and polygons, polygons alone beside VTK's
// FlyingEdges on the same field, edits, and peak memory.
#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>

#include <map>
#include <random>

#include "representations/implicit/implicit_surface.h"
#include "terrain/memory.h"
#include "terrain/sources/noise/cave_terrain.h"
#ifdef TERRABENCH_FLYING_EDGES
#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#endif

namespace {

using namespace terrabench;

constexpr int kSize = 256;

// Columns of the stacks are 1 m wide at every size.
std::unique_ptr<ImplicitSurface> make(int n, Kernel kernel, double radius, Extractor extractor) {
  static std::map<int, std::unique_ptr<LayeredStack>> stacks;
  std::unique_ptr<LayeredStack>& stack = stacks[n];
  Progress progress;
  if (!stack) {
    const TerrainSource source = noise::cave_source({.extent = static_cast<float>(n)});
    stack =
        LayeredStack::build_stack(source, {column_parameters(), {{"resolution", std::int64_t{n}}}}, progress);
  }
  ByteSink bytes;  // a copy
  stack->save(bytes);
  ByteSource in(bytes.bytes(), "copy");
  std::unique_ptr<LayeredStack> copy(static_cast<LayeredStack*>(LayeredStack::load(in).release()));
  return std::make_unique<ImplicitSurface>(std::move(copy), kernel, radius, 0, extractor);
}

double bytes_of(const TriangleMesh& mesh) {
  return static_cast<double>(mesh.positions.size() * sizeof(glm::vec3) +
                             mesh.normals.size() * sizeof(glm::vec3) +
                             mesh.indices.size() * sizeof(std::uint32_t));
}

void field_and_polygons(benchmark::State& state) {
  const auto kernel = static_cast<Kernel>(state.range(1));
  const auto extractor = static_cast<Extractor>(state.range(2));
  const auto surface =
      make(static_cast<int>(state.range(0)), kernel, static_cast<double>(state.range(3)), extractor);
  double peak = 0, mesh_bytes = 0, triangles = 0;
  for (auto _ : state) {
    const std::int64_t before = HeapCounter::live();
    HeapCounter::reset_peak();
    const TriangleMesh mesh = surface->mesh({});
    peak = static_cast<double>(HeapCounter::peak() - before);
    mesh_bytes = bytes_of(mesh);
    triangles = static_cast<double>(mesh.triangles());
  }
  state.counters["triangles"] = triangles;
  state.counters["peak/mesh"] = peak / mesh_bytes;
  state.SetLabel(std::string(kKernelNames[static_cast<std::size_t>(kernel)]) + ", " +
                 std::string(kExtractorNames[static_cast<std::size_t>(extractor)]));
}

// All samples of a lattice and one more on each side, as an array.
class SampleArray final : public SampledField {
 public:
  explicit SampleArray(const ImplicitSurface& surface)
      : lattice_(surface.lattice()), width_(lattice_.cells.x + 5), height_(lattice_.cells.y + 3) {
    std::vector<float> xs, ys;
    for (int i = -2; i < width_ - 2; ++i) xs.push_back(lattice_.position(0, i));
    for (int k = -1; k < height_ - 1; ++k) ys.push_back(lattice_.position(1, k));
    const auto planes = surface.field().planes(xs, ys);
    const std::size_t plane = xs.size() * ys.size();
    values_.resize(plane * static_cast<std::size_t>(lattice_.cells.z + 5));
    for (int j = -2; j <= lattice_.cells.z + 2; ++j) {
      planes->sample(lattice_.position(2, j),
                     std::span(values_).subspan(static_cast<std::size_t>(j + 2) * plane, plane));
    }
  }

  std::unique_ptr<FieldPlanes> planes(std::span<const float> xs, std::span<const float> ys) const override {
    struct Planes final : FieldPlanes {
      Planes(const SampleArray& of, int first, std::size_t columns, std::size_t heights)
          : array(of), i(first), width(columns), height(heights) {}
      void sample(double z, std::span<float> out) override {
        const auto j = static_cast<int>(std::lround((z - array.lattice_.low.z) / array.lattice_.cell));
        for (std::size_t c = 0; c < width; ++c) {
          std::copy_n(array.column(i + static_cast<int>(c), j), height, &out[c * height]);
        }
      }
      const SampleArray& array;
      int i;
      std::size_t width, height;
    };
    const auto first = static_cast<int>(std::lround((xs[0] - lattice_.low.x) / lattice_.cell));
    return std::make_unique<Planes>(*this, first, xs.size(), ys.size());
  }
  float at(glm::vec3) const override { return 0; }
  Heights heights(glm::dvec2, glm::dvec2) const override { return {-1e300, 1e300}; }

  const FieldLattice& lattice() const { return lattice_; }
  // From height -1.
  const float* column(int i, int j) const {
    return &values_[(static_cast<std::size_t>(j + 2) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(i + 2)) *
                    static_cast<std::size_t>(height_)];
  }

 private:
  FieldLattice lattice_;
  int width_, height_;
  std::vector<float> values_;
};

const SampleArray& sampled() {
  static const SampleArray array(*make(kSize, Kernel::kCube, 2, Extractor::kMarchingCubes));
  return array;
}

void polygons_of_a_given_field(benchmark::State& state) {
  const SampleArray& array = sampled();
  double triangles = 0;
  for (auto _ : state) {
    triangles = static_cast<double>(
        closed_surface(array, array.lattice(), static_cast<Extractor>(state.range(0))).triangles());
  }
  state.counters["triangles"] = triangles;
  state.SetLabel(std::string(kExtractorNames[static_cast<std::size_t>(state.range(0))]) +
                 ", with normals and walls");
}

#ifdef TERRABENCH_FLYING_EDGES
void flying_edges_of_a_given_field(benchmark::State& state) {
  const SampleArray& array = sampled();
  // With a layer of air around, so that the surface is closed as ours. x of VTK is our y, so that heights are
  // contiguous in both.
  const glm::ivec3 points = array.lattice().cells + 3;
  vtkNew<vtkImageData> image;
  image->SetDimensions(points.y, points.x, points.z);
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(image->GetScalarPointer());
  for (int j = 0; j < points.z; ++j) {
    for (int i = 0; i < points.x; ++i, values += points.y) {
      std::fill_n(values, points.y, -1.0F);
      if (i == 0 || j == 0 || i == points.x - 1 || j == points.z - 1) continue;
      std::copy_n(array.column(i - 1, j - 1) + 1, points.y - 2, values + 1);
    }
  }
  double triangles = 0;
  for (auto _ : state) {
    vtkNew<vtkFlyingEdges3D> filter;
    filter->SetInputData(image);
    filter->SetValue(0, 0.0);
    filter->ComputeNormalsOn();
    filter->ComputeScalarsOff();
    filter->Update();
    triangles = static_cast<double>(filter->GetOutput()->GetPolys()->GetNumberOfCells());
  }
  state.counters["triangles"] = triangles;
  state.SetLabel("VTK, with normals and walls");
}
#endif

// One edit of 16³ cells at 512³ and all chunks that it changes.
void edit_and_rebuild(benchmark::State& state) {
  const auto surface = make(512, Kernel::kCube, 2, static_cast<Extractor>(state.range(0)));
  const glm::ivec2 chunks = surface->chunks();
  std::vector<std::uint64_t> versions(static_cast<std::size_t>(chunks.x) *
                                      static_cast<std::size_t>(chunks.y));
  std::mt19937 random(1);
  double rebuilt = 0;
  std::vector<float> x(256), z(256);
  for (auto _ : state) {
    const auto low_x = static_cast<float>(random() % 496), low_z = static_cast<float>(random() % 496),
               low_y = static_cast<float>(128 + random() % 200);
    for (std::size_t c = 0; c < 256; ++c) {
      x[c] = low_x + static_cast<float>(c % 16) + 0.5F;
      z[c] = low_z + static_cast<float>(c / 16) + 0.5F;
    }
    const std::vector<Span> strokes(
        256, Span{low_y, low_y + 16, random() % 2 == 0 ? Material::kAir : Material::kBedrock});
    surface->edit({x, z}, strokes);
    std::vector<glm::ivec2> changed;
    for (int j = 0; j < chunks.y; ++j) {
      for (int i = 0; i < chunks.x; ++i) {
        std::uint64_t& version = versions[static_cast<std::size_t>(j * chunks.x + i)];
        if (surface->version({i, j}) > version) changed.emplace_back(i, j);
        version = surface->version({i, j});
      }
    }
    tbb::parallel_for(std::size_t{0}, changed.size(),
                      [&](std::size_t c) { benchmark::DoNotOptimize(surface->chunk(changed[c], 0)); });
    rebuilt += static_cast<double>(changed.size());
  }
  state.counters["chunks"] = rebuilt / static_cast<double>(state.iterations());
  state.SetLabel(std::string(kExtractorNames[static_cast<std::size_t>(state.range(0))]));
}

void one_chunk(benchmark::State& state) {
  const auto surface = make(512, Kernel::kCube, 2, Extractor::kMarchingCubes);
  std::size_t triangles = 0;
  for (auto _ : state) triangles = surface->chunk({7, 7}, static_cast<int>(state.range(0))).triangles();
  state.counters["triangles"] = static_cast<double>(triangles);
}

BENCHMARK(field_and_polygons)
    ->ArgNames({"n", "kernel", "extractor", "radius"})
    ->Args({256, 0, 0, 2})
    ->Args({256, 0, 1, 2})
    ->Args({256, 1, 0, 2})
    ->Args({256, 0, 0, 1})
    ->Args({256, 0, 0, 4})
    ->Args({256, 0, 0, 8})
    ->Args({256, 0, 0, 16})
    ->Args({512, 0, 0, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(polygons_of_a_given_field)
    ->Arg(0)
    ->Arg(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
#ifdef TERRABENCH_FLYING_EDGES
BENCHMARK(flying_edges_of_a_given_field)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
#endif
BENCHMARK(edit_and_rebuild)->Arg(0)->Arg(1)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(one_chunk)->ArgName("detail")->DenseRange(0, 3)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
