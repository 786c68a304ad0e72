// Shows a run while it goes, to browsers on this machine or, when asked to, on others; and decides who may
// look.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

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

// Who may look: by the name under which the page is asked for, and, where others than this machine can reach
// it, by a key.

class Visitors {
  public:
    // host: the name that the page is asked for under. keyed: whether it takes a key.
    Visitors(std::string host, int port, bool keyed);

    // Whether a Host header names this page. One that does not comes from a page of somebody else's whose
    // name leads here.
    bool knows_host(std::string_view header) const;

    bool keyed() const { return keyed_; }
    // "http://host:port/", with the key that is good now.
    std::string address() const;
    // Takes the key: what the visitor is known by from then on. A key is good once; there is a new one then.
    std::optional<std::string> admit(std::string_view key);
    // Whether a Cookie header has what one was admitted by.
    bool admitted(std::string_view cookies) const;

  private:
    std::string host_;
    int port_;
    bool keyed_;
    std::string key_;
    std::deque<std::string> tokens_;
};

inline constexpr const char* kCookie = "grainreel";

}  // namespace grainreel
