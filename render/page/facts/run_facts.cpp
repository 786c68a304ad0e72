#include "render/page/facts/run_facts.hpp"

#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/files/folder_lock.hpp"
#include "engine/files/run_json.hpp"
#include "render/page/embed.hpp"

namespace grainreel {
namespace {

using Json = nlohmann::json;

// Members one inside the other; null where there is none.
const Json* member(const Json& record, std::initializer_list<const char*> path) {
    const Json* at = &record;
    for (const char* name : path) {
        if (!at->is_object()) return nullptr;
        const auto found = at->find(name);
        if (found == at->end()) return nullptr;
        at = &*found;
    }
    return at;
}

// The words for a text, a number or a truth; empty for anything else.
std::string text_of(const Json* value) {
    if (value == nullptr || value->is_structured() || value->is_null()) return "";
    return value->is_string() ? value->get<std::string>() : value->dump();
}

// fault: what is wrong with the file, if something is.
Json parsed(const std::filesystem::path& path, std::string& fault) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        fault = path.string() + ": is missing";
        return {};
    }
    try {
        const std::vector<std::uint8_t> bytes = read_bytes(path);
        const bool may_throw = false;
        Json record = Json::parse(bytes.begin(), bytes.end(), nullptr, may_throw);
        if (record.is_discarded())
            fault = path.string() + ": is damaged, for it is no JSON";
        else if (!record.is_object() || !record.contains("status"))
            fault = path.string() + ": is no record of a run";
        return record;
    } catch (const RunError& problem) {
        fault = problem.what();
        return {};
    }
}

}  // namespace

RunFacts run_facts(const std::filesystem::path& folder) {
    RunFacts facts;
    const Json record = parsed(folder / "run.json", facts.fault);
    const auto text = [&](std::initializer_list<const char*> path) { return text_of(member(record, path)); };
    facts.status = text({"status"}).empty() ? "unknown" : text({"status"});
    if (lacks_only_page(folder / "run.json")) facts.status = "complete";
    if (facts.status == "running" && !FolderLock::holder(folder)) facts.status = "broken off";
    facts.error = text({"error"});
    facts.version = text({"program", "version"});
    facts.commit = text({"program", "commit"});
    facts.finished = text({"finished"}).empty() ? text({"started"}) : text({"finished"});
    facts.state_hash = text({"engine", "state_hash"});
    const Json* frames = member(record, {"written", "film_frames"});
    if (frames != nullptr && frames->is_number_integer()) facts.film_frames = frames->get<std::int64_t>();
    const Json* kept = member(record, {"written", "trajectory_frames"});
    if (kept != nullptr && kept->is_number_integer()) facts.trajectory_frames = kept->get<std::int64_t>();
    const Json* rows = member(record, {"written", "measures_rows"});
    if (rows != nullptr && rows->is_number_integer()) facts.measures_rows = rows->get<std::int64_t>();
    const auto line = [&](const char* name, const std::string& words) {
        if (!words.empty()) facts.lines.emplace_back(name, words);
    };
    line("status", facts.status);
    line("error", text({"error"}));
    line("command", text({"command"}));
    line("scene file", text({"scene"}));
    line("program", "grainreel " + facts.version + (facts.commit.empty() ? "" : ", commit " + facts.commit));
    line("compiler", text({"program", "compiler"}));
    line("seed", text({"engine", "seed"}));
    line("step (s)", text({"engine", "step_s"}));
    line("steps", text({"engine", "steps"}));
    line("engine threads", text({"threads", "engine"}));
    line("vector instructions", text({"engine", "vector"}));
    line("hash of the end state", facts.state_hash);
    line("started", text({"started"}));
    line("finished", text({"finished"}));
    line("film encoded by", text({"encoder"}));
    line("film drawn by", text({"gl"}));
    const Json* warnings = member(record, {"warnings"});
    if (warnings != nullptr && warnings->is_array())
        for (const Json& warning : *warnings)
            if (warning.is_string()) facts.warnings.push_back(warning.get<std::string>());
    return facts;
}

}  // namespace grainreel
