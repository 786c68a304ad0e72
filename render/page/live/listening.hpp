// The socket at which a run is shown.
#pragma once

#include <string>

namespace grainreel {

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

}  // namespace grainreel
