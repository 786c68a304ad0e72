#include "render/app/study/members/runner.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <xxhash.h>
#include <algorithm>
#include <cstdlib>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/driver/pace.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/app/study/members/child.hpp"

namespace grainreel {
namespace {

using Status = MemberResult::Status;
using Json = nlohmann::json;

constexpr const char* kCheckpointName = "checkpoint.grs";
constexpr int poll_interval = 200;     // ms
constexpr double packing_share = 0.1;  // share of a member's cost that the progress line assumes for packing

struct Job {
    std::size_t member = 0;
    bool is_poster = false;
    bool anew = false;  // even if the member has a checkpoint
};

struct Running {
    Job job;
    bool goes_on = false;  // from a checkpoint
    Child child;
    double done = 0;         // 0 to 1
    std::string last_error;  // the last error that it has told
};

class Runner {
  public:
    Runner(const Study& study, const std::vector<Member>& members, const StudyFolder& folder,
           const StudyRequest& request, std::vector<MemberResult>& results, Listener& listener,
           const std::function<void()>& gained)
        : study_(study),
          members_(members),
          folder_(folder),
          request_(request),
          results_(results),
          listener_(listener),
          gained_(gained) {
        plan_jobs();
    }

    void run() {
        while (!running_.empty() || (!jobs_.empty() && !stopping())) {
            while (!stopping() && !jobs_.empty() && running_.size() < static_cast<std::size_t>(request_.jobs))
                start();
            if (stopping() && !told_to_stop_) tell_to_stop();
            wait();
            show_progress();
        }
    }

  private:
    bool stopping() const { return listener_.stop_signal() != 0; }
    double cost(std::size_t member) const { return request_.cost.empty() ? 1 : request_.cost[member]; }

    bool wants_poster(std::size_t member) const {
        return request_.posters && members_[member].seed_index == 0 &&
               results_[member].status == Status::complete &&
               !std::filesystem::exists(folder_.member(members_[member]) / "poster.png") &&
               !std::filesystem::exists(folder_.poster(members_[member])) &&
               std::filesystem::exists(folder_.member(members_[member]) / "trajectory.nc");
    }

    // Puts the first seed of all settings before the second seeds, so that the charts have their shape early.
    void plan_jobs() {
        std::vector<std::size_t> order(members_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return members_[a].seed_index < members_[b].seed_index;
        });
        for (const std::size_t member : order) {
            if (!request_.collect_only && is_pending(member, results_[member], request_)) {
                jobs_.push_back({member, false});
                cost_left_ += cost(member);
            } else if (wants_poster(member)) {
                jobs_.push_back({member, true});
            }
        }
        cost_planned_ = cost_left_;
    }

    void start() {
        const Job job = jobs_.front();
        jobs_.pop_front();
        const Member& member = members_[job.member];
        const bool goes_on = !job.is_poster && !job.anew && can_go_on(job.member);
        std::vector<std::string> words =
            job.is_poster ? poster_command(member, results_[job.member], folder_)
            : goes_on     ? go_on_command(member, folder_)
                          : run_command(study_, member, folder_, request_.films, request_.cache);
        words.insert(words.end(), {"--progress", "json"});
        running_.push_back({job, goes_on, Child(words), 0, ""});
    }

    // Whether the member was stopped, or was shorter, and left a checkpoint.
    bool can_go_on(std::size_t member) const {
        return !request_.films && results_[member].status == Status::incomplete &&
               is_there(folder_.member(members_[member]) / kCheckpointName);
    }

    void tell_to_stop() {
        told_to_stop_ = true;
        jobs_.clear();
        listener_.info(fmt::format("stopping in good order: {}", counted(running_.size(), "member")));
        for (const Running& one : running_) one.child.send(SIGTERM);
    }

    void wait() {
        std::vector<pollfd> files;
        for (const Running& one : running_) files.push_back({one.child.file(), POLLIN, 0});
        ::poll(files.data(), files.size(), poll_interval);
        for (Running& one : running_)
            for (const std::string& line : one.child.read()) listen(one, line);
        for (std::size_t i = 0; i < running_.size();) {
            if (!running_[i].child.ended()) {
                ++i;
                continue;
            }
            const Running ended = std::move(running_[i]);
            running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
            take(ended);
        }
    }

    // Takes a line of the member's stderr: an event of --progress json, or an error in words.
    static void listen(Running& one, const std::string& line) {
        const Json event = Json::parse(line, nullptr, false);
        if (!event.is_object()) {
            one.last_error = line;
            return;
        }
        const std::string kind = event.value("event", "");
        if (kind == "error") one.last_error = event.value("text", "");
        if (kind != "progress" || one.job.is_poster) return;
        const double done = event.value("done", 0.0);
        const std::string stage = event.value("stage", "");
        if (stage == "vibrating") one.done = packing_share + (1 - packing_share) * done;
    }

    void take(const Running& ended) {
        const std::size_t index = ended.job.member;
        if (ended.job.is_poster) return take_poster(ended);
        const int status = ended.child.status();
        if (ended.goes_on && status != 0 && !stopping()) {  // its checkpoint is of no use
            jobs_.push_front({index, false, true});
            return;
        }
        cost_left_ -= cost(index);
        MemberResult& result = results_[index];
        result = read_result(folder_.member(members_[index]), study_.measures, members_[index].steps);
        if (stopping() && result.status != Status::complete) return;
        if (status != 0) {
            result.status = Status::failed;
            if (result.error.empty()) result.error = ended.last_error;
            if (result.error.empty())
                result.error = status > 128 ? fmt::format("was ended by signal {}", status - 128)
                                            : fmt::format("ended with status {}", status);
            listener_.error(fmt::format("{}: {}", member_text(study_, members_[index]), result.error));
        }
        if (wants_poster(index)) jobs_.push_front({index, true});
        gained_();
    }

