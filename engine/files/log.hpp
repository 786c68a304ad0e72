// log.txt: every message of a run with its time. Each line is on disk when the call returns. A full disk
// costs lines of the log but never ends the run.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace grainreel {

class RunLog {
  public:
    // goes_on: new lines follow those of an existing file. Throws RunError when the file cannot be made.
    explicit RunLog(const std::filesystem::path& path, bool goes_on = false);
    ~RunLog();

    void info(const std::string& message);
    void warning(const std::string& message);
    void error(const std::string& message);

  private:
    std::unique_ptr<spdlog::logger> logger_;
};

}  // namespace grainreel
