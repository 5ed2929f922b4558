#version 450 core
// The number of the triangle at the pixel, counted from 1; 0 is the background.
flat in uint first_triangle;
layout(location = 0) out uint number;

void main() { number = first_triangle + uint(gl_PrimitiveID) + 1u; }
