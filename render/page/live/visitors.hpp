// Who may look: by the name under which the page is asked for, and, where others than this machine can reach
// it, by a key.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace grainreel {

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
