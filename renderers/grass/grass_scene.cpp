#include "renderers/grass/grass_scene.h"

#include "renderers/gl.h"
#include "renderers/grass/look_block.h"
#include "renderers/target.h"

namespace terrabench {

struct PlainGround::Gl {
  explicit Gl(const GrassGround& ground)
      : positions(make_buffer(ground.positions)),
        normals(make_buffer(ground.normals)),
        indices(make_buffer(ground.indices)),
        count(static_cast<GLsizei>(ground.indices.size())) {
    for (const auto& [location, buffer] : {std::pair{0U, &positions}, std::pair{1U, &normals}}) {
      glVertexArrayVertexBuffer(array.id(), location, buffer->id(), 0, sizeof(glm::vec3));
      glVertexArrayAttribFormat(array.id(), location, 3, GL_FLOAT, GL_FALSE, 0);
      glVertexArrayAttribBinding(array.id(), location, location);
      glEnableVertexArrayAttrib(array.id(), location);
    }
    glVertexArrayElementBuffer(array.id(), indices.id());
    check_gl("uploading the ground");
  }

  Program program = link_program("grass_soil.vert", "grass_soil.frag");
  LookBlock look;
  VertexArray array;
  Buffer positions, normals, indices;
  GLsizei count;
};

PlainGround::PlainGround(const GrassGround& ground) : gl_(std::make_unique<Gl>(ground)) {}
PlainGround::~PlainGround() = default;

void PlainGround::draw(const GrassLook& look) {
  gl_->look.set(look);
  glUseProgram(gl_->program.id());
  glBindVertexArray(gl_->array.id());
  glDrawElements(GL_TRIANGLES, gl_->count, GL_UNSIGNED_INT, nullptr);
}

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
