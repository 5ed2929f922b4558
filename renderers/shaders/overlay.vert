#version 450 core
layout(location = 0) in vec4 position;  // clip space
layout(location = 1) in vec4 paint;     // sRGB and opacity
layout(location = 2) in vec2 profile;   // pixels from the middle of the line, and half its width

out vec4 ink;
out vec2 across;

void main() {
  ink = paint;
  across = profile;
  gl_Position = position;
}
