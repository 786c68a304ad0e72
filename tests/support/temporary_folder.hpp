// An empty folder for one test, which is removed afterwards, and files in it.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace grainreel::test {

inline std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void write_text(const std::filesystem::path& path, std::string_view text) {
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}

// Writes a file that seems an hour old, so that no reader waits for the rest of it.
inline void write_old_text(const std::filesystem::path& path, std::string_view text) {
    write_text(path, text);
    std::filesystem::last_write_time(path,
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
}

class TemporaryFolder {
  public:
    enum class Where { disk, memory };  // memory: /dev/shm, or the disk where that is missing

    explicit TemporaryFolder(Where where = Where::disk) {
        const std::filesystem::path shared = "/dev/shm";
        std::error_code ignored;
        const bool in_memory = where == Where::memory && std::filesystem::is_directory(shared, ignored);
        std::string name =
            (in_memory ? shared : std::filesystem::temp_directory_path()) / "grainreel-test-XXXXXX";
        if (::mkdtemp(name.data()) == nullptr) std::abort();
        path_ = name;
    }
    ~TemporaryFolder() {
        if (::getpid() != maker_) return;  // a child of the test ends
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

    // The file, which is written with its folders.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        write_text(path_ / name, bytes);
        return path_ / name;
    }
    std::filesystem::path write_old(const std::string& name, std::string_view bytes) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        write_old_text(path_ / name, bytes);
        return path_ / name;
    }
    std::filesystem::path append(const std::string& name, std::string_view bytes) const {
        std::ofstream(path_ / name, std::ios::binary | std::ios::app)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
    ::pid_t maker_ = ::getpid();
};

}  // namespace grainreel::test
