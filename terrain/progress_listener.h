// Receives progress in place of the terminal, as a window does.
#pragma once

#include <functional>
#include <string_view>

namespace terrabench {

// What is being done, and its share that is done, 0 to 1. Called from any thread, about ten times per second.
using ProgressListener = std::function<void(std::string_view what, double share)>;

// From now on, every Progress with Output::kTerminal tells this instead of writing to standard error; null:
// writes again. To be called while no such work is being done.
void listen_to_progress(ProgressListener);

}  // namespace terrabench
