// What a representation costs, measured alike for all types from outside: bytes, files, queries, meshing,
// rays and edits.
#pragma once

#include <memory>

#include "experiments/cross/representations/scenes.h"
#include "experiments/recorder.h"
#include "experiments/samples.h"
#include "terrain/mesh.h"

namespace terrabench::cross {

// What is timed is added to the samples, to be taken while the scene, the structure and the mesh are there.

// Seconds to build, the bytes of each part, and the bytes that operator new takes back. Returns what was
// built.
std::unique_ptr<Representation> measure_build(const Scene&, const RepresentationType&, const Parameters&,
                                              Recorder&, Samples&, Progress&);
// Bytes on disk, seconds to save and to load, and how many of some thousand lines the loaded copy answers
// differently.
void measure_file(const Scene&, const RepresentationType&, const Representation&, Recorder&, Samples&);
// Points and columns per second of processor time, on one thread, at random places.
void measure_queries(const Scene&, const Representation&, Samples&);
TriangleMesh measure_mesh(const Representation&, Recorder&, Samples&);
// Rays per second of processor time, on one thread: from above, downward in random directions; and along the
// ground, from 2 % of its height above it, within 6° of the horizontal. Cast as Representation::ray_caster()
// does, or through the mesh; both are compared hit by hit. `ray_agreement`: the share of rays for which the
// two hit the same place within a cell, or both nothing.
void measure_rays(const Scene&, const Representation&, const TriangleMesh&, int rays, Recorder&, Samples&);

// Two edits. A sphere is dug where the ground is highest and filled again: dig_*, fill_*, `rebuilt`. And the
// tree of heightmaps' radial erosion, which also removes the ground above it, with the same radius at the
// highest place, of the thousand highest, where the tree takes it: event_*, `event_rebuilt`. Of each step the
// seconds, the bytes added since before the edit, and the triangles that must be meshed again
// (new_triangles()), of which `mesh` are those before. A type that does not take the edit is built again from
// the changed ground, with the scene's columns if that is a solid (`…rebuilt` = 1). Each edit is timed on a
// structure built anew. Nothing is recorded if the sphere's radius is less than a cell, on ground with a
// relief below two cells or a side below 16: the sphere could lie between the samples. `event_misplaced`: of
// the ground that the event should remove, how much is still there, plus by how much the ground below
// changes, as a share.
// `parameters`: with which the structure was built.
void measure_edit(const Scene&, const RepresentationType&, const Parameters& parameters,
                  const Representation&, const TriangleMesh& mesh, Recorder&, Progress&);
// The triangles of `after` that `before` does not have, by the bits of their corners: the least that anything
// drawn must take over after the edit. O(n log n) of all triangles, 8 bytes each.
std::size_t new_triangles(const TriangleMesh& before, const TriangleMesh& after);

}  // namespace terrabench::cross
