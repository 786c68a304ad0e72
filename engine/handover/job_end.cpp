#include "engine/handover/job_end.hpp"

#include <fmt/format.h>
#include <fstream>
#include <sstream>

#include "engine/handover/decks.hpp"
#include "engine/handover/engine_job.hpp"

namespace grainreel {

namespace fs = std::filesystem;

std::string log_name(PeerEngine engine) {
    return fmt::format("log.{}", key_of(engine));
}

std::string output_name(PeerEngine engine) {
    return fmt::format("out.{}", key_of(engine));
}

namespace {

bool says(const fs::path& file, const std::string& words) {
    std::ifstream said(file);
    for (std::string line; std::getline(said, line);)
        if (line.find(words) != std::string::npos) return true;
    return false;
}

}  // namespace

JobEnd job_end(const fs::path& folder, const HandoverFacts& facts) {
    JobEnd end;
    std::ifstream said(folder / status_name);
    std::string first, second;
    std::getline(said, first);
    std::getline(said, second);
    end.begun = !first.empty();
    if (second.starts_with("job ")) end.job = second.substr(4);
    end.goes_on = end.job.ends_with(" continue");
    int status = 0;
    end.ended = static_cast<bool>(std::istringstream(first) >> status);
    if (!end.ended || status == 0) return end;
    // A killed engine loses what it had not written of its log, and prints the error to its output as well.
    for (const std::string& file : {log_name(facts.engine), output_name(facts.engine)}) {
        const std::string error = engine_error(folder / file, folder / deck_name(facts.engine));
        if (error.empty()) continue;
        end.failure = fmt::format("{} ended: {}", name_of(facts.engine), error);
        return end;
    }
    // Where a rank was killed, mpirun asks the others to end.
    if (status <= 128 && says(folder / output_name(facts.engine), "SIGINT/SIGTERM caught")) {
        end.failure = fmt::format("{} was asked to end by a signal", name_of(facts.engine));
        return end;
    }
    end.failure = status > 128 ? fmt::format("{} was ended by signal {}", name_of(facts.engine), status - 128)
                               : fmt::format("{} ended with exit status {}", name_of(facts.engine), status);
    end.failure += fmt::format("; its output is in {}", (folder / output_name(facts.engine)).string());
    return end;
}

std::string came_so_far(const fs::path& folder, const HandoverFacts& facts, double until, double wanted) {
    const JobEnd end = job_end(folder, facts);
    const std::string why = end.failure.empty() ? "" : end.failure + "; it";
    return fmt::format("{} has come to {:.4g} s of {:.4g} s; what there is is shown",
                       why.empty() ? name_of(facts.engine) : why, until, wanted);
}

}  // namespace grainreel
