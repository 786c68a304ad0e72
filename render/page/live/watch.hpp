// Shows a run while it goes, to browsers on this machine or, when asked to, on others.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/run/folder/listener.hpp"
#include "render/page/live/live_run.hpp"
#include "render/page/live/server.hpp"

namespace grainreel {

struct WatchPlace {
    std::string host = "127.0.0.1";  // that visitors use
    std::optional<int> port;         // without one: the usual one, or any that is free
};

// Throws UserError when the place cannot be had.
Listening listen_at(const WatchPlace& place);

struct WatchTask {
    std::filesystem::path run;
    std::string host;
    Listening listening;
    int until =
        -1;  // a descriptor: once its other end is closed the run has ended, and so does this soon after
};

// Tells `listener` the address, and shows the run until a signal comes, or until the run is over where
// `until` says so. Returns the exit status: 0; 1 when the folder has gone; 128 + the signal.
int watch_run(WatchTask request, const Planner& planner, RunListener& listener);

}  // namespace grainreel
