#version 450 core
#define BY_HEIGHT
#include "relief.glsl"
