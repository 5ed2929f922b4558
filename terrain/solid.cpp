#include "terrain/solid.h"

namespace terrabench {

std::string_view name(Material material) {
  switch (material) {
    case Material::kAir:
      return "air";
    case Material::kBedrock:
      return "bedrock";
  }
  return "unnamed material";
}

}  // namespace terrabench
