#version 450 core
#define BY_PLAN
#include "relief.glsl"
