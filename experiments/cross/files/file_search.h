// The best files of a type: of all its settings, those whose file is small and close to the ground.
//
// One search with a number of builds, the same for all types. The settings are what RepresentationType::
// file_knobs says, the resolution, and the error that encode() may add. A quarter of the builds spreads over
// all settings evenly (Roberts 2018). Then two builds for each error that is an aim have the ground's own
// resolution and the type's default settings, and pass the error to encode() or to the type's knobs. The rest
// take the aims by turns: each builds the best file nearest to its aim again, finer or coarser by the factor
// by which it misses, some with all settings varied. Every file is written, read back and compared.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "experiments/cross/representations/scenes.h"

namespace terrabench::cross {

struct BuiltFile {
  Parameters parameters;
  double within = 0;      // metres that encode() may add
  std::size_t bytes = 0;  // on disk
  // Of what the file gives back. Heights in metres at every sample; of a solid its tops on the lines.
  double largest = 0, rmse = 0;
  double volume_error = 0;  // 1 - IoU
};

// Builds, saves and loads; `bytes`: on disk.
std::unique_ptr<Representation> through_file(const Scene&, const RepresentationType&, const Parameters&,
                                             double within, std::size_t& bytes, Progress&);

using FileError = double BuiltFile::*;
// Those of which no other has both fewer bytes and less error, the smallest first. O(n log n).
std::vector<BuiltFile> best_files(std::vector<BuiltFile>, FileError);
// The smallest within an error, and the closest within bytes; null if there is none.
const BuiltFile* smallest_within(const std::vector<BuiltFile>&, FileError, double most);
const BuiltFile* closest_within(const std::vector<BuiltFile>&, FileError, double most_bytes);

// The smallest file within an error, or the closest one within bytes.
struct FileAim {
  enum Of { kError, kBytes } of;
  FileError error;
  double most;  // of the error, or bytes
};

// All files that were made; settings that the type refuses are builds without a file. The same for every
// number of threads.
std::vector<BuiltFile> search_files(const Scene&, const RepresentationType&, int builds,
                                    std::span<const FileAim> aims, Progress&);

}  // namespace terrabench::cross
