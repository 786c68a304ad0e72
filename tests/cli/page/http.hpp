// A visitor of a page on this machine. It uses bare sockets, so it can also do what no browser does.
#pragma once

#include <string>
#include <string_view>

namespace grainreel::test {

class Visitor {
  public:
    explicit Visitor(int port);
    ~Visitor();
    Visitor(Visitor&& other) noexcept : socket_(other.socket_) { other.socket_ = -1; }
    Visitor(const Visitor&) = delete;
    Visitor& operator=(const Visitor&) = delete;

    bool send(std::string_view text) const;  // false once the other side has closed
    // Returns all that comes until the other side closes, nothing has come for so long (s), or so many bytes
    // have come.
    std::string receive(double seconds = 20, std::size_t most = std::size_t(1) << 30) const;

  private:
    int socket_ = -1;
};

struct HttpAnswer {
    int status = 0;  // 0: no status came
    std::string head, body;
};

HttpAnswer parsed(const std::string& received);
// host: value of the header; empty stands for "127.0.0.1:port". more: further header lines, each with its
// \r\n.
HttpAnswer get(int port, const std::string& path, const std::string& host = "", const std::string& more = "");

}  // namespace grainreel::test
