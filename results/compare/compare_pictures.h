// Compares the pictures of two results folders, or of any two folders of PNG and WebP files: whether they are
// the same file, and if not, by PSNR and SSIM (terrain/metrics/image_error.h). A PNG file and a WebP file of
// one name are two files of one picture. Plots and previews of a report are not
// among them: `report` makes them anew from the records and the pictures.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "results/store/store.h"

namespace terrabench {

// What two pictures must reach to count as close: decibels, and mean structural similarity from -1 to 1.
struct PictureLimits {
  double psnr = 40, ssim = 0.99;
};

enum class PictureChange {
  kNotCompared,  // two sizes, a missing or damaged file, or not the one that its record names
  kDiffers,      // below a limit
  kClose,        // other bytes, at or above both limits
  kIdentical,    // the same bytes
  kOnlyBefore,
  kOnlyAfter,
};
std::string_view name(PictureChange);

struct ComparedPicture {
  std::string file;             // relative to the folder before, or after if only there
  std::string file_after = {};  // of both: relative to the folder after
  PictureChange change = PictureChange::kNotCompared;
  std::string reason = "";       // why it was not compared
  std::array<int, 2> size = {};  // width and height; of kDiffers and kClose, as the rest
  double psnr = 0, ssim = 0;     // PSNR is infinite where all pixels are equal
  std::size_t differing = 0;     // pixels
};

struct PictureComparison {
  PictureLimits limits;
  std::vector<ComparedPicture>
      pictures;  // by `change`, the least PSNR first, then the least SSIM, then by name

  std::size_t count(PictureChange) const;
  bool passed() const { return count(PictureChange::kNotCompared) + count(PictureChange::kDiffers) == 0; }
};

// The pictures that the records of each name. O(pixels), on all threads; in memory at a time are a small pair
// of pictures per thread, or one pair of more than 4 million pixels. Throws environment_error when memory
// does not suffice for such a pair.
PictureComparison compare_pictures(const Store& before, const Store& after, const PictureLimits& = {});
// All *.png and *.webp of both folders and of the folders in them. Throws bad_input when the folders have
// none of the same name.
PictureComparison compare_pictures(const std::filesystem::path& before, const std::filesystem::path& after,
                                   const PictureLimits& = {});

// The comparison in words: a line for every picture that is not identical in both.
std::string pictures_text(const PictureComparison&, bool colour);
std::string pictures_json(const PictureComparison&);  // an object

}  // namespace terrabench
