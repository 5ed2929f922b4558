#include "renderers/landscape/landscape_gl.h"

#include <algorithm>
#include <cmath>

#include "terrain/memory.h"

namespace terrabench {
namespace {

// Texture units; the shaders name them in their bindings.
constexpr GLuint kMaterialMaps = 0, kSkyNoise = 1, kWaveMap = 2, kReflection = 3, kRefraction = 4, kDepth = 5,
                 kShadowMaps = 6, kOcclusion = 7;
constexpr int kMaterialSide = 512, kWaveSide = 512, kSkyWidth = 2048, kSkyHeight = 768;

Program ground_program(bool meshes, bool lit) {
  return link_program(meshes ? "ground_mesh.vert" : "ground_heights.vert",
                      lit ? "ground.frag" : "depth.frag");
}

// Keeps a target of this size, or replaces it; none if it is not needed.
void fit(std::optional<PassTarget>& target, bool needed, int width, int height, GLenum format,
         bool has_depth = true) {
  if (!needed) {
    target.reset();
  } else if (!target || target->width() != width || target->height() != height) {
    target.reset();
    target.emplace(width, height, format, has_depth);
  }
}

}  // namespace

SceneBlock describe(const LandscapeStyle& s, double seconds) {
  SceneBlock b;
  b.sun = glm::vec4(s.sun, s.fog_sun_exponent);
  b.sun_light = glm::vec4(s.sun_light, s.fog_sun);
  b.sky_light = glm::vec4(s.sky_light, s.occlusion);
  b.sky_high = glm::vec4(s.sky_high, s.sky_falloff);
  b.sky_low = glm::vec4(s.sky_low, s.haze);
  b.fog_color = glm::vec4(s.fog_color, s.fog_distance);
  // Reduced to one period here, so that a float in the shader stays precise after days.
  const double turns = seconds * s.cloud_speed;
  b.cloud_color = glm::vec4(s.cloud_color, turns - std::floor(turns));
  b.cloud_range = glm::vec4(s.cloud_range, s.cloud_shading, 0);
  b.border = glm::vec4(s.ground.low.x, s.ground.low.z, s.ground.high.x, s.ground.high.z);
  b.border_fade = glm::vec4(s.border_width, s.border_distance, 0);
  b.band_tops = glm::vec4(s.band_tops[0], s.band_tops[1], s.band_tops[2], s.band_tops[3]);
  b.ground = glm::vec4(s.band_blend, s.steep, s.steep_blend, s.texture_width);
  b.ground_modes =
      glm::vec4(s.slope_as_printed ? 1 : 0, s.triplanar ? 1 : 0, s.bumps, s.occlusion > 0 ? 0 : 1);
  for (std::size_t k = 0; k < kMaterials; ++k) {
    b.materials[2 * k] = glm::vec4(s.materials[k].dark, 0);
    b.materials[2 * k + 1] = glm::vec4(s.materials[k].light, 0);
  }
  b.water = glm::vec4(s.water_level, 0, 0, s.wave_width);
  b.water_color = glm::vec4(s.water_color, s.clarity);
  b.waves = glm::vec4(s.distortion, s.wave_slope, static_cast<float>(s.wave_speed * seconds), s.highlight);
  b.fresnel =
      glm::vec4(static_cast<float>(s.fresnel), s.fresnel_normal, s.fresnel_power, s.highlight_exponent);
  return b;
}

LandscapeGl::LandscapeGl(const LandscapeStyle& style)
    : depth{ground_program(false, false), ground_program(true, false)},
      lit{ground_program(false, true), ground_program(true, true)},
      sky(link_program("fullscreen.vert", "sky.frag")),
      water(link_program("water.vert", "water.frag")),
      occlusion(link_program("fullscreen.vert", "occlusion.frag")),
      blur(link_program("fullscreen.vert", "occlusion_blur.frag")) {
  block.reserve(sizeof(SceneBlock));
  glTextureStorage3D(materials.id(), mip_levels(kMaterialSide, kMaterialSide), GL_RGBA8, kMaterialSide,
                     kMaterialSide, kMaterials);
  glTextureParameteri(materials.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  make_textures(style);
}

void LandscapeGl::make_textures(const LandscapeStyle& style) {
  for (int k = 0; k < kMaterials; ++k) {
    const Texels map = material_map(k, kMaterialSide, style.seed);
    glTextureSubImage3D(materials.id(), 0, 0, 0, k, kMaterialSide, kMaterialSide, 1, GL_RGBA, GL_FLOAT,
                        map.values.data());
  }
  glGenerateTextureMipmap(materials.id());
  waves.emplace(repeating_texture(wave_map(kWaveSide, style.seed), GL_RGBA16F));
  sky_noise.emplace(
      repeating_texture(terrabench::sky_noise(kSkyWidth, kSkyHeight, style.seed, style.cloud_size), GL_R16));
  // Rows end at the zenith and at the horizon.
  glTextureParameteri(sky_noise->id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  check_gl("making the landscape's textures");
}

void LandscapeGl::make_targets(const View& view, const LandscapeStyle& style) {
  const bool occludes = style.occlusion > 0;
  // Reflection and refraction: 8 bytes of colour and 4 of depth each; occlusion: 4 of depth and twice 1.
  const std::uint64_t bytes = static_cast<std::uint64_t>(view.width) *
                              static_cast<std::uint64_t>(view.height) *
                              ((style.has_water ? 24U : 0U) + (occludes ? 6U : 0U));
  if (bytes > 0) require_memory(bytes, "the passes of a landscape", "draw a smaller picture");
  fit(reflection, style.has_water, view.width, view.height, GL_RGBA16F);
  fit(refraction, style.has_water, view.width, view.height, GL_RGBA16F);
  fit(depths, occludes, view.width, view.height, 0);
  fit(occluded, occludes, view.width, view.height, GL_R8, false);
  fit(blurred, occludes, view.width, view.height, GL_R8, false);
  // A shader's shadow sampler must have a texture that compares, with or without shadows.
  const int side = style.shadows ? kShadowSide : 1;
  GLint now = 0;
  if (shadows) glGetTextureLevelParameteriv(shadows->id(), 0, GL_TEXTURE_WIDTH, &now);
  if (now == side) return;
  shadows.emplace();
  glTextureStorage3D(shadows->id(), 1, GL_DEPTH_COMPONENT32F, side, side, kCascades);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTextureParameteri(shadows->id(), wrap, GL_CLAMP_TO_EDGE);
  }
  glTextureParameteri(shadows->id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(shadows->id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(shadows->id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(shadows->id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glNamedFramebufferDrawBuffer(shadow_framebuffer.id(), GL_NONE);
  check_gl("making shadow maps");
}

void LandscapeGl::write(const SceneBlock& content) {
  block.write(0, &content, sizeof content);
  bind();
}

void LandscapeGl::bind() {
  glBindBufferBase(GL_UNIFORM_BUFFER, kSceneBinding, block.id());
  glBindTextureUnit(kMaterialMaps, materials.id());
  glBindTextureUnit(kSkyNoise, sky_noise->id());
  glBindTextureUnit(kWaveMap, waves->id());
  glBindTextureUnit(kShadowMaps, shadows->id());
}

void LandscapeGl::draw_sky(bool shown) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);  // front is the other side in a mirrored pass
  glProgramUniform1i(sky.id(), uniform(sky, "shown"), shown ? 1 : 0);
  glUseProgram(sky.id());
  glBindVertexArray(nothing.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
}

void LandscapeGl::draw_ground(Pass pass) {
  const GroundPrograms& programs = has_colors(pass) ? lit : depth;
  if (pass == Pass::kPicture) glBindTextureUnit(kOcclusion, blurred ? blurred->color() : 0);
  const auto use = [&](const Program& program) {
    if (has_colors(pass)) {
      glProgramUniform1i(program.id(), uniform(program, "shown"), pass == Pass::kPicture ? 1 : 0);
    }
    glUseProgram(program.id());
  };
  if (buffers.has_heights()) {
    use(programs.heights);
    buffers.draw_heights();
  }
  if (buffers.has_meshes()) {
    use(programs.meshes);
    buffers.draw_meshes();
  }
  glUseProgram(0);
}

void LandscapeGl::draw_water(float reach) {
  glBindTextureUnit(kReflection, reflection->color());
  glBindTextureUnit(kRefraction, refraction->color());
  glBindTextureUnit(kDepth, refraction->depth());
  glProgramUniform1f(water.id(), uniform(water, "reach"), reach);
  glUseProgram(water.id());
  glBindVertexArray(nothing.id());
  glDisable(GL_CULL_FACE);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glEnable(GL_CULL_FACE);
  check_gl("drawing the water");
}

// From the depth of the picture to a smooth map of how open each pixel is to the sky.
void LandscapeGl::draw_occlusion(const View& view, const LandscapeStyle& style) {
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(nothing.id());
  glBindTextureUnit(kDepth, depths->depth());
  occluded->bind();
  glProgramUniform1f(occlusion.id(), uniform(occlusion, "radius"), style.occlusion_radius);
  glUseProgram(occlusion.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  blurred->bind();
  glBindTextureUnit(kOcclusion, occluded->color());
  glProgramUniform1f(blur.id(), uniform(blur, "near"), view.near);
  glUseProgram(blur.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindTextureUnit(kOcclusion, 0);
  glEnable(GL_DEPTH_TEST);
  check_gl("drawing ambient occlusion");
}

}  // namespace terrabench
