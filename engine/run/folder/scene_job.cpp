#include "engine/run/folder/scene_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/counted.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/run/driver/also_exports.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

namespace {

Progress::Stage stage_of(const PackingProgress& packing) {
    switch (packing.stage) {
        case PackingProgress::Stage::growing:
            return Progress::Stage::growing;
        case PackingProgress::Stage::raining:
            return Progress::Stage::raining;
        case PackingProgress::Stage::settling:
            break;
    }
    return Progress::Stage::settling;
}

}  // namespace

SceneJob::SceneJob(const JobRequest& request, Listener& listener, const Scene& scene, const Plan& plan,
                   int threads)
    : FolderJob(request, listener), driver_(scene, plan, threads) {
    check_also(scene);
}

SceneJob::SceneJob(const JobRequest& request, Listener& listener, const Scene& scene, const Plan& plan,
                   ResumePoint point)
    : FolderJob(request, listener), driver_(scene, plan, std::move(point)) {
    check_also(scene);
}

SceneJob::SceneJob(const JobRequest& request, Listener& listener, const Scene& scene, const Plan& plan)
    : SceneJob(request, listener, scene, plan, engine_threads(scene)) {
    new_folder();
}

SceneJob::SceneJob(const JobRequest& request, Listener& listener, const Scene& scene, const Plan& plan,
                   ResumePoint point, std::shared_ptr<FolderLock> lock)
    : SceneJob(request, listener, scene, plan, std::move(point)) {
    go_on_in(std::move(lock), false);
}

void SceneJob::new_folder() {
    make_folder({driver_.scene().name, request_.base, request_.out, request_.force});
}

void SceneJob::go_on_in(std::shared_ptr<FolderLock> lock, bool hands_out) {
    make_folder({.name = driver_.scene().name, .out = request_.out, .goes_on = std::move(lock)});
    driver_.keep_former(desk_.folder->lock(), hands_out, desk_.record.version);
    mark_begun();
}

bool SceneJob::work() {
    describe();
    if (!driver_.packed() && !pack()) return false;
    mark_begun();
    start();
    vibrating_.emplace();
    const auto go_on = [this] {
        show_progress();
        tell_news();
        return desk_.listener.stop_signal() == 0;
    };
    while (next(go_on)) continue;
    tell_news();
    if (const auto warning = driver_.overlap_warning()) warn(*warning);
    return desk_.listener.stop_signal() == 0;
}

void SceneJob::describe() {
    const Scene& scene = driver_.scene();
    const Plan& plan = driver_.plan();
    std::vector<std::string> warnings = plan.warnings;
    for (std::string& warning : more_warnings()) warnings.push_back(std::move(warning));
    driver_.describe(desk_.record);
    begin_record(warnings);
    driver_.use_folder(desk_.folder->lock(), desk_.record.version, desk_.folder->previous());
    desk_.listener.detail(fmt::format("{}: {}, {} of {:.4g} s ({})", scene.file,
                                      counted(scene.grains(), "grain"), counted(plan.steps, "step"),
                                      plan.clock.step, plan.step_reason));
    desk_.listener.detail(threads_text());
}

std::string SceneJob::threads_text() const {
    return fmt::format("threads: engine {}", driver_.simulation().threads());
}

bool SceneJob::pack() {
    Stopwatch packing;
    const auto watcher = [&](const PackingProgress& now) {
        Progress progress;
        progress.stage = stage_of(now);
        progress.done = now.done;
        if (packing.seconds() > 0.5) {
            progress.particle_steps_per_second = static_cast<double>(now.steps) *
                                                 static_cast<double>(driver_.scene().grains()) /
                                                 packing.seconds();
        }
        progress.elapsed = desk_.watch.seconds();
        desk_.listener.progress(progress);
        return desk_.listener.stop_signal() == 0;
    };
    if (request_.keep_packings) driver_.keep_packings(*request_.keep_packings);
    if (!driver_.pack(watcher)) return false;
    if (const std::string found = driver_.found_packing_text(); !found.empty()) desk_.listener.info(found);
    desk_.listener.detail(driver_.packing_text());
    for (const std::string& warning : driver_.packing_warnings()) warn(warning);
    return true;
}

void SceneJob::tell_news() {
    const std::vector<std::string> lines = news();
    for (; told_ < lines.size(); ++told_) warn(lines[told_]);
}

