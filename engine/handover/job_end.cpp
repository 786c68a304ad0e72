#include "engine/handover/job_end.hpp"

#include <fmt/format.h>
#include <csignal>
#include <fstream>

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
    int status = 0;
    end.ended = static_cast<bool>(std::ifstream(folder / status_name) >> status);
    if (!end.ended || status == 0) return end;
    // A killed engine loses what it had not written of its log, and prints the error to its output as well.
    for (const std::string& file : {log_name(facts.engine), output_name(facts.engine)}) {
        const std::string said = engine_error(folder / file, folder / deck_name(facts.engine));
        if (said.empty()) continue;
        end.failure = fmt::format("{} ended: {}", name_of(facts.engine), said);
        return end;
    }
    // Where a rank was killed, mpirun asks the others to end.
    const bool asked = status == 128 + SIGTERM || status == 128 + SIGINT || status == 128 + SIGHUP;
    if (asked || (status <= 128 && says(folder / output_name(facts.engine), "SIGINT/SIGTERM caught"))) {
        end.failure = fmt::format("{} was asked to end by a signal (Ctrl-C, scancel or a time limit)",
                                  name_of(facts.engine));
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
