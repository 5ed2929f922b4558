// Polygons of the implicit surface on the hybrid paper's noise terrain, with normals and walls, beside VTK's
// FlyingEdges on the same field. vs_vtk is the ratio of the fastest times in the same run.
#include <benchmark/benchmark.h>
#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <chrono>

#include "representations/implicit/implicit_surface.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace {

using namespace terrabench;

std::unique_ptr<ImplicitSurface> surface(int size) {
  Progress progress;
  const TerrainSource source = noise::cave_source({.extent = static_cast<float>(size)});
  return std::make_unique<ImplicitSurface>(
      LayeredStack::build_stack(source, {column_parameters(), {{"resolution", std::int64_t{size}}}},
                                progress),
      Kernel::kCube, 2, 0, Extractor::kMarchingCubes);
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
  static const SampleArray array(*surface(256));
  return array;
}

// Seconds of the fastest call: the least disturbed one on a busy machine.
template <class Work>
double fastest(benchmark::State& state, const Work& work) {
  double best = 1e30;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

double g_flying_edges = 0;

void flying_edges(benchmark::State& state) {
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
  vtkIdType triangles = 0;
  g_flying_edges = fastest(state, [&] {
    vtkNew<vtkFlyingEdges3D> filter;
    filter->SetInputData(image);
    filter->SetValue(0, 0.0);
    filter->ComputeNormalsOn();
    filter->ComputeScalarsOff();
    filter->Update();
    triangles = filter->GetOutput()->GetPolys()->GetNumberOfCells();
  });
  state.counters["triangles"] = static_cast<double>(triangles);
}

void our_polygons(benchmark::State& state, Extractor extractor) {
  const SampleArray& array = sampled();
  std::size_t triangles = 0;
  const double best =
      fastest(state, [&] { triangles = closed_surface(array, array.lattice(), extractor).triangles(); });
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["vs_vtk"] = g_flying_edges / best;
}

// From the stacks: with the field's samples, as mesh() makes it.
void from_stacks(benchmark::State& state) {
  const auto implicit = surface(static_cast<int>(state.range(0)));
  std::size_t triangles = 0;
  for (auto _ : state) triangles = implicit->mesh({}).triangles();
  state.counters["triangles"] = static_cast<double>(triangles);
}

// VTK comes first: the ratios need it.
#define IMPLICIT_TIMES MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond)
BENCHMARK(flying_edges)->IMPLICIT_TIMES;
BENCHMARK_CAPTURE(our_polygons, marching_cubes, Extractor::kMarchingCubes)->IMPLICIT_TIMES;
BENCHMARK_CAPTURE(our_polygons, surface_nets, Extractor::kSurfaceNets)->IMPLICIT_TIMES;
BENCHMARK(from_stacks)->ArgName("n")->Arg(256)->Arg(512)->IMPLICIT_TIMES;

}  // namespace
