// The server of the live page: its socket, HTTP for reading alone (GET and HEAD, by libmicrohttpd, on a
// thread of its own), and files of the run's folder that visitors may have.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace grainreel {

// The socket at which a run is shown.

inline constexpr int kUsualWatchPort = 8422;

class Listening {
  public:
    // host: a name or an address of this machine. port: 0 for any that is free. Throws UserError where
    // another program has the port, or the machine no such address.
    Listening(const std::string& host, int port);
    // A socket that listens already, which another process made for this one.
    explicit Listening(int socket);
    ~Listening();
    Listening(Listening&& other) noexcept;
    Listening& operator=(Listening&&) = delete;

    int socket() const { return socket_; }
    int release();  // the caller's from then on
    int port() const { return port_; }
    bool is_loopback() const { return loopback_; }  // nobody but this machine can reach it

  private:
    void look();  // at what the socket is bound to

    int socket_ = -1, port_ = 0;
    bool loopback_ = true;
};

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

// A file of a run's folder, for whoever asks for it by name. path: of the request, "/measures.csv". 404 for
// all that is no plain file right in the folder: paths, hidden files, links, folders.
WatchAnswer run_file(const std::filesystem::path& folder, const std::string& path);

}  // namespace grainreel
