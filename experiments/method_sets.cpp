#include "experiments/method_sets.h"

#include "lod/lod.h"
#include "representations/representation.h"
#include "results/claims/sets.h"

namespace terrabench {
namespace {

using Facts = std::initializer_list<std::pair<const char*, bool>>;

SetMember member(std::string_view name, std::string_view label, Facts facts) {
  SetMember made{{{"name", std::string(name)}, {"label", std::string(label)}}};
  for (const auto& [fact, holds] : facts) {
    if (holds) made.fields.emplace(fact, "yes");
  }
  return made;
}

SetMember member(const RepresentationType& type) {
  const Traits& traits = type.traits;
  return member(type.name, type.label,
                {{"overhangs", traits.overhangs},
                 {"materials", traits.materials},
                 {"lossless", traits.lossless},
                 {"editable", traits.editable},
                 {"events", traits.events},
                 {"erodes", traits.erodes},
                 {"rays", traits.rays},
                 {"digs", traits.editable || traits.events},
                 {"growth", type.growth.has_value()},
                 {"growth_in_solids", type.growth_in_solids.has_value()}});
}

SetMember member(std::string_view name, std::string_view label, const LodType& type, bool bounds_error) {
  return member(name, label,
                {{"conforming", type.traits.conforming},
                 {"bounds_error", bounds_error},
                 {"near_surface", type.traits.near_surface},
                 {"tunable", type.tunable()},
                 {"joins", !type.unstitched.empty()},
                 {"growth", type.growth.has_value()}});
}

}  // namespace

void declare_methods() {
  Sets sets;
  for (const RepresentationType& type : representations()) sets["representations"].push_back(member(type));
  for (const LodType& type : lods())
    sets["lods"].push_back(member(type.name, type.label, type, type.traits.bounds_error));
  for (const Entrant& entrant : entrants())
    sets["entrants"].push_back(
        member(entrant.name, entrant.label, lod(entrant.method), entrant.bounds_error));
  declare_sets(std::move(sets));
}

}  // namespace terrabench
