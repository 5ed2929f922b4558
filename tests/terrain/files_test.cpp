#include "terrain/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/terrain/small_files.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Files, WriteMakesFoldersAndReplacesWholeFiles) {
  const TemporaryFolder folder;
  write_file(folder / "a/b/c.txt", "first, and longer");
  write_file(folder / "a/b/c.txt", "second");
  EXPECT_EQ(read_file(folder / "a/b/c.txt"), "second");
  write_file(folder / "empty", "");
  EXPECT_EQ(read_file(folder / "empty"), "");
}

TEST(Files, AFailedWriteLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  write_file(folder / "kept.txt", "old");
  const Failure failure =
      failure_with_small_files(100'000, [&] { write_file(folder / "kept.txt", std::string(1 << 20, 'x')); });
  EXPECT_EQ(failure.code, ExitCode::kEnvironment);
  EXPECT_THAT(failure.what, HasSubstr("kept.txt"));
  EXPECT_EQ(read_file(folder / "kept.txt"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("kept.txt"));
}

TEST(Files, AnUnwritableTargetIsAnEnvironmentError) {
  const TemporaryFolder folder;
  write_file(folder / "file", "x");
  std::filesystem::create_directory(folder / "folder");
  write_file(folder / "folder/inside", "x");
  // Below a file, over a folder, in a file system that takes nothing.
  for (const std::string& path :
       {folder / "file/below", folder / "folder", std::string("/proc/terrabench/x")}) {
    const Failure failure = failure_of([&] { write_file(path, "content"); });
    EXPECT_EQ(failure.code, ExitCode::kEnvironment) << path;
    EXPECT_FALSE(failure.advice.empty());
  }
  EXPECT_THAT(folder.names(), testing::UnorderedElementsAre("file", "folder"));
}

TEST(Files, ReadRefusesMissingFoldersAndLargeFiles) {
  const TemporaryFolder folder;
  folder.write("ten", "0123456789");
  EXPECT_EQ(read_file(folder / "ten", 10), "0123456789");
  for (const auto& call : std::vector<std::function<void()>>{
           [&] { (void)read_file(folder / "none"); }, [&] { (void)read_file(folder.path()); },
           [&] { (void)read_file(folder / "ten", 9); }, [&] { (void)read_file("/dev/zero"); }}) {
    EXPECT_EQ(failure_of(call).code, ExitCode::kBadInput);
  }
}

TEST(Files, BytesComeBackAsTheyWerePut) {
  ByteSink sink;
  sink.put(std::uint8_t{7});
  sink.put(3.25);
  sink.put_text("höhe");
  const std::vector<std::uint16_t> values{1, 2, 65535};
  sink.put_array(std::span<const std::uint16_t>(values));
  ByteSource source(sink.bytes(), "memory");
  EXPECT_EQ(source.get<std::uint8_t>(), 7);
  EXPECT_EQ(source.get<double>(), 3.25);
  EXPECT_EQ(source.get_text(), "höhe");
  EXPECT_EQ(source.get_array<std::uint16_t>(3), values);
  EXPECT_EQ(source.left(), 0U);
  EXPECT_TRUE(source.get_array<std::uint16_t>(0).empty());
}

TEST(Files, NothingIsReadPastTheEnd) {
  ByteSink sink;
  sink.put(std::uint32_t{0xFFFFFFFF});  // also the length of a text that is not there
  const auto fails = [&](auto&& read) {
    ByteSource source(sink.bytes(), "stack.bin");
    const Failure failure = failure_of([&] { read(source); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput);
    EXPECT_THAT(failure.what, HasSubstr("stack.bin"));
    EXPECT_THAT(failure.what, HasSubstr("at byte"));
  };
  fails([](ByteSource& s) { (void)s.get<std::uint64_t>(); });
  fails([](ByteSource& s) { (void)s.get_text(); });
  fails([](ByteSource& s) { (void)s.get_array<std::uint8_t>(5); });
  // Counts whose bytes overflow 64 bits.
  fails([](ByteSource& s) { (void)s.get_array<std::uint64_t>(std::uint64_t{1} << 61); });
  fails([](ByteSource& s) { (void)s.get_array<std::uint32_t>(~std::uint64_t{0}); });
}

TEST(Files, ChecksumIsXxh3) {
  // The published value for no input.
  EXPECT_EQ(checksum(std::string_view()), "99aa06d3014798d86001c324468d497f");
  EXPECT_NE(checksum("a"), checksum("b"));
}

}  // namespace
}  // namespace terrabench
