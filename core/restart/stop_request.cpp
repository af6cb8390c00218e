#include "core/restart/stop_request.hpp"

#include <algorithm>
#include <csignal>
#include <limits>

namespace treejet {

namespace {

volatile std::sig_atomic_t caught = 0;

extern "C" void catch_signal(int signal) {
  caught = signal;
}

/// Unless whoever started us has it ignored: a shell does so with SIGINT for what runs in the background.
void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  if (action.sa_handler == SIG_IGN) return;
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

/// Part of the wall time, and seconds at the most, kept for a checkpoint that takes longer than all before.
constexpr double reserve = 0.02, most_reserve = 60;

}  // namespace

StopSignals::StopSignals(const Setting& setting) : setting_(setting) {
  for (int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2, SIGHUP, SIGXCPU}) handle(signal, catch_signal);
  handle(SIGXFSZ, SIG_IGN);  // the failed write tells, by name of the file
  handle(SIGPIPE, SIG_IGN);  // the files are worth more than the table that nobody reads any more
  if (!setting_.checkpoint && !setting_.walltime) next_save_ = std::numeric_limits<double>::infinity();
}

StopRequest StopSignals::stop_request() {
  if (caught != 0) return StopRequest::stop;
  if (!setting_.checkpoint && !setting_.walltime) return StopRequest::go_on;
  if (--to_look_ > 0) return StopRequest::go_on;
  const StopRequest stop_request = look_at_clock();
  if (stop_request == StopRequest::save) stride_ = 1;  // the next look is to see how long that took
  to_look_ = stride_;
  return stop_request;
}

StopRequest StopSignals::look_at_clock() {
  constexpr double looks_apart = 0.01;  // s
  constexpr int most_steps = 256;       // by then a look costs nothing
  const auto now = Clock::now();
  const double since = seconds(now - last_look_), elapsed = seconds(now - started_);
  last_look_ = now;
  if (saving_) {  // the interval counts from the end of a save, however long that took
    saving_ = false;
    next_save_ = elapsed + setting_.checkpoint.value_or(std::numeric_limits<double>::infinity());
  }
  longest_ = std::max(longest_, since);
  stride_ = since < looks_apart ? std::min(2 * stride_, most_steps) : std::max(stride_ / 2, 1);
  if (setting_.walltime) {
    const double left = *setting_.walltime - elapsed;
    if (left < 2 * longest_ + std::min(reserve * *setting_.walltime, most_reserve)) return StopRequest::stop;
  }
  if (elapsed < next_save_) return StopRequest::go_on;
  saving_ = true;
  return StopRequest::save;
}

std::string StopSignals::reason() const {
  switch (caught) {
    case SIGTERM:
      return "SIGTERM";
    case SIGINT:
      return "SIGINT";
    case SIGUSR1:
      return "SIGUSR1";
    case SIGUSR2:
      return "SIGUSR2";
    case SIGHUP:
      return "SIGHUP";
    case SIGXCPU:
      return "SIGXCPU";
    default:
      return setting_.walltime ? "walltime" : "a signal to another process";
  }
}

}  // namespace treejet
