// Drills as bytes. The paper stores four plain values per drill and suggests better forms (Stuetzle &
// Franklin 2012, §4.1: chain-coded channels, shapes that follow the channel); this is one. Channels are trees
// that grow upstream from their outlets: the neighbours that drain into a pixel, relative to the direction in
// which it drains itself, are one symbol (an entropy-coded Freeman chain that may fork). Its shape, rounded
// to a quantum, is coded as the difference from the drill downstream. O(drills) to write, O(drills log
// drills) to read, at about a microsecond per drill.
#pragma once

#include <cstddef>

#include "representations/drill/drills.h"
#include "terrain/files.h"

namespace terrabench {

// Bit for bit what decode_drills() gives back. `drills` are quantised (quantum.h), in the order of
// extract_drills().
void encode_drills(const Drills& drills, ByteSink& out);
// Throws bad_input for bytes that encode_drills() cannot have written, environment_error for more drills than
// fit the memory. Every pixel holds at most one drill, so that decoding damaged bytes ends soon.
Drills decode_drills(ByteSource& in);

}  // namespace terrabench
