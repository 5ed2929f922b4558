// DEMs that must not be believed: one that names files on the network, and text grids with words in them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>

#include "terrain/sources/dem/dem.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/raster_file.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

// Listens on a port of this machine. It hangs up on every caller at once, so that none waits for an answer.
class Listener {
 public:
  Listener() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(socket_, 4), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { hang_up(); });
  }
  ~Listener() {
    shutdown(socket_, SHUT_RDWR);  // ends accept()
    thread_.join();
    close(socket_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int port() const { return port_; }
  bool was_called() const { return called_; }

 private:
  void hang_up() {
    for (int caller; (caller = accept(socket_, nullptr, nullptr)) >= 0; close(caller)) called_ = true;
  }

  int socket_, port_ = 0;
  std::atomic<bool> called_ = false;
  std::thread thread_;
};

std::string vrt_of(const std::string& source, int width = 4, int depth = 4) {
  return fmt::format(
      "<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\"><GeoTransform>0,1,0,0,0,-1</GeoTransform>"
      "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename>{}</SourceFilename>"
      "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>",
      width, depth, source);
}

std::string grid(const std::string& values) {
  return "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n" + values;
}

// Reads the name itself and a .vrt that has it as its source; both must fail without a call. Returns what the
// first failure says.
std::string refused(const std::string& name, const Listener& listener) {
  const TemporaryFolder folder;
  const Failure direct = failure_of([&] { (void)read_dem(name); });
  EXPECT_EQ(direct.code, ExitCode::kBadInput) << name;
  const std::string path = folder.write("a.vrt", vrt_of(name));
  EXPECT_EQ(failure_of([&] { (void)read_dem(path); }).code, ExitCode::kBadInput) << name;
  EXPECT_FALSE(listener.was_called()) << name;
  return direct.what;
}

TEST(DemTrust, NoNetworkByAFileSystem) {
  const Listener listener;
  const std::string url = fmt::format("http://127.0.0.1:{}/a.tif", listener.port());
  for (const char* const prefix : {"/vsicurl/", "/vsicurl_streaming/", "/vsicurl?url="}) {
    EXPECT_THAT(refused(prefix + url, listener), HasSubstr("--allow-network"));
  }
  refused("/vsizip//vsicurl/" + url, listener);  // says only that there is no such archive
}

TEST(DemTrust, NoNetworkByAFormat) {
  const Listener listener;
  const std::string host = fmt::format("127.0.0.1:{}", listener.port());
  for (const std::string& name :
       {"NETCDF:\"http://" + host + "/x\":z", "netcdf:http://" + host + "/x",
        "NETCDF:\"[mode=dap4]http://" + host + "/x\":z", "NETCDF:\"http:\"\"//" + host + "/x\":z"}) {
    EXPECT_THAT(refused(name, listener), HasSubstr("--allow-network"));
  }
  refused("FITS:\"http://" + host + "/x\":1", listener);
  refused("http://" + host + "/x.nc", listener);
}

TEST(DemTrust, NoNetworkByAReferenceSystem) {
  const Listener listener;
  const TemporaryFolder folder;
  const std::string text = folder.write("a.asc", grid("1 2 3\n4 5 6\n"));
  const std::string path = folder.write(
      "a.vrt",
      fmt::format("<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\" subClass=\"VRTWarpedDataset\">"
                  "<VRTRasterBand dataType=\"Float32\" band=\"1\" subClass=\"VRTWarpedRasterBand\"/>"
                  "<GDALWarpOptions><SourceDataset>{}</SourceDataset><Transformer><ReprojectionTransformer>"
                  "<SourceSRS>http://127.0.0.1:{}/a</SourceSRS><TargetSRS>EPSG:4326</TargetSRS>"
                  "</ReprojectionTransformer></Transformer></GDALWarpOptions></VRTDataset>",
                  text, listener.port()));
  const Failure failure = failure_of([&] { (void)read_dem(path); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, HasSubstr("--allow-network"));
  EXPECT_FALSE(listener.was_called());
}

TEST(DemTrust, NetcdfOfThisMachineIsRead) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.nc";
  RasterFile file = metres();
  file.format = "netCDF";
  file.write(path);
  expect_ramp(read_dem(path).heights, 6, 4);
  expect_ramp(read_dem("NETCDF:\"" + path + "\":Band1").heights, 6, 4);
}

TEST(DemTrust, WordInATextGridIsNoHeight) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.asc", grid("1 2 3\n4 five 6\n"));
  const Failure failure = failure_of([&] { (void)read_dem(path); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, HasSubstr("a.asc:8:3"));
  EXPECT_THAT(failure.what, HasSubstr("'five'"));
  for (const char* const values : {"1 2 3\n4 5x 6\n", "1 2 3\n4 5 --6\n", "a 2 3\n4 5 6\n"}) {
    const std::string other = folder.write("b.asc", grid(values));
    EXPECT_EQ(failure_of([&] { (void)read_dem(other); }).code, ExitCode::kBadInput) << values;
  }
}

TEST(DemTrust, WordInATextGridBehindAVirtualFileIsNoHeight) {
  const TemporaryFolder folder;
  const std::string text = folder / "a.asc";
  const std::string virtual_file = folder.write("a.vrt", vrt_of(text, 3, 2));
  const std::string nested = folder.write("b.vrt", vrt_of(virtual_file, 3, 2));
  for (const std::string& path : {virtual_file, nested, "vrt://" + text + "?bands=1"}) {
    folder.write("a.asc", grid("1 2 3\n4 5 6\n"));
    EXPECT_EQ(read_dem(path).heights.at(1, 1), 5.0F) << path;
    folder.write("a.asc", grid("1 2 3\n4 five 6\n"));
    const Failure failure = failure_of([&] { (void)read_dem(path); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << path;
    EXPECT_THAT(failure.what, HasSubstr("a.asc:8:3: 'five'"));
  }
}

TEST(DemTrust, WordsForNoHeightAreVoids) {
  const TemporaryFolder folder;
  const std::string header = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n";
  // Among whole numbers and others, at the beginning or elsewhere, declared or not.
  for (const char* const no_data :
       {"", "NODATA_value -9999\n", "NODATA_value nan\n", "NODATA_value null\n"}) {
    for (const char* const word : {"nan", "NaN", "-nan", "null", "NULL", "NA", "n/a"}) {
      for (const char* const form : {"{} 2 3\n4 5 6\n", " {} 2 3\n4 5 6\n", "1 2 3\n4 {} 6\n",
                                     "1.5 2 3\n4 5 {}\n", "{0} 2 3\n{0} 5 {0}"}) {
        const std::string text = header + no_data + fmt::format(fmt::runtime(form), word);
        const Heightfield field = read_dem(folder.write("a.asc", text)).heights;
        const std::size_t voids = form[1] == '0' ? 3 : 1;
        EXPECT_EQ(height_range(field).no_data, voids) << text;
        EXPECT_GE(height_range(field).lowest, 1) << text;
        EXPECT_EQ(field.cell_x, 10) << text;
      }
    }
  }
  EXPECT_THAT(folder.names(), testing::ElementsAre("a.asc"));
}

TEST(DemTrust, AGridWithWordsKeepsItsReferenceSystem) {
  const TemporaryFolder folder;
  OGRSpatialReference utm;
  utm.importFromEPSG(kUtm33);
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT1_ESRI", nullptr};
  ASSERT_EQ(utm.exportToWkt(&text, options), OGRERR_NONE);
  folder.write("a.prj", text);
  CPLFree(text);
  const Dem dem = read_dem(folder.write("a.asc", grid("null 2 3\n4 5 null\n")));
  EXPECT_EQ(height_range(dem.heights).no_data, 2U);
  EXPECT_THAT(dem.heights.georeference.crs, HasSubstr("UTM"));
}

TEST(DemTrust, EveryWayToWriteANumberIsRead) {
  const TemporaryFolder folder;
  for (const char* const values : {"1 2 3\n4 5 6\n", "+1 2.0 3e0 4\r\n5 6", "1,5 2 3\n4 5 6\n",
                                   "1 2 3 -9999 5 6\n", "  1\t2 3\n\n4 5 .6e+1\n"}) {
    const std::string path = folder.write("a.asc", grid(values));
    const Dem dem = read_dem(path);
    EXPECT_EQ(dem.heights.heights.size(), 6U) << values;
  }
}

}  // namespace
}  // namespace terrabench
