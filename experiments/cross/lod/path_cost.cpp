#include "experiments/cross/lod/path_cost.h"

#include "experiments/stopwatch.h"
#include "terrain/memory.h"

namespace terrabench::cross {

PathCost fly(const Flight& flight, const Contender& method, double knob, Progress& progress) {
  PathCost cost;
  cost.times.reserve(flight.views.size());
  cost.triangles.reserve(flight.views.size());
  const HeapScope heap;
  Stopwatch watch;
  const std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
  cost.build_time = watch.seconds();
  lod->tune(knob);
  watch = {};
  cost.first_uploaded = lod->update(flight.views.front()).stats.bytes_sent();
  cost.first_update_time = watch.seconds();
  for (std::size_t i = 1; i < flight.views.size(); ++i) {
    watch = {};
    const Frame& frame = lod->update(flight.views[i]);
    cost.times.push_back(watch.seconds());
    cost.triangles.push_back(static_cast<double>(frame.stats.triangles));
    cost.uploaded += static_cast<double>(frame.stats.bytes_sent());
  }
  cost.uploaded /= static_cast<double>(cost.times.size());
  cost.bytes_held = lod->memory().total();  // first: waits for threads that still allocate
  cost.heap_growth = heap.held();
  return cost;
}

}  // namespace terrabench::cross
