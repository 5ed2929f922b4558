#include "results/further_grounds.h"

#include <algorithm>

namespace terrabench {
namespace {

// Whether the claim reads anything of that ground; then it reads it here instead.
bool move_to(const FurtherGround& ground, Claim& claim) {
  bool moved = false;
  for (Condition& condition : claim.conditions) {
    if (condition.kind == Condition::Kind::kFigure) {
      condition.figure += "." + ground.name;
      moved = true;
    }
    for (Operand& operand : condition.operands) {
      std::string& name = operand.case_name;
      if (name != ground.of && !name.starts_with(ground.of + "/")) continue;
      name.replace(0, ground.of.size(), ground.name);
      moved = true;
    }
  }
  return moved;
}

}  // namespace

std::vector<Claim> on_further_grounds(const std::vector<Claim>& claims,
                                      std::span<const FurtherGround> grounds) {
  std::vector<Claim> all;
  for (const Claim& claim : claims) {
    all.push_back(claim);
    for (const FurtherGround& ground : grounds) {
      Claim again = claim;
      if (!move_to(ground, again)) continue;
      again.id += "." + ground.name;
      again.where += ", on " + ground.label;
      again.profiles = ground.profiles;
      const auto known = std::find_if(ground.known.begin(), ground.known.end(),
                                      [&](const FurtherGround::Known& k) { return k.claim == claim.id; });
      if (known != ground.known.end()) {
        again.known = known->verdict;
        if (!known->note.empty()) again.note = known->note;
      }
      all.push_back(std::move(again));
    }
  }
  return all;
}

}  // namespace terrabench
