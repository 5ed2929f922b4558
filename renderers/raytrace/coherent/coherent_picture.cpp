#include "renderers/raytrace/coherent/coherent_picture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderers/ramp.h"
#include "renderers/raytrace/ray_camera.h"
#include "renderers/raytrace/sample_sequence.h"
#include "renderers/raytrace/scattering.h"
#include "renderers/raytrace/sun.h"
#include "terrain/error.h"
#include "terrain/progress.h"

namespace terrabench {
namespace {

struct Path {
  glm::vec3 light{0}, weight{1};
  SampleSequence samples;
  bool ended = false;
};

class Tracer {
 public:
  Tracer(const PartScene& scene, const View& view, const CoherentSettings& settings)
      : scene_(scene),
        settings_(settings),
        camera_(view),
        queries_(scene),
        sky_(scene.light),
        sun_(scene.light) {}

  // Adds the light of all samples to the tile's pixels, and notes what their first samples see.
  void tile(glm::ivec2 from, glm::ivec2 to, CoherentPicture& picture);

 private:
  void begin(glm::ivec2 from, glm::ivec2 to, int width);
  void shade(std::size_t path, int bounce);
  void cast_shadows();
  void drop_ended();

  const PartScene& scene_;
  const CoherentSettings& settings_;
  RayCamera camera_;
  PartQueries queries_;
  Sky sky_;
  Sun sun_;

  std::vector<Path> paths_;  // of the tile
  std::vector<std::uint32_t> active_;
  std::vector<Ray> rays_, to_sun_;  // per active path
  std::vector<PartHit> hits_;
  std::vector<glm::vec3> sunlight_;  // what the path gets unless its ray to the sun is blocked
  std::vector<std::uint8_t> blocked_;
};

Ray ray_from(const PartHit& s, const glm::vec3& direction) {
  const float side = glm::dot(direction, s.facet) > 0 ? s.offset : -s.offset;
  return {.origin = s.point.position + side * s.facet, .direction = direction};
}

void Tracer::begin(glm::ivec2 from, glm::ivec2 to, int width) {
  paths_.clear();
  rays_.clear();
  active_.clear();
  for (int y = from.y; y < to.y; ++y) {
    for (int x = from.x; x < to.x; ++x) {
      for (int k = 0; k < settings_.samples; ++k) {
        const auto cell =
            static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width) + static_cast<std::uint32_t>(x);
        SampleSequence samples(cell, static_cast<std::uint32_t>(k), settings_.seed);
        rays_.push_back(camera_.ray(glm::vec2(x, y) + samples.next()));
        active_.push_back(static_cast<std::uint32_t>(paths_.size()));
        paths_.push_back({.samples = samples});
      }
    }
  }
}

// Light at the path's hit: sets its ray to the sun and its next ray, or ends it.
void Tracer::shade(std::size_t i, int bounce) {
  Path& path = paths_[active_[i]];
  Ray& ray = rays_[i];
  const PartHit& s = hits_[i];
  sunlight_[i] = glm::vec3(0);
  to_sun_[i] = {.far = -1};
  path.ended = true;
  if (!s.hit()) {
    const glm::vec3 sky = sky_.radiance(ray.direction);
    path.light += path.weight * (bounce == 0 ? sky + sun_.radiance(ray.direction) : sky);
    return;
  }
  if (bounce > settings_.bounces) return;
  RayMaterial made_of = scene_.material(s.point);
  if (bounce > 0) made_of.roughness = std::max(made_of.roughness, kIndirectRoughness);
  const Scattering scattering(made_of, s.facet, s.point.normal, -ray.direction);
  if (sun_.shines()) {
    const glm::vec3 direction = sun_.direction(path.samples.next());
    sunlight_[i] = path.weight * scene_.light.sun_irradiance * scattering.toward(direction);
    if (sunlight_[i] != glm::vec3(0)) to_sun_[i] = ray_from(s, direction);
  }
  glm::vec3 direction, part;
  const float lobe = scattering.has_lobes() ? path.samples.next().x : 0;
  if (!scattering.sample(lobe, path.samples.next(), direction, part)) return;
  path.weight *= part;
  path.ended = false;
  ray = ray_from(s, direction);
}

void Tracer::cast_shadows() {
  blocked_.resize(to_sun_.size());
  queries_.occluded(to_sun_, blocked_);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (blocked_[i] == 0) paths_[active_[i]].light += sunlight_[i];
  }
}

