// Applying an event to a tree (Alonso, Joan-Arinyo & Solano, §3.2, figure 12). The paper's four steps are
// here: IdentifyHmap is identify_host(); CreateHeightmaps and ApplyEvent are stage(), one per event in
// a file of its own; AttachNewHeightmaps is Edit::commit(). Costs are proportional to the region touched.
#pragma once

#include "representations/ght/model.h"

namespace terrabench::ght {

class Edit;

// Applies the whole event, or throws and leaves the tree as it was, to the bit. `number` counts from 1 and
// names the event in errors. Throws bad_input when the event is invalid or the ground does not allow it,
// environment_error when memory or cell numbers run out.
void apply_event(Model& model, const events::Event& event, std::size_t number);

// The deepest outdoor heightmap that contains the whole of a convex region in plan (counter-clockwise seen
// from above), with a height or link in every cell there; of equally deep ones the latest; the root if none.
NodeId identify_host(const Model& model, std::span<const glm::dvec2> region);

// Stages what an event does to the tree; see edit.h. New heightmaps: linear erosion 4, radial erosion 1,
// normal and inverse fault 3, lateral fault 2, tunnel one per side of its section + 2 borders, cave one per
// side + 2 (entry and end).
void stage(Edit& edit, const events::LinearErosion& event);
void stage(Edit& edit, const events::RadialErosion& event);
void stage(Edit& edit, const events::DipFault& event);
void stage(Edit& edit, const events::LateralFault& event);
void stage(Edit& edit, const events::Carving& event);

}  // namespace terrabench::ght
