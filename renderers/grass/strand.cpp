#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "renderers/grass/grass.h"

namespace terrabench {
namespace {

float printed_random(glm::vec2 at) {
  return glm::fract(std::sin(glm::dot(at, {12.9898F, 78.233F})) * 43758.5453F);
}

std::uint32_t scrambled(std::uint32_t bits) {
  bits = (bits ^ bits >> 16) * 0x7feb352dU;
  bits = (bits ^ bits >> 15) * 0x846ca68bU;
  return bits ^ bits >> 16;
}

std::uint32_t scrambled(const glm::vec3& position) {
  const auto bits = [&](int axis) { return std::bit_cast<std::uint32_t>(position[axis]); };
  return scrambled(bits(0) + scrambled(bits(1) + scrambled(bits(2))));
}

float fraction(std::uint32_t bits) { return static_cast<float>(bits >> 8) / (1 << 24); }

glm::vec3 barycentric(glm::vec2 pair) {
  if (pair.x + pair.y > 1) {
    float& larger = pair.x > pair.y ? pair.x : pair.y;
    larger = 1 - larger;
  }
  return {pair, 1 - pair.x - pair.y};
}

}  // namespace

GrassStrand grow_strand(const GrassGround& ground, const GrassGrowth& growth, const glm::uvec4& triangle,
                        std::uint32_t number) {
  const glm::vec3 &a = ground.positions[triangle.x], &b = ground.positions[triangle.y],
                  &c = ground.positions[triangle.z];
  const bool printed = growth.random == RandomReading::kPrinted;
  const auto guide = [&](std::uint32_t vertex) {
    const glm::vec3& at = ground.positions[vertex];
    const float random = printed ? printed_random({at.x, at.z}) : fraction(scrambled(at));
    return ground.normals[vertex] * growth.height * (1 + growth.height_variation * (2 * random - 1));
  };
  const std::uint32_t own = scrambled(number + scrambled(a) + scrambled(scrambled(b) + scrambled(c)));
  const auto nth = static_cast<float>(number);
  const glm::vec2 plan(a.x, a.z);
  const glm::vec3 share =
      barycentric(printed ? glm::vec2(printed_random(plan / growth.texture_metres * nth),
                                      printed_random((plan + 1.0F) * nth))
                          : glm::vec2(fraction(scrambled(own + 1)), fraction(scrambled(own + 2))));
  const glm::vec3 x = a * share.x, y = b * share.y, z = c * share.z;
  const glm::vec3 tip =
      guide(triangle.x) * share.x + guide(triangle.y) * share.y + guide(triangle.z) * share.z;
  GrassStrand strand{};
  strand.root = growth.point == PointReading::kSum       ? x + y + z
                : growth.point == PointReading::kProduct ? x * y * z
                                                         : glm::cross(glm::cross(x, y), z);
  const float high = glm::length(tip);
  const bool grows = high > 1e-6F * growth.height;
  strand.height = grows ? high : 0;
  strand.up = grows ? tip / high : glm::vec3(0, 1, 0);
  strand.random = printed ? printed_random({strand.root.x, strand.root.z}) : fraction(own);
  strand.side = glm::normalize(b - a);
  if (growth.turned) {
    const float angle = 6.2831853F * glm::fract(strand.random * 61);
    strand.side =
        glm::normalize(std::cos(angle) * strand.side + std::sin(angle) * glm::cross(strand.up, strand.side));
  }
  strand.width = growth.width * strand.height / growth.height;
  return strand;
}

}  // namespace terrabench
