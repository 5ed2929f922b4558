// Tables of spans: any text is read or refused with an Error, and what was read is a table.
#include <cmath>
#include <cstdlib>

#include "representations/export/span_table.h"
#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terrabench;
  try {
    const SpanTable table = parse_spans({reinterpret_cast<const char*>(data), size}, "fuzz");
    if (table.x.size() != table.spans.size() || table.z.size() != table.spans.size()) std::abort();
    for (const Span& span : table.spans) {
      if (!(span.bottom < span.top) || !std::isfinite(span.bottom) || !std::isfinite(span.top)) std::abort();
      if (span.material == Material::kAir) std::abort();
    }
    (void)heights_of(table, {5, 4, -1, 30, 0.5, 30, {}});
  } catch (const Error&) {
  }
  return 0;
}

std::vector<std::vector<std::uint8_t>> fuzz_seeds() {
  const std::string head = std::string(terrabench::kSpanHeader) + "\n";
  std::vector<std::vector<std::uint8_t>> seeds;
  for (const std::string& text : {head, head + "0,30,211.5,236,1\n0.5,30,-1e-3,7,2\r\n0.5,60,7,8.25,255"}) {
    seeds.emplace_back(text.begin(), text.end());
  }
  return seeds;
}
