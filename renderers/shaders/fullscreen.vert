#version 450 core
// One triangle over the whole picture, at the far plane. Without vertex data.
out vec2 at;  // clip space

void main() {
  at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(at, 0.0, 1.0);
}
