#include "engine/scene/file/scene_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/shipped/shipped_scenes.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_of_a_path = 400;  // characters, in a message

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
    throw UserError(fmt::format("{}: {}", excerpt(file.string(), most_of_a_path), what));
}

std::string advice_for_missing(const std::filesystem::path& file) {
    const std::optional<std::string> meant = nearest_shipped_scene(file.filename().string());
    return meant ? fmt::format("did you mean the shipped scene '{}'?", *meant)
                 : "give the path of a scene file (.toml)";
}

// Whether it is a pipe.
bool check_kind(const std::filesystem::path& file, Pipes pipes) {
    using Type = std::filesystem::file_type;
    std::error_code ignored;
    switch (std::filesystem::status(file, ignored).type()) {
        case Type::regular:
            return false;
        case Type::fifo:
            if (pipes == Pipes::taken) return true;
            fail(file, "this is a pipe; give the path of an ordinary file");
        case Type::directory:
            fail(file, "this is a folder; give the path of a scene file (.toml)");
        case Type::not_found:
            fail(file, "there is no such file; " + advice_for_missing(file));
        case Type::none:
        case Type::unknown:
            fail(file, "cannot be read; check its permissions");
        default:
            fail(file, "this is a device; give the path of a scene file (.toml)");
    }
}

struct Closing {
    int file;
    ~Closing() { ::close(file); }
};

// Until something comes through the pipe, or it ends. Whoever wants the program to stop is heard meanwhile.
void wait_for(const std::filesystem::path& file, int pipe) {
    pollfd waiting{pipe, POLLIN, 0};
    if (::poll(&waiting, 1, -1) < 0) fail(file, "this is a pipe, and waiting for it was stopped");
}

}  // namespace

std::string load_scene_file(const std::filesystem::path& file, Pipes pipes) {
    const bool pipe = check_kind(file, pipes);
    const int open = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (open < 0) fail(file, "cannot be read; check its permissions");
    const Closing closing{open};
    std::string text;
    char part[1 << 16];
    while (true) {
        if (pipe) wait_for(file, open);
        const ssize_t got = ::read(open, part, sizeof part);
        if (got == 0) return text;
        if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
        if (got < 0) fail(file, "cannot be read; check its permissions");
        text.append(part, static_cast<std::size_t>(got));
        if (text.size() > largest_scene_file)
            fail(file,
                 fmt::format("is larger than the {} MiB that a scene may have; give the path of a scene "
                             "file (.toml)",
                             largest_scene_file >> 20));
    }
}

}  // namespace grainreel
