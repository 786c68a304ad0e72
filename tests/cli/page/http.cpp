// A visitor of a page on this machine, by bare sockets.
#include "tests/cli/page/http.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/format.h>

namespace grainreel::test {

Visitor::Visitor(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0) {
        ::close(socket_);
        socket_ = -1;
    }
}

Visitor::~Visitor() {
    if (socket_ >= 0) ::close(socket_);
}

bool Visitor::send(std::string_view text) const {
    while (!text.empty()) {
        const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
        if (sent <= 0) return false;
        text.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

std::string Visitor::receive(double seconds, std::size_t most) const {
    std::string all;
    if (socket_ < 0) return all;  // nobody listens
    std::array<char, 65536> part;
    while (all.size() < most) {
        pollfd ready{socket_, POLLIN, 0};
        if (::poll(&ready, 1, static_cast<int>(1000 * seconds)) <= 0) break;
        const ssize_t got = ::recv(socket_, part.data(), std::min(part.size(), most - all.size()), 0);
        if (got <= 0) break;
        all.append(part.data(), static_cast<std::size_t>(got));
    }
    return all;
}

HttpAnswer parsed(const std::string& received) {
    const std::size_t end = received.find("\r\n\r\n");
    if (end == std::string::npos || !received.starts_with("HTTP/1.1 ")) return {};
    return {std::atoi(received.c_str() + 9), received.substr(0, end + 2), received.substr(end + 4)};
}

HttpAnswer get(int port, const std::string& path, const std::string& host, const std::string& more) {
    const Visitor visitor(port);
    visitor.send(fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\n{}Connection: close\r\n\r\n", path,
                             host.empty() ? fmt::format("127.0.0.1:{}", port) : host, more));
    return parsed(visitor.receive());
}

}  // namespace grainreel::test
