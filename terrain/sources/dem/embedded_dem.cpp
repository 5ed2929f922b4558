#include "terrain/sources/dem/embedded_dem.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <mutex>

#include "terrain/embedded.h"

namespace terrabench {

std::span<const EmbeddedFile> embedded_dems();  // what terrabench_embed generates

std::string embedded_dem(std::string_view name) {
  constexpr std::string_view kFolder = "/vsimem/terrabench-dems";
  static std::once_flag once;
  std::call_once(once, [&] {
    for (const auto& [path, bytes] : embedded_dems()) {
      const std::string file = fmt::format("{}{}", kFolder, path.substr(path.rfind('/')));
      // GDAL takes the bytes as writable; read_dem() opens files for reading only.
      VSIFCloseL(VSIFileFromMemBuffer(file.c_str(), reinterpret_cast<GByte*>(const_cast<char*>(bytes.data())),
                                      bytes.size(), FALSE));
    }
  });
  return fmt::format("{}/{}.tif", kFolder, name);
}

}  // namespace terrabench
