// The methods that can be shown: every entry of the registry of levels of detail, and every variant of one.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lod/lod.h"
#include "terrain/parameters.h"

namespace terrabench::viewer {

struct Method {
  std::string name, label;  // "geomipmap_morph", "geomipmap, morphing"
  const LodType* type;
  Parameters options;
};

// Every method, each followed by its variants.
std::vector<Method> methods();
// Throws unknown_name.
Method method_named(std::string_view name);

}  // namespace terrabench::viewer
