#version 450 core
#include "relief.glsl"
