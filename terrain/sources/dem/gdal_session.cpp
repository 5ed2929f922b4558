#include "terrain/sources/dem/gdal_session.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <string_view>

#include "terrain/printable.h"
#include "terrain/sources/dem/network.h"

namespace terrabench {
namespace {

// Formats that hold elevations, or pictures used as heights. All others are removed: drivers that fetch from
// the network or a database, vector formats, MEM, whose "file names" are addresses in memory, and FITS, whose
// library fetches URLs by itself.
constexpr std::string_view kFormats[] = {
    "AAIGrid", "ACE2",     "AIG",         "ARG",       "BAG",      "BLX",      "BMP",    "BT",
    "BYN",     "DTED",     "EHdr",        "ENVI",      "ERS",      "GIF",      "GPKG",   "GRIB",
    "GS7BG",   "GSAG",     "GSBG",        "GTX",       "GTiff",    "GXF",      "GenBin", "GRASSASCIIGrid",
    "HDF5",    "HF2",      "HFA",         "HDF5Image", "ILWIS",    "ISCE",     "ISG",    "ISIS2",
    "ISIS3",   "JDEM",     "JP2OpenJPEG", "JPEG",      "Leveller", "NGSGEOID", "NITF",   "NWT_GRD",
    "PCIDSK",  "PCRaster", "PDS",         "PDS4",      "PNG",      "PNM",      "RMF",    "ROI_PAC",
    "RRASTER", "RST",      "SAGA",        "SDTS",      "SGI",      "SIGDEM",   "SNODAS", "SRTMHGT",
    "TGA",     "Terragen", "USGSDEM",     "VICAR",     "VRT",      "WEBP",     "XYZ",    "ZMap",
    "Zarr",    "netCDF"};

// The cache of decoded blocks for all open files together. Reading proceeds block by block, so that a larger
// cache does not help.
constexpr GIntBig kBlockCache = GIntBig{64} << 20;

constexpr std::size_t kMostWarnings = 8, kLongestMessage = 300;

void register_drivers() {
  GdalMessages messages;  // a plugin that fails to load does not matter to the reader of a file
  // A raw file that is shorter than its header says must fail, not read as zeros.
  CPLSetConfigOption("RAW_CHECK_FILE_SIZE", "YES");
  CPLSetConfigOption("GDAL_ERROR_ON_LIBJPEG_WARNING", "YES");
  GDALAllRegister();
  GDALDriverManager* const manager = GetGDALDriverManager();
  for (int i = manager->GetDriverCount() - 1; i >= 0; --i) {
    GDALDriver* const driver = manager->GetDriver(i);
    if (std::find(std::begin(kFormats), std::end(kFormats), driver->GetDescription()) != std::end(kFormats))
      continue;
    manager->DeregisterDriver(driver);
    GDALDestroyDriver(driver);
  }
  guard_network();
  guard_text_grids();
  if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr) GDALSetCacheMax64(kBlockCache);
}

// One line of bounded length without control characters: messages quote the content of damaged files.
std::string tidy(const char* text) {
  std::string line = printable(text == nullptr ? "" : text);
  if (line.size() > kLongestMessage) line = line.substr(0, kLongestMessage) + "…";
  return line.empty() ? "GDAL gave no reason" : line;
}

}  // namespace

void register_gdal() {
  static std::once_flag once;
  std::call_once(once, register_drivers);
}

GdalMessages::GdalMessages() { CPLPushErrorHandlerEx(&GdalMessages::collect, this); }
GdalMessages::~GdalMessages() { CPLPopErrorHandler(); }

void GdalMessages::collect(CPLErr severity, CPLErrorNum, const char* text) {
  auto& messages = *static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
  // Errors in the database of reference systems affect the name of a reference system, not the heights.
  const bool about_place = text != nullptr && std::string_view(text).starts_with("PROJ:");
  if (severity >= CE_Failure && !about_place) {
    if (messages.first_failure_.empty()) messages.first_failure_ = tidy(text);
  } else if (severity >= CE_Warning && messages.warnings_.size() < kMostWarnings) {
    std::string warning = tidy(text);
    auto& known = messages.warnings_;
    if (std::find(known.begin(), known.end(), warning) == known.end()) known.push_back(std::move(warning));
  }
}

MachineError cannot_write(const std::filesystem::path& path, const std::string& why) {
  return MachineError(fmt::format("cannot write: {}", why), path.string(),
                      "check the folder's permissions and the space left on its disk");
}

}  // namespace terrabench
