#version 450 core
// Which triangle of the frame covers the pixel, counted from 1; 0 is the background.
flat in uint first_triangle;
layout(location = 0) out uint number;

void main() { number = first_triangle + uint(gl_PrimitiveID) + 1u; }
