#include "results/store/provenance.h"

#include <gmock/gmock.h>
#include <sched.h>

#include <algorithm>

#include "results/store/record_json.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

using testing::MatchesRegex;

TEST(ProvenanceTest, NamesCodeMachineAndCommand) {
  const Provenance p = collect_provenance({.command = {"terrabench", "run", "hybrid.*"},
                                           .gl_renderer = "llvmpipe",
                                           .simd = "AVX2",
                                           .threads = 3,
                                           .libraries = {{"Mine", "1.2"}, {"VTK", "other"}}});
  EXPECT_THAT(p.time, MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]T[0-2][0-9]:[0-5][0-9]:[0-6][0-9]Z"));
  EXPECT_EQ(p.command, "terrabench run 'hybrid.*'");
  EXPECT_THAT(p.git_revision, MatchesRegex("unknown|[0-9a-f]{40}"));
  EXPECT_FALSE(p.compiler.empty());
  EXPECT_THAT(p.flags, testing::HasSubstr("-std=c++20"));
  EXPECT_FALSE(p.cpu.empty());
  EXPECT_FALSE(p.os.empty());
  EXPECT_EQ(p.memory, physical_memory());
  EXPECT_EQ(p.threads, 3);
  EXPECT_EQ(p.simd, "AVX2");
  EXPECT_EQ(p.id, digest(p));
  const auto version = [&](std::string_view name) {
    const auto it =
        std::find_if(p.libraries.begin(), p.libraries.end(), [&](auto& l) { return l.first == name; });
    return it == p.libraries.end() ? "" : it->second;
  };
  EXPECT_EQ(version("Mine"), "1.2");
  EXPECT_EQ(version("VTK"), "other") << "the caller knows better";
  EXPECT_THAT(version("GDAL"), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(version("fmt"), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(ProvenanceTest, ThreadsDefaultToThoseThatTheProcessMayUse) {
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(collect_provenance({}).threads, CPU_COUNT(&before));
  CPU_ZERO(&one);
  for (std::size_t cpu = 0; CPU_COUNT(&one) == 0; ++cpu) {
    if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
  }
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(collect_provenance({}).threads, 1);
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

TEST(ProvenanceTest, IdChangesWithAnythingInIt) {
  Provenance p = collect_provenance({});
  const std::string id = p.id;
  p.git_dirty = !p.git_dirty;
  EXPECT_NE(digest(p), id);
}

TEST(ProvenanceTest, CommandsCanBePasted) {
  EXPECT_EQ(quote_command({"a", "b c", "", "it's", "$x", "--set=k=v"}),
            "a 'b c' '' 'it'\\''s' '$x' --set=k=v");
  EXPECT_EQ(quote_command({"a\tb\nit's\\",
                           "\xc2\x9b"
                           "31m",
                           "Łódź"}),
            "$'a\\x09b\\x0ait\\'s\\\\' $'\\xc2\\x9b31m' 'Łódź'");
}

}  // namespace
}  // namespace terrabench
