// Drills as bytes. The paper stores four plain values a drill and hopes for better (Stuetzle & Franklin 2012,
// §4.1: chain-coded channels, shapes that follow the channel); this is one such form. Channels are trees that
// grow upstream from their outlets: each pixel says which of its neighbours drain into it, relative to the
// direction it drains itself, in one symbol (an entropy-coded Freeman chain that may fork). Its shape,
// rounded to a quantum, is coded as the difference from the drill downstream. O(drills) to write, O(drills
// log drills) to read, at about a microsecond a drill.
#pragma once

#include <cstddef>

#include "representations/drill/drills.h"
#include "terrain/files.h"

namespace terrabench {

// Rounds elevations to whole multiples of `quantum` metres, and slope and curvature so finely that the shape
// is as good some w samples from the pixel: to quantum / 2^⌊log₂ w⌋ and the square of that. Rounding keeps
// every order, so that what was monotone stays so. Throws usage_error when `quantum` is not above 0, or so
// fine that a number does not fit 22 bits.
void quantise(Drills& drills, float quantum);

// A power of two near 1/256 of the range of heights: drills err by some 2 % of the range, beside which such
// rounding is lost.
float automatic_quantum(const Heightfield& field);

// Bit for bit what decode_drills() gives back. `drills` are quantised, as extract_drills() orders them.
void encode_drills(const Drills& drills, ByteSink& out);
// Throws bad_input for bytes that encode_drills() cannot have written, environment_error for more drills than
// fit into memory. Every pixel is taken at most once, so that damaged bytes end soon.
Drills decode_drills(ByteSource& in);

}  // namespace terrabench
