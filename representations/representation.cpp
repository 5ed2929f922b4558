#include "representations/representation.h"

#include <algorithm>

#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {

void Representation::materials(Points where, std::span<Material> out) const {
  SpanSink sink;
  spans({where.x, where.z}, sink);
  for (std::size_t i = 0; i < where.size(); ++i) {
    const float y = where.y[i];
    const std::span<const Span> column = sink.column(i);
    const auto above =
        std::find_if(column.begin(), column.end(), [&](const Span& span) { return y < span.top; });
    out[i] = above != column.end() && above->bottom <= y ? above->material : Material::kAir;
  }
}

void Representation::edit(Columns, std::span<const Span>) {
  throw usage_error("this representation cannot be edited", "edit",
                    "choose an editable representation: see `terrabench list representations`");
}

std::int64_t destroy_and_count(std::unique_ptr<Representation> structure) {
  const std::int64_t before = HeapCounter::live();
  structure.reset();
  return before - HeapCounter::live();
}

}  // namespace terrabench
