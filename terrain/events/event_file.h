// A terrain as a small TOML file: the name of a ground, a seed and the events on it. A complex terrain takes
// a few hundred bytes, and is the same each time.
//
//   terrain = "diamond-square"   # a name in the catalogue, or a DEM file
//   seed = 7
//   size = 129                   # samples per side of the ground; optional: its own size
//   [[event]]
//   kind = "tunnel"              # the other keys are the fields of the event in event.h
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
  int size = 0;  // 0: the ground's own size
  std::vector<Event> events;
  std::vector<int> lines;  // of each event in the file
};

// Throws bad_input with the line when the file is not of this form: syntax, unknown keys and kinds, values of
// the wrong type. Does not check the values themselves; validate() does.
Script parse_script(std::string_view text, const std::string& origin);

// The text of a script, which parse_script() reads back to the bit; the second overload writes only the
// events.
std::string to_text(const Script&);
std::string to_text(std::span<const Event>);

// The terrain that the script describes: its ground when it has no events, otherwise the solid after them and
// the events. Throws bad_input, with the line, for events that are invalid or that the ground does not allow.
TerrainSource open_script(std::string_view text, const std::string& origin);

}  // namespace terrabench::events
