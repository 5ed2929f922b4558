// The three views in which "ght" shows a tree, whole or cut open.
#pragma once

#include "experiments/figures/views.h"
#include "experiments/ght/tree_view.h"

namespace terrabench::ght {

// The root's ground plane grey, those of other nodes in colour.
Image planes_view(GlContext&, const Ght&, const figures::Look&);
// The triangles of the root grey, those of other nodes blue.
Image wires_view(GlContext&, const Ght&, const figures::Look&);
// Lit and coloured by height, as a block of ground; with particles above it, if there are any.
Image solid_view(GlContext&, const Ght&, const figures::Look&, const TriangleMesh& particles = {});

}  // namespace terrabench::ght
