// Runs the members of a study side by side, each as a process of its own on one thread. Also makes the
// commands that run them and the folder of the study.
//
// There are processes and not threads for three reasons: a member that runs out of memory or meets a bug ends
// alone; the NetCDF library, which writes the trajectories, is not made for several threads; and a cluster
// can get the same commands that run here (--print-commands). A process costs a tenth of a second, and a
// member takes seconds at least. Both ways reach the same speed (docs/notes/performance.md#studies).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/run/folder/listener.hpp"
#include "render/app/study/file/members.hpp"
#include "render/app/study/results/results.hpp"

namespace grainreel {

// The folder of a study, with the paths in it.
struct StudyFolder {
    std::filesystem::path path;  // the folder's absolute path

    // Where the copy of the scene lies that members read. Since it is a copy, editing the scene does not
    // change members that are still to be run.
    std::filesystem::path scene(const Study& study) const;

    // Where the copy of a file of a mesh or path lies for the members. Files with the same name and other
    // contents lie in folders of their own.
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

// Writes the study's copy in its folder (study_copy.cpp): study.toml, its scene, and the files that both
// name. It is a study as it stands, so whoever has the folder and the program can run it again. Throws
// RunError when that cannot be done.
void write_study_copy(const Study& study, const std::vector<Member>& members, const StudyFolder& folder);

// The next two functions make commands as lists of the words after the program's name. This one runs a member
// on one thread; earlier files of the member are replaced.
std::vector<std::string> run_command(const Study& study, const Member& member, const StudyFolder& folder,
                                     bool film, bool cache);

// A complete run that is a member's but for its end, which came earlier.
struct ShorterRun {
    std::size_t member = 0;
    std::filesystem::path folder;
};
// The longest of these for each member that has not been run. Runs that are members of the study themselves
// are left alone.
std::vector<ShorterRun> shorter_runs(const std::vector<Member>& members, const StudyFolder& folder);

// The command by which a member goes on from its checkpoint to its end.
std::vector<std::string> go_on_command(const Member& member, const StudyFolder& folder);

// The command that draws the last frame of a complete member as its poster.
std::vector<std::string> poster_command(const Member& member, const MemberResult& result,
                                        const StudyFolder& folder);

struct StudyRequest {
    int jobs = 1;  // members at a time
    bool films = false;
    bool cache = true;          // members take packings from the user's cache folder, and keep theirs
    bool retry = false;         // run failed members again
    bool posters = true;        // make posters of the first seed of each setting
    bool collect_only = false;  // run no members; make posters only
    std::vector<bool> wanted;   // for each member, whether it may be run; empty: all may
    std::vector<double> cost;  // for each member, its cost in any unit, from which the time left is estimated
};

// Whether the member with that number is still to be run.
bool is_pending(std::size_t member, const MemberResult& result, const StudyRequest& request);

// Runs the members that are pending, the first seed of all settings first. results: for each member, what is
// on disk; it is brought up to date when the member ends. `gained` is called after each member that was not
// stopped. Returns when all are done, or once the listener has a stop signal and the running members have
// ended in good order.
void run_members(const Study& study, const std::vector<Member>& members, const StudyFolder& folder,
                 const StudyRequest& request, std::vector<MemberResult>& results, Listener& listener,
                 const std::function<void()>& gained);

}  // namespace grainreel
