// What a film needs beside itself while it is made: a folder next to it that goes with the writer. Another
// folder that has got its name meanwhile is left alone.
#pragma once

#include <sys/stat.h>

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

class WorkFolder {
  public:
    // Throws RunError.
    explicit WorkFolder(const std::filesystem::path& film) : path_(film.parent_path() / "movie.work") {
        const std::error_code error = make_plain_folder(path_);
        if (error)
            throw RunError(fmt::format("{}: cannot make the folder: {}", path_.string(), error.message()));
        made_ = identity();
    }
    ~WorkFolder() {
        if (!kept_) remove();
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    std::filesystem::path file(const char* name) const { return path_ / name; }
    // From now on it stays, since it holds the only copy of the film; until remove().
    void keep() { kept_ = true; }
    void remove() {
        std::error_code ignored;
        if (identity() == made_) std::filesystem::remove_all(path_, ignored);
        kept_ = true;
    }

  private:
    // Device and number of what has the name now; zeros for nothing.
    std::pair<dev_t, ino_t> identity() const {
        struct stat named {};
        return ::stat(path_.c_str(), &named) == 0 ? std::pair(named.st_dev, named.st_ino)
                                                  : std::pair<dev_t, ino_t>();
    }

    std::filesystem::path path_;
    std::pair<dev_t, ino_t> made_;
    bool kept_ = false;
};

}  // namespace grainreel
