#include "terrain/sources/dem/network.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_virtual.h>
#include <gdal_priv.h>
#include <ogr_srs_api.h>

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

void refuse(const char* name) {
  CPLError(CE_Failure, CPLE_OpenFailed, "%s would be fetched from the network; --allow-network permits it",
           name);
}

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
};

void refuse_file_systems() {
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

// For what GDAL fetches without a file system, such as a reference system given by its URL.
CPLHTTPResult* refuse_fetch(const char* url, CSLConstList, GDALProgressFunc, void*, CPLHTTPFetchWriteFunc,
                            void*, void*) {
  refuse(url);
  auto* const result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  result->nStatus = 1;
  result->pszErrBuf = CPLStrdup("refused");
  return result;
}

GDALDataset* (*open_netcdf)(GDALOpenInfo*) = nullptr;

// Whether "://" stands in the name. Quotes and backslashes do not count: GDAL and libnetcdf take them out.
bool names_url(const char* name) {
  constexpr std::string_view kMark = "://";
  std::size_t matched = 0;
  for (; *name != '\0'; ++name) {
    if (*name == '"' || *name == '\\') continue;
    matched = *name == kMark[matched] ? matched + 1 : *name == kMark[0] ? 1 : 0;
    if (matched == kMark.size()) return true;
  }
  return false;
}

// libnetcdf itself fetches URLs, by DAP or HTTP and past GDAL's file systems.
GDALDataset* open_local_netcdf(GDALOpenInfo* info) {
  if (!names_url(info->pszFilename)) return open_netcdf(info);
  // Any other URL may be meant for another driver.
  if (STARTS_WITH_CI(info->pszFilename, "NETCDF:")) refuse(info->pszFilename);
  return nullptr;
}

void refuse_remote_netcdf() {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("netCDF");
  if (driver == nullptr) return;
  open_netcdf = driver->pfnOpen;
  driver->pfnOpen = open_local_netcdf;
}

}  // namespace

void allow_network() { network_allowed = true; }

void guard_network() {
  if (network_allowed) return;
  refuse_file_systems();
  refuse_remote_netcdf();
  CPLHTTPSetFetchCallback(refuse_fetch, nullptr);
  OSRSetPROJEnableNetwork(FALSE);  // grids of datum shifts
}

}  // namespace terrabench
