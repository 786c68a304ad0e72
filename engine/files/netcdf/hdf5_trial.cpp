#include "engine/files/netcdf/hdf5_trial.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {

namespace {

constexpr std::size_t superblock = 64;

std::string superblock_of(const std::filesystem::path& file) {
    std::string bytes(superblock, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

// Does the work in the child process, without our signal handlers, without a core file and with a time limit.
[[noreturn]] void work_alone(const std::function<void()>& work, unsigned seconds) {
    constexpr std::array<int, 6> signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM};
    for (const int signal : signals) ::signal(signal, SIG_DFL);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::alarm(seconds);
    try {
        work();
    } catch (...) {  // the parent gets the same exception when it does the work itself
    }
    ::_exit(0);
}

}  // namespace

std::mutex& hdf5_library() {
    static std::mutex one;
    return one;
}

bool is_hdf5(const std::filesystem::path& file) {
    return superblock_of(file).starts_with(kHdf5Signature);
}

// HDF5 file format specification, II.A: the superblock tells where the file ends.
void check_hdf5(const std::filesystem::path& file) {
    const std::string name = file.string(), head = superblock_of(file);
    if (head.size() < superblock) throw UserError("{}: is cut off within its first bytes", name);
    const int version = static_cast<unsigned char>(head[8]);
    if (version > 3)
        throw UserError("{}: byte 8: has the version {} of HDF5's superblock; 0 to 3 are read", name,
                        version);
    const int width = static_cast<unsigned char>(head[version < 2 ? 13 : 9]);
    if (width != 8) return;  // the library reports what is wrong with such a file
    const std::size_t place = version == 0 ? 40 : version == 1 ? 44 : 28;
    std::uint64_t end = 0;  // little-endian
    for (std::size_t i = 8; i-- > 0;) end = end << 8 | static_cast<unsigned char>(head[place + i]);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && end > size)
        throw UserError("{}: is cut off: it has {} bytes of {}; copy it again", name, size, end);
}

void try_in_child(const std::filesystem::path& file, const std::function<void()>& read_all) {
    constexpr std::uintmax_t least = 30, most = 3600, bytes_a_second = 5000000;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    const std::uintmax_t seconds = std::min(least + (error ? 0 : size) / bytes_a_second, most);
    const pid_t child = ::fork();
    if (child < 0) return;
    if (child == 0) work_alone(read_all, static_cast<unsigned>(seconds));
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        refuse_file(file, "is a damaged HDF5 file, on which the HDF5 library fails; copy it again");
}

}  // namespace grainreel