    void take_poster(const Running& ended) {
        if (ended.child.status() == 0 || stopping()) return;
        listener_.warning(fmt::format("{}: no poster: {}", member_text(study_, members_[ended.job.member]),
                                      ended.last_error));
    }

    void show_progress() {
        const auto in = [&](Status status) {
            return std::count_if(results_.begin(), results_.end(),
                                 [&](const auto& r) { return r.status == status; });
        };
        double done = cost_planned_ - cost_left_;
        for (const Running& one : running_)
            if (!one.job.is_poster) done += one.done * cost(one.job.member);
        Progress progress;
        progress.stage = Progress::Stage::studying;
        progress.done = cost_planned_ > 0 ? std::min(1.0, done / cost_planned_) : 1;
        progress.what = fmt::format("{} of {}, {} running", in(Status::complete),
                                    counted(results_.size(), "member"), running_.size());
        if (const auto failed = in(Status::failed); failed > 0)
            progress.what += fmt::format(", {} failed", failed);
        progress.elapsed = watch_.seconds();
        constexpr double soon = 0.02;  // share of the work from which the time left can be estimated
        if (progress.done > soon) progress.remaining = progress.elapsed * (1 - progress.done) / progress.done;
        listener_.progress(progress);
    }

    const Study& study_;
    const std::vector<Member>& members_;
    const StudyFolder& folder_;
    const StudyRequest& request_;
    std::vector<MemberResult>& results_;
    Listener& listener_;
    const std::function<void()>& gained_;
    std::deque<Job> jobs_;
    std::vector<Running> running_;
    Stopwatch watch_;
    double cost_planned_ = 0, cost_left_ = 0;
    bool told_to_stop_ = false;
};

}  // namespace

bool is_pending(std::size_t member, const MemberResult& result, const StudyRequest& request) {
    if (!request.wanted.empty() && !request.wanted[member]) return false;
    switch (result.status) {
        case Status::complete:
            return request.films && !result.has_film;
        case Status::failed:
            return request.retry;
        case Status::missing:
        case Status::incomplete:
            break;
    }
    return true;
}

void run_members(const Study& study, const std::vector<Member>& members, const StudyFolder& folder,
                 const StudyRequest& request, std::vector<MemberResult>& results, Listener& listener,
                 const std::function<void()>& gained) {
    Runner(study, members, folder, request, results, listener, gained).run();
}

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
        throw UserError("{}: cannot be made ({}); give another --out", folder.path.string(),
                        failure.message());
    write_study_copy(study, members, folder);
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
    // Members keep no checkpoints, since their moments are not brought back: a member is rather run again. A
    // value that the study sets comes later and overrides this.
    for (const char* word : {"--set", "output.checkpoints=none"}) words.emplace_back(word);
    for (const Assignment& assignment : member.sets) {
        words.push_back("--set");
        words.push_back(assignment.text);
    }
    for (const Assignment& assignment : member.framing) {
        words.push_back("--set");
        words.push_back(assignment.text);
    }
    for (const MemberFile& file : member.files) {
        words.push_back("--set");
        words.push_back(file.key + "=" + quoted(folder.copy_of(file).string()));
    }
    return words;
}

std::vector<std::string> go_on_command(const Member& member, const StudyFolder& folder) {
    return {"resume",    folder.member(member).string(),
            "--until",   fmt::format("{} s", member.duration),
            "--no-film", "--no-report",
            "--threads", "1"};
}

std::vector<ShorterRun> shorter_runs(const std::vector<Member>& members, const StudyFolder& folder) {
    std::set<std::string> members_of_study;
    std::map<std::string, std::size_t> by_stem;  // members that have no folder yet
    std::error_code none;
    for (std::size_t m = 0; m < members.size(); ++m) {
        members_of_study.insert(members[m].name);
        if (!is_there(folder.member(members[m]))) by_stem.emplace(members[m].stem, m);
    }
    std::map<std::size_t, std::pair<double, std::filesystem::path>> longest;  // duration and folder
    for (const auto& entry : std::filesystem::directory_iterator(folder.path / "members", none)) {
        const std::string name = entry.path().filename().string();
        const std::size_t end = name.rfind('_');
        const auto member = by_stem.find(name.substr(0, end));
        if (end == std::string::npos || member == by_stem.end() || members_of_study.count(name) > 0) continue;
        const double duration = std::strtod(name.c_str() + end + 1, nullptr);
        if (!(duration > 0) || duration >= members[member->second].duration) continue;
        const ReadRunJson record = read_run_json(entry.path() / "run.json");
        const bool complete = record.fault.empty() && record.record.status == RunStatus::complete;
        auto& best = longest[member->second];
        if (complete && is_there(entry.path() / kCheckpointName) && duration > best.first)
            best = {duration, entry.path()};
    }
    std::vector<ShorterRun> runs;
    for (const auto& [member, best] : longest)
        if (best.first > 0) runs.push_back({member, best.second});
    return runs;
}

std::vector<std::string> poster_command(const Member& member, const MemberResult& result,
                                        const StudyFolder& folder) {
    return {"render", folder.member(member).string(), "--at",    fmt::format("{}", result.simulated),
            "--out",  folder.poster(member).string(), "--force", "--threads",
            "1"};
}

}  // namespace grainreel
