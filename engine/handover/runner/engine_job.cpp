#include "engine/handover/runner/engine_job.hpp"

#include <fmt/format.h>

#include "engine/handover/runner/engine_words.hpp"

namespace grainreel {

EngineJob::EngineJob(PeerEngine engine, int ranks, const std::string& deck, const std::string& restart)
    : engine_(engine),
      deck_(deck),
      program_(find_engine(engine)),
      ranks_(rank_words(engine, program_, deck, ranks)) {
    if (!restart.empty())
        for (const char* word : {"-var", "goes_on", "1", "-var", "restart", restart.c_str()})
            ranks_.words.emplace_back(word);
}

std::string EngineJob::command() const {
    std::string text;
    for (const std::string& word : ranks_.words) text += (text.empty() ? "" : " ") + word;
    return text;
}

void EngineJob::start(const std::filesystem::path& folder) {
    folder_ = folder;
    process_ = std::make_unique<GuardedProcess>(ranks_.words, folder, folder / kOutput);
}

bool EngineJob::is_running() {
    return process_ && !process_->status();
}

std::string EngineJob::failure() {
    const std::string said = engine_error(folder_ / kOutput, folder_ / deck_);
    if (!said.empty()) return fmt::format("{} ended: {}", name_of(engine_), said);
    const int status = process_->status().value_or(0);
    if (status == 0) return "";
    if (status > 128)
        return fmt::format("{} was ended by signal {}; its output is in {}", name_of(engine_), status - 128,
                           (folder_ / kOutput).string());
    return fmt::format("{} ended with exit status {}; its output is in {}", name_of(engine_), status,
                       (folder_ / kOutput).string());
}

}  // namespace grainreel
