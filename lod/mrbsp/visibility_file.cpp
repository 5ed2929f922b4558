#include "lod/mrbsp/visibility_file.h"

#include "lod/mrbsp/visibility_binary.h"
#include "lod/mrbsp/visibility_text.h"
#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;

// What the table differs in from the one asked for; empty when in nothing.
std::string_view difference(const VisibilityTable& table, const GroundGrid& ground, const BisectionTree& tree,
                            const VisibilityOptions& options) {
  if (table.surface != surface_checksum(ground, tree)) {
    return "its visibility was computed for other ground or another depth";
  }
  if (table.conservative != options.conservative) {
    return table.conservative ? "its sets are conservative, not sampled"
                              : "its sets are sampled, not conservative";
  }
  const VisibilityHead head = visibility_head(ground, tree, options);
  if (table.cells != head.cells) return "its visibility has other cells";
  if (table.depth != head.depth) return "its visibility has triangles of another coarseness";
  if (table.eye_height != options.eye_height) return "its visibility is for another eye height";
  return {};
}

}  // namespace

void write_visibility(const std::filesystem::path& path, const VisibilityTable& table) {
  if (path.extension() == ".txt") {
    const std::string text = visibility_text(table);
    if (text.size() > kLargestFile) {
      throw usage_error("so many changes are no text of 1 GiB", path.string(),
                        "give a name that does not end in .txt, or choose fewer cells");
    }
    write_file(path, text);
    return;
  }
  ByteSink file;
  save_visibility(table, file);
  write_file(path, file.bytes());
}

VisibilityTable read_visibility(const std::filesystem::path& path) {
  const std::string file = read_file(path, kLargestFile);
  if (path.extension() == ".txt") return parse_visibility(file, path.string());
  return load_visibility(std::as_bytes(std::span(file)), path.string());
}

VisibilityTable kept_visibility(const std::filesystem::path& path, const GroundGrid& ground,
                                const BisectionTree& tree, const VisibilityOptions& options,
                                Progress& progress) {
  std::error_code error;
  const bool there = std::filesystem::exists(path, error);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  // Before the sets are found, which takes long.
  if (error || (!there && !std::filesystem::is_directory(folder, error))) {
    throw environment_error("there is no such folder, or it cannot be read", folder.string(),
                            "name a file in a folder that there is");
  }
  if (!there) {
    VisibilityTable table = changes_of(find_visible(ground, tree, options, progress));
    write_visibility(path, table);
    return table;
  }
  VisibilityTable table = read_visibility(path);
  if (const std::string_view what = difference(table, ground, tree, options); !what.empty()) {
    throw usage_error(what, path.string(), "name another file, or remove this one to have it written anew");
  }
  return table;
}

}  // namespace terrabench
