// Tells the claims files which methods there are: the sets `representations`, `lods` and `entrants` (methods
// and variants). Members have a name, a label, and a field per trait and per thing that the method can do
// (method_sets.cpp); results/claims/sets.h says how claims choose among them.
#pragma once

namespace terrabench {

// To be called once, after add_representation() and add_lod(), before a claims file is read.
void declare_methods();

}  // namespace terrabench
