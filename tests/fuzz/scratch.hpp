// The folder of this process for files that readers are to open. It lies in memory where there is /dev/shm,
// and goes with the process.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace grainreel::fuzz {

class Scratch {
  public:
    Scratch() {
        const std::filesystem::path memory = "/dev/shm";
        std::error_code none;
        std::string name =
            ((std::filesystem::is_directory(memory, none) ? memory : std::filesystem::temp_directory_path()) /
             "grainreel-fuzz-XXXXXX")
                .string();
        if (::mkdtemp(name.data()) == nullptr) std::abort();
        path_ = name;
        maker_ = ::getpid();
        // Indices and imports go with it too.
        ::setenv("XDG_CACHE_HOME", path_.c_str(), 1);
    }
    ~Scratch() {
        if (::getpid() != maker_) return;  // a child of a reader ended
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    // The same file, with other content each time. It is as old as if it had been there for an hour: readers
    // wait a little for the rest of what was written a moment ago.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        const std::filesystem::path file = path_ / name;
        std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        std::filesystem::last_write_time(
            file, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
        return file;
    }

  private:
    std::filesystem::path path_;
    ::pid_t maker_ = 0;
};

inline const Scratch& scratch() {
    static const Scratch one;
    return one;
}

}  // namespace grainreel::fuzz
