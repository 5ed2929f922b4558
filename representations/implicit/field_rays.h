// Rays on the implicit surface, cast on its field and not on a mesh: the hit is where the field of
// stack_field.h changes its sign, within the box of bounds().
//
// The caster holds, per column of the lattice's cells, the intervals of height in which the surface can pass.
// At any other height the field has the same sign at the column's four edges, and by more than it can change
// on the way there from a sample of the lattice; or the height lies above all that is solid in the kernel's
// reach. Between the edges the field is linear along x and along z where the lattice's cells do not straddle
// columns and the cube's radius is whole columns (by default on square columns), so that no margin is needed.
// Elsewhere the margin is the most that the field can change between a point and the nearest edge. So no
// surface is missed between the intervals. Within them a ray is sphere-traced (Hart 1996): each step is the
// distance over which the field cannot reach 0, but at least a quarter of a cell. Ground that a ray crosses
// for less than that may be missed. Where the field's sign has changed, the hit is narrowed down to a 1024th
// of a cell.
//
// mesh() approximates the same surface from the lattice's samples alone. By default its vertices are means
// of crossings (surface nets), so that its edges are rounder than the field's: hits lie within a third of
// a cell of the mesh. Along a ray that grazes the ground the two hits can be farther apart.
#pragma once

#include <memory>

#include "representations/implicit/implicit_surface.h"
#include "representations/ray_cast.h"

namespace terrabench {

// As Representation::ray_caster(). Null for a kernel so small, of less than about 1.6 of the lattice's cells,
// that the corners of a cell say nothing of its inside. Takes 4 B per column of cells and a fifteenth of
// that, 8 B per interval, and 2 B per column of the stacks. Samples the lattice once, in parallel.
std::unique_ptr<RayCaster> field_ray_caster(const ImplicitSurface&);

}  // namespace terrabench
