// Makes the commands that run the members of a study. A command is the list of words after the program's
// name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/app/study/file/members.hpp"
#include "render/app/study/results/results.hpp"

namespace grainreel {

struct StudyFolder {
    std::filesystem::path path;  // the folder's absolute path

    // The path of the members' copy of the scene. They read a copy, so that editing the scene does not change
    // members that are still to be run.
    std::filesystem::path scene(const Study& study) const;

    // The path of the members' copy of a mesh or a path. Two files with the same name can lie beside each
    // other.
    std::filesystem::path copy_of(const MemberFile& file) const {
        return path / "meshes" / file.hash / std::filesystem::path(file.from).filename();
    }

    std::filesystem::path member(const Member& member) const { return path / "members" / member.name; }
    std::filesystem::path poster(const Member& member) const {
        return path / "posters" / (member.name + ".png");
    }
    std::filesystem::path charts() const { return path / "charts"; }
};

// Makes the folder with all that the commands need. Throws UserError when that cannot be done.
void make_study_folder(const Study& study, const std::vector<Member>& members, const StudyFolder& folder);

// The command that runs a member on one thread. Earlier files of the member are replaced.
std::vector<std::string> run_command(const Study& study, const Member& member, const StudyFolder& folder,
                                     bool film, bool cache);

// The command that draws the last frame of a complete member as its poster.
std::vector<std::string> poster_command(const Member& member, const MemberResult& result,
                                        const StudyFolder& folder);

}  // namespace grainreel
