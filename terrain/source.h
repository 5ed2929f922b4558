// What a structure is built from: a named piece of ground, as heights or as a solid, with what identifies it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/progress.h"
#include "terrain/solid.h"

namespace terrabench {

namespace events {
struct Sculpture;
}

// Exactly one of the two is set.
struct TerrainSource {
  std::string name;                // catalogue name or path
  std::string checksum;            // of the content
  std::vector<std::string> notes;  // what the reader converted, guessed or left out, for the user
  std::optional<Heightfield> heights;
  std::optional<Solid> solid;
  // What the solid was evaluated from, for structures that can repeat the events; null for other solids and
  // for heights.
  std::shared_ptr<const events::Sculpture> events;

  // For heights: the ground's floor lies one cell under the lowest sample, so that every column has
  // substance.
  Bounds bounds() const;
};

// A name in the catalogue: one line in terrain/sources/catalogue.cpp.
struct TerrainType {
  std::string_view name, summary, origin;
  TerrainSource (*open)(std::uint64_t seed);
};
std::span<const TerrainType> terrains();

// True for what can only be a file (it exists, or looks like a path), false for a catalogue name. Throws
// unknown_name, with the nearest, for anything else.
bool names_dem_file(std::string_view name_or_path);

// By catalogue name or, for anything else, the path of any DEM that GDAL opens. Throws unknown_name or
// bad_input.
TerrainSource open_terrain(std::string_view name_or_path, std::uint64_t seed = 0);

}  // namespace terrabench
