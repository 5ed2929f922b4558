#include "representations/ght/dispatch.h"

namespace terrabench::ght {

void apply(Model&, const events::Carving&, NodeId, const Refusal& refusal) {
  refusal.refuse("is not among the tree's events", "leave it out");
}

}  // namespace terrabench::ght
