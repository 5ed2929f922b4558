#version 450 core
in vec4 ink;
in vec2 across;

out vec4 color;

void main() {
  float cover = clamp(across.y + 0.5 - abs(across.x), 0.0, 1.0);
  color = vec4(ink.rgb, ink.a * cover);
}
