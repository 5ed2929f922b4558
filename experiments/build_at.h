// Representations at a given resolution, as in the papers' tables.
#pragma once

#include <memory>
#include <string_view>

#include "representations/layered_stack/layered_stack.h"
#include "representations/representation.h"

namespace terrabench {

// The named representation with its parameter "resolution" set to n.
inline std::unique_ptr<Representation> build_at_resolution(std::string_view name, const TerrainSource& source,
                                                           std::int64_t n, Progress& progress) {
  const RepresentationType& type = representation(name);
  Parameters parameters(type.parameters);
  parameters.set("resolution", n);
  return type.build(source, parameters, progress);
}

inline std::unique_ptr<LayeredStack> stack_at_resolution(const TerrainSource& source, std::int64_t n,
                                                         Progress& progress) {
  return LayeredStack::build_stack(source, Parameters(column_parameters(), {{"resolution", n}}), progress);
}

}  // namespace terrabench
