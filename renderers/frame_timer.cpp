#include "renderers/frame_timer.h"

#include <chrono>
#include <cstdint>

#include "renderers/gl.h"

namespace terrabench {
namespace {

double wall_time(const std::function<void(int)>& draw, int frame) {
  const auto begin = std::chrono::steady_clock::now();
  draw(frame);
  glFinish();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Queries of all frames are kept and read at the end: reading one at once would stall the next frame.
std::vector<double> query_times(int first, int frames, const std::function<void(int)>& draw) {
  const std::vector<TimeQuery> queries(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    glBeginQuery(GL_TIME_ELAPSED, queries[static_cast<std::size_t>(i)].id());
    draw(first + i);
    glEndQuery(GL_TIME_ELAPSED);
    glFlush();
  }
  std::vector<double> seconds;
  for (const TimeQuery& query : queries) {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &nanoseconds);
    seconds.push_back(1e-9 * static_cast<double>(nanoseconds));
  }
  return seconds;
}

}  // namespace

FrameClock frame_clock(const GlContext& context) {
  return context.software() ? FrameClock::kWall : FrameClock::kTimerQueries;
}

std::vector<double> time_frames(FrameClock clock, int warm_up, int frames,
                                const std::function<void(int)>& draw) {
  for (int i = 0; i < warm_up; ++i) draw(i);
  glFinish();
  std::vector<double> seconds;
  if (clock == FrameClock::kTimerQueries) {
    seconds = query_times(warm_up, frames, draw);
  } else {
    for (int i = 0; i < frames; ++i) seconds.push_back(wall_time(draw, warm_up + i));
  }
  check_gl("timing frames");
  return seconds;
}

}  // namespace terrabench
