#include "renderers/raytrace/raytraced_picture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderers/ramp.h"
#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr int kPass = 8;  // samples of a tile before the next tile, and between checks for an interrupt

// Pixels from a place to the line through two projected points, which may lie behind the eye.
float distance_to_line(const glm::vec2& at, const glm::vec3& a, const glm::vec3& b) {
  // Relative to the place: the products of large coordinates would lose the distance of short edges.
  const glm::vec3 from{a.x - at.x * a.z, a.y - at.y * a.z, a.z}, to{b.x - at.x * b.z, b.y - at.y * b.z, b.z};
  const glm::vec3 line = glm::cross(from, to);
  return std::abs(line.z) / std::hypot(line.x, line.y);
}

const View& with_memory(const View& view) {
  const auto pixels = static_cast<std::uint64_t>(std::max(view.width, 0)) *
                      static_cast<std::uint64_t>(std::max(view.height, 0));
  require_memory(pixels * 20, "a ray-traced picture", "choose a smaller picture");
  return view;
}

}  // namespace

RaytracedPicture::RaytracedPicture(const RayScene& scene, const View& view, const RaytraceSettings& settings,
                                   Progress* progress)
    : camera_(view),
      settings_(settings),
      tracer_(scene, settings, progress),
      width_(view.width),
      height_(with_memory(view).height),
      tiles_across_((view.width + kTile - 1) / kTile),
      has_wires_(std::any_of(scene.meshes.begin(), scene.meshes.end(),
                             [](const RayMesh& mesh) { return mesh.wire_width > 0; })) {
  for (int y = 0; y < height_; y += kTile) {
    for (int x = 0; x < width_; x += kTile) {
      tiles_.push_back({x, y, std::min(x + kTile, width_), std::min(y + kTile, height_)});
    }
  }
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  sums_.resize(pixels);
  counted_.resize(pixels);
  objects_.resize(pixels);
}

void RaytracedPicture::accumulate(int samples, Progress* progress) {
  const int goal = samples > 0 ? samples : settings_.samples;
  const int least = this->samples();
  const int passes = std::max(0, (goal - least + kPass - 1) / kPass);
  if (progress != nullptr) progress->begin("trace rays", tiles_.size() * static_cast<std::uint64_t>(passes));
  for (int done = least; done < goal; done += kPass) {
    const int until = std::min(done + kPass, goal);
    tbb::parallel_for(
        std::size_t{0}, tiles_.size(),
        [&](std::size_t t) {
          trace(tiles_[t], until);
          if (progress != nullptr) progress->advance();
        },
        tbb::simple_partitioner());
  }
  if (progress != nullptr) progress->end();
}

void RaytracedPicture::trace(Tile& tile, int until) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      const std::size_t at = pixel(x, y);
      if (tile.samples == 0) {
        const RayHit hit =
            tracer_.closest(camera_.ray({static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F}));
        objects_[at] = hit.placement + 1;  // RayHit::kNone + 1 is 0
      }
      glm::vec3 sum = sums_[at], radiance;
      for (int k = tile.samples; k < until; ++k) {
        if (!sample(x, y, k, radiance)) continue;
        sum += radiance;
        ++counted_[at];
      }
      if (!std::isfinite(sum.x + sum.y + sum.z)) {
        throw bad_input("the radiance is not finite", fmt::format("pixel ({}, {})", x, y),
                        "check what the materials' functions return there");
      }
      sums_[at] = sum;
    }
  }
  tile.samples = std::max(tile.samples, until);
}

bool RaytracedPicture::sample(int x, int y, int number, glm::vec3& radiance) const {
  const auto cell = static_cast<std::uint32_t>(pixel(x, y));
  SampleSequence samples(cell, static_cast<std::uint32_t>(number), settings_.seed);
  const glm::vec2 at = glm::vec2(x, y) + samples.next();
  const Ray ray = camera_.ray(at);
  const RayHit hit = tracer_.closest(ray);
  const RayScene& scene = tracer_.scene();
  if (!hit.hit() && scene.background) return false;
  const float opacity = has_wires_ && hit.hit() ? wire_opacity(at, hit) : 0;
  radiance = opacity < 1 ? tracer_.radiance(ray, hit, samples) : glm::vec3(0);
  if (opacity > 0) {
    const glm::vec3 wire = scene.meshes[scene.instances[hit.placement].mesh].wire_color;
    radiance = glm::mix(radiance, wire, opacity);
  }
  return true;
}

// Of the wire at this place, or 0. A wire has half its width on each of the triangles at an edge.
float RaytracedPicture::wire_opacity(const glm::vec2& at, const RayHit& hit) const {
  const RayScene& scene = tracer_.scene();
  const MeshPlacement& placement = scene.instances[hit.placement];
  const RayMesh& mesh = scene.meshes[placement.mesh];
  if (mesh.wire_width <= 0) return 0;
  const std::uint32_t* const corners = &mesh.mesh->indices[3 * std::size_t{hit.triangle}];
  glm::vec3 projected[3];
  for (int k = 0; k < 3; ++k) {
    projected[k] =
        camera_.project(glm::vec3(placement.to_world * glm::vec4(mesh.mesh->positions[corners[k]], 1)));
  }
  const unsigned edges = mesh.wires.empty() ? 7U : mesh.wires[hit.triangle];
  for (unsigned k = 0; k < 3; ++k) {
    const bool is_wire = (edges >> k & 1U) != 0;
    if (is_wire && distance_to_line(at, projected[k], projected[(k + 1) % 3]) < 0.5F * mesh.wire_width) {
      return mesh.wire_opacity;
    }
  }
  return 0;
}

int RaytracedPicture::samples() const {
  return std::min_element(tiles_.begin(), tiles_.end(),
                          [](const Tile& a, const Tile& b) { return a.samples < b.samples; })
      ->samples;
}

const RaytracedPicture::Tile& RaytracedPicture::tile_at(int x, int y) const {
  return tiles_[static_cast<std::size_t>(y / kTile) * static_cast<std::size_t>(tiles_across_) +
                static_cast<std::size_t>(x / kTile)];
}

glm::vec3 RaytracedPicture::radiance(int x, int y) const {
  const std::size_t at = pixel(x, y);
  return sums_[at] / static_cast<float>(std::max(1U, counted_[at]));
}

Image RaytracedPicture::image() const {
  Image image(width_, height_, {0, 0, 0});
  const glm::vec3 background = tracer_.scene().background.value_or(glm::vec3(0));
  tbb::parallel_for(0, height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const auto samples = static_cast<float>(std::max(1, tile_at(x, y).samples));
      const float covered = static_cast<float>(counted_[pixel(x, y)]) / samples;
      image.set(x, y, srgb_bytes(glm::mix(background, tone_mapped(radiance(x, y)), covered)));
    }
  });
  return image;
}

Image raytrace(const RayScene& scene, const View& view, const RaytraceSettings& settings,
               Progress* progress) {
  RaytracedPicture picture(scene, view, settings, progress);
  picture.accumulate(settings.samples, progress);
  return picture.image();
}

}  // namespace terrabench
