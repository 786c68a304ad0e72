// What lies at hand for everybody who works on one run's folder.
#pragma once

#include <optional>

#include "engine/files/log.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/driver/first_failure.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/run/folder/listener.hpp"

namespace grainreel {

struct RunDesk {
    explicit RunDesk(RunListener& to) : listener(to) {}

    LoggingListener listener;
    std::optional<RunFolder> folder;  // once it is made
    std::optional<RunLog> log;        // once the folder is made
    RunRecord record;                 // run.json
    StageTimes times;
    Stopwatch watch;  // since the run began
    FirstFailure failure;
};

}  // namespace grainreel
