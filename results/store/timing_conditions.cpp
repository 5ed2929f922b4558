#include "results/store/timing_conditions.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <thread>

#include "results/build_info.h"

namespace terrabench {
namespace {

// Of each processor's governor, the first that is not "performance".
std::string scaling_governor(int processors) {
  for (int i = 0; i < processors; ++i) {
    std::string governor;
    std::ifstream(fmt::format("/sys/devices/system/cpu/cpu{}/cpufreq/scaling_governor", i)) >> governor;
    if (!governor.empty() && governor != "performance") return governor;
  }
  return "";
}

// "200000 100000": microseconds allowed per period; "max 100000": no limit.
double control_group_quota() {
  double allowed = 0, period = 0;
  std::ifstream in("/sys/fs/cgroup/cpu.max");
  return in >> allowed >> period && period > 0 ? allowed / period : 0;
}

// A quarter of the processors busy with other work is enough to disturb work that uses all of them.
constexpr double kBusyShare = 0.25;

// The load is averaged over a minute, so that it is high after a build that has ended. Then what the machine
// does now is measured, while this process waits.
double busy_processors(int processors) {
  double load = 0;
  std::ifstream("/proc/loadavg") >> load;
  if (load <= kBusyShare * processors) return load;
  const auto now = [] {
    std::ifstream stat("/proc/stat");
    return read_ticks(stat);
  };
  const ProcessorTicks before = now();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const ProcessorTicks after = now();
  if (!(after.all > before.all)) return load;
  return processors * (after.busy - before.busy) / (after.all - before.all);
}

}  // namespace

ProcessorTicks read_ticks(std::istream& in) {
  std::string name;
  in >> name;  // cpu
  // user, nice, system, idle, waiting for a disk, interrupts, soft interrupts, taken by the host
  constexpr std::array kBusy{true, true, true, false, false, true, true, true};
  ProcessorTicks sum;
  for (const bool busy : kBusy) {
    double time = 0;
    if (!(in >> time)) return {};
    sum.all += time;
    if (busy) sum.busy += time;
  }
  return sum;
}

int allowed_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  return sched_getaffinity(0, sizeof allowed, &allowed) == 0
             ? std::max(1, CPU_COUNT(&allowed))
             : static_cast<int>(std::thread::hardware_concurrency());
}

TimingConditions read_timing_conditions() {
  TimingConditions now;
  now.build_type = kBuildType;
  now.flags = kFlags;
  now.processors = static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  now.busy = busy_processors(now.processors);
  now.allowed_processors = allowed_processors();
  now.quota = control_group_quota();
  now.governor = scaling_governor(now.processors);
  return now;
}

std::vector<std::string> timing_warnings(const TimingConditions& now) {
  std::vector<std::string> warnings;
  if (now.flags.find("-fsanitize=") != std::string::npos) {
    warnings.emplace_back("this build has sanitizers: times are several times those of a release build");
  } else if (now.flags.find("-O2") == std::string::npos && now.flags.find("-O3") == std::string::npos) {
    warnings.push_back(fmt::format(
        "this build ({}) is not optimised: times are many times those of a release build", now.build_type));
  }
  if (now.busy > kBusyShare * now.processors) {
    warnings.push_back(
        fmt::format("the machine is busy (other work uses {:.2g} of {} processors): times are longer",
                    now.busy, now.processors));
  }
  if (!now.governor.empty()) {
    warnings.push_back(fmt::format(
        "the processor scales its frequency (governor '{}', not 'performance'): times vary", now.governor));
  }
  if (now.quota > 0 && now.quota < now.allowed_processors) {
    warnings.push_back(
        fmt::format("the control group allows {:.2g} of {} processors: threads are paused, times vary",
                    now.quota, now.allowed_processors));
  }
  return warnings;
}

}  // namespace terrabench