void SceneJob::warn(const std::string& line) {
    desk_.listener.warning(line);
    desk_.record.warnings.push_back(line);
}

void SceneJob::show_progress() {
    const Plan& plan = driver_.plan();
    Progress progress;
    progress.stage = Progress::Stage::vibrating;
    progress.done = driver_.done();
    progress.time = plan.clock.time(driver_.simulation().step());
    progress.end = plan.clock.time(plan.steps);
    progress.particle_steps_per_second = driver_.recent_speed();
    add_progress(progress);
    progress.elapsed = desk_.watch.seconds();
    const double vibrating = vibrating_->seconds();
    if (progress.done > 0 && vibrating > 1)
        progress.remaining = vibrating * (1 - progress.done) / progress.done;
    desk_.listener.progress(progress);
}

void SceneJob::side_work_closed() {
    if (!driver_.has_other_formats()) return;
    const Stopwatch writing;
    const std::string written =
        write_also(folder(), driver_.scene(),
                   [&](const std::string& format, double done) { return tell_export(format, done); });
    desk_.times.add("writing other formats", writing.seconds());
    if (!written.empty()) desk_.listener.info(fmt::format("wrote {}: {}", folder().string(), written));
    if (desk_.listener.in_a_hurry())
        desk_.listener.info(fmt::format(
            "{}: not all formats of output.also were written; `export` writes them", folder().string()));
}

void SceneJob::conclude() {
    driver_.conclude(desk_.record);
    desk_.record.wall_seconds = driver_.times().all();
}

std::string SceneJob::stopped_text() const {
    return fmt::format("stopped at {:.2f} of {:.2f} s", desk_.record.simulated,
                       driver_.plan().clock.time(driver_.plan().steps));
}

void SceneJob::report_written() {
    desk_.listener.info(fmt::format("wrote {}: {}{}, log.txt{}", folder().string(), side_files_text(),
                                    driver_.files_text(), page_text()));
    report_segregation();
    desk_.listener.info(
        fmt::format("took {}: packing {}, engine {} ({:.1f} M particle-steps/s){}",
                    duration_text(desk_.watch.seconds()), duration_text(driver_.times().of("packing")),
                    duration_text(driver_.times().of("engine")), driver_.speed() * 1e-6, side_times_text()));
}

void SceneJob::report_segregation() {
    const Scene& scene = driver_.scene();
    const RunFiles& files = *driver_.files();
    if (scene.species.size() < 2 || !files.last_measures()) return;
    const LateMeans& late = files.late_measures();
    const std::string text = segregation_text(scene, *files.first_measures(), late.means(), late.over());
    if (!text.empty()) desk_.listener.info(text);
}

namespace {

// Lacey's index and that of unlike neighbours are 0 when segregated and 1 when mixed. They disagree if they
// are farther apart than this.
constexpr double wide_apart = 0.25;

}  // namespace

std::string segregation_text(const Scene& scene, const Measures& from, const Measures& to,
                             const std::string& over) {
    const BigAndSmall kinds = big_and_small(scene.species);
    const std::string &big = scene.species[kinds.big].name, &small = scene.species[kinds.small].name;
    std::vector<std::string> parts;
    const auto say = [&](const std::string& what, const char* column, const char* meaning, bool sign) {
        const double first = from.at(column), last = to.at(column);
        if (!std::isfinite(first) || !std::isfinite(last)) return;
        const auto number = [&](double value) {
            return sign ? fmt::format("{:+.2f}", value) : fmt::format("{:.2f}", value);
        };
        parts.push_back(fmt::format("{} from {} to {}{}", what, number(first), number(last), meaning));
    };
    say(fmt::format("mean height of {} minus {}, divided by the bed's height,", big, small),
        "height_difference", "", true);
    say(fmt::format("probability that {} lies above {}", big, small), "big_above_small", " (1/2 is mixed)",
        false);
    say("unlike neighbours, divided by what chance gives,", "unlike_neighbours", " (1 is mixed)", false);
    say("Lacey mixing index", "lacey", " (1 is mixed)", false);
    if (parts.empty()) return "";
    const bool differ = std::abs(to.at("unlike_neighbours") - to.at("lacey")) > wide_apart;
    return fmt::format("segregation, from the start to the mean over {}: {}{}", over, fmt::join(parts, "; "),
                       differ ? "; neighbours and samples of 32 grains disagree on how mixed it is" : "");
}

}  // namespace grainreel
