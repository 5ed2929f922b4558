// What a structure is built from: named ground, as heights or as a solid, and what identifies its content.
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
  // The events that the solid was evaluated from, for structures that can apply them themselves; null for
  // other solids and for heights.
  std::shared_ptr<const events::Sculpture> events;

  // For heights: the ground's floor lies one cell under the lowest sample, so that every column has
  // substance.
  Bounds bounds() const;
};

// Heights as a source, with the checksum of their content. Holds the field, O(samples).
TerrainSource source_of(std::string_view name, Heightfield heights);

// A name in the catalogue: one line in terrain/sources/catalogue.cpp.
struct TerrainType {
  std::string_view name, summary, origin;
  TerrainSource (*open)(std::uint64_t seed);
};
std::span<const TerrainType> terrains();

// The prefix of a picture's path that is read as land, see terrain/sources/drawing/drawing.h:
// "drawing:coast.png", "drawing:coast.png,sea_level=0.4,peak=1500".
inline constexpr std::string_view kDrawingPrefix = "drawing:";

// The file that a terrain is read from: a drawing's picture, or what can only be a path (it exists, or looks
// like one). Empty for a catalogue name. Throws unknown_name, with the nearest, for anything else.
std::string terrain_file(std::string_view name_or_path);
// Whether it is the path of a DEM, alone or with options (dem.h); not that of an event file.
bool names_dem_file(std::string_view name_or_path);

// By catalogue name, as a drawing or, for anything else, the path of any DEM that GDAL opens. Throws
// unknown_name or bad_input.
TerrainSource open_terrain(std::string_view name_or_path, std::uint64_t seed = 0);

}  // namespace terrabench
