#include "viewer/history.h"

namespace terrabench::viewer {

void History::add(const FrameSample& sample) {
  samples_.push_back(sample);
  while (samples_.front().at < sample.at - kSeconds) samples_.pop_front();
}

}  // namespace terrabench::viewer
