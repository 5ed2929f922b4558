#include "renderers/grass/plain_ground.h"

#include "renderers/gl.h"
#include "renderers/grass/look_block.h"

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

}  // namespace terrabench
