// DEMs that must not be believed: one that names files on the network, and text grids with words in them.
#include <cpl_conv.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "terrain/sources/dem/dem.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

// Listens on a port of this machine.
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
  }
  ~Listener() { close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int port() const { return port_; }
  bool was_called() const {
    pollfd waiting{socket_, POLLIN, 0};
    return poll(&waiting, 1, 100) > 0;
  }

 private:
  int socket_, port_ = 0;
};

std::string vrt_of(const std::string& source) {
  return fmt::format(
      "<VRTDataset rasterXSize=\"4\" rasterYSize=\"4\"><GeoTransform>0,1,0,0,0,-1</GeoTransform>"
      "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename>{}</SourceFilename>"
      "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>",
      source);
}

TEST(DemTrust, NoNetworkFromAFile) {
  const CPLConfigOptionSetter no_long_wait("GDAL_HTTP_TIMEOUT", "1", false);
  const Listener listener;
  const TemporaryFolder folder;
  const std::string url = fmt::format("http://127.0.0.1:{}/a.tif", listener.port());
  for (const std::string& source :
       {"/vsicurl/" + url, "/vsicurl_streaming/" + url, "/vsicurl?url=" + url, "/vsizip//vsicurl/" + url}) {
    const std::string path = folder.write("a.vrt", vrt_of(source));
    const Failure failure = failure_of([&] { (void)read_dem(path); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << source;
    const Failure direct = failure_of([&] { (void)read_dem(source); });
    EXPECT_EQ(direct.code, ExitCode::kBadInput) << source;
    if (source.starts_with("/vsizip/")) continue;  // says only that there is no such archive
    EXPECT_THAT(direct.what, HasSubstr("--allow-network")) << source;
  }
  EXPECT_FALSE(listener.was_called());
}

std::string grid(const std::string& values) {
  return "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n" + values;
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
