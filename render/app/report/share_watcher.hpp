// Watches what tells its share done: charts and benches. Shows it with the time left, and says whether to go
// on.
#pragma once

#include <chrono>
#include <string>

#include "render/app/report/reporter.hpp"
#include "render/app/report/stop_signal.hpp"

namespace grainreel {

class ShareWatcher {
  public:
    ShareWatcher(Reporter& reporter, Progress::Stage stage)
        : reporter_(reporter), stage_(stage), begin_(std::chrono::steady_clock::now()) {}

    // done: 0 to 1. False after a signal to stop.
    bool operator()(const std::string& what, double done) const {
        Progress progress;
        progress.stage = stage_;
        progress.what = what;
        progress.done = done;
        progress.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        if (done > 0.02) progress.remaining = progress.elapsed * (1 - done) / done;
        reporter_.progress(progress);
        return stop_signal() == 0;
    }

  private:
    Reporter& reporter_;
    Progress::Stage stage_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace grainreel
