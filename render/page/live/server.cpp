#include "render/page/live/server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <microhttpd.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {

namespace {

constexpr unsigned most_connections = 256;
constexpr unsigned longest_silence = 20;          // s until a silent connection is closed
constexpr std::size_t most_header_bytes = 16384;  // memory of a connection, which holds a request's headers
// An answer stays in memory until its visitor has received it, which may take long. So the number of large
// answers at one time is limited.
constexpr std::size_t large_answer = 65536;  // bytes from which an answer is large
constexpr int most_large_answers = 64;

struct Held {
    std::shared_ptr<const std::string> body;
    std::atomic<int>* count;  // counts the large answers; null for a small one
};

void let_go(void* held) {
    const std::unique_ptr<Held> answer(static_cast<Held*>(held));
    if (answer->count != nullptr) --*answer->count;
}

std::string header_of(MHD_Connection* connection, const char* name) {
    const char* value = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
    return value != nullptr ? value : "";
}

// How many headers of a request have this name, which is given in lower case.
std::size_t count_of(MHD_Connection* connection, std::string_view name) {
    struct Count {
        std::string_view name;
        std::size_t times;
    } count{name, 0};
    const auto take = [](void* all, MHD_ValueKind, const char* key, const char*) {
        auto& to = *static_cast<Count*>(all);
        to.times += same_word(key, to.name) ? 1 : 0;
        return MHD_YES;
    };
    MHD_get_connection_values(connection, MHD_HEADER_KIND, take, &count);
    return count.times;
}

}  // namespace

WatchAnswer text_answer(unsigned status, std::string text) {
    WatchAnswer answer;
    answer.status = status;
    answer.body = std::make_shared<const std::string>(std::move(text));
    return answer;
}

struct WatchServer::Impl {
    std::function<WatchAnswer(const WatchRequest&)> answer;
    std::atomic<int> large_answers{0};
    MHD_Daemon* daemon = nullptr;

    MHD_Result queue(MHD_Connection* connection, const WatchAnswer& answer_now) {
        MHD_Response* response = made(answer_now);
        if (response == nullptr) return MHD_NO;
        MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, answer_now.type.c_str());
        // The page may not load anything from other servers or send anything to them, and no other page may
        // embed it.
        MHD_add_response_header(response, "Content-Security-Policy",
                                "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
                                "img-src 'self' data: blob:; media-src 'self' blob:; connect-src 'self'; "
                                "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
        MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
        MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
        MHD_add_response_header(response, "Cross-Origin-Resource-Policy", "same-origin");
        MHD_add_response_header(response, MHD_HTTP_HEADER_CACHE_CONTROL, "no-store");
        for (const auto& [name, value] : answer_now.headers)
            MHD_add_response_header(response, name.c_str(), value.c_str());
        const MHD_Result result = MHD_queue_response(connection, answer_now.status, response);
        MHD_destroy_response(response);
        return result;
    }

    MHD_Response* made(const WatchAnswer& answer_now) {
        if (answer_now.file >= 0) return MHD_create_response_from_fd64(answer_now.file_size, answer_now.file);
        auto held = std::make_unique<Held>(Held{answer_now.body, nullptr});
        if (!held->body) held->body = std::make_shared<const std::string>();
        if (held->body->size() > large_answer) {
            held->count = &large_answers;
            ++large_answers;
        }
        auto* bytes = const_cast<char*>(held->body->data());  // libmicrohttpd only reads them
        const std::size_t size = held->body->size();
        Held* const given = held.release();
        MHD_Response* response =
            MHD_create_response_from_buffer_with_free_callback_cls(size, bytes, let_go, given);
        if (response == nullptr) let_go(given);
        return response;
    }

    // Called when the headers have come. The answer is given at once; the rest of the request is ignored.
    MHD_Result handle(MHD_Connection* connection, const char* url, std::string_view method) {
        if (method != "GET" && method != "HEAD") {
            WatchAnswer refused =
                text_answer(MHD_HTTP_METHOD_NOT_ALLOWED, "This page is for reading alone.\n");
            refused.headers = {{"Allow", "GET, HEAD"}, {"Connection", "close"}};
            return queue(connection, refused);
        }
        if (large_answers >= most_large_answers) {
            WatchAnswer busy = text_answer(MHD_HTTP_SERVICE_UNAVAILABLE, "Too many visitors at once.\n");
            busy.headers = {{"Retry-After", "2"}};
            return queue(connection, busy);
        }
        if (count_of(connection, "host") > 1)
            return queue(connection, text_answer(MHD_HTTP_BAD_REQUEST, "This request names two hosts.\n"));
        WatchRequest request;
        request.path = url;
        request.host = header_of(connection, "Host");
        request.cookies = header_of(connection, "Cookie");
        if (const char* key = MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, "key"))
            request.key = key;
        return queue(connection, answer(request));
    }

    static MHD_Result handler(void* self, MHD_Connection* connection, const char* url, const char* method,
                              const char*, const char*, std::size_t*, void**) {
        try {
            return static_cast<Impl*>(self)->handle(connection, url, method);
        } catch (const std::exception&) {
            return MHD_NO;  // ends the connection; the visitor may try again
        }
    }
};

