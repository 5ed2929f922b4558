// A terrain as a small text: the name of a ground, a seed and what happened to it (TOML). A complex terrain
// is a few hundred bytes, and repeats exactly.
//
//   terrain = "diamond-square"   # a name in the catalogue, or a DEM file
//   seed = 7
//   size = 129                   # samples a side; left out, as the ground comes
//   [[event]]
//   kind = "tunnel"              # the other keys are the event's fields in event.h
//   from = [20, 30, 40]
//   …
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/events/event.h"
#include "terrain/source.h"

namespace terrabench::events {

inline constexpr std::string_view kExtension = ".toml";
inline constexpr std::size_t kMostBytes = std::size_t{1} << 23;  // of a file

struct Script {
  std::string terrain;
  std::uint64_t seed = 0;
  int size = 0;  // 0: as the ground comes
  std::vector<Event> events;
  std::vector<int> lines;  // where each event stands in the file
};

// Throws bad_input with the line for anything that is not such a file: syntax, unknown keys and kinds, values
// of another type. What the values mean is validate()'s business.
Script parse_script(std::string_view text, const std::string& origin);

// The text that parse_script() reads back to the bit. The second gives the events alone.
std::string to_text(const Script&);
std::string to_text(std::span<const Event>);

// The terrain that the script describes: its ground when it has no events, else the solid after them, with
// the events. Throws bad_input, with the line, for events that cannot happen to the ground.
TerrainSource open_script(std::string_view text, const std::string& origin);

}  // namespace terrabench::events
