#include "validation/support/machine.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "parallel/threads.hpp"

namespace treejet {

namespace {

struct Use {
  double all = 0, busy = 0, own = 0;
};

Use use() {
  Use u;
  std::ifstream file("/proc/stat");
  std::string word;
  file >> word;
  constexpr int idle = 3, waiting = 4, fields = 8;  // user nice system idle iowait irq softirq steal
  double ticks;
  for (int k = 0; k < fields && file >> ticks; ++k) {
    u.all += ticks / double(sysconf(_SC_CLK_TCK));
    if (k != idle && k != waiting) u.busy += ticks / double(sysconf(_SC_CLK_TCK));
  }
  for (int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage r;
    getrusage(who, &r);
    u.own += double(r.ru_utime.tv_sec + r.ru_stime.tv_sec) +
             1e-6 * double(r.ru_utime.tv_usec + r.ru_stime.tv_usec);
  }
  return u;
}

}  // namespace

ProcessorUse::ProcessorUse() {
  const Use u = use();
  all_ = u.all, busy_ = u.busy, own_ = u.own;
}

double ProcessorUse::by_others() const {
  const Use u = use();
  return u.all > all_ ? std::max(0.0, (u.busy - busy_ - (u.own - own_)) / (u.all - all_)) : 0;
}

std::vector<int> cores_apart() {
  const CoreSet mine = cores_of_this_process();
  std::set<std::string> seen;
  std::vector<int> cores;
  for (std::size_t id = 0; id < mine.size(); ++id) {
    if (!mine[id]) continue;
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", id));
    std::string siblings;
    if (!(file >> siblings)) siblings = fmt::format("{}", id);
    if (seen.insert(siblings).second) cores.push_back(static_cast<int>(id));
  }
  return cores;
}

int physical_cores() {
  return std::max(1, static_cast<int>(cores_apart().size()));
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

std::string cores_of(const Ranks& ranks) {
  const CoreSet mine = cores_of_this_process();
  std::size_t low = 0, high = mine.size() - 1;
  while (low < high && !mine[low]) ++low;
  while (high > low && !mine[high]) --high;
  const double own[] = {double(low), double(high)};
  const std::vector<double> ends = ranks.of_all(own);
  std::string text;
  for (std::size_t k = 0; k < ends.size(); k += 2) {
    if (k > 0) text += ",";
    text += ends[k] == ends[k + 1] ? fmt::format("{}", ends[k]) : fmt::format("{}-{}", ends[k], ends[k + 1]);
  }
  return text;
}

double peak_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;)
    if (word == "VmHWM:") {
      double kilobytes;
      file >> kilobytes;
      return 1024 * kilobytes;
    }
  return std::nan("");
}

}  // namespace treejet
