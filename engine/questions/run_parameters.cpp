#include "engine/questions/run_parameters.hpp"

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/flat_toml.hpp"

namespace grainreel {

Answer parameters_answer(const StoredRun& run) {
    const std::filesystem::path folder = run.path(), scene = folder / "scene.toml";
    if (!is_plain(scene)) throw UserError("{}: has no scene.toml; ask a run's folder", folder.string());
    const RunJson record = read_run_json(folder / "run.json").record;
    AnswerTable table{
        "parameters", "Parameters", {{"key", Dimension::number, ""}, {"value", Dimension::number, ""}}, {}};
    const auto row = [&](const std::string& key, const std::string& value) {
        if (!value.empty()) table.rows.push_back({key, value});
    };
    row("program.version", record.version);
    row("program.commit", record.commit);
    row("program.compiler", record.compiler);
    if (record.settled) row("packing.settled", fmt::format("{:.6g}", *record.settled));
    for (const auto& [key, value] : flat_toml(load_scene_file(scene)))
        if (!key.starts_with("film.")) row(key, value);
    return {{std::move(table)}, {}};
}

}  // namespace grainreel
