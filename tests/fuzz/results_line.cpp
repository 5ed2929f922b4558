// Lines of measurements.jsonl: any bytes are read or refused with an Error, and what is read can be written
// again.
#include <string>
#include <string_view>

#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

using terrabench::Line;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Line line = terrabench::parse_line(fuzz_text(data, size), "fuzz");
    const std::string again =
        std::visit([](const auto& content) { return terrabench::to_line(content); }, line.content);
    if (terrabench::parse_line(again, "again").altered) std::abort();
  } catch (const terrabench::Error&) {
  }
  return 0;
}

FuzzSeeds fuzz_seeds() {
  terrabench::Record record;
  record.experiment = "e";
  record.case_name = "c";
  record.profile = "quick";
  record.run = "0123";
  record.parameters = {{"n", std::int64_t{3}}, {"x", 0.5}, {"on", true}, {"s", record.profile}};
  record.metrics = {{"m", "s", {1, 2.5, 1e-300}}};
  record.figures = {{"p.F1", "figures/p.F1.png", "caption", "0123"}};
  terrabench::Provenance run;
  run.libraries = {{"GDAL", "3.6.2"}};
  FuzzSeeds seeds;
  for (const std::string& line : {terrabench::to_line(record), terrabench::to_line(run)}) {
    seeds.emplace_back(line.begin(), line.end());
  }
  return seeds;
}
