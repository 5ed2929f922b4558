// Random events on a site, for sequences that no one planned, and why the tree refuses some of them.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "experiments/ght/site.h"

namespace terrabench::ght {

// An event of any kind anywhere, up to most of the terrain long. Carvings go through the higher ground.
events::Event wild_event(Dice& dice, const Site& site);

// An event as the paper draws them: half to one and a quarter times the site's size long, two cells and more
// inside the terrain, and one that is defined on this ground; a carving is at least two cells wide and has
// more than a cell of ground, as the events before have left it, over both its ends. A carving is redrawn
// until the definition (terrain/events/evaluate.h) allows it after `before`; where the site has no place for
// one, the result is a radial erosion.
events::Event sane_event(Dice& dice, const Site& site, const Ght& tree,
                         std::span<const events::Event> before);

// Why an event was refused.
enum class Refusal : std::uint8_t {
  kImpossible,  // the definition refuses it too: it leaves the terrain, or a carving starts in the air
  kBorder,      // within two sample spacings of the terrain's border
  kOverhang,    // over the overhang of an inverse fault, where no heightmap has one height
  kCarving,     // over or within one sample spacing of a tunnel or cave
  kThin,        // a carving less than two cells wide, or with less than a cell of ground over it
  kMouth,       // a carving's own mouth is not one simple hole
  kOther,
};
inline constexpr std::string_view kRefusals[] = {"impossible", "border", "overhang", "carving",
                                                 "thin",       "mouth",  "other"};
// From the error that the tree gave. O(events) and, for a carving, O(its length).
Refusal why_refused(const Site& site, const events::Event& event, std::span<const events::Event> before,
                    std::string_view error);

// Whether the ground that the event needs comes within two cells of an overhang or a carving that the events
// `before` left, from the events alone (for carvings, plus the ground of the tree that their walls reach).
bool meets_fold(const Site& site, const Ght& tree, const events::Event& event,
                std::span<const events::Event> before);

}  // namespace terrabench::ght
