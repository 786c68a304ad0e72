// The live page of a run that this process computes, by a process of its own: what visitors do slows the run
// no more than another program would, and its files are read as by anybody.
#pragma once

#include <sys/types.h>
#include <filesystem>
#include <string>

#include "render/app/messages/reporter.hpp"
#include "render/page/live/server.hpp"

namespace grainreel {

class WatchChild {
  public:
    // Throws RunError when no process can be made.
    WatchChild(const std::filesystem::path& run, const std::string& host, Listening listening,
               const ReporterOptions& report);
    // The run is over: waits until the visitors have heard it, which takes some seconds at most.
    ~WatchChild();
    WatchChild(const WatchChild&) = delete;
    WatchChild& operator=(const WatchChild&) = delete;

  private:
    pid_t process_ = -1;
    int alive_ = -1;  // our end of a pipe, which closes with us
};

}  // namespace grainreel
