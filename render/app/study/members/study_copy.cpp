// The copy of a study in its own folder: study.toml, its scene, and the files that both name.
#include "render/app/study/members/runner.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <algorithm>

#include "engine/base/plain_file.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/app/study/results/drawing.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

// The place in the text that a position of toml++ means; its columns count letters, not bytes.
std::size_t place_of(const std::string& text, const toml::source_position& at) {
    std::size_t place = 0;
    for (toml::source_index line = 1; line < at.line; ++line) place = text.find('\n', place) + 1;
    for (toml::source_index column = 1; column < at.column && place < text.size(); ++column) {
        ++place;
        while (place < text.size() && (static_cast<unsigned char>(text[place]) & 0xC0) == 0x80) ++place;
    }
    return place;
}

// Other words for a value of the study's file.
struct Replacement {
    std::size_t begin, end;
    std::string words;
};

Replacement other_words(const std::string& text, const toml::node& value, const fs::path& path) {
    return {place_of(text, value.source().begin), place_of(text, value.source().end),
            quoted(path.generic_string())};
}

fs::path reference_of(const StudyChart& chart) {
    return fs::path("references") / (chart_stem(chart) + ".csv");
}

// The study's text with paths that lead to the copies, and with its title: without one, it would be called
// after its file.
std::string text_of_copy(const Study& study, const fs::path& scene) {
    const toml::table table = toml::parse(study.text);
    std::vector<Replacement> all{other_words(study.text, *table.get("scene"), scene)};
    for (std::size_t i = 0; i < study.charts.size(); ++i)
        if (const toml::node* file = table["chart"][i]["reference"].node())
            all.push_back(other_words(study.text, *file, reference_of(study.charts[i])));
    std::sort(all.begin(), all.end(),
              [](const Replacement& a, const Replacement& b) { return a.begin > b.begin; });
    std::string text = study.text;
    for (const Replacement& one : all) text.replace(one.begin, one.end - one.begin, one.words);
    return table.contains("title") ? text : fmt::format("title = {}\n{}", quoted(study.title), text);
}

// Where a file that the scene names lies beside the scene's copy, so that the same path leads to it. Empty
// where the path is absolute in the scene, or leads out of the study's folder.
fs::path beside_copy(const Study& study, const fs::path& from, const StudyFolder& folder) {
    const fs::path scenes = fs::absolute(study.scene).parent_path().lexically_normal();
    const fs::path relative = fs::absolute(from).lexically_normal().lexically_relative(scenes);
    const fs::path copy = (folder.scene(study).parent_path() / relative).lexically_normal();
    const fs::path inside = copy.lexically_relative(folder.path);
    return relative.empty() || inside.empty() || *inside.begin() == ".." ? fs::path() : copy;
}

void copy_files(const Study& study, const std::vector<Member>& members, const StudyFolder& folder) {
    std::error_code ignored;
    for (const Member& member : members) {
        for (const MemberFile& file : member.files) {
            const fs::path copy = beside_copy(study, file.from, folder);
            if (!copy.empty() && !fs::equivalent(file.from, copy, ignored))
                keep_file(file.from, file.hash, copy);
        }
        if (member.start_file.empty() || !fs::is_regular_file(member.start_file, ignored)) continue;
        const fs::path copy = beside_copy(study, member.start_file, folder);
        if (copy.empty() || fs::equivalent(member.start_file, copy, ignored)) continue;
        fs::create_directories(copy.parent_path(), ignored);
        fs::copy_file(member.start_file, copy, fs::copy_options::overwrite_existing, ignored);
    }
}

}  // namespace

void write_study_copy(const Study& study, const std::vector<Member>& members, const StudyFolder& folder) {
    const fs::path scene = folder.scene(study);
    std::error_code ignored;
    for (const StudyChart& chart : study.charts) {
        if (!chart.reference) continue;
        fs::create_directories(folder.path / "references", ignored);
        replace_file(folder.path / reference_of(chart), chart.reference_text);
    }
    replace_file(scene, study.scene_text);
    copy_files(study, members, folder);
    replace_file(folder.path / "study.toml", text_of_copy(study, scene.lexically_relative(folder.path)));
}

}  // namespace grainreel
