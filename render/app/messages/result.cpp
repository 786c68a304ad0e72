#include "render/app/messages/result.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

int first_error = 0;  // errno of the first failure

void note_error() {
    if (first_error == 0) first_error = errno != 0 ? errno : EIO;
}

void put(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) note_error();
}

}  // namespace

void print_result(std::string_view text) {
    put(visible(text, "\n\t"));
}

void print_exact(std::string_view text) {
    ::isatty(STDOUT_FILENO) != 0 ? print_result(text) : put(text);
}

void open_missing_streams() {
    // open() gives the lowest free number, and these are tried from the lowest on. Stdout is opened for
    // reading alone, so that printing fails as it does without a stdout.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0) [[maybe_unused]]
            const int opened = ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void close_results() {
    if (std::fflush(stdout) != 0) note_error();
    // `inspect ... | head` has read what it wanted.
    if (first_error != 0 && first_error != EPIPE)
        throw RunError(fmt::format("stdout: cannot be written: {}", std::strerror(first_error)));
}

int tell_folder(const FolderRun::Ended& ended, const FilmRequest& request) {
    if (ended.folder && request.to_stdout)
        std::fprintf(stderr, "%s\n", visible(ended.folder->string()).c_str());
    if (ended.folder && !request.to_stdout) print_exact(ended.folder->string() + "\n");
    return ended.exit_status;
}

}  // namespace grainreel
