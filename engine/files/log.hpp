// log.txt: every message of a run with its time. Each line is on disk when the call returns; a full disk
// costs the log its lines, never the run.
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
    // Throws RunError when the file cannot be made.
    // goes_on: behind what is there already.
    explicit RunLog(const std::filesystem::path& path, bool goes_on = false);
    ~RunLog();

    void info(const std::string& message);
    void warning(const std::string& message);
    void error(const std::string& message);

  private:
    std::unique_ptr<spdlog::logger> logger_;
};

}  // namespace grainreel
