// Starts the program of an unpacked archive, after a look whether all of its files are there. It is linked
// statically: it can still speak when libraries of the archive are missing. It needs no locale and no C++
// library.
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace {

constexpr int bad_archive = 2;
constexpr int longest_path = 4096;
constexpr const char* program_name = "lib/grainreel/grainreel";
// Rights that are looked for apart from access(), which finds that root may do anything.
constexpr mode_t may_read = S_IRUSR | S_IRGRP | S_IROTH, may_run = S_IXUSR | S_IXGRP | S_IXOTH;

struct Path {
    char text[longest_path];
};

[[noreturn]] void stop(const char* text) {
    std::fprintf(stderr, "error: %s\n", text);
    ::_exit(bad_archive);
}

// The folder above bin/, with all links resolved.
Path archive_folder() {
    Path folder{};
    const ssize_t size = ::readlink("/proc/self/exe", folder.text, sizeof folder.text - 1);
    if (size <= 0) stop("/proc/self/exe cannot be read; mount /proc");
    for (int level = 0; level < 2; ++level)
        if (char* const last = std::strrchr(folder.text, '/')) *last = '\0';
    return folder;
}

Path inside(const Path& folder, const char* name) {
    Path path{};
    const int size = std::snprintf(path.text, sizeof path.text, "%s/%s", folder.text, name);
    if (size < 0 || size >= longest_path)
        stop("the path of this archive is too long; unpack it in another folder");
    return path;
}

[[noreturn]] void incomplete(const Path& folder, const char* name, const char* what) {
    static char text[3 * longest_path];
    std::snprintf(text, sizeof text, "%s: %s %s; unpack the archive again", folder.text, name, what);
    stop(text);
}

// Whether the list was not cut off: its last line is "end". Goes back to its begin.
bool is_whole(std::FILE* list) {
    constexpr char end[] = "end\n";
    constexpr std::size_t size = sizeof end - 1;
    char last[size]{};
    const bool whole = std::fseek(list, -static_cast<long>(size), SEEK_END) == 0 &&
                       std::fread(last, 1, size, list) == size && std::memcmp(last, end, size) == 0;
    std::rewind(list);
    return whole;
}

// Each line of the list has a file's size in bytes and its path in the archive.
void check_files(const Path& folder) {
    constexpr const char* list = "share/grainreel/files";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> lines(std::fopen(inside(folder, list).text, "re"),
                                                                std::fclose);
    if (!lines) incomplete(folder, list, "is missing");
    if (!is_whole(lines.get())) incomplete(folder, list, "is not whole");
    static char line[longest_path];
    while (std::fgets(line, sizeof line, lines.get())) {
        line[std::strcspn(line, "\n")] = '\0';
        if (std::strcmp(line, "end") == 0) return;
        long long size = 0;
        int start = 0;
        if (std::sscanf(line, "%lld %n", &size, &start) != 1) break;
        const char* const name = line + start;
        struct stat facts {};
        if (::stat(inside(folder, name).text, &facts) != 0) incomplete(folder, name, "is missing");
        if (facts.st_size != size) incomplete(folder, name, "is not whole");
        if ((facts.st_mode & may_read) == 0 || ::access(inside(folder, name).text, R_OK) != 0)
            incomplete(folder, name, "may not be read");
        if (std::strcmp(name, program_name) == 0 && (facts.st_mode & may_run) == 0)
            incomplete(folder, name, "may not be run");
    }
    incomplete(folder, list, "is not whole");
}

}  // namespace

int main(int, char** words) {
    const Path folder = archive_folder();
    check_files(folder);
    const Path program = inside(folder, program_name);
    ::execv(program.text, words);
    if (errno == ENOENT)  // the program is there, but the loader of glibc that it names is not
        stop("this system has no glibc; grainreel's archive needs Debian 12, or a Linux with a glibc as new");
    static char text[2 * longest_path];
    std::snprintf(text, sizeof text,
                  "%s: cannot be started: %s; move the folder to a disk that programs may run from",
                  program.text, std::strerror(errno));
    stop(text);
}
