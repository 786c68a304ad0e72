#include "render/app/study/members/member_commands.hpp"

#include <xxhash.h>

#include <set>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {

std::filesystem::path StudyFolder::scene(const Study& study) const {
    const auto hash = XXH64(study.scene_text.data(), study.scene_text.size(), 0);
    return path / "scenes" / fmt::format("{:016x}", hash) / study.scene.filename();
}

namespace {

void keep_files(const std::vector<Member>& members, const StudyFolder& folder) {
    std::set<std::filesystem::path> kept;
    for (const Member& member : members) {
        for (const MemberFile& file : member.files) {
            const std::filesystem::path copy = folder.copy_of(file);
            if (!kept.insert(copy).second) continue;
            std::error_code ignored;
            std::filesystem::create_directories(copy.parent_path(), ignored);
            keep_file(file.from, file.hash, copy);
        }
    }
}

}  // namespace

void make_study_folder(const Study& study, const std::vector<Member>& members, const StudyFolder& folder) {
    const std::filesystem::path scene = folder.scene(study);
    std::error_code failure;
    for (const auto& wanted : {folder.path / "members", folder.path / "posters", scene.parent_path()})
        if (!failure) std::filesystem::create_directories(wanted, failure);
    if (failure)
        throw UserError(fmt::format("{}: cannot be made ({}); give another --out", folder.path.string(),
                                    failure.message()));
    replace_file(folder.path / "study.toml", study.text);
    replace_file(scene, study.scene_text);
    keep_files(members, folder);
}

std::vector<std::string> run_command(const Study& study, const Member& member, const StudyFolder& folder,
                                     bool film, bool cache) {
    std::vector<std::string> words{"movie",   folder.scene(study).string(),
                                   "--out",   folder.member(member).string(),
                                   "--force", "--threads",
                                   "1",       "--no-report"};
    if (!film) words.push_back("--no-film");
    if (!cache) words.push_back("--no-cache");
    // Members get no checkpoints, since they are run again rather than brought back. A value that the study
    // sets comes later and overrides this.
    for (const char* word : {"--set", "output.checkpoints=none"}) words.emplace_back(word);
    for (const Assignment& assignment : member.sets) {
        words.push_back("--set");
        words.push_back(assignment.text);
    }
    for (const MemberFile& file : member.files) {
        words.push_back("--set");
        words.push_back(file.key + "=" + quoted(folder.copy_of(file).string()));
    }
    return words;
}

std::vector<std::string> poster_command(const Member& member, const MemberResult& result,
                                        const StudyFolder& folder) {
    return {"render", folder.member(member).string(), "--at",    fmt::format("{}", result.simulated),
            "--out",  folder.poster(member).string(), "--force", "--threads",
            "1"};
}

}  // namespace grainreel
