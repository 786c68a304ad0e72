// Shows a run while it is computed, to browsers on this machine or, if asked for, on others; and decides who
// may look.
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
    std::string host = "127.0.0.1";  // host name that visitors use
    std::optional<int> port;         // none: the usual port, or any free one
};

// Opens a socket at this place. Throws UserError when that is not possible.
Listening listen_at(const WatchPlace& place);

struct WatchTask {
    std::filesystem::path run;
    std::string host;
    Listening listening;
    // File descriptor of a pipe whose other end is closed when the run ends; watching then ends soon. -1:
    // none.
    int until = -1;
};

// Tells `listener` the address, and shows the run until a signal comes or, with `until`, until the run is
// over. Returns the exit status: 0; 1 when the folder is gone; 128 + the signal's number.
int watch_run(WatchTask request, const Planner& planner, Listener& listener);

// Decides who may look: by the host name in the request and, if other machines can reach the page, by a key.
class Visitors {
  public:
    // host: the name under which visitors ask for the page. keyed: whether a key is needed.
    Visitors(std::string host, int port, bool keyed);

    // Whether a Host header names this page. A request with another name comes from a foreign page whose name
    // was made to resolve to this machine (DNS rebinding).
    bool knows_host(std::string_view header) const;

    bool keyed() const { return keyed_; }
    // "http://host:port/", with the key that is good now.
    std::string address() const;
    // Takes a key and returns the text by which the visitor is known from then on, or none for a wrong key. A
    // key works once; then there is a new one.
    std::optional<std::string> admit(std::string_view key);
    // Whether a Cookie header has a text that admit() returned.
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
