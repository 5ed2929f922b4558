#include "lod/mrbsp/visibility_file.h"

#include "lod/mrbsp/visibility_binary.h"
#include "lod/mrbsp/visibility_text.h"
#include "terrain/files.h"

namespace terrabench {

void write_visibility(const std::filesystem::path& path, const VisibilityTable& table) {
  if (path.extension() == ".txt") {
    write_file(path, visibility_text(table));
    return;
  }
  ByteSink file;
  save_visibility(table, file);
  write_file(path, file.bytes());
}

VisibilityTable read_visibility(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;
  const std::string file = read_file(path, kLargestFile);
  if (path.extension() == ".txt") return parse_visibility(file, path.string());
  return load_visibility(std::as_bytes(std::span(file)), path.string());
}

}  // namespace terrabench
