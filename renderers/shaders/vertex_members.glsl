// Of the block Vertex: what relief.frag reads of a vertex. Without wires, the last three are 0.
  vec3 world;
  vec3 normal;
  vec3 paint;
  float bend;
  noperspective vec3 to_edge;
  flat vec3 strength;  // 0 for an edge that is not drawn
  flat vec3 reach;     // pixels of ink from an edge into the triangle
