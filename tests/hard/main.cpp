// The program hard_day [GROUP [CASE]] [--seed N] runs all groups, one group, or one case of it. With --turn N
// it runs all groups, the long ones with a part of their cases: each turn has the part that follows, so that
// many turns have them all.
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "tests/hard/group.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::hard {
namespace {

namespace fs = std::filesystem;

struct Wanted {
    std::string group;  // empty: all
    int number = -1;    // -1: all
    std::uint64_t seed = 1;
    std::optional<int> turn;
};

// The folder where problems are kept until somebody has looked at them.
fs::path kept_folder() {
    return fs::temp_directory_path() / "grainreel-hard";
}

class Run {
  public:
    Run(const Group& group, const Wanted& wanted, const fs::path& base)
        : group_(group), wanted_(wanted), base_(base) {}

    // Runs all cases. Returns whether all went well.
    bool all() {
        const auto started = std::chrono::steady_clock::now();
        std::thread other([this] { work(); });
        work();
        other.join();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
        std::string counts;
        int cases = problems_;
        for (const auto& [kind, count] : counts_) {
            counts += fmt::format(", {} {}", count, kind);
            cases += count;
        }
        fmt::print("{}: {} cases{}, {} problem{} ({:.0f} s)\n", group_.name, cases, counts, problems_,
                   problems_ == 1 ? "" : "s", took.count());
        std::fflush(stdout);
        return problems_ == 0;
    }

  private:
    void work() {
        int count = wanted_.group.empty() ? group_.when_all_run : 0;
        if (wanted_.turn && group_.in_a_turn > 0) count = group_.in_a_turn;
        if (count == 0) count = group_.cases;
        const int first = wanted_.turn.value_or(0) % group_.cases * count % group_.cases;
        for (int k; (k = next_++) < count;)
            if (const int number = (first + k) % group_.cases; wanted_.number < 0 || number == wanted_.number)
                one(number);
    }

    void one(int number) {
        const fs::path here = base_ / fmt::format("{}-{}", group_.name, number);
        fs::create_directories(here);
        Dice dice(wanted_.seed, group_.name, number);
        Outcome outcome;
        try {
            outcome = group_.run(number, dice, here);
        } catch (const std::exception& problem) {
            outcome.problem = fmt::format("the test itself failed: {}", problem.what());
        }
        const std::lock_guard lock(mutex_);
        if (outcome.problem.empty()) {
            ++counts_[outcome.kind];
        } else {
            ++problems_;
            const fs::path kept = kept_folder() / here.filename();
            std::error_code ignored;
            fs::remove_all(kept, ignored);
            fs::create_directories(kept.parent_path(), ignored);
            fs::copy(here, kept, fs::copy_options::recursive, ignored);
            fmt::print("{} {}: {}\n    kept in {}; again: ./test --hard \"{}\" {} --seed {}\n", group_.name,
                       number, outcome.problem, kept.string(), group_.name, number, wanted_.seed);
            std::fflush(stdout);
        }
        std::error_code ignored;
        fs::remove_all(here, ignored);
    }

    const Group& group_;
    const Wanted& wanted_;
    const fs::path& base_;
    std::atomic<int> next_ = 0;
    std::mutex mutex_;
    std::map<std::string, int> counts_;
    int problems_ = 0;
};

// Tries to get mounts that only this process sees and that end with it. Returns whether this is allowed.
bool may_mount() {
    return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

Wanted read_words(int count, char** words) {
    Wanted wanted;
    for (int i = 1; i < count; ++i) {
        if (std::strcmp(words[i], "--seed") == 0 && i + 1 < count)
            wanted.seed = std::stoull(words[++i]);
        else if (std::strcmp(words[i], "--turn") == 0 && i + 1 < count)
            wanted.turn = std::stoi(words[++i]);
        else if (wanted.group.empty())
            wanted.group = words[i];
        else
            wanted.number = std::stoi(words[i]);
    }
    return wanted;
}

int day(const Wanted& wanted) {
    const test::TemporaryFolder folder;
    const bool mounts = may_mount();  // asked before there are threads
    Ground ground = lay_ground(folder.path());
    if (mounts) ground.full = folder / "full";
    bool well = true, any = false;
    for (const Group& group :
         {damaged_trajectories(ground), mutated_scenes(ground), changed_continuations(ground),
          killed_runs(ground), resumed_runs(ground), full_disks(ground), random_scenes()}) {
        if (!wanted.group.empty() && wanted.group != group.name) continue;
        any = true;
        well = Run(group, wanted, folder.path()).all() && well;
    }
    if (!any) throw std::invalid_argument("no group " + wanted.group);
    return well ? 0 : 1;
}

}  // namespace
}  // namespace grainreel::hard

int main(int count, char** words) {
    try {
        return grainreel::hard::day(grainreel::hard::read_words(count, words));
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "hard_day: %s\n", problem.what());
        return 2;
    }
}
