// GrassLook as the shaders read it: the uniform block of renderers/shaders/grass_look.glsl. Only for the
// sources in renderers/grass.
#pragma once

#include <glm/geometric.hpp>

#include "renderers/gl.h"
#include "renderers/grass/grass.h"

namespace terrabench {

// A uniform buffer, bound as number 0 by set().
class LookBlock {
 public:
  LookBlock() { glNamedBufferStorage(buffer_.id(), sizeof(Block), nullptr, GL_DYNAMIC_STORAGE_BIT); }
  void set(const GrassLook& look) {
    const Block block{.world_to_clip = look.world_to_clip,
                      .eye = {look.eye, look.seconds},
                      .sun = {glm::normalize(look.sun), look.linear ? 1.0F : 0.0F},
                      .sun_colour = {look.sun_colour, 0},
                      .sky_colour = {look.sky_colour, 0},
                      .fog_colour = {look.fog_colour, look.fog_density},
                      .fog_sun_colour = {look.fog_sun_colour, 0},
                      .clip_plane = look.clip_plane,
                      .wind = {look.wind.x, look.wind.y, look.thin_from, look.none_beyond}};
    glNamedBufferSubData(buffer_.id(), 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffer_.id());
  }

 private:
  struct Block {  // std140
    glm::mat4 world_to_clip;
    glm::vec4 eye, sun, sun_colour, sky_colour, fog_colour, fog_sun_colour, clip_plane, wind;
  };
  Buffer buffer_;
};

}  // namespace terrabench