WatchServer::WatchServer(Listening listening, std::function<WatchAnswer(const WatchRequest&)> answer)
    : impl_(std::make_unique<Impl>()) {
    impl_->answer = std::move(answer);
    const int socket = listening.release();
    impl_->daemon =
        MHD_start_daemon(MHD_USE_EPOLL_INTERNAL_THREAD, 0, nullptr, nullptr, &Impl::handler, impl_.get(),
                         MHD_OPTION_LISTEN_SOCKET, socket, MHD_OPTION_CONNECTION_LIMIT, most_connections,
                         MHD_OPTION_CONNECTION_TIMEOUT, longest_silence, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
                         most_header_bytes, MHD_OPTION_END);
    if (impl_->daemon == nullptr) {
        ::close(socket);
        throw RunError("watch: the server cannot be started");
    }
}

WatchServer::~WatchServer() {
    MHD_stop_daemon(impl_->daemon);
}

namespace {

constexpr int waiting_at_most = 64;  // largest number of connections that are not accepted yet

struct FreeAddresses {
    void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Addresses addresses_of(const std::string& host, int port) {
    addrinfo wanted{};
    wanted.ai_family = AF_UNSPEC;
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const int code = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
    if (code != 0)
        throw UserError("--watch-host {}: no such host ({}); give a name or an address of this machine", host,
                        ::gai_strerror(code));
    return Addresses(found);
}

[[noreturn]] void refuse(const std::string& host, int port, int why) {
    if (why == EADDRINUSE)
        throw UserError("port {}: another program has it; give another one, or 0 for any that is free", port);
    if (why == EACCES)
        throw UserError("port {}: only the system's own programs may have it; give one above 1023", port);
    throw UserError("--watch-host {}: cannot be listened at: {}; give an address of this machine", host,
                    std::strerror(why));
}

bool is_any(const sockaddr* address) {
    if (address->sa_family == AF_INET)
        return reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr == htonl(INADDR_ANY);
    return address->sa_family == AF_INET6 &&
           IN6_IS_ADDR_UNSPECIFIED(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr);
}

}  // namespace

Listening::Listening(const std::string& host, int port) {
    const Addresses addresses = addresses_of(host, port);
    if (is_any(addresses->ai_addr))
        throw UserError("--watch-host {}: stands for every address; name the one that the others are to use",
                        host);
    socket_ = ::socket(addresses->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0) refuse(host, port, errno);
    const int yes = 1;
    ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (::bind(socket_, addresses->ai_addr, addresses->ai_addrlen) != 0 ||
        ::listen(socket_, waiting_at_most) != 0) {
        const int why = errno;
        ::close(std::exchange(socket_, -1));
        refuse(host, port, why);
    }
    look();
}

Listening::Listening(int socket) : socket_(socket) {
    int listens = 0;
    socklen_t size = sizeof listens;
    if (::getsockopt(socket, SOL_SOCKET, SO_ACCEPTCONN, &listens, &size) != 0 || listens == 0) {
        socket_ = -1;
        throw UserError("--socket {}: is no socket that listens", socket);
    }
    look();
}

Listening::~Listening() {
    if (socket_ >= 0) ::close(socket_);
}

Listening::Listening(Listening&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), port_(other.port_), loopback_(other.loopback_) {}

int Listening::release() {
    return std::exchange(socket_, -1);
}

void Listening::look() {
    sockaddr_storage bound{};
    socklen_t size = sizeof bound;
    if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&bound), &size) != 0) return;
    if (bound.ss_family == AF_INET) {
        const auto* address = reinterpret_cast<const sockaddr_in*>(&bound);
        port_ = ntohs(address->sin_port);
        loopback_ = (ntohl(address->sin_addr.s_addr) >> 24) == 127;
    } else {
        const auto* address = reinterpret_cast<const sockaddr_in6*>(&bound);
        port_ = ntohs(address->sin6_port);
        loopback_ = IN6_IS_ADDR_LOOPBACK(&address->sin6_addr) != 0;
    }
}

namespace {

constexpr std::array<std::pair<std::string_view, const char*>, 10> types{{
    {".html", "text/html; charset=utf-8"},
    {".csv", "text/csv; charset=utf-8"},
    {".toml", "text/plain; charset=utf-8"},
    {".txt", "text/plain; charset=utf-8"},
    {".json", "application/json"},
    {".mp4", "video/mp4"},
    {".webm", "video/webm"},
    {".png", "image/png"},
    {".gif", "image/gif"},
    {".nc", "application/x-netcdf"},
}};

bool is_plain_name(std::string_view name) {
    return !name.empty() && name.front() != '.' && name.find('/') == std::string_view::npos &&
           name.find('\0') == std::string_view::npos;
}

}  // namespace

WatchAnswer run_file(const std::filesystem::path& folder, const std::string& path) {
    const auto none = [] { return text_answer(404, "There is no such file in the run's folder.\n"); };
    const std::string name = path.empty() ? path : path.substr(1);
    if (!is_plain_name(name)) return none();
    const int place = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (place < 0) return none();
    const int file = ::openat(place, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    ::close(place);
    if (file < 0) return none();
    struct stat about {};
    if (::fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) {
        ::close(file);
        return none();
    }
    WatchAnswer answer;
    answer.file = file;
    answer.file_size = static_cast<std::uint64_t>(about.st_size);
    answer.type = "application/octet-stream";
    for (const auto& [end, type] : types)
        if (name.ends_with(end)) answer.type = type;
    return answer;
}

}  // namespace grainreel
