// Descends a bit tree to a range of its leaves: O(leaves in the range + levels), where to find each leaf by
// its number takes O(levels).
#pragma once

#include <cstddef>

#include "lod/cbt/bisection.h"
#include "lod/cbt/bit_tree.h"

namespace terrabench::cbt {

// Calls use(leaf, parent, leaves of the parent, state) for leaves `first` to `last` - 1 in order; a root has
// no parent, and then 0 leaves. enter(triangle, state) is called for each node on the way. Its changes of
// the state pass on to both halves; if it returns false, all leaves below are skipped.
template <class State, class Enter, class Use>
class LeafWalk {
 public:
  LeafWalk(const Bisection& bisection, const BitTree& tree, std::size_t first, std::size_t last,
           const Enter& enter, const Use& use)
      : tree_(tree), first_(first), last_(last), enter_(enter), use_(use) {
    std::size_t before = 0;
    for (NodeId k = 0; k < bisection.roots(); ++k) {
      const std::size_t leaves = tree.sum(bisection.root(k));
      if (is_asked_for(before, leaves)) descend(bisection.at(bisection.root(k)), {}, 0, before, leaves, {});
      before += leaves;
    }
  }

 private:
  bool is_asked_for(std::size_t before, std::size_t leaves) const {
    return before < last_ && before + leaves > first_;
  }
  void descend(const Place& place, const Place& parent, std::size_t of_parent, std::size_t before,
               std::size_t leaves, State state) const {
    if (!is_asked_for(before, leaves) || !enter_(place.triangle, state)) return;
    if (leaves == 1) {
      use_(place, parent, of_parent, state);
      return;
    }
    const Place left = place.half(false);
    const std::size_t of_left = tree_.sum(left.node);
    descend(left, place, leaves, before, of_left, state);
    descend(place.half(true), place, leaves, before + of_left, leaves - of_left, state);
  }

  const BitTree& tree_;
  std::size_t first_, last_;
  const Enter& enter_;
  const Use& use_;
};

template <class State, class Enter, class Use>
void walk_leaves(const Bisection& bisection, const BitTree& tree, std::size_t first, std::size_t last,
                 const Enter& enter, const Use& use) {
  LeafWalk<State, Enter, Use>(bisection, tree, first, last, enter, use);
}

}  // namespace terrabench::cbt
