// Joins results folders, such as those of the shards of one sweep, into one. Records and pictures are copied
// as they are; each record keeps the run, and so the machine, that measured it.
//
// Everything is checked before anything is written. Pictures are copied first, then all records are written
// in one step: whenever a merge is killed, the folder holds the old records or all of the new ones, and the
// same command completes it. O(records of all folders + bytes of pictures).
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace terrabench {

struct Merged {
  std::size_t copied = 0;    // records
  std::size_t present = 0;   // records that the output folder held already
  std::size_t repeated = 0;  // further records of a case; the first folder's is kept, of a case that failed
                             // there the first that did not
  std::size_t machines = 0;  // kinds of machine or build, between which times cannot be compared
  // Exact figures in which a repeated measurement differs from the one that is kept: "experiment case metric:
  // 3 in FOLDER on MACHINE; 4 in FOLDER on MACHINE".
  std::vector<std::string> contradictions;
  std::vector<std::string> warnings;  // of reading the folders

  bool passed() const { return contradictions.empty(); }
};

// `out` may hold results; then it counts as the first folder. Throws bad_input when a folder holds no
// measurements, an altered or damaged line, a record whose picture is missing or changed, or a measurement of
// another revision, seed, terrain or parameters than the others; environment_error when `out` cannot be
// written; usage_error when `out` is one of `folders`.
Merged merge(const std::filesystem::path& out, std::span<const std::filesystem::path> folders);

std::string merge_text(const Merged&);

}  // namespace terrabench
