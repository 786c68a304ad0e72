// The server of the live page: its socket, read-only HTTP (GET and HEAD, by libmicrohttpd, on a thread of its
// own), and the files of the run's folder that visitors may have.
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
    // host: a name or an address of this machine. port: 0 for any free one. Throws UserError when another
    // program has the port, or the machine has no such address.
    Listening(const std::string& host, int port);
    // Takes a socket that listens already, which another process made for this one.
    explicit Listening(int socket);
    ~Listening();
    Listening(Listening&& other) noexcept;
    Listening& operator=(Listening&&) = delete;

    int socket() const { return socket_; }
    int release();  // the socket is the caller's from then on
    int port() const { return port_; }
    bool is_loopback() const { return loopback_; }  // only this machine can reach it

  private:
    void look();  // finds the address to which the socket is bound

    int socket_ = -1, port_ = 0;
    bool loopback_ = true;
};

struct WatchRequest {
    std::string path;           // decoded, without the query
    std::string host, cookies;  // values of these headers; empty without them
    std::string key;            // key in the query
};

struct WatchAnswer {
    unsigned status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::shared_ptr<const std::string> body;  // shared by all visitors who get it
    int file = -1;                            // a file descriptor instead of a body; the server closes it
    std::uint64_t file_size = 0;
    std::vector<std::pair<std::string, std::string>> headers;
};

WatchAnswer text_answer(unsigned status, std::string text);

class WatchServer {
  public:
    // answer: called on the server's thread; it must not wait for anything. Throws RunError when the server
    // cannot be started.
    WatchServer(Listening listening, std::function<WatchAnswer(const WatchRequest&)> answer);
    ~WatchServer();  // closes the connections that are still open
    WatchServer(const WatchServer&) = delete;
    WatchServer& operator=(const WatchServer&) = delete;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The answer with a file of a run's folder. path: the path of the request, "/measures.csv". The answer is 404
// for anything but a plain file directly in the folder: for paths, hidden files, links and folders.
WatchAnswer run_file(const std::filesystem::path& folder, const std::string& path);

}  // namespace grainreel
