#include "terrain/sources/dem/network.h"

#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_virtual.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <string_view>
#include <vector>

namespace terrabench {
namespace {

std::atomic<bool> network_allowed = false;

// File systems of this machine; all others are taken for remote ones.
constexpr std::string_view kLocal[] = {
    "/vsimem/",   "/vsizip/",   "/vsigzip/",   "/vsitar/", "/vsisubfile/", "/vsisparse/", "/vsicached?",
    "/vsistdin/", "/vsistdin?", "/vsistdout/", "/vsi7z/",  "/vsirar/",     "/vsicrypt/"};

class RefusingFileSystem : public VSIFilesystemHandler {
 public:
  VSIVirtualHandle* Open(const char* path, const char*, bool, CSLConstList) override {
    refuse(path);
    return nullptr;
  }
  int Stat(const char* path, VSIStatBufL*, int) override {
    refuse(path);
    return -1;
  }

 private:
  static void refuse(const char* path) {
    CPLError(CE_Failure, CPLE_OpenFailed, "%s would be fetched from the network; --allow-network permits it",
             path);
  }
};

}  // namespace

void allow_network() { network_allowed = true; }

void guard_network() {
  if (network_allowed) return;
  // Never freed: GDAL's table of file systems refers to the first to the end of the process, and what it had
  // before must stay reachable.
  static auto* const refusing = new RefusingFileSystem;
  static auto* const replaced = new std::vector<VSIFilesystemHandler*>;
  const auto replace = [&](const std::string& prefix) {
    replaced->push_back(VSIFileManager::GetHandler(prefix.c_str()));
    VSIFileManager::InstallHandler(prefix, refusing);
  };
  const CPLStringList prefixes(VSIGetFileSystemsPrefixes());
  for (int i = 0; i < prefixes.size(); ++i) {
    std::string prefix = prefixes[i];
    if (std::ranges::find(kLocal, prefix) != std::end(kLocal)) continue;
    replace(prefix);
    // The form with options, /vsicurl?url=…, which the list leaves out.
    prefix.back() = '?';
    replace(prefix);
  }
}

}  // namespace terrabench
