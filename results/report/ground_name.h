// Names for grounds that a claims file does not name: most are paths of DEMs, which can hold any character,
// and two of which can end in the same file name.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace terrabench {

// Part of file names and ids, at most 49 bytes: what can be kept of the file's name, and the start of a
// digest of the whole name, which tells grounds apart and is the same in every report: "alps-1f0c93ab". Only
// letters, digits, '_' and '-'.
std::string ground_id(std::string_view ground);

// For readers, one per ground, in the same order: the file's name, preceded by as many of its folders as tell
// it from the other grounds' files, and followed by what part of it was read: "alps.tif, its middle 257 ×
// 257". The grounds must differ. O(n² · length)
std::vector<std::string> ground_labels(std::span<const std::string> grounds);

// The text with the label wherever it has the ground's name, if that is a path or a DEM with options; other
// names stay.
std::string with_label(std::string text, std::string_view ground, std::string_view label);

}  // namespace terrabench
