#include "renderers/grass/grass_scene.h"

#include "renderers/gl.h"
#include "renderers/target.h"

namespace terrabench {

GrassScene::GrassScene(GlContext& gl, const GrassGround& ground, const GrassGrowth& growth)
    : gl_(gl), ground_(ground), patch_(ground, growth) {}

void GrassScene::begin(const View& view) {
  look.world_to_clip = world_to_clip(view);
  look.eye = view.eye;
  RenderTarget& target = gl_.target();
  target.resize(view.width, view.height);
  target.bind();
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glClearColor(background.r, background.g, background.b, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  ground_.draw(look);
  if (bare_) bare_->draw(look);
}

void GrassScene::add_bare(const GrassGround& ground) { bare_.emplace(ground); }

void GrassScene::draw(const View& view, GrassTechnique technique) {
  begin(view);
  grass_.draw(patch_, look, technique);
  gl_.target().average();
}

Image GrassScene::picture(const View& view, GrassTechnique technique) {
  draw(view, technique);
  check_gl("drawing grass");
  return gl_.target().read();
}

std::int64_t GrassScene::count_billboards(const View& view, GrassTechnique technique) {
  begin(view);
  return grass_.count_billboards(patch_, look, technique);
}

}  // namespace terrabench
