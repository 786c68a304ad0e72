#include "render/page/live/server.hpp"

#include <microhttpd.h>
#include <unistd.h>

#include <atomic>
#include <string_view>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

constexpr unsigned most_connections = 256;
constexpr unsigned longest_silence = 20;          // s, until a connection is cut off
constexpr std::size_t most_header_bytes = 16384;  // of a request, and of what is remembered of it
// An answer is held as long as the slowest visitor takes. Of large ones there are no more than so many at
// once.
constexpr std::size_t large_answer = 65536;  // bytes
constexpr int most_large_answers = 64;

struct Held {
    std::shared_ptr<const std::string> body;
    std::atomic<int>* count;  // of large answers; null for a small one
};

void let_go(void* held) {
    const std::unique_ptr<Held> answer(static_cast<Held*>(held));
    if (answer->count != nullptr) --*answer->count;
}

std::string header_of(MHD_Connection* connection, const char* name) {
    const char* value = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
    return value != nullptr ? value : "";
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
        // Nothing of the page may come from elsewhere or go there, and nobody may put it into a page of
        // theirs.
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
        auto* bytes = const_cast<char*>(held->body->data());  // which libmicrohttpd only reads
        const std::size_t size = held->body->size();
        Held* const given = held.release();
        MHD_Response* response =
            MHD_create_response_from_buffer_with_free_callback_cls(size, bytes, let_go, given);
        if (response == nullptr) let_go(given);
        return response;
    }

    // Called when the headers are there. The answer is given at once, so that whatever else a request has is
    // cut off.
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
            return MHD_NO;  // ends the connection; the next one may fare better
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

unsigned WatchServer::connections() const {
    const MHD_DaemonInfo* info = MHD_get_daemon_info(impl_->daemon, MHD_DAEMON_INFO_CURRENT_CONNECTIONS);
    return info != nullptr ? info->num_connections : 0;
}

}  // namespace grainreel
