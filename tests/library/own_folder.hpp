// A folder of its own for each test, which is removed at the end.
#pragma once

#include <filesystem>
#include <string>

#include <unistd.h>

class OwnFolder {
  public:
    OwnFolder()
        : path_(std::filesystem::temp_directory_path() / ("library_test." + std::to_string(::getpid()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~OwnFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};