void Tracer::drop_ended() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (paths_[active_[i]].ended) continue;
    active_[kept] = active_[i];
    rays_[kept++] = rays_[i];
  }
  active_.resize(kept);
  rays_.resize(kept);
}

void Tracer::tile(glm::ivec2 from, glm::ivec2 to, CoherentPicture& picture) {
  begin(from, to, picture.width);
  const auto samples = static_cast<std::size_t>(settings_.samples);
  const auto pixel = [&](std::size_t path) {
    const auto n = static_cast<int>(path / samples), across = to.x - from.x;
    return static_cast<std::size_t>(from.y + n / across) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(from.x + n % across);
  };
  for (int bounce = 0; bounce <= settings_.bounces && !active_.empty(); ++bounce) {
    hits_.resize(active_.size());
    to_sun_.resize(active_.size());
    sunlight_.resize(active_.size());
    queries_.closest(rays_, hits_);
    for (std::size_t p = 0; bounce == 0 && p < paths_.size(); p += samples) {
      if (hits_[p].hit()) picture.objects[pixel(p)] = hits_[p].point.instance + 1;
    }
    tbb::parallel_for(std::size_t{0}, active_.size(), [&](std::size_t i) { shade(i, bounce); });
    cast_shadows();
    drop_ended();
  }
  // What is left finds the sky or nothing.
  blocked_.resize(rays_.size());
  queries_.occluded(rays_, blocked_);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    Path& path = paths_[active_[i]];
    if (blocked_[i] == 0) path.light += path.weight * sky_.radiance(rays_[i].direction);
  }
  for (std::size_t p = 0; p < paths_.size(); ++p) picture.radiance[pixel(p)] += paths_[p].light;
}

void check(const CoherentSettings& settings) {
  const auto within = [](int value, int least, int most, const char* what) {
    if (value >= least && value <= most) return;
    throw usage_error(fmt::format("invalid {} {}", what, value), "ray tracing",
                      fmt::format("it must be {} to {}", least, most));
  };
  within(settings.samples, 1, 65536, "number of samples");
  within(settings.bounces, 0, 64, "number of bounces");
  within(settings.tile, 1, 4096, "side of tiles");
}

}  // namespace

CoherentPicture trace_coherent(const PartScene& scene, const View& view, const CoherentSettings& settings,
                               Progress* progress) {
  check(settings);
  check_daylight(scene.light);
  Tracer tracer(scene, view, settings);
  const std::size_t pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
  require_memory(pixels * 16, "a ray-traced picture", "choose a smaller picture");
  CoherentPicture picture{view.width, view.height, std::vector<glm::vec3>(pixels),
                          std::vector<std::uint32_t>(pixels)};
  const int across = (view.width + settings.tile - 1) / settings.tile;
  const int down = (view.height + settings.tile - 1) / settings.tile;
  if (progress != nullptr) progress->begin("trace rays", static_cast<std::uint64_t>(across) * down);
  for (int j = 0; j < down; ++j) {
    for (int k = 0; k < across; ++k) {
      const int i = j % 2 == 0 ? k : across - 1 - k;  // back and forth, so that neighbours share parts
      const glm::ivec2 from{i * settings.tile, j * settings.tile};
      const glm::ivec2 to{std::min(from.x + settings.tile, view.width),
                          std::min(from.y + settings.tile, view.height)};
      tracer.tile(from, to, picture);
      if (progress != nullptr) progress->advance();
    }
  }
  if (progress != nullptr) progress->end();
  for (std::size_t p = 0; p < pixels; ++p) {
    glm::vec3& mean = picture.radiance[p];
    mean /= static_cast<float>(settings.samples);
    if (!std::isfinite(mean.x + mean.y + mean.z)) {
      throw bad_input("the radiance is not finite", fmt::format("pixel {}", p),
                      "check what the material function returns there");
    }
  }
  return picture;
}

Image CoherentPicture::image() const {
  Image image(width, height, {0, 0, 0});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.set(x, y, srgb_bytes(tone_mapped(radiance[static_cast<std::size_t>(y) * width + x])));
    }
  }
  return image;
}

}  // namespace terrabench
