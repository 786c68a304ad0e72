// HTTP for reading alone: GET and HEAD, by libmicrohttpd, on a thread of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/page/live/listening.hpp"

namespace grainreel {

struct WatchRequest {
    std::string path;           // decoded, without the question
    std::string host, cookies;  // of the headers; empty without them
    std::string key;            // of the question
};

struct WatchAnswer {
    unsigned status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::shared_ptr<const std::string> body;  // shared by all who get it
    int file = -1;                            // in place of a body: a descriptor, which the server closes
    std::uint64_t file_size = 0;
    std::vector<std::pair<std::string, std::string>> headers;
};

WatchAnswer text_answer(unsigned status, std::string text);

class WatchServer {
  public:
    // answer: called on the server's thread; it may not wait for anything. Throws RunError.
    WatchServer(Listening listening, std::function<WatchAnswer(const WatchRequest&)> answer);
    ~WatchServer();  // cuts off who is still there
    WatchServer(const WatchServer&) = delete;
    WatchServer& operator=(const WatchServer&) = delete;

    unsigned connections() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel
