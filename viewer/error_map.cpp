#include "viewer/error_map.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

namespace terrabench::viewer {

Rgb error_colour(double share) {
  constexpr Rgb kStops[] = {{255, 255, 255}, {255, 237, 160}, {254, 178, 76}, {240, 59, 32}, {60, 0, 20}};
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(std::size(kStops) - 1);
  const auto below = std::min(static_cast<std::size_t>(at), std::size(kStops) - 2);
  const double part = at - static_cast<double>(below);
  Rgb colour{};
  for (std::size_t c = 0; c < colour.size(); ++c) {
    colour[c] =
        static_cast<std::uint8_t>(std::lround((1 - part) * kStops[below][c] + part * kStops[below + 1][c]));
  }
  return colour;
}

ErrorMap map_errors(const SurfaceRaster& drawn, const Heightfield& ground, const View& view, double full) {
  const SeenSamples seen(ground, view);
  ErrorMap map{Image(ground.width, ground.depth, kNotSeen), screen_error(drawn, ground, seen).visible};
  const std::vector<float> errors = visible_errors(drawn, ground, seen);
  for (int j = 0; j < ground.depth; ++j) {
    for (int i = 0; i < ground.width; ++i) {
      const float error = errors[static_cast<std::size_t>(j) * static_cast<std::size_t>(ground.width) +
                                 static_cast<std::size_t>(i)];
      if (!std::isnan(error)) map.colours.set(i, j, error_colour(static_cast<double>(error) / full));
    }
  }
  return map;
}

void ErrorMapper::start(const Frame& frame, const Heightfield& ground, const View& view, double full) {
  if (busy()) return;
  auto drawn = std::make_shared<SurfaceRaster>(frame, ground.width, ground.depth);
  future_ = std::async(std::launch::async,
                       [drawn, &ground, view, full] { return map_errors(*drawn, ground, view, full); });
}

std::optional<ErrorMap> ErrorMapper::take() {
  if (!busy() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return future_.get();
}

void ErrorMapper::wait() {
  if (busy()) future_.wait();
  future_ = {};
}

}  // namespace terrabench::viewer
