// Applying an event to a tree (Alonso, Joan-Arinyo & Solano, figures 12, 14 and 16): the host is identified,
// new heightmaps are created with what the event makes of the ground, and attached to the tree. Strong
// guarantee: an event that cannot be leaves the tree as it was, to the bit. Costs are of the region touched.
//
// Counts of new heightmaps: linear erosion 4, radial erosion 1, normal and inverse fault 3, lateral fault 2,
// tunnel its sides + 2, cave its sides + 2 (entry and end).
#pragma once

#include "representations/ght/surgery.h"
#include "terrain/events/event.h"

namespace terrabench::ght {

// `number` counts from 1 and is what errors call the event. Throws bad_input when the event cannot be or the
// geometry does not allow it, environment_error when memory or cell numbers run out.
void dispatch(Model& model, const events::Event& event, std::size_t number);

// The deepest outdoor heightmap that holds the whole of a convex region in plan (counter-clockwise seen from
// above), with a height or a link in every cell there; of several the latest. The root holds all.
NodeId identify_host(const Model& model, std::span<const glm::dvec2> region);

// One for each family of events.
void apply(Model& model, const events::LinearErosion& event, NodeId host, const Refusal& refusal);
void apply(Model& model, const events::RadialErosion& event, NodeId host, const Refusal& refusal);
void apply(Model& model, const events::DipFault& event, NodeId host, const Refusal& refusal);
void apply(Model& model, const events::LateralFault& event, NodeId host, const Refusal& refusal);
void apply(Model& model, const events::Carving& event, NodeId host, const Refusal& refusal);

// What an event shares with all its nodes.
inline Node new_node(const Model& model, NodeId host, Area area) {
  Node node;
  node.parent = host;
  node.event = static_cast<std::uint32_t>(model.tree.events().size());
  node.area = area;
  return node;
}

}  // namespace terrabench::ght
